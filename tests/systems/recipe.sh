#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Builds and tries the container of the Dockerfile, from the committed sources, where there is no registry and no daemon: recipe.sh 12|13 FOLDER
#
# Needs the Debian packages buildah and debootstrap. FOLDER gets everything: an empty system (debootstrap), which is the image `debian:12` or
# `debian:13` that the recipe begins with, and the images that buildah makes. Steps run in a chroot, so that it works inside a container,
# too. Then the entry point of the image runs a scene into a folder from outside, and mpirun one on two ranks. With CCACHE_DIR set, that
# compiler cache is used, with MYOLINES_JOBS so many jobs. Stops at the first step that fails and says which; exit code 1.
set -euo pipefail

if [ $# -ne 2 ]; then
  echo "usage, as root: recipe.sh 12|13 FOLDER" >&2
  exit 2
fi
source "$(dirname "$(readlink -f "$0")")/system.sh"
release=$1
folder=$(realpath -m "$2")
finish_with "$folder/base"
storage=(buildah --root "$folder/storage" --runroot "$folder/run" --storage-driver vfs)
mkdir -p "$folder"

begin "an empty Debian $release as the image debian:$release"
make_system "$folder/base"
if ! "${storage[@]}" inspect --type image "debian:$release" >/dev/null 2>&1; then
  base=$("${storage[@]}" from scratch)
  "${storage[@]}" add -q "$base" "$folder/base" / >/dev/null
  "${storage[@]}" commit -q --rm "$base" "debian:$release"
fi

begin "the recipe"
rm -rf "$folder/sources" && mkdir "$folder/sources"
git -C "$repository" archive HEAD | tar -x -C "$folder/sources"
"${storage[@]}" bud --isolation chroot --pull-never --build-arg "DEBIAN=$release" -t myolines ${CCACHE_DIR:+-v "$CCACHE_DIR:/root/.cache/ccache"} \
  ${MYOLINES_JOBS:+--env "MYOLINES_JOBS=$MYOLINES_JOBS"} "$folder/sources"

begin "the container"
rm -rf "$folder/work" && mkdir "$folder/work"
container=$("${storage[@]}" from --pull-never myolines)
in_container() {
  "${storage[@]}" run --isolation chroot -v "$folder/work:/work" "$container" -- "$@"
}
read -ra entry <<<"$("${storage[@]}" inspect --format '{{range .OCIv1.Config.Entrypoint}}{{.}} {{end}}' "$container")"
in_container "${entry[@]}" --version
in_container "${entry[@]}" run /usr/share/myolines/input/oscillator.xml --quiet
[ "$(wc -l <"$folder/work/results/oscillator/trajectory.csv")" -gt 100 ]
in_container mpirun -np 2 "${entry[@]}" run /usr/share/myolines/input/isometric_block.xml --quiet --out block --set system/geometry/refinement=1
grep '"ranks": 2' "$folder/work/block/manifest.json"
"${storage[@]}" rm "$container" >/dev/null
