// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/study/measures.h>

namespace myolines::study
{
  /// Amplitude of the vibration that @p series shows about @p t: half the mean of the two swings nearest to @p t, a swing being the
  /// distance between neighbouring turning points. Only rows within a time @p width are looked at, which has @p t in its middle, or ends at
  /// that end of the series that is nearer. 0 if these have fewer than three turning points: what is slower than that is no vibration of
  /// this width.
  double amplitude_about(const Series &series, double t, double width);
} // namespace myolines::study
