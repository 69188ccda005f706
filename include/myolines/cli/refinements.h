// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/scene.h>
#include <myolines/study/verify.h>

#include <filesystem>
#include <string>
#include <vector>

namespace myolines
{
  /// What can be made finer or coarser in a scene, with the rates of theory and predicted costs:
  /// - steps: half and twice as long, of the order of the method; where steps are chosen by error, tolerances an eighth and eight times as
  ///   large, of the order p / k, p that of the method and k the exponent of its estimate (1 for methods that choose their steps
  ///   themselves);
  /// - mesh: as SystemEntry::mesh has it, of the order degree + 1;
  /// - degree: one more, or one less where there is no higher one;
  /// - least damping: method_of_least_damping(), where the system has inertia, for which the scene may have another method.
  /// - method: the first of methods_for_every_system(), where its order is higher than that of the scene's.
  /// Meshes that need more memory than there is are left out, and finer ones where steps are explicit.
  /// @throws InputError if it is no scene.
  study::Refinements refinements_of(const std::filesystem::path &file, const std::vector<std::string> &overrides);

  /// The tolerances of the list @p control, whose steps are chosen by error, times @p factor.
  std::vector<std::string> scaled_tolerances(const scene::Node &control, double factor);
} // namespace myolines
