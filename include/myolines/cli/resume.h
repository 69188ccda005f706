// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/cli/experiment.h>
#include <myolines/output/checkpoint.h>

namespace myolines
{
  /// Where @p now, the scene to resume with, must not differ from @p saved, the scene in the checkpoint: everything but
  /// the title and the lists `output` and `solver`, and in `time` the end, the steps and their control. Both as resolved XML.
  /// @throws InputError that names every parameter that differs, with both values.
  void refuse_other_run(const std::string &saved, const std::string &now, const std::string &scene_file);

  /// Where the files that the body of @p scene is made of are not as they were when a state was saved, its unknowns have another meaning.
  /// @p inputs has the checksums of the files of that run. @throws InputError.
  void refuse_other_mesh(const scene::Node &scene, const std::map<std::string, std::string> &inputs);

  /// What is not as it was when @p checkpoint was written and costs the resumed run its bit-equality; a line each.
  std::vector<std::string> changes_of_machine(const Checkpoint &checkpoint, InstructionSet instruction_set);
} // namespace myolines
