// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/observers/muscle3d_series.h>

namespace myolines
{
  SeriesEntry activation_and_length_series()
  {
    return switched_series("activation and length", true, SeriesNeeds::nothing, "activation_muscle_length-3d.csv.",
                           [](const SeriesContext &context) -> std::unique_ptr<SeriesFile> {
                             std::vector<std::string> columns{"Time [s]", "Activation (%)", "Muscle length [m]"};
                             for (const ActivationRegion &region : context.system.parameters().regions)
                               columns.push_back("Activation of " + region.name + " (%)");
                             return make_series_file(context.folder,
                                                     {"activation_muscle_length-3d.csv", "Activation and length of the muscle"}, columns,
                                                     [](const Muscle3dSample &sample) {
                                                       const Activation    a = sample.activation();
                                                       std::vector<double> row{sample.t(), 100 * a.level[0], sample.muscle_length()};
                                                       for (int r = 1; r < a.n_regions; ++r)
                                                         row.push_back(100 * a.level[r]);
                                                       return row;
                                                     });
                           });
  }
} // namespace myolines
