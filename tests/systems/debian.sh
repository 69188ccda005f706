#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Builds, installs and tries the committed sources on an empty Debian: debian.sh 12|13 FOLDER [--tests [CTEST ARGUMENTS]]
#
# FOLDER becomes the root of the system (debootstrap), or is one that this script has made before; the sources go to FOLDER/src/myolines.
# There it runs what the README says: `./myolines.sh run`, with --tests also `./myolines.sh test`, and `./myolines.sh package`. It installs
# the packages, and outside the sources runs the installed program, its pages, a scene on two ranks, and a project that uses the library.
# With CCACHE_DIR set, that compiler cache is used, with MYOLINES_JOBS so many jobs. Runs as root. Stops at the first step that fails and says which; exit code 1.
set -euo pipefail

if [ $# -lt 2 ] || [ "$(id -u)" -ne 0 ]; then
  echo "usage, as root: debian.sh 12|13 FOLDER [--tests [CTEST ARGUMENTS]]" >&2
  exit 2
fi
release=$1
case $release in
  12) suite=bookworm ;;
  13) suite=trixie ;;
  *)
    echo "unknown release of Debian: $1, expected 12 or 13" >&2
    exit 2
    ;;
esac
repository=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.." && pwd)
root=$(realpath -m "$2")
with_tests=${3:-}
shift $(($# > 3 ? 3 : $#))

step=start
finish() {
  local status=$?
  for place in ccache dev/shm dev sys proc; do
    mountpoint -q "$root/$place" && umount "$root/$place"
  done
  [ $status -eq 0 ] && echo "Debian: everything works" || echo "Debian: failed at: $step" >&2
  exit $((status == 0 ? 0 : 1))
}
trap finish EXIT

begin() {
  step=$1
  echo "=== $step"
}

# inside COMMAND: of a shell in the new system, with nothing of the environment of this one.
inside() {
  chroot "$root" /usr/bin/env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
    DEBIAN_FRONTEND=noninteractive OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 \
    OMPI_MCA_rmaps_base_oversubscribe=1 PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe ${CCACHE_DIR:+CCACHE_DIR=/ccache} ${MYOLINES_JOBS:+MYOLINES_JOBS="$MYOLINES_JOBS"} \
    bash -euo pipefail -c "$1"
}

begin "an empty Debian $release in $root"
if [ ! -e "$root/etc/debian_version" ]; then
  debootstrap --variant=minbase "$suite" "$root" http://deb.debian.org/debian >"$root.log" 2>&1 || {
    tail -5 "$root.log" >&2
    exit 1
  }
fi
for place in proc sys dev dev/shm; do # MPI reads the processors in one, and talks through the last
  mountpoint -q "$root/$place" || mount --bind "/$place" "$root/$place"
done
if [ -n "${CCACHE_DIR:-}" ]; then
  mkdir -p "$root/ccache"
  mountpoint -q "$root/ccache" || mount --bind "$CCACHE_DIR" "$root/ccache"
fi
cp /etc/resolv.conf /etc/hosts "$root/etc/"
inside "apt-get update -qq"
mkdir -p "$root/src/myolines"
git -C "$repository" archive HEAD | tar -x -C "$root/src/myolines"

begin "./myolines.sh run input/isometric_block.xml"
inside "cd /src/myolines && ./myolines.sh run input/isometric_block.xml --overwrite --set system/geometry/refinement=1"
if [ "$with_tests" = --tests ]; then
  begin "./myolines.sh test $*"
  inside "cd /src/myolines && ./myolines.sh test $*"
fi

begin "./myolines.sh package"
inside "cd /src/myolines && ./myolines.sh package"
begin "installation of the packages"
inside "apt-get install -y -qq --no-install-recommends --reinstall /src/myolines/build/release/*.deb bash-completion man-db >/dev/null"

begin "the installed program"
inside "
  cd \$(mktemp -d)
  myolines --version
  ! readelf -d /usr/bin/myolines | grep -E '(RPATH|RUNPATH).*/src'
  [ \"\$(myolines manual)\" = \"\$(zcat -f /usr/share/man/man1/myolines.1*)\" ]
  cmp <(myolines completion) /usr/share/bash-completion/completions/myolines
  for scene in /usr/share/myolines/input/*.xml; do myolines check \$scene >/dev/null || { echo \"refused: \$scene\"; exit 1; }; done
  myolines run /usr/share/myolines/input/oscillator.xml --quiet --out oscillator
  myolines plot oscillator >/dev/null && ls oscillator/pictures | grep -q svg
  mpirun -np 2 myolines run /usr/share/myolines/input/isometric_block.xml --quiet --out block --set system/geometry/refinement=1
  grep '\"ranks\": 2' block/manifest.json"

begin "the Python package"
inside "
  cd \$(mktemp -d)
  python3 -B -c 'import math, myolines
u = myolines.Simulation(\"/usr/share/myolines/input/oscillator.xml\").advance(1).u[0]
assert abs(u - math.cos(1)) < 0.01, u'"

begin "projects that use the library"
inside "
  cd \$(mktemp -d) && cp -r /src/myolines/examples/. .
  for project in pendulum library methods muscle_parts; do
    cmake -S \$project -B \$project/build -G Ninja >/dev/null && cmake --build \$project/build
  done
  pendulum/build/pendulum | tee out
  awk '{ exit !(\$1 > 59.9999 && \$1 < 60.0001) }' out
  library/build/convergence /usr/share/myolines/input/oscillator.xml 32
  library/build/matrices /usr/share/myolines/input/isometric_block.xml
  cmake --install methods/build --prefix /usr >/dev/null
  myolines run /usr/share/myolines/input/isometric_block.xml --quiet --out plugged_in --set plug-ins=methods --set integrator/type=houbolt \\
    --set system/geometry/refinement=1
  grep '\"integrator houbolt\"' plugged_in/manifest.json
  methods/build/try_methods --gtest_brief=1
  cmake --install muscle_parts/build --prefix /usr >/dev/null
  myolines run /usr/share/myolines/input/isometric_block.xml --quiet --out parts --set plug-ins=muscle-parts --set system/geometry/refinement=1 \\
    --set 'output/series/furthest point=true'
  grep '\"law mooney\"' parts/manifest.json && [ \$(wc -l <parts/furthest.csv) -gt 2 ]"
