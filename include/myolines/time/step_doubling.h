// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/time/error_norm.h>

namespace myolines
{
  /// A one-step method that estimates its error by taking every step twice, whole and in halves. With p its order
  ///
  ///     e = (y_halves - y_whole) / (2^p - 1)
  ///
  /// is the error of y_halves, with which the run goes on (Hairer, Norsett and Wanner, doi:10.1007/978-3-540-78862-1, II.4).
  /// What the method remembers from step to step is put back for the second way, through its save() and load().
  std::unique_ptr<Integrator> make_step_doubling(const IntegratorEntry &entry, const scene::Node &integrator,
                                                 const IntegratorContext &context);
} // namespace myolines
