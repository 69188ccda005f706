#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Builds, installs and tries the committed sources on an empty Debian: debian.sh 12|13 FOLDER [--tests [CTEST ARGUMENTS]]
#
# FOLDER becomes the root of the system (debootstrap), or is one that this script has made before; the sources go to FOLDER/src/myolines.
# There it runs what the README says: `./myolines.sh run`, with --tests also `./myolines.sh test`, and `./myolines.sh package`. The packages go
# into a second empty system, FOLDER.installed, made anew each time: there is nothing of what the build needed, so that what a package fails
# to ask for is missing. There it runs the installed program, its pages, a scene on two ranks, the first three tutorials to the letter, and
# projects that use the library. With CCACHE_DIR set, that compiler cache is used, with MYOLINES_JOBS so many jobs. MIRROR is another mirror of
# Debian than http://deb.debian.org/debian. Runs as root. Stops at the first step that fails and says which; exit code 1.
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
built=$(realpath -m "$2")
installed=$built.installed
with_tests=${3:-}
shift $(($# > 3 ? 3 : $#))

step=start
leave() { # SYSTEM
  local place
  for place in ccache dev/shm dev sys proc; do
    if mountpoint -q "$1/$place"; then
      umount "$1/$place"
    fi
  done
}
finish() {
  local status=$?
  leave "$built"
  leave "$installed"
  [ $status -eq 0 ] && echo "Debian: everything works" || echo "Debian: failed at: $step" >&2
  exit $((status == 0 ? 0 : 1))
}
trap finish EXIT

begin() {
  step=$1
  echo "=== $step"
}

# enter SYSTEM: makes it where there is none, with what MPI reads of the processors, and what it talks through.
enter() {
  if [ ! -e "$1/etc/debian_version" ]; then
    debootstrap --variant=minbase "$suite" "$1" "${MIRROR:-http://deb.debian.org/debian}" >"$1.log" 2>&1 || {
      tail -n 5 "$1.log" >&2
      exit 1
    }
  fi
  local place
  for place in proc sys dev dev/shm; do
    mountpoint -q "$1/$place" || mount --bind "/$place" "$1/$place"
  done
  cp /etc/resolv.conf /etc/hosts "$1/etc/"
  inside "$1" "apt-get update -qq"
}

# inside SYSTEM COMMAND: of a shell there, with nothing of the environment of this one.
inside() {
  chroot "$1" /usr/bin/env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
    DEBIAN_FRONTEND=noninteractive OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 \
    OMPI_MCA_rmaps_base_oversubscribe=1 PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe \
    ${CCACHE_DIR:+CCACHE_DIR=/ccache} ${MYOLINES_JOBS:+MYOLINES_JOBS="$MYOLINES_JOBS"} bash -euo pipefail -c "$2"
}

begin "an empty Debian $release in $built"
enter "$built"
if [ -n "${CCACHE_DIR:-}" ]; then
  mkdir -p "$built/ccache"
  mountpoint -q "$built/ccache" || mount --bind "$CCACHE_DIR" "$built/ccache"
fi
mkdir -p "$built/src/myolines"
git -C "$repository" archive HEAD | tar -x -C "$built/src/myolines"

begin "./myolines.sh run input/isometric_block.xml"
inside "$built" "cd /src/myolines && ./myolines.sh run input/isometric_block.xml --overwrite --set system/geometry/refinement=1"
if [ "$with_tests" = --tests ]; then
  begin "./myolines.sh test $*"
  inside "$built" "cd /src/myolines && ./myolines.sh test $*"
fi

begin "./myolines.sh package"
rm -f "$built"/src/myolines/build/release/*.deb
inside "$built" "cd /src/myolines && ./myolines.sh package"

begin "the packages in an empty Debian $release in $installed"
leave "$installed"
rm -rf --one-file-system "$installed"
mkdir -p "$installed/var/cache/apt/archives"
enter "$installed"
cp -al "$built"/var/cache/apt/archives/*.deb "$installed/var/cache/apt/archives/" 2>/dev/null || true # what has been fetched already
mkdir "$installed/packages"
cp "$built"/src/myolines/build/release/*.deb "$installed/packages/"
inside "$installed" "apt-get install -y -qq /packages/myolines_*.deb man-db bash-completion >/dev/null"

begin "the installed program"
inside "$installed" "
  cd \$(mktemp -d)
  myolines --version
  ! grep -qF /src/myolines /usr/bin/myolines
  man myolines | grep COMMANDS >/dev/null
  [ \"\$(myolines manual)\" = \"\$(zcat -f /usr/share/man/man1/myolines.1*)\" ]
  cmp <(myolines completion) /usr/share/bash-completion/completions/myolines
  for scene in /usr/share/myolines/input/*.xml; do myolines check \$scene >/dev/null || { echo \"refused: \$scene\"; exit 1; }; done
  myolines run /usr/share/myolines/input/oscillator.xml --quiet --out oscillator
  myolines plot oscillator >/dev/null && ls oscillator/pictures | grep -q svg
  mpirun -np 2 myolines run /usr/share/myolines/input/isometric_block.xml --quiet --out block --set system/geometry/refinement=1
  grep '\"ranks\": 2' block/manifest.json"

begin "tutorials 1 to 3 to the letter"
mkdir -p "$installed/pages"
cp "$repository"/doc/manual/{first_muscle,own_muscle,is_it_right}.md "$repository"/tests/documentation/follow.py "$installed/pages/"
inside "$installed" "
  apt-get install -y -qq --no-install-recommends python3-minimal >/dev/null # of what follows the pages, not of these
  cd \$(mktemp -d)
  python3 -B /pages/follow.py --installed /usr/share/myolines/input /pages/{first_muscle,own_muscle,is_it_right}.md"
inside "$built" "
  cd /src/myolines && rm -rf results
  python3 -B tests/documentation/follow.py doc/manual/{first_muscle,own_muscle,is_it_right}.md"

begin "the Python package"
inside "$installed" "
  apt-get install -y -qq --no-install-recommends /packages/python3-myolines_*.deb >/dev/null
  cd \$(mktemp -d)
  python3 -B -c 'import math, myolines
u = myolines.Simulation(\"/usr/share/myolines/input/oscillator.xml\").advance(1).u[0]
assert abs(u - math.cos(1)) < 0.01, u'"

begin "projects that use the library"
cp -r "$repository/examples" "$installed/"
inside "$installed" "
  apt-get install -y -qq --no-install-recommends /packages/libmyolines-dev_*.deb g++ cmake ninja-build libgtest-dev >/dev/null
  cd \$(mktemp -d) && cp -r /examples/. .
  for project in pendulum library methods muscle_parts; do
    cmake -S \$project -B \$project/build -G Ninja >/dev/null && cmake --build \$project/build
  done
  pendulum/build/pendulum | tee out
  awk '{ exit !(\$1 > 59.9999 && \$1 < 60.0001) }' out
  library/build/convergence /usr/share/myolines/input/oscillator.xml 32
  library/build/matrices /usr/share/myolines/input/isometric_block.xml
  mkdir own && library/build/own_loop /usr/share/myolines/input/oscillator.xml 100 own && [ \$(wc -l <own/trajectory.csv) -gt 100 ]
  cmake --install methods/build --prefix /usr >/dev/null
  myolines run /usr/share/myolines/input/isometric_block.xml --quiet --out plugged_in --set plug-ins=methods --set integrator/type=houbolt \\
    --set system/geometry/refinement=1
  grep '\"integrator houbolt\"' plugged_in/manifest.json
  methods/build/try_methods --gtest_brief=1
  cmake --install muscle_parts/build --prefix /usr >/dev/null
  myolines run /usr/share/myolines/input/isometric_block.xml --quiet --out parts --set plug-ins=muscle-parts --set system/geometry/refinement=1 \\
    --set system/activation/type=bursts --set system/activation/amplitude=0.5 --set system/activation/duration=0.1 \\
    --set 'output/series/furthest point=true'
  grep '\"law mooney\"' parts/manifest.json && [ \$(wc -l <parts/furthest.csv) -gt 2 ]"
