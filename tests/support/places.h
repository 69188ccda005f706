// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace myolines::test
{
  std::string source_folder();       ///< of this repository
  std::string program_file();        ///< the program `myolines` of this build
  std::string loaded_program_file(); ///< see LoadedProgram
} // namespace myolines::test
