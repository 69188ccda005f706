#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Tries Debian packages where nothing else is: packages.sh 12|13 FOLDER PACKAGES [FETCHED]
#
# FOLDER becomes the root of an empty system (debootstrap), made anew each time: there is nothing of what the build needed, so that what a package
# fails to ask for is missing. The packages of the folder PACKAGES are installed there; FETCHED is a folder of packages of Debian that need not
# be fetched again. It runs the installed program, its pages, a scene on two ranks, the first three tutorials to the letter, Python, and the
# projects of examples/ that use the library. Stops at the first step that fails and says which; exit code 1.
set -euo pipefail

if [ $# -lt 3 ]; then
  echo "usage, as root: packages.sh 12|13 FOLDER PACKAGES [FETCHED]" >&2
  exit 2
fi
source "$(dirname "$(readlink -f "$0")")/system.sh"
installed=$(realpath -m "$2")
packages=$(realpath "$3")
fetched=${4:-}
if [ -e "$installed" ] && [ ! -e "$installed/packages" ]; then
  echo "$installed is not one that this script has made" >&2
  exit 2
fi
finish_with "$installed"

begin "the packages in an empty Debian $1 in $installed"
leave "$installed"
rm -rf --one-file-system "$installed"
mkdir -p "$installed/packages"
enter "$installed"
if [ -n "$fetched" ]; then
  ln -f "$fetched"/*.deb "$installed/var/cache/apt/archives/" 2>/dev/null || cp "$fetched"/*.deb "$installed/var/cache/apt/archives/"
fi
cp "$packages"/*.deb "$installed/packages/"
inside "$installed" "apt-get install -y -qq /packages/myolines_*.deb man-db bash-completion >/dev/null"

begin "the installed program"
inside "$installed" "
  cd \$(mktemp -d)
  myolines --version
  if grep -F /src/myolines /usr/bin/myolines; then echo \"the program knows where it was built\"; exit 1; fi
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
