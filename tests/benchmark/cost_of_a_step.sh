#!/usr/bin/env bash
# CPU seconds per time step of the isometric block: cost_of_a_step.sh PROGRAM [refinement] [points] [more arguments of run]
# Start-up and outputs are included. Run it alone on the machine; compare ratios from one run, not seconds of two.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
program=$1
refinement=${2:-3}
points=${3:-4}
shift; shift $(($# < 2 ? $# : 2))
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
TIMEFORMAT='%U %S'
cpu=$( { time "$program" run "$here/../../input/isometric_block.xml" --out "$work" --quiet --set "system/geometry/refinement=$refinement" \
  --set "system/discretisation/quadrature points=$points" --set time/step=0.025 "$@" > /dev/null; } 2>&1 )
awk -F, -v cpu="$cpu" -v r="$refinement" -v p="$points" '
  NR > 1 && $4 == "accepted" { steps++ }
  NR > 1 { newton += $5; krylov += $6 }
  END { split(cpu, t, " ")
        printf "refinement %d, %d points: %.2f CPU s per step, %.2f Newton iterations and %.1f Krylov iterations per step, %d steps\n",
               r, p, (t[1] + t[2]) / steps, newton / steps, krylov / steps, steps }' "$work/steps.csv"
