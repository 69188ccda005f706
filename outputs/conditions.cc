// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/boundary/face_mean.h>
#include <myolines/muscle3d/discretisation.h>
#include <myolines/muscle3d/surface_forces.h>
#include <myolines/observers/muscle3d_series.h>

#include <map>

namespace myolines
{
  namespace
  {
    /// conditions.csv: what each boundary condition does to the body, and what its springs and dashpots do.
    class Conditions
    {
    public:
      explicit Conditions(const Muscle3dSystem &system)
        : system_(system)
      {
        const Vector3 rest;
        for (const auto &condition : conditions())
          if (condition->tendon(0, Side::right, rest))
            faces_.emplace(condition->facts().name, FaceMean(*system.discretisation().space, condition->facts().face));
      }

      std::vector<std::string> columns() const
      {
        std::vector<std::string> all{"Time [s]"};
        const Vector3            rest;
        for (const auto &condition : conditions())
          {
            const std::string &name = condition->facts().name;
            if (moves())
              all.push_back(name + " power [W]");
            if (condition->facts().supports)
              all.push_back(name + " stored [J]");
            if (condition->facts().supports && moves())
              all.push_back(name + " dissipation [W]");
            if (const auto tendon = condition->tendon(0, Side::right, rest))
              {
                all.push_back(name + " elongation [m]");
                if ((*tendon)[1] > 0)
                  all.push_back(name + " strain");
              }
          }
        return all;
      }

      std::vector<double> row(const Muscle3dSample &sample) const
      {
        const State &state = sample.state();
        const Point  point{state.t, sample.side(), state.u, state.v, state.a};

        std::map<std::string, double> constrained; // power of prescribed motion and ties
        if (moves())
          for (const Reaction &reaction : sample.reactions())
            constrained[reaction.condition] = reaction.power;

        std::vector<double> row{state.t};
        for (const auto &condition : conditions())
          {
            const BoundaryFacts      &facts   = condition->facts();
            const SurfaceForces      &surface = system_.surface_forces();
            const SurfaceForces::Work work    = facts.supports ? surface.work(point, condition.get()) : SurfaceForces::Work{};
            if (moves())
              row.push_back(constrained[facts.name] + surface.power_on_body(point, *condition));
            if (facts.supports)
              row.push_back(work.energy);
            if (facts.supports && moves())
              row.push_back(work.dissipation);
            if (const auto face = faces_.find(facts.name); face != faces_.end())
              {
                const auto [elongation, length] = *condition->tendon(state.t, sample.side(), face->second.of(state.u));
                row.push_back(elongation);
                if (length > 0)
                  row.push_back(elongation / length);
              }
          }
        return row;
      }

    private:
      const BoundaryConditions &conditions() const { return system_.parameters().boundary; }
      bool                      moves() const { return system_.parameters().dynamic; } ///< states have velocities

      const Muscle3dSystem           &system_;
      std::map<std::string, FaceMean> faces_; ///< of tendons, by name of the condition
    };
  } // namespace

  SeriesEntry conditions_series()
  {
    return switched_series(
        "conditions", false, SeriesNeeds::nothing,
        "conditions.csv: power of each boundary condition on the body, energy and dissipation of its springs and dashpots, "
        "elongation and strain of its tendon; powers and dissipation of dynamic systems only.",
        [](const SeriesContext &context) -> std::unique_ptr<SeriesFile> {
          const auto                     conditions = std::make_shared<Conditions>(context.system);
          const std::vector<std::string> columns    = conditions->columns();
          if (columns.size() == 1)
            return nullptr;
          return make_series_file(context.folder,
                                  {"conditions.csv", "Powers of the boundary conditions, energies of springs, elongation of tendons"},
                                  columns, [conditions](const Muscle3dSample &sample) { return conditions->row(sample); });
        });
  }
} // namespace myolines
