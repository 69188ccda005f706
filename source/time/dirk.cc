#include <myolines/time/combination.h>
#include <myolines/time/dirk.h>
#include <myolines/time/start.h>

#include <cmath>
#include <numeric>

namespace myolines
{
  namespace
  {
    class DirkMethod : public Integrator
    {
    public:
      DirkMethod(const DirkTable &table, const IntegratorContext &context)
        : needs_acceleration_(table.explicit_first_stage())
        , context_(context)
        , solver_(context)
        , stepper_(table, solver_)
      {}

      void start(State &state) override
      {
        start_piece(context_, solver_, state);
        if (needs_acceleration_)
          consistent_acceleration(context_, solver_, Side::right, state);
      }
      StepReport step(const double dt, State &state) override { return stepper_.step(dt, state); }
      void       save(Archive &) const override {}
      void       load(const Archive &) override {}

    private:
      const bool              needs_acceleration_;
      const IntegratorContext context_;
      StageSolver             solver_;
      DirkStepper             stepper_;
    };

    void add(Vector &y, const double factor, const Vector &x) { combine(y, {{1, &y}, {factor, &x}}); }
  } // namespace

  double DirkTable::c(const std::size_t stage) const { return std::accumulate(a[stage].begin(), a[stage].end(), 0.); }

  void DirkStepper::allocate(const State &state)
  {
    if (!stages_.empty())
      return;
    stages_.assign(table_.a.size(), State{0, state.u, state.u, state.u});
    d_         = state.u;
    increment_ = state.u;
  }

  /// For d = u_i - u_(i-1) and g = a_ii dt: v = (u - u^)/g, a = (v - v^)/g with u^, v^ the sums over the stages before.
  /// The first guess d = 0 is a displacement that the body has had: extrapolated ones violate the volume constraint of
  /// nearly incompressible bodies and make the tangent indefinite.
  void DirkStepper::predict(const std::size_t i, const double dt, const State &state, State &point)
  {
    const double g = diagonal(i, dt);
    combine(point.u, {{1, i == 0 ? &state.u : &stages_[i - 1].u}});
    combine(point.v, {{1 / g, &increment_}});
    combine(point.a, {{-1 / g, &state.v}});
    for (std::size_t j = 0; j < i; ++j)
      {
        add(point.v, -dt * table_.a[i][j] / g, stages_[j].v);
        add(point.a, -dt * table_.a[i][j] / g, stages_[j].a);
      }
    add(point.a, 1 / g, point.v);
  }

  StepReport DirkStepper::step(const double dt, State &state)
  {
    allocate(state);
    StepReport report;
    increment_                 = 0;
    const std::size_t n_stages = table_.a.size(), first = table_.explicit_first_stage() ? 1 : 0;
    if (first == 1)
      {
        combine(stages_[0].u, {{1, &state.u}});
        combine(stages_[0].v, {{1, &state.v}});
        combine(stages_[0].a, {{1, &state.a}});
      }
    for (std::size_t i = first; i < n_stages; ++i)
      {
        const double g    = diagonal(i, dt);
        const bool   last = i + 1 == n_stages;
        Stage        stage;
        stage.t = last ? state.t + dt : state.t + table_.c(i) * dt;
        stage.c = {1, 1 / g, 1 / (g * g)};
        predict(i, dt, state, stages_[i]);
        d_ = 0;
        record(solver_.solve(stage, stages_[i], d_), report);
        if (!report.accepted())
          return report;
        add(increment_, 1, d_);
      }
    swap(state, stages_.back());
    return report;
  }

  std::unique_ptr<Integrator> make_dirk(const DirkTable &table, const MethodFacts &facts, const scene::Node &integrator,
                                        const IntegratorContext &context)
  {
    require_fitting_system(facts, integrator, context);
    return std::make_unique<DirkMethod>(table, context);
  }

  DirkTable sdirk2_table()
  {
    const double gamma = 1 - std::sqrt(0.5);
    return {{{gamma}, {1 - gamma, gamma}}};
  }
} // namespace myolines
