// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/observers/muscle3d_series.h>

#include <algorithm>
#include <optional>

namespace myolines
{
  /// reaction.csv: per condition the force with which it pulls on the muscle, and at the end of the row the parts of these forces along the
  /// line of action, where there is one.
  SeriesEntry reactions_series()
  {
    return switched_series(
        "reactions", true, SeriesNeeds::nothing, "reaction.csv: force with which each prescribed boundary condition pulls on the muscle.",
        [](const SeriesContext &context) -> std::unique_ptr<SeriesFile> {
          std::vector<BoundaryFacts> reacting = facts_of(context.system.parameters().boundary);
          reacting.erase(std::remove_if(reacting.begin(), reacting.end(), [](const BoundaryFacts &facts) { return !facts.reacts(); }),
                         reacting.end());
          if (reacting.empty())
            return nullptr;
          std::vector<std::string> columns{"Time [s]"};
          for (const BoundaryFacts &condition : reacting)
            for (const char *axis : {" x [N]", " y [N]", " z [N]"})
              columns.push_back(condition.name + axis);
          for (const BoundaryFacts &condition : reacting)
            for (const std::string &own : condition.columns)
              columns.push_back(condition.name + " " + own);
          std::optional<dealii::Tensor<1, 3>> along;
          if (const auto &line = context.system.line_of_action().line)
            along = line->direction;
          for (const BoundaryFacts &condition : reacting)
            if (along)
              columns.push_back(condition.name + " along the line [N]");
          return make_series_file(context.folder, {"reaction.csv", "Forces with which the boundary conditions pull on the body"}, columns,
                                  [along](const Muscle3dSample &sample) {
                                    std::vector<double> row{sample.t()};
                                    for (const Reaction &reaction : sample.reactions())
                                      row.insert(row.end(), {reaction.force[0], reaction.force[1], reaction.force[2]});
                                    for (const Reaction &reaction : sample.reactions())
                                      row.insert(row.end(), reaction.own.begin(), reaction.own.end());
                                    if (along)
                                      for (const Reaction &reaction : sample.reactions())
                                        row.push_back(reaction.force * *along);
                                    return row;
                                  });
        });
  }
} // namespace myolines
