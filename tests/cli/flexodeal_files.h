// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "../support/places.h"
#include "program_runner.h"

#include <myolines/base/error.h>
#include <myolines/cli/catalogue.h>
#include <myolines/cli/flexodeal.h>

#include <sstream>

/// Files in the formats of Flexodeal, and what becomes of them.
namespace myolines::test
{
  inline const std::filesystem::path flexodeal_data = std::filesystem::path(myolines::test::source_folder()) / "tests/data/flexodeal";

  inline FlexodealOptions flexodeal_options(const TestFolder &folder)
  {
    FlexodealOptions files;
    files.parameters = flexodeal_data / "parameters.prm";
    files.strain     = flexodeal_data / "strain.dat";
    files.activation = flexodeal_data / "activation.dat";
    files.scene      = folder / "scene.xml";
    return files;
  }

  /// The parameters with the first @p from replaced.
  inline std::filesystem::path changed(const TestFolder &folder, const std::string &from, const std::string &to)
  {
    std::string text = contents(flexodeal_data / "parameters.prm");
    if (text.find(from) == std::string::npos)
      throw std::logic_error("no \"" + from + "\" in the parameters");
    return folder.write("changed.prm", text.replace(text.find(from), from.size(), to));
  }

  /// The parameters as those of the complete program: gastrocnemius, aponeurosis, tendon, and entries of @p fat.
  inline std::filesystem::path complete(const TestFolder &folder, const std::string &fat, const std::string &scale = "1")
  {
    std::string text    = contents(flexodeal_data / "parameters.prm");
    const auto  replace = [&text](const std::string &from, const std::string &to, const std::string &by) {
      const std::size_t begin = text.find(from), end = text.find(to, begin);
      text.replace(begin, end - begin, by);
    };
    replace("  set Length", "  set Pressure ratio",
            "  set Muscle length = 0.1\n  set Aponeurosis length = 0.08\n  set Aponeurosis height = 0.003\n  set Muscle width = 0.02\n"
            "  set Pennation angle = 20\n  set Grid scale = " +
                scale + "\n");
    std::string tissues = fat;
    for (const std::string tissue : {"Aponeurosis", "Tendon"})
      {
        const std::string small = tissue == "Tendon" ? "tendon" : "aponeurosis";
        tissues += "set Sigma naught " + small + " = 2e5\nset Bulk modulus " + small + " = 1e7\nset Sigma naught " + small +
                   " base material = 2e5\nset " + tissue + " base material factor = 1\n";
        for (const char *k : {"1", "2", "3"})
          tissues += "set " + tissue + " base material constant " + k + " = 4\n";
      }
    replace("  set Muscle x", "  set Sigma naught base", tissues);
    return folder.write("complete.prm", text);
  }

  /// A bar of 4 by 1 by 2 cells as deal.II writes it: version 1, faces with numbers, but for those of 0, which is at x = 0. The upper layer
  /// is aponeurosis, the end tendon. In units of 1/ @p per_metre metre.
  inline std::filesystem::path bar_of_dealii(const TestFolder &folder, const double per_metre)
  {
    const auto         point = [](const int i, const int j, const int k) { return 1 + i + 5 * (j + 2 * k); };
    std::ostringstream nodes, cells;
    int                n_nodes = 0, n_cells = 0;
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 5; ++i)
          nodes << ++n_nodes << "  " << per_metre * 0.025 * i << " " << per_metre * 0.02 * j << " " << per_metre * 0.01 * k << "\n";
    for (int k = 0; k < 2; ++k)
      {
        for (int i = 0; i < 4; ++i)
          {
            cells << ++n_cells << " 5 " << (i == 3 ? 3 : k == 1 ? 2 : 1) << " 0 8";
            for (int up = 0; up < 2; ++up)
              for (const auto &[di, dj] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
                cells << " " << point(i + di, dj, k + up);
            cells << "\n";
          }
        cells << ++n_cells << " 3 1 0 4 " << point(4, 0, k) << " " << point(4, 1, k) << " " << point(4, 1, k + 1) << " "
              << point(4, 0, k + 1) << "\n";
      }
    return folder.write("bar.msh", "$NOD\n" + std::to_string(n_nodes) + "\n" + nodes.str() + "$ENDNOD\n$ELM\n" + std::to_string(n_cells) +
                                       "\n" + cells.str() + "$ENDELM\n");
  }

  /// The list "system" of the scene that @p options give.
  inline scene::Node system_of(const FlexodealOptions &options)
  {
    std::ostringstream out;
    import_flexodeal(options, out);
    return read_whole_scene(options.scene, {}).section("system");
  }

  inline std::string flexodeal_refusal(const FlexodealOptions &options)
  {
    std::ostringstream out;
    try
      {
        import_flexodeal(options, out);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "accepted";
  }
} // namespace myolines::test
