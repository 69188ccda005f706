#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# One door to the project: installs what is missing, builds, runs, tests. Works from any folder.
set -euo pipefail

root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")" && pwd)
release=$root/build/release
debug=$root/build/debug

packages=(g++ cmake ninja-build ccache libdeal.ii-dev trilinos-all-dev libsundials-dev libopenmpi-dev openmpi-bin
          libopenblas0 libgtest-dev libbenchmark-dev libcli11-dev nlohmann-json3-dev libsqlite3-dev zlib1g-dev numdiff
          gnuplot-nox python3 libjs-three libjs-chart.js
          pybind11-dev libpython3-dev python3-numpy python3-scipy python3-matplotlib)
debian=$(sed -n 's/^VERSION_ID="\([0-9]*\)"$/\1/p' /etc/os-release 2>/dev/null || true)
if [ "$debian" = 13 ]; then
  packages+=(mold) # the linker that deal.II asks for there; without it, a slower one links
fi

# MPI starts as root and with more ranks than cores (containers); one thread per rank, or the ranks fight for cores.
# Open MPI 5 reads another name than 4 for the latter.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1 PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1

usage() {
  cat <<'TEXT'
usage: ./myolines.sh run SCENE [ARGUMENTS]   build the program if need be and run a scene (arguments: myolines run --help)
       ./myolines.sh check SCENE, plot FOLDER, study STUDY, ...
                                             the same with any other command of the program (myolines --help)
       ./myolines.sh test [ARGUMENTS]        build everything, run all tests (arguments go to ctest: -R NAME, -L LABEL, ...)
       ./myolines.sh build                   build the program only: build/release/myolines
       ./myolines.sh package                 build the Debian packages of program, library and Python package: build/release/*.deb
       ./myolines.sh install                 install the Debian packages that are missing
       ./myolines.sh manual                  build the manual as a site and as a book: build/manual/html/index.html, build/manual/myolines.pdf
       ./myolines.sh --help | --version

As many files are compiled, and tests run, at a time as there are cores, or MYOLINES_JOBS of them if that variable is set.
Missing Debian packages are installed by every command when it runs as root; otherwise they are named (exit code 2).
TEXT
}

is_installed() {
  [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

install_packages() {
  if ! command -v dpkg-query >/dev/null; then
    echo "not a Debian system: CMake will say which libraries it cannot find" >&2
    return
  fi
  local missing=() package
  for package in "${packages[@]}"; do
    is_installed "$package" || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return
  if [ "$(id -u)" -ne 0 ]; then
    echo "missing Debian packages: ${missing[*]}" >&2
    echo "install them with: sudo apt-get update && sudo apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 2
  fi
  echo "installing ${missing[*]}" >&2
  export DEBIAN_FRONTEND=noninteractive
  apt-get update -qq >&2
  apt-get install -y -qq --no-install-recommends "${missing[@]}" >&2
}

# MYOLINES_JOBS of them; else one job per core, but no more than one per 2 GB of free memory: deal.II is heavy to compile.
build_jobs() {
  if [ -n "${MYOLINES_JOBS:-}" ]; then
    echo "$MYOLINES_JOBS"
    return
  fi
  local cores memory_kb limit
  cores=$(env -u OMP_NUM_THREADS nproc) # nproc heeds that variable
  memory_kb=$(awk '/^MemAvailable:/ { print $2 }' /proc/meminfo)
  limit=$(cat /sys/fs/cgroup/memory.max 2>/dev/null || echo max)
  if [ "$limit" != max ] && [ $((limit / 1024)) -lt "$memory_kb" ]; then
    memory_kb=$((limit / 1024))
  fi
  local by_memory=$((memory_kb / 2000000))
  [ "$by_memory" -lt 1 ] && by_memory=1
  echo $((by_memory < cores ? by_memory : cores))
}

# configure PRESET [OPTIONS]; the presets belong to the repository's own folder.
configure() {
  local preset=$1
  shift
  (cd "$root" && cmake --preset "$preset" "$@") >&2
}

build_program() {
  configure release
  cmake --build "$release" --target myolines --parallel "$(build_jobs)" >&2
}

# Release, and of Debug the tests in which assertions look on; they appear as tests of the Release tree, so that one
# ctest tells all.
build_all() {
  configure debug
  configure release -DMYOLINES_DEBUG_BUILD="$debug"
  # All else in a tree waits for its precompiled header, which takes one core a minute.
  cmake --build "$release" --target myolines_pch --parallel 1 >&2 &
  cmake --build "$debug" --target assertions --parallel "$(build_jobs)" >&2
  wait $!
  cmake --build "$release" --parallel "$(build_jobs)" >&2
}

command=${1:-}
case "$command" in
  test)
    shift
    [ "$debian" = 12 ] && packages+=(clang-format-14) # that of .clang-format, which 13 does not have
    install_packages
    build_all
    exec ctest --test-dir "$release" --output-on-failure --parallel "$(build_jobs)" "$@"
    ;;
  build)
    install_packages
    build_program
    echo "$release/myolines"
    ;;
  package)
    packages+=(dpkg-dev file)
    install_packages
    build_program
    cmake --build "$release" --target myolines_library myolines_python --parallel "$(build_jobs)" >&2
    (cd "$release" && cpack -G DEB) >&2
    ls "$release"/*.deb
    ;;
  manual) # without a build of the program: its pages have what it prints
    packages=(python3-sphinx python3-myst-parser python3-matplotlib weasyprint fonts-dejavu-core)
    install_packages
    exec "$root/doc/manual/build" "$root/build/manual"
    ;;
  install)
    install_packages
    ;;
  -h | --help | help)
    usage
    ;;
  "")
    usage >&2
    exit 2
    ;;
  *) # of the program, which names its commands if this is none of them
    install_packages
    build_program
    exec "$release/myolines" "$@"
    ;;
esac
