// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace myolines
{
  extern const char *const version;     ///< of the program
  extern const char *const build_facts; ///< of this binary, see build_facts.h
  extern const char *const git_hash;    ///< of the sources, with "-dirty" if they differ from it; "" if they are in no repository

  using Versions = std::vector<std::pair<std::string, std::string>>; ///< of things by their names

  /// Of deal.II, Trilinos and p4est as compiled with, of MPI, HDF5 and zlib as loaded.
  Versions library_versions();

  const char *build_type(); ///< "Release" or "Debug"
} // namespace myolines
