// SPDX-License-Identifier: LGPL-2.1-or-later
#include "measured_run.h"
#include "../support/places.h"

#include "../cli/program_runner.h"

#include <myolines/cli/experiment.h>
#include <myolines/measures/marker_probe.h>
#include <myolines/scene/numbers.h>

#include <cmath>
#include <ctime>

namespace myolines::testing
{
  namespace
  {
    class Watch : public Observer
    {
    public:
      Watch(const Muscle3dSystem &system, const WorkLedger &ledger, MeasuredRun &run)
        : ledger_(ledger)
        , run_(run)
        , middle_(system, {{"middle", middle_of(system.parameters().geometry.size)}}, "the middle of the block")
      {}

      void begin(const State &state) override
      {
        solves_ = ledger_.counted("nonlinear solves");
        clock_  = std::clock();
        look(state);
      }

      void accepted(const State &state, const StepRecord &record) override
      {
        iterations_ += record.report.newton_iterations;
        look(state);
      }

      void last(const State &state) override
      {
        run_.cpu_seconds      = static_cast<double>(std::clock() - clock_) / CLOCKS_PER_SEC;
        run_.newton_per_stage = iterations_ / static_cast<double>(ledger_.counted("nonlinear solves") - solves_);
        run_.u                = state.u;
        run_.v                = state.v;
      }

    private:
      static dealii::Point<3> middle_of(const std::array<double, 3> &size) { return {size[0] / 2, size[1] / 2, size[2] / 2}; }

      /// Velocities are interpolated as displacements are.
      void look(const State &state) { run_.mid_velocity.push_back(middle_.values(state.v)[0][0]); }

      const WorkLedger &ledger_;
      MeasuredRun      &run_;
      const MarkerProbe middle_;
      std::uint64_t     solves_     = 0;
      std::clock_t      clock_      = 0;
      double            iterations_ = 0;
    };
  } // namespace

  MeasuredRun measured_run(const std::string &scene, const Overrides &overrides)
  {
    Overrides all{"solver/nonlinear/relative tolerance=1e-12", "solver/nonlinear/absolute tolerance=1e-11", "time/control/type=fixed",
                  "output/checkpoint/every=1000000"};
    all.insert(all.end(), overrides.begin(), overrides.end());
    const TestFolder folder; // of the checkpoint
    Experiment       experiment(read_whole_scene(myolines::test::source_folder() + "/input/" + scene, all));
    MeasuredRun      run;
    Watch            watch(dynamic_cast<const Muscle3dSystem &>(*experiment.assembled().system), experiment.ledger(), run);
    experiment.run({&watch}, folder.path(), [] { return 0; });
    return run;
  }

  double relative_error(const Vector &x, const Vector &reference)
  {
    Vector difference = x;
    difference -= reference;
    return difference.l2_norm() / reference.l2_norm();
  }

  double relative_variation(const std::vector<double> &values, const std::vector<double> &reference)
  {
    const std::size_t n = values.size() - 1, every = (reference.size() - 1) / n;
    if (n * every + 1 != reference.size())
      throw std::logic_error("the steps of the reference are no multiple");
    double sum = 0, reference_sum = 0;
    for (std::size_t i = 1; i <= n; ++i)
      {
        sum += std::abs(values[i] - values[i - 1]);
        reference_sum += std::abs(reference[i * every] - reference[(i - 1) * every]);
      }
    return sum / reference_sum;
  }

  const std::vector<Scheme> &schemes()
  {
    const auto                       type   = [](const std::string &name) { return "integrator/type=" + name; };
    const auto                       radius = [](const std::string &rho) { return "integrator/spectral radius at infinity=" + rho; };
    const std::string                own = "integrator/first step=own", averaged = "integrator/force evaluation=averaged state";
    static const std::vector<Scheme> all{{"be", {type("backward euler")}},
                                         {"bdf2", {type("bdf2"), "integrator/first step=backward euler"}},
                                         {"newmark", {type("newmark"), own}},
                                         {"hht.1", {type("hht alpha"), "integrator/alpha=-0.1", own}},
                                         {"hht.3", {type("hht alpha"), "integrator/alpha=-0.3", own}},
                                         {"genalpha", {type("generalized alpha"), radius("0.5"), averaged, own}},
                                         {"genalpha0", {type("generalized alpha"), radius("0"), averaged, own}},
                                         {"trbdf2", {type("tr-bdf2"), own}},
                                         {"sdirk2", {type("sdirk2")}},
                                         {"sdirk3", {type("sdirk3")}}};
    return all;
  }

  const Scheme &scheme(const std::string &name)
  {
    for (const Scheme &known : schemes())
      if (known.name == name)
        return known;
    throw std::out_of_range(name);
  }

  MeasuredRun kinked_run(const Scheme &scheme, const unsigned int n, const unsigned int refinement, const Overrides &more)
  {
    Overrides overrides{"system/geometry/refinement=" + std::to_string(refinement), "system/discretisation/quadrature points=3",
                        "time/step=" + scene::format_number(0.2 / n)};
    overrides.insert(overrides.end(), scheme.parameters.begin(), scheme.parameters.end());
    overrides.insert(overrides.end(), more.begin(), more.end());
    return measured_run("kinked_block.xml", overrides);
  }
} // namespace myolines::testing
