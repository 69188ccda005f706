#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# What `cmake --install` leaves works where it is and shows what it should: tree.sh BUILD_FOLDER SCRATCH_FOLDER
set -euo pipefail
build=$1 prefix=$2/prefix
rm -rf "$prefix"
cmake --install "$build" --prefix "$prefix" >/dev/null

fail() {
  echo "$*" >&2
  exit 1
}

[ "$("$prefix/bin/myolines" --version)" = "$("$build/myolines" --version)" ] || fail "the installed program is another one"
"$prefix/bin/myolines" check "$prefix/share/myolines/input/oscillator.xml" >/dev/null
grep -q '^\.SH COMMANDS$' "$prefix/share/man/man1/myolines.1" || fail "no manual page"
grep -q '^complete .* myolines$' "$prefix/share/bash-completion/completions/myolines" || fail "no completion"

library=$prefix/lib/libmyolines.so
[ -e "$library" ] || library=$(find "$prefix" -name libmyolines.so)
readelf -d "$library" | grep 'SONAME.*libmyolines\.so\.[0-9]*\.[0-9]*\]' >/dev/null || fail "no SONAME"
ours='( |^)myolines::|^(typeinfo|typeinfo name|vtable|VTT|construction vtable|(non-)?virtual thunk)( for| to) myolines::'
shown=$(nm -DC --defined-only "$library" | cut -d' ' -f3-)
grep -q 'myolines::run_loop(' <<<"$shown" || fail "the library does not show its own symbols"
others=$(grep -vE "$ours" <<<"$shown" || true)
[ -z "$others" ] || fail "the library shows symbols of others: ${others:0:300}"

# The table of licences in doc/install.md.
allowed='deal|trilinos_(nox|belos|belosepetra|ml|amesos|epetra|epetraext|teuchos[a-z]*|thyra[a-z]*|anasazi[a-z]*)|sundials_[a-z]+|mpi|hdf5[a-z_]*|sqlite3|z|muparser|boost_[a-z]+|tbb|lapack|blas|petsc[a-z_]*|stdc\+\+|m|gcc_s|c|ld-linux[a-z0-9_-]*'
for file in "$prefix/bin/myolines" "$library"; do
  needed=$(readelf -d "$file" | sed -n 's/.*(NEEDED).*\[\(lib\)\?\(.*\)\]/\2/p')
  unknown=$(grep -vE "^($allowed)[.-]" <<<"$needed" || true)
  [ -z "$unknown" ] || fail "$file links $unknown, of which doc/install.md does not tell the licence"
  readelf -d "$file" | grep -E "(RPATH|RUNPATH).*$build" && fail "$file looks for libraries in the build folder"
done
# The Python package, where it was built, finds the library and the program beside it.
package=$prefix/lib/python3/dist-packages/myolines
if [ -d "$package" ]; then
  python=$(sed -n 's/^_Python_EXECUTABLE:INTERNAL=//p' "$build/CMakeCache.txt")
  found=$(cd / && PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$(dirname "$package") "$python" -c \
    'import myolines; from myolines import program; print(myolines.Scene.template("oscillator").check(), program.find())')
  [ "$found" = "[] $prefix/bin/myolines" ] || fail "the installed Python package says: $found"
  module=$(find "$package" -name '_core*.so')
  needed=$(readelf -d "$module" | sed -n 's/.*(NEEDED).*\[\(lib\)\?\(.*\)\]/\2/p')
  unknown=$(grep -vE "^($allowed|myolines)[.-]" <<<"$needed" || true)
  [ -z "$unknown" ] || fail "$module links $unknown, of which doc/install.md does not tell the licence"
  readelf -d "$module" | grep -E "(RPATH|RUNPATH).*$build" && fail "$module looks for libraries in the build folder"
fi
leaks=$(grep -rlF "$build" "$prefix" || true)
[ -z "$leaks" ] || fail "paths of the build folder are in $leaks"
