#include <myolines/time/stage.h>

namespace myolines
{
  namespace
  {
    MethodFacts facts()
    {
      MethodFacts facts;
      facts.name = "static";
      facts.summary =
          "A sequence of equilibria: inertia and rates are left out, loads and boundaries follow the time; boundary rates play no part.";
      facts.reference = "thesis (5.4.2), remark 5.6: V = 0 throughout";
      facts.order     = 0;
      facts.stability = "no dynamics";
      facts.dynamic   = false;
      return facts;
    }

    /// R(t_1, u_1, 0, 0) = 0; v and a stay zero, also on moving boundaries, so that no rate term is met.
    class Static : public Integrator
    {
    public:
      explicit Static(IntegratorContext context)
        : stage_(at_rest(context))
      {}

      void start(State &state) override
      {
        state.v = 0;
        state.a = 0;
      }

      StepReport step(const double dt, State &state) override
      {
        Stage stage;
        stage.t = state.t + dt;
        stage.c = {1, 0, 0};

        State predictors = state;
        predictors.v     = 0;
        predictors.a     = 0;
        Vector increment = state.u;
        increment        = 0;
        return stage_.step(stage, predictors, increment, state);
      }

      void save(Archive &) const override {}
      void load(const Archive &) override {}

    private:
      static IntegratorContext at_rest(IntegratorContext context)
      {
        context.boundary_rates = BoundaryRates::scheme; // the "scheme" of this method is v = a = 0
        return context;
      }

      StageSolver stage_;
    };
  } // namespace

  IntegratorEntry static_entry()
  {
    IntegratorEntry entry;
    entry.facts  = facts();
    entry.schema = scene::Schema(entry.facts.summary);
    entry.make   = [](const scene::Node &, const IntegratorContext &context) { return std::make_unique<Static>(context); };
    return entry;
  }
} // namespace myolines
