// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/error.h>
#include <myolines/cli/catalogue.h>
#include <myolines/time/integrator.h>

#include <optional>
#include <string>
#include <vector>

namespace myolines
{
  /// "muscle 3d, quasi-static".
  std::string variant_name(const SystemEntry &system, const SystemVariant &variant);

  /// The example of a system as this variant, with the defaults of the method.
  std::vector<scene::Setting> example_of(const SystemEntry &system, const SystemVariant &variant, const IntegratorEntry &integrator);

  /// Why a run of that example is refused, by the words of the run itself, which is made for it but not started; none if it is not.
  std::optional<InputProblem> why_refused(const SystemEntry &system, const SystemVariant &variant, const IntegratorEntry &integrator);

  /// The built-in methods that take every system and estimate their errors, highest order first; the first is the one to begin with
  /// (doc/which_method.md).
  std::vector<const IntegratorEntry *> methods_for_every_system();

  /// The one whose facts have `least_damping`.
  const IntegratorEntry &method_of_least_damping();
} // namespace myolines
