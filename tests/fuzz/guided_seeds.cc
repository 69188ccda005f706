// SPDX-License-Identifier: LGPL-2.1-or-later
// Meshes of two cubes in the versions of Gmsh's format, of which no program at hand writes the older and the binary ones: guided_seeds
// FOLDER.

#include "../meshes/gmsh_texts.h"

#include <fstream>

int main(int argc, char **argv)
{
  if (argc != 2)
    return 2;
  using namespace myolines::test;
  const std::pair<const char *, std::string> seeds[] = {{"gmsh-1", gmsh_1()},
                                                        {"gmsh-2", gmsh_2()},
                                                        {"gmsh-2-binary", gmsh_2_binary(false)},
                                                        {"gmsh-2-swapped", gmsh_2_binary(true)},
                                                        {"gmsh-4.0", gmsh_4(false, false)},
                                                        {"gmsh-4.0-binary", gmsh_4(false, true)},
                                                        {"gmsh-4.1", gmsh_4(true, false)},
                                                        {"gmsh-4.1-binary", gmsh_4(true, true)},
                                                        {"gmsh-4.1-swapped", gmsh_4(true, true, true)},
                                                        {"gmsh-4.1-partitioned", gmsh_4(true, false, false, true)}};
  for (const auto &[name, text] : seeds)
    std::ofstream(std::string(argv[1]) + "/" + name, std::ios::binary) << text;
}
