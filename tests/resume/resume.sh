#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Requirement: a run that is interrupted in any way and resumed leaves what it would have left.
#   resume.sh PROGRAM WORK_FOLDER CASE
# Cases: killed, killed_ml, killed_error, stopped, ranks, outputs; see below.
set -euo pipefail
program=$1 work=$2 case=$3
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$work"
mkdir -p "$work"
cd "$work"
export OMPI_MCA_rmaps_base_oversubscribe=1 PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
# Solvers two digits sharper than what same_numbers() asks for.
block=(--set output/checkpoint/every=3 --set output/checkpoint/seconds=0 --set "solver/nonlinear/relative tolerance=1e-11" --quiet)

fail() {
  echo "$1" >&2
  exit 1
}

# Sets `command`, to be run or sent to the background: only then is $! the program itself.
prepare() { # FOLDER ARGUMENTS...
  local folder=$1
  shift
  command=("$program" run "$here/block.xml" --out "$folder" "${block[@]}" "$@")
}

run() {
  prepare "$@"
  "${command[@]}"
}

run_parallel() {
  prepare "$@"
  mpirun -np 2 "${command[@]}"
}

lines() { cat "$1" 2> /dev/null | wc -l; }

# Returns when FOLDER/run.log has N lines, or the process is over.
wait_for_lines() { # PROCESS FOLDER N
  while kill -0 "$1" 2> /dev/null && [ "$(lines "$2/run.log")" -lt "$3" ]; do sleep 0.005; done
}

same_bytes() { # FOLDER FOLDER: all tables
  for table in "$1"/*.csv; do
    cmp "$table" "$2/$(basename "$table")" || fail "$(basename "$table") differs"
  done
  [ "$(ls "$1"/*.csv | wc -l)" = "$(ls "$2"/*.csv | wc -l)" ] || fail "not the same tables"
}

same_numbers() { # FOLDER FOLDER: reactions to solver tolerance
  numdiff -q -s ',\n' -r 1e-8 -a 1e-9 "$1/reaction.csv" "$2/reaction.csv" || fail "the reactions differ"
}

# Kills without warning after so many more lines in the log, again and again, then lets the run finish.
# A machine busy with other work may let the run finish before the kill: that part is then taken back and tried again.
killed() { # ARGUMENTS...
  run whole "$@"
  local resume=() tries=0
  for more in 6 4 9 1 7; do
    rm -rf before
    if [ -d part ]; then cp -r part before; fi
    until killed_after "$more" "${resume[@]}" "$@"; do
      tries=$((tries + 1))
      [ $tries -lt 20 ] || fail "the run was always over before it was killed"
      rm -rf part
      if [ -d before ]; then cp -r before part; fi
    done
    if [ -f part/checkpoint ]; then resume=(--resume); fi
  done
  run part "${resume[@]}" "$@"
  grep -q "resumed after step" part/run.log || fail "nothing was resumed"
  same_bytes whole part
}

# True if the run was killed, false if it had ended by then.
killed_after() { # LINES ARGUMENTS...
  local last=$(($(lines part/run.log) + $1)) code=0
  shift
  prepare part "$@"
  "${command[@]}" &
  wait_for_lines $! part "$last"
  kill -9 $! 2> /dev/null || true
  wait $! 2> /dev/null || code=$?
  [ $code = 0 ] || [ $code = 137 ] || fail "exit code $code before the run was killed"
  [ $code = 137 ]
}

case $case in
killed)
  killed --set output/series/every=4 --set time/step=0.0025
  ;;
killed_ml) # a hierarchy of more than one level
  killed --set time/step=0.0025 --set solver/preconditioner/type=ml --set "solver/preconditioner/coarse size=50"
  ;;
killed_error) # steps chosen by error, some refused, and output that does not follow them
  killed --set integrator/type=sdirk2 --set time/control/type=error --set "time/control/displacement/relative tolerance=3e-5" \
    --set "time/control/displacement/absolute tolerance=3e-8" \
    --set output/motion/interval=0.004 --set "output/series/markers=middle 0.015 0.005 0.005"
  grep -q "error too large" whole/steps.csv || fail "no step was refused"
  ;;
stopped) # steps enough that it is stopped long before its end
  run whole --set time/step=0.001
  prepare part --set time/step=0.001
  "${command[@]}" 2> message &
  wait_for_lines $! part 5
  kill -TERM $!
  code=0
  wait $! || code=$?
  [ $code = 3 ] || fail "exit code $code after SIGTERM, expected 3"
  grep -q "To resume: .* --resume" message || fail "the message does not say how to resume"
  run part --set time/step=0.001 --resume
  same_numbers whole part
  cmp <(cut -d, -f1,2 whole/steps.csv) <(cut -d, -f1,2 part/steps.csv) || fail "the steps differ"
  ;;
ranks)
  run whole
  run one_two --set time/end=0.06
  run_parallel one_two --resume
  run_parallel two_one --set time/end=0.06
  run two_one --resume
  same_numbers whole one_two
  same_numbers whole two_one
  grep -q '"resumed": ".*ranks: 2 instead of 1' one_two/manifest.json || fail "the manifest is silent about the ranks"
  run_parallel two_two --set time/end=0.06
  run_parallel two_two --resume
  run_parallel whole_two
  same_bytes whole_two two_two
  ;;
outputs)
  what=(--set "output/fields/what=displacement, pressure" --set output/quadrature/every=6 --set time/end=0.03)
  run one "${what[@]}" --set output/fields/format=hdf5
  run_parallel two "${what[@]}" --set output/fields/format=hdf5
  for file in quadrature-0000.h5 quadrature-0006.h5 fields-0006.h5 fields-mesh-0000.h5; do
    [ "$(stat -c %s one/$file)" = "$(stat -c %s two/$file)" ] || fail "$file has another size on two ranks"
  done
  cmp one/fields.xdmf two/fields.xdmf || fail "fields.xdmf differs"
  run_parallel vtu "${what[@]}"
  pieces=$(ls vtu/fields_0006.*.vtu | wc -l)
  [ "$pieces" = 2 ] || fail "$pieces pieces of fields_0006.pvtu"
  for piece in vtu/fields_0006.*.vtu; do
    grep -q "$(basename "$piece")" vtu/fields_0006.pvtu || fail "fields_0006.pvtu does not name $piece"
  done
  grep -q 'file="fields_0006.pvtu"' vtu/fields.pvd || fail "fields.pvd does not name the last instant"
  ;;
*)
  fail "unknown case $case"
  ;;
esac
