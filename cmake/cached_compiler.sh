#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Compiles through ccache: cached_compiler.sh REPOSITORY COMPILER ARGUMENTS. Objects are shared by all clones: paths below REPOSITORY are taken
# relative to it. A precompiled header counts by a checksum beside it, which is computed once and not for every object: it has 600 MB.
export CCACHE_BASEDIR="$1" CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_PCH_EXTSUM=true
shift
ccache "$@" || exit
for argument; do
  case $argument in
    *.gch) [ -f "$argument" ] && sha1sum < "$argument" > "$argument.sum" ;;
  esac
done
exit 0
