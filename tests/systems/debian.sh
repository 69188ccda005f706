#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Builds, installs and tries the committed sources on an empty Debian: debian.sh 12|13 FOLDER [--tests [CTEST ARGUMENTS]]
#
# FOLDER becomes the root of the system (debootstrap), or is one that this script has made before; the sources go to FOLDER/src/myolines.
# There it runs what the README says: `./myolines.sh run`, with --tests also `./myolines.sh test`, and `./myolines.sh package`; follows the first
# three tutorials to the letter; and tries the packages in a second empty system, FOLDER.installed (packages.sh). With CCACHE_DIR set, that
# compiler cache is used, with MYOLINES_JOBS so many jobs. Stops at the first step that fails and says which; exit code 1.
set -euo pipefail

if [ $# -lt 2 ] || [ "${3:---tests}" != --tests ]; then
  echo "usage, as root: debian.sh 12|13 FOLDER [--tests [CTEST ARGUMENTS]]" >&2
  exit 2
fi
source "$(dirname "$(readlink -f "$0")")/system.sh"
release=$1
built=$(realpath -m "$2")
with_tests=${3:-}
shift $(($# > 3 ? 3 : $#))
finish_with "$built"

begin "an empty Debian $release in $built"
enter "$built"
if [ -n "${CCACHE_DIR:-}" ]; then
  mkdir -p "$built/ccache"
  mountpoint -q "$built/ccache" || mount --bind "$CCACHE_DIR" "$built/ccache"
fi
mkdir -p "$built/src/myolines"
# An index of its own: what has changed since the last time is written anew, so that it is compiled, and what is gone is removed.
GIT_INDEX_FILE=$built/src/index git -C "$repository" --work-tree="$built/src/myolines" read-tree --reset -u HEAD

begin "./myolines.sh run input/isometric_block.xml"
inside "$built" "cd /src/myolines && ./myolines.sh run input/isometric_block.xml --overwrite --set system/geometry/refinement=1"
if [ "$with_tests" = --tests ]; then
  begin "./myolines.sh test $*"
  inside "$built" "cd /src/myolines && ./myolines.sh test $*"
fi

begin "./myolines.sh package"
rm -f "$built"/src/myolines/build/release/*.deb
inside "$built" "cd /src/myolines && ./myolines.sh package"

begin "tutorials 1 to 3 to the letter, from the sources"
inside "$built" "
  cd /src/myolines && rm -rf results
  python3 -B tests/documentation/follow.py doc/manual/{first_muscle,own_muscle,is_it_right}.md"

begin "the packages"
"$repository/tests/systems/packages.sh" "$release" "$built.installed" "$built/src/myolines/build/release" "$built/var/cache/apt/archives"
