// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/time/error_norm.h>
#include <myolines/time/first_order_form.h>

#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_nvector.h>

#include <functional>
#include <memory>
#include <string>

namespace myolines
{
  /// One session with SUNDIALS, on the ranks of a communicator.
  class SundialsContext
  {
  public:
    explicit SundialsContext(MPI_Comm communicator);              ///< @throws std::runtime_error if SUNDIALS makes none
    ~SundialsContext() { SUNContext_Free(&context_); }            ///< Ends the session.
    SundialsContext(const SundialsContext &)            = delete; ///< A session has one owner.
    SundialsContext &operator=(const SundialsContext &) = delete;

    operator SUNContext() const { return context_; } ///< For calls of SUNDIALS.

  private:
    MPI_Comm   communicator_;
    SUNContext context_ = nullptr;
  };

  using SundialsVector = std::unique_ptr<std::remove_pointer_t<N_Vector>, void (*)(N_Vector)>; ///< A vector of SUNDIALS that frees itself.

  /// y = (u, v) of the free unknowns of @p form, zero.
  SundialsVector make_sundials_vector(const FirstOrderForm &form, SUNContext context);

  ///@{
  /// The entries of this rank.
  inline double       *entries(N_Vector x) { return N_VGetArrayPointer(x); }
  inline const double *entries(const SundialsVector &x) { return N_VGetArrayPointer(x.get()); }
  inline double       *entries(SundialsVector &x) { return N_VGetArrayPointer(x.get()); }
  ///@}

  /// A matrix that SUNDIALS hands around and only we know, with the solver that goes with it.
  class SundialsMatrix
  {
  public:
    /// y = A x or A y = x, of whole vectors (u, v); false: it failed, and a shorter step may help.
    using Map = std::function<bool(const double *x, double *y)>;

    /// @p times may be empty: only the mass is multiplied with.
    SundialsMatrix(SUNContext context, Map solve, Map times = {});
    ~SundialsMatrix();
    SundialsMatrix(const SundialsMatrix &)            = delete; ///< SUNDIALS keeps a pointer to the object.
    SundialsMatrix &operator=(const SundialsMatrix &) = delete;

    SUNMatrix       matrix() const { return matrix_; } ///< for calls of SUNDIALS
    SUNLinearSolver solver() const { return solver_; } ///< the solver that belongs to it

  private:
    Map             solve_, times_;
    SUNMatrix       matrix_;
    SUNLinearSolver solver_;
  };

  /// Weights with which the WRMS norm of SUNDIALS is sqrt(E_u^2 + E_v^2), E of a block the root mean square of its errors over its
  /// tolerance as in ErrorNorm; without a tolerance of velocities it is E_u.
  void set_error_weights(const ErrorTolerances &tolerances, const FirstOrderForm &form, const double *y, double *weights);

  std::string sundials_version(); ///< as loaded

  /// Throws (std::runtime_error) unless @p flag says success; for calls that cannot fail if the program is right.
  void require_success(int flag, const char *call);
} // namespace myolines
