#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# interface.sh ROOT FOLDER: the C++ interface as pages in FOLDER/html, by Doxygen. Every public name is documented, and there is no other warning.
# Exit code 77 where there is no Doxygen.
set -euo pipefail
command -v doxygen >/dev/null || { echo "there is no doxygen" && exit 77; }
mkdir -p "$2"
cd "$1"
{ cat doc/manual/Doxyfile && echo "OUTPUT_DIRECTORY = $2"; } | doxygen -
