#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# examples/methods is built against an installed library and runs in the installed program, or is refused: plugin.sh BUILD_FOLDER
# SOURCE_FOLDER SCRATCH_FOLDER
set -euo pipefail
source=$2
rm -rf "$3"
mkdir -p "$3"
cd "$3"
prefix=$PWD/prefix
unset MYOLINES_PLUGIN_PATH

fail() {
  echo "$*" >&2
  exit 1
}

# refused WORDS ARGUMENTS...: the program ends with 2 and says the words.
refused() {
  local words=$1 status=0
  shift
  "$prefix/bin/myolines" "$@" >refused.txt 2>&1 || status=$?
  [ $status -eq 2 ] && grep -qF -- "$words" refused.txt || fail "not refused with \"$words\" (exit code $status): $(cat refused.txt)"
}

cmake --install "$1" --prefix "$prefix" >/dev/null
cp -r "$source/examples/methods" project
cmake -S project -B build -G Ninja -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_INSTALL_PREFIX="$prefix" >/dev/null
cmake --build build --target methods

myolines=$prefix/bin/myolines
scene=$prefix/share/myolines/input/oscillator.xml
of_it=(--set plug-ins=methods --set "integrator/type=rho bathe")
plugin=$PWD/build/methods.so

# Nothing of it is there until it is asked for, and then only by name from the folders, or by file from the command line.
"$myolines" list integrators | grep -q '^rho bathe$' && fail "it is there already"
refused 'there is no plug-in "methods"' check "$scene" "${of_it[@]}"
refused 'is no name of a plug-in' check "$scene" --set "plug-ins=$plugin" --set "integrator/type=rho bathe"
refused 'is no name of a plug-in' check "$scene" --set plug-ins=../build/methods
refused 'there is no file' check "$scene" --plugin nowhere.so
refused 'this is no plug-in of Myolines' check "$scene" --plugin "$prefix/lib/libmyolines.so"
"$myolines" check "$scene" --plugin "$plugin" --set "integrator/type=rho bathe" >/dev/null

# From a folder of the environment; from that of the installation.
MYOLINES_PLUGIN_PATH=/nowhere:$PWD/build "$myolines" check "$scene" "${of_it[@]}" >/dev/null
cmake --install build >/dev/null
"$myolines" list plug-ins | grep -A1 '^methods$' | grep -q 'integrator rho bathe' || fail "list plug-ins does not name it"
"$myolines" list integrators | grep '^rho bathe$' >/dev/null || fail "list integrators does not name it"
"$myolines" list methods "rho bathe" | grep 'muscle 3d' >/dev/null || fail "list methods does not try it"
"$myolines" check "$scene" "${of_it[@]}" | grep '^Plug-in: methods, integrator rho bathe' >/dev/null || fail "check does not name it"
"$myolines" template oscillator "rho bathe" >template.xml
grep -q '"plug-ins".*"methods"' template.xml || fail "the template does not name the plug-in"
"$myolines" run template.xml --quiet --out run
grep -q '"integrator rho bathe"' run/manifest.json || fail "the manifest does not name it"
"$myolines" run template.xml --quiet --out run --resume --set time/end=12

if [ -d "$prefix/lib/python3/dist-packages/myolines" ]; then
  python=$(sed -n 's/^_Python_EXECUTABLE:INTERNAL=//p' "$1/CMakeCache.txt")
  MYOLINES_PLUGIN_PATH=$PWD/build PYTHONPATH=$prefix/lib/python3/dist-packages "$python" -B -c \
    'import myolines; myolines.Simulation("template.xml").advance(1)' || fail "Python does not load it"
  PYTHONPATH=$prefix/lib/python3/dist-packages "$python" -B -c 'import myolines; myolines.Simulation("template.xml").advance(1)' ||
    fail "Python does not load it from the folder of the installation"
fi

# The same source as one of those that are built in: the same numbers.
"$myolines" run "$scene" --quiet --out built_in --set integrator/type=bathe
"$myolines" run "$scene" --quiet --out plugged_in "${of_it[@]}"
for table in built_in/*.csv; do
  cmp <(cut -d, -f1-3 "$table") <(cut -d, -f1-3 "plugged_in/${table##*/}")
done

# Runs that the program starts itself load the file as well.
cat >study.xml <<TEXT
<ParameterList name="study">
  <Parameter name="scene" type="string" value="$scene"/>
  <Parameter name="settings" type="string" value="integrator/type=rho bathe | time/end=1"/>
  <ParameterList name="grids">
    <ParameterList name="all">
      <ParameterList name="step">
        <Parameter name="type" type="string" value="list"/>
        <Parameter name="parameter" type="string" value="time/step"/>
        <Parameter name="values" type="string" value="0.1 | 0.05"/>
      </ParameterList>
    </ParameterList>
  </ParameterList>
  <ParameterList name="quantities">
    <ParameterList name="displacement">
      <Parameter name="file" type="string" value="trajectory.csv"/>
      <Parameter name="column" type="string" value="Displacement [m]"/>
      <Parameter name="measure" type="string" value="final"/>
    </ParameterList>
  </ParameterList>
</ParameterList>
TEXT
mv prefix/lib/myolines/plugins away
refused '"rho bathe" is not a valid choice' study study.xml --out study
"$myolines" study study.xml --plugin build/methods.so --out study --quiet
[ "$(grep -c done study/study.csv)" = 2 ] || fail "the study has not run: $(cat study/study.csv)"
"$myolines" study study.xml --plugin build/methods.so --list | grep -- '--plugin' >/dev/null || fail "the list of cases does not name it"
"$myolines" verify "$scene" --plugin build/methods.so --set "integrator/type=rho bathe" --set time/end=1 --quantity "trajectory.csv:Displacement [m]" \
  --out verify --quiet
"$myolines" advise "$scene" --plugin build/methods.so --set time/end=1 --quantity "trajectory.csv:Displacement [m]" --accuracy "1 %" --out advise --quiet
grep 'rho bathe' advise/advise.csv >/dev/null || fail "the method of the plug-in is no candidate"
mv away prefix/lib/myolines/plugins

# A run that goes on with another build, though that lies elsewhere, says so.
mkdir rebuilt
cp "$plugin" rebuilt/methods.so
printf ' ' >>rebuilt/methods.so
MYOLINES_PLUGIN_PATH=$PWD/rebuilt "$myolines" run template.xml --out run --resume --set time/end=13 |
  grep 'rebuilt/methods.so has changed since' >/dev/null || fail "nothing is said of another build"

# Of two files of one name the second is refused, and one that was cut short before the loader sees it.
refused 'there is a plug-in "methods" already, of the file' check "$scene" --plugin "$plugin" --plugin rebuilt/methods.so
"$myolines" check "$scene" --plugin "$plugin" --plugin build/../build/methods.so --set "integrator/type=rho bathe" >/dev/null
mkdir cut
size=$(wc -c <"$plugin")
for part in 1 10 20 30 40 50 60 70 80 90; do
  head -c $((size * part / 100)) "$plugin" >cut/methods.so
  refused 'cut/methods.so: ' check "$scene" --plugin cut/methods.so
done
MYOLINES_PLUGIN_PATH=$PWD/cut "$myolines" list plug-ins | grep 'is not whole\|is no plug-in' >/dev/null || fail "the list does not say what is refused"

# Built with something else.
mkdir others
changed() {
  LC_ALL=C sed "s/$1/$2/" "$plugin" >others/methods.so
  cmp -s "$plugin" others/methods.so && fail "there is no \"$1\" in it"
  refused "$3" check "$scene" --plugin others/methods.so --set "integrator/type=rho bathe"
}
changed 'version of Myolines: 0' 'version of Myolines: 9' 'was built with "version of Myolines: 9'
changed 'headers of Myolines: .' 'headers of Myolines: x' 'was built with "headers of Myolines: x'
changed 'assertions: off' 'assertions: onn' 'was built with "assertions: onn", this program with "assertions: off"'
if [ "$(uname -m)" = x86_64 ]; then
  cmake -S project -B avx2 -G Ninja -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_FLAGS=-mavx2 >/dev/null
  cmake --build avx2 --target methods
  refused 'the plug-in "methods" was built with "instructions: avx2"' check "$scene" --plugin avx2/methods.so
fi
cp "$plugin" others/twice.so
refused 'brings what there is already: integrator rho bathe' check "$scene" --plugin others/twice.so "${of_it[@]}"

# Its methods pass the suite of those that are built in.
cmake --build build --target try_methods
build/try_methods --gtest_brief=1
