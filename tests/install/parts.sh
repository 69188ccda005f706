#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# examples/muscle_parts is built against an installed library; its law, support, table and profile are right: parts.sh BUILD_FOLDER SOURCE_FOLDER
# SCRATCH_FOLDER
set -euo pipefail
rm -rf "$3"
mkdir -p "$3"
cp -r "$2/examples/muscle_parts" "$3/project"
cmake --install "$1" --prefix "$3/prefix" >/dev/null
cd "$3"
myolines=$PWD/prefix/bin/myolines
unset MYOLINES_PLUGIN_PATH
cmake -S project -B build -G Ninja -DCMAKE_PREFIX_PATH="$PWD/prefix" -DCMAKE_INSTALL_PREFIX="$PWD/prefix" >/dev/null
cmake --build build
plugin=$PWD/build/muscle-parts.so

fail() {
  echo "$*" >&2
  exit 1
}

# last COLUMN TABLE: of the last row.
last() {
  awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) column = i }
    END { if (!column) { print "no column " name " in " FILENAME > "/dev/stderr"; exit 1 } print $column }' "$2"
}

# near X Y TOLERANCE: relative.
near() {
  awk -v x="$1" -v y="$2" -v e="$3" 'BEGIN { gap = x - y; if (gap < 0) gap = -gap; size = y < 0 ? -y : y; exit !(gap <= e * size) }' ||
    fail "$1 is not $2 within $3"
}

# A cube of 1 cm of nothing but the law, stretched along x to 1.3 between planes of symmetry.
cat >law.xml <<'TEXT'
<ParameterList name="scene">
  <Parameter name="plug-ins" type="string" value="muscle-parts"/>
  <ParameterList name="system">
    <Parameter name="type" type="string" value="muscle 3d"/>
    <Parameter name="inertia" type="string" value="quasi-static"/>
    <ParameterList name="geometry">
      <Parameter name="length" type="double" value="0.01"/>
      <Parameter name="width" type="double" value="0.01"/>
      <Parameter name="height" type="double" value="0.01"/>
      <Parameter name="refinement" type="int" value="1"/>
      <Parameter name="tissue" type="string" value="rubber"/>
    </ParameterList>
    <ParameterList name="tissues">
      <ParameterList name="own">
        <ParameterList name="rubber">
          <Parameter name="bulk modulus" type="double" value="1e9"/>
          <ParameterList name="laws">
            <ParameterList name="second">
              <Parameter name="type" type="string" value="mooney"/>
              <Parameter name="c2" type="double" value="3e4"/>
            </ParameterList>
          </ParameterList>
        </ParameterList>
      </ParameterList>
    </ParameterList>
    <ParameterList name="boundary">
      <ParameterList name="pulled">
        <Parameter name="face" type="string" value="x+"/>
        <Parameter name="type" type="string" value="formula"/>
        <Parameter name="components" type="string" value="x"/>
        <Parameter name="displacement x" type="string" value="0.003*t"/>
        <Parameter name="velocity x" type="string" value="0.003"/>
        <Parameter name="acceleration x" type="string" value="0"/>
      </ParameterList>
      <ParameterList name="back">
        <Parameter name="face" type="string" value="x-"/>
        <Parameter name="type" type="string" value="symmetry plane"/>
      </ParameterList>
      <ParameterList name="side">
        <Parameter name="face" type="string" value="y-"/>
        <Parameter name="type" type="string" value="symmetry plane"/>
      </ParameterList>
      <ParameterList name="bottom">
        <Parameter name="face" type="string" value="z-"/>
        <Parameter name="type" type="string" value="symmetry plane"/>
      </ParameterList>
    </ParameterList>
  </ParameterList>
  <ParameterList name="integrator">
    <Parameter name="type" type="string" value="static"/>
  </ParameterList>
  <ParameterList name="time">
    <Parameter name="end" type="double" value="1"/>
    <Parameter name="step" type="double" value="0.25"/>
  </ParameterList>
</ParameterList>
TEXT
MYOLINES_PLUGIN_PATH=$PWD/build "$myolines" check law.xml | grep '^Plug-in: muscle-parts' >/dev/null || fail "check does not name it"
cmake --install build >/dev/null
"$myolines" list laws mooney | grep -q 'c2' || fail "list laws does not tell its parameters"
"$myolines" list "boundary conditions" buffer | grep -q 'stiffness' || fail "list does not tell the parameters of the support"

# P_11 = 2 c2 (1 - l^-3), whatever the instruction set.
for set in baseline $(grep -qw avx2 /proc/cpuinfo && echo avx2); do
  "$myolines" run law.xml --quiet --out "law_$set" --instruction-set "$set" --set output/series/reactions=true --set 'output/series/furthest point=true'
  near "$(last 'pulled x [N]' "law_$set/reaction.csv")" "$(awk 'BEGIN { print 1e-4 * 6e4 * (1 - 1.3^-3) }')" 1e-4
done
# The corner that moves most: 3 mm along x, and across as the volume says.
near "$(last 'Displacement [m]' law_baseline/furthest.csv)" "$(awk 'BEGIN { a = 1 - 1 / sqrt(1.3); print sqrt(9e-6 + 2 * (0.01 * a)^2) }')" 1e-4
mpirun -np 2 "$myolines" run law.xml --quiet --out two_ranks --set 'output/series/furthest point=true'
near "$(last 'Displacement [m]' two_ranks/furthest.csv)" "$(last 'Displacement [m]' law_baseline/furthest.csv)" 1e-9

# The same cube pushed onto a buffer by a dead load of 2e4 Pa: 6e4 (1 - l^-3) + k L (l - 1) = 2e4. Pulled off it, it is free.
list() { # NAME TYPE MORE: a condition of x+
  echo "<ParameterList name=\"$1\"><Parameter name=\"face\" type=\"string\" value=\"x+\"/><Parameter name=\"type\" type=\"string\" value=\"$2\"/>$3</ParameterList>"
}
load=$(list load "directed traction" '<Parameter name="direction" type="string" value="1 0 0"/><Parameter name="traction" type="double" value="2e4"/>')
wall=$(list wall buffer '<Parameter name="stiffness" type="double" value="1e7"/>')
sed -e '/name="pulled"/,/<\/ParameterList>/d' -e "s|<ParameterList name=\"boundary\">|&$load$wall|" law.xml >pushed.xml
sed "s|$wall||" pushed.xml >free.xml
tables=(--quiet --set output/series/reactions=true --set "output/series/furthest point=true")
"$myolines" run pushed.xml "${tables[@]}" --out pushed
near "$(awk -v F="$(last 'wall x [N]' pushed/reaction.csv)" 'BEGIN { l = 1 - F / 1e7 / 1e-4 / 0.01; print 6e4 * (1 - l^-3) - F / 1e-4 }')" 2e4 1e-4
"$myolines" run pushed.xml "${tables[@]}" --out pulled --set system/boundary/load/traction=-1e4
[ "$(awk -v F="$(last 'wall x [N]' pulled/reaction.csv)" 'BEGIN { print F == 0 }')" = 1 ] || fail "the buffer pulls"
"$myolines" run free.xml "${tables[@]}" --out free --set system/boundary/load/traction=-1e4
cmp pulled/furthest.csv free/furthest.csv

# States of runs with parts of a plug-in are read again.
sed "s|<ParameterList name=\"boundary\">|&${wall//x+/y+}|" prefix/share/myolines/input/isometric_block.xml >block.xml
"$myolines" run block.xml --quiet --out block --set plug-ins=muscle-parts --set time/end=0.01 --set system/geometry/refinement=1
"$myolines" compare block block >/dev/null

# A profile of the plug-in drives any system. A force 4 sin^2(pi t/T) on a mass of 1 kg and a spring of 1 N/m, over after T = 1.5 s: until then
# u = 2 (1 - cos t) - 2 (cos Wt - cos t)/(1 - W^2), W = 2 pi/T. Steps end where it ends, and where the next begins.
bursts=(--set plug-ins=muscle-parts --set system/force/type=bursts --set system/force/amplitude=4 --set system/force/duration=1.5
  --set system/force/period=2.25 --set system/displacement=0 --set integrator/type=newmark)
"$myolines" list profiles | grep '^bursts$' >/dev/null || fail "list profiles does not name it"
oscillator=prefix/share/myolines/input/oscillator.xml
"$myolines" check "$oscillator" "${bursts[@]}" | grep '^Plug-in: muscle-parts.*profile bursts' >/dev/null || fail "check does not name the profile"
"$myolines" run "$oscillator" "${bursts[@]}" --quiet --out bursts --set time/end=1.5 --set time/step=0.001
near "$(last 'Displacement [m]' bursts/trajectory.csv)" \
  "$(awk 'BEGIN { pi = atan2(0, -1); T = 1.5; W = 2 * pi / T; print 2 * (1 - cos(T)) - 2 * (1 - cos(T)) / (1 - W^2) }')" 1e-5
"$myolines" run "$oscillator" "${bursts[@]}" --quiet --out bursts_coarse --set time/end=4 --set time/step=0.7
for instant in 1.5 2.25 3.75; do
  grep -q "^$instant," bursts_coarse/trajectory.csv || fail "no step ends at $instant s: $(cut -d, -f1 bursts_coarse/trajectory.csv)"
done
status=0
"$myolines" check "$oscillator" "${bursts[@]}" --set system/force/period=1 >refused.txt 2>&1 || status=$?
[ $status -eq 2 ] && grep -q 'system/force/period' refused.txt || fail "bursts that overlap are not refused: $(cat refused.txt)"
# It repeats for ever, and the whole of an activation is looked at before a run.
"$myolines" check block.xml --set plug-ins=muscle-parts --set system/activation/type=bursts --set system/activation/amplitude=0.5 \
  --set system/activation/duration=0.01 --set system/activation/period=0.02 >/dev/null
status=0
"$myolines" check block.xml --set plug-ins=muscle-parts --set system/activation/type=bursts --set system/activation/amplitude=1.5 \
  --set system/activation/duration=0.1 >refused.txt 2>&1 || status=$?
[ $status -eq 2 ] && grep -q 'the activation is 1.5' refused.txt || fail "an activation of 1.5 is not refused: $(cat refused.txt)"
