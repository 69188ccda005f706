#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# printed.sh PROGRAM COMMANDS [LINES]: what the commands of a tutorial print, as a block of Markdown. They run in an empty folder that has the program and the
# scenes where the tutorial has them; `myolines` stands for build/release/myolines. LINES are patterns of sed -n, such as 1p; others become an ellipsis.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
program=$(readlink -f "$1")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder/build/release"
ln -s "$program" "$folder/build/release/myolines"
ln -s "$root/input" "$folder/input"
cd "$folder"
eval "${2//myolines /build/release/myolines }" >printed 2>/dev/null
echo '```'
if [ $# = 2 ]; then
  cat printed
else # an ellipsis where lines are left out
  sed -n "$3" printed | awk 'NR == FNR { line[NR] = $0; n = NR; next } FNR == 1 { at = 1 } $0 == line[at] && at <= n { if (skipped) print "..."; skipped = 0; print; ++at; next } { skipped = 1 }' - printed
fi
echo '```'
