// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/combination.h>
#include <myolines/time/dirk_tables.h>
#include <myolines/time/start.h>

namespace myolines
{
  namespace
  {
    /// v_1 and a_1 are derivatives of the cubic through u at t_1 and the three ends of steps before, at any distances. The first two steps
    /// of a smooth piece are of sdirk3, whose errors are smaller than those of this method.
    class Houbolt : public Integrator
    {
    public:
      explicit Houbolt(const IntegratorContext &context)
        : context_(context)
        , solver_(context)
        , starter_(sdirk3_table(), solver_, context)
        , now_(context.make_vector())
        , before_{now_, now_}
        , end_(context.make_state())
      {}

      void start(State &state) override
      {
        start_piece(context_, solver_, state);
        dt_[0] = dt_[1] = 0;
      }

      StepReport step(const double dt, State &state) override
      {
        combine(now_, {{1, &state.u}});
        const StepReport report = dt_[1] == 0 ? starter_.step(dt, state) : go_on(dt, state);
        if (!report.accepted())
          return report;
        before_[1].swap(before_[0]);
        before_[0].swap(now_);
        dt_[1] = std::exchange(dt_[0], dt);
        return report;
      }

      void remember(Memory &memory) override
      {
        memory.keep("last step", dt_[0]);
        memory.keep("step before", dt_[1]);
        memory.keep("u before the last step", before_[0]);
        memory.keep("u before that", before_[1]);
      }

    private:
      StepReport go_on(const double dt, State &state)
      {
        const double x[] = {-dt, -dt - dt_[0], -dt - dt_[0] - dt_[1]}; // of the earlier ends from t_1
        double       v[3], a[3], c_v = 0, c_a = 0; // derivatives at t_1 of the cubics that are 1 at one end and 0 at the others
        for (unsigned int j = 0; j < 3; ++j)
          {
            const double p = x[(j + 1) % 3], q = x[(j + 2) % 3], scale = x[j] * (x[j] - p) * (x[j] - q);
            v[j] = p * q / scale;
            a[j] = -2 * (p + q) / scale;
            c_v -= v[j];
            c_a -= a[j];
          }
        const Stage stage{state.t + dt, Side::left, {1, c_v, c_a}}; // u_1 = u~ + d with the u~ of no acceleration
        combine(end_.u, {{-a[0] / c_a, &state.u}, {-a[1] / c_a, &before_[0]}, {-a[2] / c_a, &before_[1]}});
        combine(end_.v, {{c_v, &end_.u}, {v[0], &state.u}, {v[1], &before_[0]}, {v[2], &before_[1]}});
        end_.a = 0;
        return solver_.step(stage, end_, state);
      }

      const IntegratorContext context_;
      StageSolver             solver_;
      DirkStepper             starter_;
      double                  dt_[2] = {0, 0}; ///< of the last step and the one before; 0: there was none
      Vector                  now_, before_[2];
      State                   end_;
    };
  } // namespace

  IntegratorEntry houbolt_entry()
  {
    IntegratorEntry entry;
    entry.facts  = {"houbolt", "Velocity and acceleration at the end of a step are those of a cubic through the last four displacements.",
                    "Houbolt, doi:10.2514/8.1722", 2, "A-stable for equal steps, damps high frequencies at once and low ones as well"};
    entry.schema = scene::Schema(entry.facts.summary);
    entry.make   = [](const scene::Node &, const IntegratorContext &context) { return std::make_unique<Houbolt>(context); };
    entry.facts.doubles = false;
    return entry;
  }
} // namespace myolines
