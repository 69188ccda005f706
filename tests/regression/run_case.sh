#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Runs one regression case and compares numbers, never screen text.
#   run_case.sh PROGRAM CASE_FOLDER WORK_FOLDER [extra arguments of `myolines run`]
# A case folder holds
#   scene.xml or import    the scene, or the arguments of `myolines import flexodeal` (files relative to the folder)
#   expected/*.csv         numbers from elsewhere, see why.md
#   tolerances             lines "FILE ABSOLUTE RELATIVE [COLUMNS]": a number passes if either tolerance holds
#   exit_code              (optional) the exit code that is expected; 0 if absent
#   message                (optional) a text that the program must print on standard error
set -euo pipefail
program=$1 case=$2 work=$3
shift 3
rm -rf "$work"
mkdir -p "$work"

scene=$case/scene.xml
if [ -f "$case/import" ]; then
  scene=$work/scene.xml
  (cd "$case" && xargs "$program" import flexodeal --out "$scene" < import)
fi

wanted=0
[ -f "$case/exit_code" ] && wanted=$(cat "$case/exit_code")
code=0
"$program" run "$scene" --out "$work/results" --quiet "$@" 2> "$work/stderr" || code=$?
cat "$work/stderr" >&2
if [ "$code" != "$wanted" ]; then
  echo "exit code $code, expected $wanted" >&2
  exit 1
fi
if [ -f "$case/message" ] && ! grep -qF "$(cat "$case/message")" "$work/stderr"; then
  echo "the message lacks: $(cat "$case/message")" >&2
  exit 1
fi

failed=0
while read -r file absolute relative columns; do
  [ -n "$file" ] || continue
  # Without column names: headers may differ in units and spelling, numbers may not.
  tail -n +2 "$case/expected/$file" | cut -d, -f"${columns:-1-}" > "$work/expected.csv"
  tail -n +2 "$work/results/$file" | cut -d, -f"${columns:-1-}" > "$work/computed.csv"
  if ! numdiff -s ',\n' -a "$absolute" -r "$relative" "$work/expected.csv" "$work/computed.csv" > "$work/numdiff.txt"; then
    echo "$file differs (absolute $absolute, relative $relative):" >&2
    tail -40 "$work/numdiff.txt" >&2
    failed=1
  fi
done < "$case/tolerances"
exit $failed
