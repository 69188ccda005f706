// SPDX-License-Identifier: LGPL-2.1-or-later
// Where a pressure that follows a face has an energy.
#include <myolines/muscle3d/surface_forces.h>

#include <algorithm>
#include <map>

namespace myolines
{
  void SurfaceForces::find_potentials(const Muscle3dParameters &parameters)
  {
    const bool moves = std::any_of(parameters.boundary.begin(), parameters.boundary.end(), [](const auto &condition) {
      const auto &moving = condition->facts().moving;
      return moving[0] || moving[1] || moving[2];
    });
    for (const auto &condition : parameters.boundary)
      if (condition->facts().follows)
        {
          const Edge here                = edge(*condition);
          const Edge all                 = {dealii::Utilities::MPI::max(here.cuts_cells ? 1 : 0, d_.communicator) == 1,
                                            dealii::Utilities::MPI::max(here.moves ? 1 : 0, d_.communicator) == 1};
          no_potential_[condition.get()] = !condition->constant_pressure() ? "it is no constant pressure"
                                           : moves                         ? "a condition moves the body"
                                           : all.cuts_cells                ? "the box of its face cuts cells"
                                           : all.moves                     ? "the edge of its face is not held"
                                                                           : "";
        }
  }

  /// The work of a pressure p on a face is -p times the volume that the face sweeps, which depends on the way that its edge takes. Edges
  /// that two cells of the face share are inside.
  SurfaceForces::Edge SurfaceForces::edge(const BoundaryCondition &condition) const
  {
    using Line = std::vector<unsigned int>; // nodes, sorted
    std::map<Line, unsigned int> times;
    std::vector<Line>            owned;
    for (const Face &face : faces_)
      if (face.condition == &condition)
        {
          const auto acts = [](const FacePoint &point) { return point.area > 0; };
          if (std::none_of(face.points.begin(), face.points.end(), acts))
            continue;
          if (!std::all_of(face.points.begin(), face.points.end(), acts))
            return {true, false};
          for (const int side : {0, n1_ - 1})
            for (const int stride : {1, n1_})
              {
                Line line;
                for (int i = 0; i < n1_; ++i)
                  line.push_back(face.nodes[stride == 1 ? side * n1_ + i : i * n1_ + side]);
                std::sort(line.begin(), line.end());
                ++times[line];
                if (face.cell->is_locally_owned())
                  owned.push_back(std::move(line));
              }
        }
    const auto &lines = d_.constraints.lines;
    const auto  held  = [&](const unsigned int node) {
      for (unsigned int c = 0; c < 3; ++c)
        {
          const auto unknown = d_.space->partitioner().local_to_global(3 * node + c);
          if (!lines.is_constrained(unknown) || !lines.get_constraint_entries(unknown)->empty())
            return false;
        }
      return true;
    };
    return {false, std::any_of(owned.begin(), owned.end(),
                               [&](const Line &line) { return times[line] == 1 && !std::all_of(line.begin(), line.end(), held); })};
  }
} // namespace myolines
