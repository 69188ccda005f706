#include <myolines/time/stage.h>

namespace myolines
{
  namespace
  {
    MethodFacts facts()
    {
      MethodFacts facts;
      facts.name      = "backward euler";
      facts.summary   = "Implicit Euler for u and v: robust, strongly dissipative, one nonlinear solve per step.";
      facts.reference = "Hairer and Wanner, Solving Ordinary Differential Equations II, doi:10.1007/978-3-642-05221-7, IV.3";
      facts.order     = 1;
      facts.stability = "L-stable";
      return facts;
    }

    /// v_1 = (u_1 - u_0)/dt, a_1 = (v_1 - v_0)/dt, R(t_1, u_1, v_1, a_1) = 0, for the increment d = u_1 - u_0:
    ///
    ///     u = u_0 + d,   v = d/dt,   a = d/dt^2 - v_0/dt.
    ///
    /// The first guess is d = 0 and not dt v_0: in nearly incompressible bodies the extrapolated displacement violates the
    /// volume constraint and makes the tangent indefinite. Nothing is remembered beyond the state.
    class BackwardEuler : public Integrator
    {
    public:
      explicit BackwardEuler(const IntegratorContext &context)
        : context_(context)
        , stage_(context)
      {}

      void start(State &state) override { start_piece(context_, state); }

      StepReport step(const double dt, State &state) override
      {
        Stage stage;
        stage.t = state.t + dt;
        stage.c = {1, 1 / dt, 1 / (dt * dt)};

        State predictors = state;
        predictors.v     = 0;
        predictors.a.equ(-1 / dt, state.v);
        return stage_.step(stage, std::move(predictors), state);
      }

      void save(Archive &) const override {}
      void load(const Archive &) override {}

    private:
      const IntegratorContext context_;
      StageSolver             stage_;
    };
  } // namespace

  IntegratorEntry backward_euler_entry()
  {
    IntegratorEntry entry;
    entry.facts  = facts();
    entry.schema = scene::Schema(entry.facts.summary);
    entry.make   = [](const scene::Node &, const IntegratorContext &context) { return std::make_unique<BackwardEuler>(context); };
    return entry;
  }
} // namespace myolines
