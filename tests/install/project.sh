#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# examples/pendulum and examples/library are built against an installed library and right: project.sh BUILD_FOLDER SOURCE_FOLDER SCRATCH_FOLDER
set -euo pipefail
rm -rf "$3"
mkdir -p "$3"
cp -r "$2/examples/pendulum" "$2/examples/library" "$3"
cmake --install "$1" --prefix "$3/prefix" >/dev/null
cd "$3"
for project in pendulum library; do
  cmake -S $project -B $project/build -G Ninja -DCMAKE_PREFIX_PATH="$PWD/prefix" >/dev/null
  cmake --build $project/build
done

# holds CONDITION FILE: of awk, about the last line of the file.
holds() {
  awk "END { exit !($1) }" "$2" || { echo "not so: $1 in $2" >&2 && tail -3 "$2" >&2 && exit 1; }
}

pendulum/build/pendulum newmark 200 | tee pendulum.txt
holds '$1 > 59.9999 && $1 < 60.0001' pendulum.txt # an error of second order: 1e-5 degrees

# One's own loop takes the steps of the program.
cat >scene.xml <<'TEXT'
<ParameterList name="scene">
  <ParameterList name="system">
    <Parameter name="type" type="string" value="oscillator"/>
    <Parameter name="mass" type="double" value="2"/>
    <Parameter name="damping" type="double" value="0.3"/>
    <Parameter name="stiffness" type="double" value="5"/>
  </ParameterList>
  <ParameterList name="integrator">
    <Parameter name="type" type="string" value="bdf2"/>
  </ParameterList>
  <ParameterList name="time">
    <Parameter name="end" type="double" value="2"/>
    <Parameter name="step" type="double" value="0.0078125"/>
  </ParameterList>
</ParameterList>
TEXT
mkdir own
library/build/own_loop scene.xml 256 own
prefix/bin/myolines run scene.xml --quiet --out program
for table in program/*.csv; do
  name=${table##*/}
  [ "$name" = steps.csv ] || cmp "$table" "own/$name"
done
ls own | grep -q csv

# The lines of doc/interface.md, one block after the other, write what the program writes, and then go on by themselves to t = 1.
mkdir lines lines/results
cp scene.xml lines/
{
  printf '#include <myolines/cli/%s.h>\n' experiment guarded mpi_session
  printf '#include <%s>\n' myolines/output/output_folder.h iostream
  echo 'using namespace myolines;'
  echo 'int main(int argc, char **argv) { return static_cast<int>(guarded([&] {'
  sed -n '/^```cpp$/,/^```$/{/^```/!p}' "$2/doc/interface.md"
  echo '}, std::cerr)); }'
} >lines/lines.cc
cat >lines/CMakeLists.txt <<'TEXT'
cmake_minimum_required(VERSION 3.22)
project(lines C CXX)
find_package(Myolines 0.1 REQUIRED)
add_executable(lines lines.cc)
target_link_libraries(lines Myolines::myolines)
TEXT
cmake -S lines -B lines/build -G Ninja -DCMAKE_PREFIX_PATH="$PWD/prefix" >/dev/null
cmake --build lines/build
(cd lines && build/lines >out.txt)
prefix/bin/myolines run scene.xml --quiet --out program_1ms --set time/step=1e-3
numdiff -q -s ', \n' -a 1e-12 program_1ms/trajectory.csv lines/results/trajectory.csv # a run sets solvers up anew where it is kept
holds '$1 > 0.9999 && $1 < 1.0011 && NR >= 1000' lines/out.txt

# The matrices of an oscillator are known; the mass of a muscle at the end of a run is symmetric.
library/build/matrices scene.xml
holds '$1 == 1 && $2 == 1 && $3 == 5' K.mtx
holds '$1 == 1 && $2 == 1 && $3 == 0.3' C.mtx
holds '$1 == 1 && $2 == 1 && $3 == 2' M.mtx
prefix/bin/myolines run prefix/share/myolines/input/isometric_block.xml --quiet --out block --set system/geometry/refinement=1
library/build/matrices block/scene.resolved.xml block
awk '/^%/ || ++lines == 1 { next } { a[$1, $2] = $3; if ($3 * $3 > most) most = $3 * $3 }
  END { for (key in a) { split(key, at, SUBSEP); gap = a[key] - a[at[2], at[1]]; if (gap * gap > 1e-20 * most) bad = 1 }
        exit bad || lines < 1000 }' M.mtx || { echo "M is not symmetric" >&2 && exit 1; }
[ "$(sed -n 3p K.mtx | cut -d' ' -f1)" = "$(sed -n 3p M.mtx | cut -d' ' -f1)" ]

library/build/convergence scene.xml 32 | tee convergence.txt
holds '$NF > 1.99 && $NF < 2.01' convergence.txt

# The system of the first example as a plug-in: a period of 2.1529 s from 60 degrees, a quarter of it to the lowest point.
prefix/bin/myolines template pendulum sdirk3 --plugin pendulum/build/pendulum-system.so >pendulum.xml
grep -q '"plug-ins".*"pendulum-system"' pendulum.xml
MYOLINES_PLUGIN_PATH=$PWD/pendulum/build prefix/bin/myolines run pendulum.xml --quiet --out pendulum_run --set time/end=0.5382187 --set time/step=0.001
awk -F, 'END { exit !($2 < 1e-3 && $2 > -1e-3) }' pendulum_run/angle.csv
