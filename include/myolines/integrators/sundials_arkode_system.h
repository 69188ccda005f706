// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/integrators/sundials_arkode_tables.h>
#include <myolines/integrators/sundials_newton.h>

#include <memory>
#include <vector>

namespace myolines
{
  /// A system as ARKODE sees it: M y' = f with M = (1, M), f = (v, -F). An additive method splits -F into -F_I of the implicit part and
  /// the rest. An iteration with the matrix M - g df_I/dy and the right-hand side b is
  ///
  ///     (M + g C + g^2 K) x_u = (M + g C) b_u + g b_v,    x_v = (x_u - b_u) / g.
  class ArkodeSystem
  {
  public:
    /// @p whole outlives the system; errors and Newton's method are measured with @p tolerances.
    ArkodeSystem(const ArkodeTables &tables, const ErrorTolerances &tolerances, const scene::Node &integrator,
                 const IntegratorContext &context, FirstOrderForm &whole, const SundialsContext &sundials, const State &layout);
    ~ArkodeSystem();
    ArkodeSystem(const ArkodeSystem &)            = delete; ///< ARKODE keeps a pointer to the object.
    ArkodeSystem &operator=(const ArkodeSystem &) = delete;

    /// Memory of ARKODE that begins at (t, y), the former one deleted. It belongs to this object.
    void *begin(double t, N_Vector y);

    /// The longest stable step [s] of an explicit method in small motions about (t, y); infinity for others, and 0 if it cannot be
    /// estimated. Ledger: "stable step estimates".
    double stable_step(double t, N_Vector y);

  private:
    void create(double t, N_Vector y);
    bool right_hand_side(FirstOrderForm &form, double t, const double *y, double *f);
    bool explicit_forces(double t, const double *y, double *f);
    bool solve(const double *b, double *x);
    bool solve_mass(const double *b, double *x);
    bool multiply_mass(const double *x, double *y);

    static int linearise(double t, N_Vector y, N_Vector f, SUNMatrix matrix, SUNMatrix mass, int up_to_date, int *renewed, double g,
                         void *self, N_Vector, N_Vector, N_Vector);

    const ArkodeTables                  tables_;
    const ErrorTolerances               tolerances_;
    const IntegratorContext             context_;
    FirstOrderForm                     &whole_;
    const SundialsContext              &sundials_;
    std::unique_ptr<SemiDiscreteSystem> implicit_system_; ///< of an additive method
    std::unique_ptr<FirstOrderForm>     implicit_form_;   ///< the same
    FirstOrderForm                     &implicit_;        ///< that, or the whole
    SundialsMatrix                      newton_, mass_;
    std::unique_ptr<SundialsNewton>     newton_method_; ///< of implicit tables
    std::vector<double>                 force_, other_;
    void                               *memory_ = nullptr;
  };
} // namespace myolines
