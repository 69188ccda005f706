// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/error_control.h>
#include <myolines/time/error_norm.h>
#include <myolines/time/start.h>
#include <myolines/time/step_doubling.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace myolines
{
  namespace
  {
    double relative(const double error, const ErrorTolerances::Block &tolerance, const double size)
    {
      return error == 0 ? 0 : error / (tolerance.absolute + tolerance.relative * size);
    }
  } // namespace

  ErrorNorm::ErrorNorm(const ErrorTolerances &tolerances, const SemiDiscreteSystem &system)
    : tolerances_(tolerances)
    , communicator_(system.initial_state(0).u.get_mpi_communicator())
  {
    const Vector layout = system.initial_state(0).u;
    for (unsigned int i = 0; i < layout.locally_owned_size(); ++i)
      if (!system.constraints().is_constrained(layout.get_partitioner()->local_to_global(i)))
        free_.push_back(i);
    n_free_ = dealii::Utilities::MPI::sum(static_cast<double>(free_.size()), communicator_);
  }

  double ErrorNorm::rms(const Vector &x) const
  {
    double sum = 0;
    for (const unsigned int i : free_)
      sum += x.local_element(i) * x.local_element(i);
    return n_free_ == 0 ? 0 : std::sqrt(dealii::Utilities::MPI::sum(sum, communicator_) / n_free_);
  }

  double ErrorNorm::of_step(const Vector &error_u, const Vector *error_v, const State &begin, const State &end) const
  {
    double error = relative(rms(error_u), tolerances_.displacement, std::max(rms(begin.u), rms(end.u)));
    if (tolerances_.velocity && error_v != nullptr)
      error = std::max(error, relative(rms(*error_v), *tolerances_.velocity, std::max(rms(begin.v), rms(end.v))));
    return error;
  }

  double ErrorNorm::of_solve(const Vector &d, const Weights &c, const double u, const double v) const
  {
    const double size  = rms(d);
    double       error = relative(std::abs(c.u) * size, tolerances_.displacement, u);
    if (tolerances_.velocity)
      error = std::max(error, relative(std::abs(c.v) * size, *tolerances_.velocity, v));
    return error / tolerances_.solver_fraction;
  }

  void ErrorNorm::judge(const double error, StepReport &report)
  {
    report.error_estimate = error;
    if (error <= 1)
      return;
    std::ostringstream text;
    text.precision(3);
    text << "the estimated error is " << error << " times the tolerance";
    report.outcome = StepReport::Outcome::error_too_large;
    report.reason  = text.str();
  }

  MethodFacts facts_with(const IntegratorEntry &entry, const scene::Node &integrator)
  {
    return entry.facts_of_parameters ? entry.facts_of_parameters(integrator) : entry.facts;
  }

  unsigned int error_exponent(const MethodFacts &facts) { return facts.error_exponent != 0 ? facts.error_exponent : facts.order + 1; }

  std::unique_ptr<Integrator> make_integrator(const IntegratorEntry &entry, const scene::Node &integrator, const IntegratorContext &context)
  {
    if (!entry.make)
      integrator.refuse("type", "\"" + entry.facts.name + "\" chooses its steps itself", "\"time/control/type\" = \"error\"",
                        "its tolerances are in \"time/control\"");
    require_fit(facts_with(entry, integrator), integrator, context);
    if (context.error_norm == nullptr)
      return entry.make(integrator, context);
    const MethodFacts facts      = facts_with(entry, integrator);
    const bool        equilibria = context.system.capabilities().orders == std::vector<unsigned int>{0};
    if (facts.order == 0 || equilibria)
      integrator.refuse("type",
                        (equilibria ? "steps end in equilibrium, however long they are: " : "") + ("\"" + facts.name + "\"") +
                            " makes no error in time that could be controlled",
                        "another \"time/control/type\"", "\"cut back\" shortens steps that fail");
    if (facts.error_exponent == 0 && !facts.doubles)
      integrator.refuse("type", "\"" + facts.name + "\" does not estimate its error, nor can its steps be taken in halves to do so",
                        "another \"time/control/type\", or a method that does",
                        "`myolines list integrators` tells what each method estimates");
    if (context.error_norm->looks_at_velocity() && !facts.estimates_velocity)
      integrator.refuse("type", "\"" + facts.name + "\" estimates the error of displacements only",
                        "no list \"time/control/velocity\", or a method that estimates both",
                        "--unset time/control/velocity; `myolines list integrators` tells what each method estimates");
    return facts.error_exponent == 0 ? make_step_doubling(entry, integrator, context) : entry.make(integrator, context);
  }

  std::unique_ptr<SelfPacedIntegrator> make_self_paced(const IntegratorEntry &entry, const scene::Node &integrator,
                                                       const IntegratorContext &context, const ErrorControlLimits &limits)
  {
    require_fit(facts_with(entry, integrator), integrator, context);
    return entry.make_self_paced(integrator, context, limits);
  }
} // namespace myolines
