// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/study/advise.h>
#include <myolines/study/command.h>

#include <CLI/CLI.hpp>

namespace myolines
{
  void add_study_options(CLI::App &command, study::Options &options);

  /// The options of a command that asks for values of a scene, beside those of the scene.
  void add_quantity_options(CLI::App &command, study::QuantityOptions &options);

  /// Those of `advise` alone.
  void add_advise_options(CLI::App &command, study::AdviseOptions &options);
} // namespace myolines
