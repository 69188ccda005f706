// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/time/integrator.h>

#include <memory>
#include <optional>

namespace myolines
{
  /// Tolerated errors of one step.
  struct ErrorTolerances
  {
    /// Tolerances of displacements, or of velocities.
    struct Block
    {
      double relative; ///< of the size of the block
      double absolute; ///< [m], [m/s]
    };
    Block                displacement; ///< always looked at
    std::optional<Block> velocity;     ///< none: velocities are not looked at

    double solver_fraction = 0.05; ///< of the tolerances, for errors of the nonlinear solves
  };

  /// The size of errors relative to the tolerances: the larger one, of displacements and velocities, of
  ///
  ///     rms(e) / (absolute + relative rms(x)),
  ///
  /// with root mean squares over the free unknowns of all ranks; constrained ones have no error.
  class ErrorNorm
  {
  public:
    ErrorNorm(const ErrorTolerances &tolerances, const SemiDiscreteSystem &system); ///< for states of @p system

    double rms(const Vector &x) const; ///< root mean square over the free unknowns

    /// Of the errors @p error_u [m] and @p error_v [m/s] of a step from @p begin to @p end; sizes are the larger ones at
    /// both ends. @p error_v is nullptr if it is not known.
    double of_step(const Vector &error_u, const Vector *error_v, const State &begin, const State &end) const;

    /// Of changes c_u @p d [m], c_v @p d [m/s] at sizes @p u, @p v, in units of the fraction that nonlinear solves may leave.
    double of_solve(const Vector &d, const Weights &c, double u, double v) const;

    const ErrorTolerances &tolerances() const { return tolerances_; }                             ///< as given
    bool                   looks_at_velocity() const { return tolerances_.velocity.has_value(); } ///< whether errors of velocities count

    /// Notes the estimate @p error in @p report and refuses the step if it exceeds 1.
    static void judge(double error, StepReport &report);

  private:
    const ErrorTolerances     tolerances_;
    const MPI_Comm            communicator_;
    std::vector<unsigned int> free_;   ///< local numbers
    double                    n_free_; ///< on all ranks
  };

  /// k of the estimates O(dt^k) that error control works with: those of the method, or of step doubling.
  unsigned int error_exponent(const MethodFacts &facts);

  /// The method as a scene asks for it. With an error norm in @p context a method without an estimate of its own gets one by
  /// step doubling. @throws InputError (at the parameters of @p integrator or from the method) if they do not fit, or if the system does
  /// not fit the facts of the method (require_fit()).
  std::unique_ptr<Integrator> make_integrator(const IntegratorEntry &entry, const scene::Node &integrator,
                                              const IntegratorContext &context);

  /// The same for a method that chooses its steps itself, which has a function for it.
  std::unique_ptr<SelfPacedIntegrator> make_self_paced(const IntegratorEntry &entry, const scene::Node &integrator,
                                                       const IntegratorContext &context, const ErrorControlLimits &limits);
} // namespace myolines
