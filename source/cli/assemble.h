// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/cli/catalogue.h>
#include <myolines/observers/outputs.h>

#include <memory>
#include <utility>
#include <vector>

namespace myolines
{
  template <typename System>
  AssembledSystem assemble(std::unique_ptr<System> system, WorkLedger &ledger)
  {
    AssembledSystem assembled;
    assembled.make_outputs = [&system = *system, &ledger](const scene::Node &output, const OutputFolder &folder) {
      return myolines::make_outputs(output, system, folder, ledger);
    };
    assembled.system = std::move(system);
    return assembled;
  }

  /// What the outside has to do with @p drives: files that they are read from, and who steers them.
  void note_drives(const std::vector<const Drive *> &drives, AssembledSystem &assembled);

  /// The system "muscle 3d" of a scene, and what it will take.
  AssembledSystem make_muscle3d(const scene::Node &node, WorkLedger &ledger, InstructionSet set);
  SizeEstimate    muscle3d_size(const scene::Node &node, unsigned int ranks);
} // namespace myolines
