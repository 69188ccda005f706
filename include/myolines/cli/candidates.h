// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/study/advise.h>

#include <filesystem>
#include <string>
#include <vector>

namespace myolines
{
  /// What may be advised for a scene: every method that takes given steps and is no program of others, with steps that are half, a quarter,
  /// ... of its time, multiples or parts of its own by powers of two; those that estimate their errors with steps by error as well,
  /// relative tolerances 0.1, 0.025, ...; and the meshes of refinements_of(). The method of the scene has its parameters, others their
  /// defaults. Whether a method takes the system its run will say.
  /// @throws InputError if it is no scene.
  study::Choices choices_of(const std::filesystem::path &file, const std::vector<std::string> &overrides);
} // namespace myolines
