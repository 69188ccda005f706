#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# examples/pendulum is built against an installed library and right: project.sh BUILD_FOLDER SOURCE_FOLDER SCRATCH_FOLDER
set -euo pipefail
rm -rf "$3"
mkdir -p "$3"
cp -r "$2/examples/pendulum" "$3/project"
cmake --install "$1" --prefix "$3/prefix" >/dev/null
cmake -S "$3/project" -B "$3/build" -G Ninja -DCMAKE_PREFIX_PATH="$3/prefix" >/dev/null
cmake --build "$3/build"
"$3/build/pendulum" newmark 200 | tee "$3/out"
awk '{ exit !($1 > 59.9999 && $1 < 60.0001) }' "$3/out" # an error of second order: 1e-5 degrees
