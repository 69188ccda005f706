// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/observers/muscle3d_series.h>
#include <myolines/observers/stress_columns.h>

namespace myolines
{
  SeriesEntry forces_series()
  {
    return switched_series(
        "forces", true, SeriesNeeds::line,
        "force_data-3d.csv: part along the line of action of the interior-point estimate (6.2.15) of the force on the force face, by "
        "part of the stress; reaction.csv has the force that balances the body.",
        [](const SeriesContext &context) -> std::unique_ptr<SeriesFile> {
          const StressParts          parts(context.system.parameters());
          const dealii::Tensor<1, 3> along = context.system.line_of_action().line.value().direction;
          std::vector<std::string>   columns{"Time [s]"};
          for (const std::string &part : parts.names("Apo"))
            columns.push_back(part + " [N]");
          columns.push_back("Volume [m^3]");
          return make_series_file(
              context.folder, {"force_data-3d.csv", "Force at the measured face, estimated from interior points, by part of the stress"},
              columns, [parts, face = context.force_face.value(), along](const Muscle3dSample &sample) {
                std::vector<double> row{sample.t()};
                for (const dealii::Tensor<1, 3> &force : parts.values(sample.face_force(face)))
                  row.push_back(force * along);
                row.push_back(sample.body().volume);
                return row;
              });
        });
  }
} // namespace myolines
