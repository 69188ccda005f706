#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Sources have the layout of .clang-format, which is of version 14: format.sh ROOT [--fix]. Exit code 77 where there is no such clang-format.
set -euo pipefail
cd "$1"
for name in clang-format-14 clang-format; do
  if command -v $name >/dev/null && $name --version | grep -q 'version 14\.'; then
    format=$name
    break
  fi
done
[ -n "${format:-}" ] || { echo "there is no clang-format 14" && exit 77; }
files() { find source include integrators boundary outputs profiles tests examples -name '*.cc' -o -name '*.h'; }
if [ "${2:-}" = --fix ]; then
  files | xargs -n 40 "$format" -i
  exit 0
fi
others=$(files | xargs -n 40 "$format" --dry-run 2>&1 | sed -n 's/^\([^ :]*\):[0-9]*:[0-9]*: warning: code should.*/\1/p' | sort -u)
[ -z "$others" ] || { echo "$others" && echo "layout: run tests/architecture/format.sh $1 --fix" >&2 && exit 1; }
