// SPDX-License-Identifier: LGPL-2.1-or-later
// The order of a method of one's own in any scene: differences of its results with twice as many steps each time.
//
//     convergence SCENE.xml STEPS

#include <myolines/cli/experiment.h>
#include <myolines/cli/guarded.h>
#include <myolines/cli/mpi_session.h>
#include <myolines/time/combination.h>
#include <myolines/time/start.h>

#include <cmath>
#include <cstdio>
#include <iostream>

namespace
{
  using namespace myolines;

  /// The implicit midpoint rule: R at the means of both ends, with a = (v_1 - v_0)/dt and (u_1 - u_0)/dt = (v_0 + v_1)/2.
  class Midpoint : public Integrator
  {
  public:
    explicit Midpoint(const IntegratorContext &context)
      : context_(context)
      , solver_(context)
      , end_(context.make_state())
      , half_(end_)
    {}

    void start(State &state) override { start_piece(context_, solver_, state); }

    StepReport step(const double dt, State &state) override
    {
      combine(end_.u, {{1, &state.u}, {dt, &state.v}}); // u_1 = u~ + d, v_1 = v_0 + 2 d/dt, a = 2 d/dt^2
      combine(end_.v, {{1, &state.v}});
      end_.a = 0;
      combine(half_.u, {{0.5, &state.u}});
      combine(half_.v, {{0.5, &state.v}});
      const Stage::Average middle{state.t + dt / 2, &half_, {0.5, 0.5, 1}};
      Stage                stage{state.t + dt, Side::left, {1, 2 / dt, 2 / (dt * dt)}};
      stage.average = &middle;
      return solver_.step(stage, end_, state);
    }

  private:
    const IntegratorContext context_;
    StageSolver             solver_;
    State                   end_, half_;
  };

  Vector displacement_after(const char *scene, const unsigned int steps)
  {
    Experiment   experiment(read_whole_scene(scene));
    Midpoint     method(experiment.context());
    State        state = experiment.start();
    const double begin = state.t, length = experiment.settings().end - begin;
    method.start(state);
    for (unsigned int i = 1; i <= steps; ++i)
      {
        const StepReport report = method.step(begin + length * i / steps - state.t, state);
        if (!report.accepted())
          throw SolveError(report.reason);
        state.t = begin + length * i / steps;
      }
    return state.u;
  }
} // namespace

int main(int argc, char *argv[])
{
  MpiSession mpi(argc, argv);
  mpi.start();
  return static_cast<int>(guarded(
      [&] {
        unsigned int steps  = std::stoi(argv[2]);
        Vector       u      = displacement_after(argv[1], steps);
        double       before = 0;
        for (unsigned int i = 0; i < 4; ++i)
          {
            steps *= 2;
            Vector finer = displacement_after(argv[1], steps);
            u -= finer;
            const double difference = u.l2_norm();
            std::printf("%6u steps: difference %.3e", steps, difference);
            std::printf(before > 0 ? ", order %.2f\n" : "\n", std::log2(before / difference));
            before = difference;
            u      = finer;
          }
      },
      std::cerr));
}
