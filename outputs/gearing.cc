// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/observers/muscle3d_series.h>

#include <cmath>
#include <limits>

namespace myolines
{
  /// gearing.csv: G = -|mean muscle velocity| / (L_f0 e0 mean fibre strain rate), thesis (7.2.13), with L_f0 of
  /// ReferenceFibre; empty while fibres are at rest. Physiological: 1 unless fibres change length faster than
  /// their maximum strain rate, 0 then.
  SeriesEntry gearing_series()
  {
    return switched_series(
        "gearing", false, SeriesNeeds::velocities_and_line, "gearing.csv: G of (7.2.13) at every row; dynamic systems only.",
        [](const SeriesContext &context) -> std::unique_ptr<SeriesFile> {
          const double fibre_speed = context.fibre.length() * context.system.parameters().muscle().fibre.maximum_strain_rate;
          return make_series_file(context.folder, {"gearing.csv", "Gearing: velocity of the muscle over that of its fibres"},
                                  {"Time [s]", "Mean muscle velocity [m/s]", "Mean fibre velocity [m/s]", "Gearing", "Physiological"},
                                  [fibre_speed](const Muscle3dSample &sample) {
                                    const double muscle = -sample.body().mean_velocity.norm();
                                    const double rate = sample.body().mean_strain_rate, fibre = fibre_speed * rate;
                                    const double gearing = fibre == 0 ? std::numeric_limits<double>::quiet_NaN() : muscle / fibre;
                                    return std::vector<double>{sample.t(), muscle, fibre, gearing, std::abs(rate) <= 1 ? 1. : 0.};
                                  });
        });
  }
} // namespace myolines
