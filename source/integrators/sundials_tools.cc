// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/integrators/sundials_tools.h>
#include <myolines/integrators/sundials_versions.h>
#include <myolines/time/error_norm.h>

#include <deal.II/base/mpi.h>

#include <nvector/nvector_parallel.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_version.h>

#include <cmath>
#include <stdexcept>

namespace myolines
{
  SundialsContext::SundialsContext(const MPI_Comm communicator)
    : communicator_(communicator)
  {
    require_success(create_sundials_context(communicator_, context_), "SUNContext_Create");
  }

  SundialsVector make_sundials_vector(const FirstOrderForm &form, const SUNContext context)
  {
    const auto     local = static_cast<sunindextype>(2 * form.n_free()), global = static_cast<sunindextype>(2 * form.n_free_of_all_ranks());
    const bool     serial = dealii::Utilities::MPI::n_mpi_processes(form.communicator()) == 1;
    SundialsVector x(serial ? N_VNew_Serial(local, context) : N_VNew_Parallel(form.communicator(), local, global, context), N_VDestroy);
    N_VConst(0, x.get());
    return x;
  }

  namespace
  {
    const SundialsMatrix::Map &map_of(void *content) { return *static_cast<const SundialsMatrix::Map *>(content); }

    int apply(const SundialsMatrix::Map &map, N_Vector x, N_Vector y) { return map(entries(x), entries(y)) ? 0 : 1; }

    SUNMatrix new_matrix(SUNContext context, void *times)
    {
      SUNMatrix matrix     = SUNMatNewEmpty(context);
      matrix->content      = times;
      matrix->ops->getid   = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
      matrix->ops->clone   = [](SUNMatrix other) { return new_matrix(other->sunctx, other->content); };
      matrix->ops->destroy = SUNMatFreeEmpty;
      matrix->ops->zero    = [](SUNMatrix) { return 0; };
      matrix->ops->copy    = [](SUNMatrix, SUNMatrix) { return 0; };
      matrix->ops->matvec  = [](SUNMatrix a, N_Vector x, N_Vector y) { return apply(map_of(a->content), x, y); };
      return matrix;
    }
  } // namespace

  SundialsMatrix::SundialsMatrix(SUNContext context, Map solve, Map times)
    : solve_(std::move(solve))
    , times_(std::move(times))
    , matrix_(new_matrix(context, &times_))
    , solver_(SUNLinSolNewEmpty(context))
  {
    solver_->content      = &solve_;
    solver_->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
    solver_->ops->getid   = [](SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; };
    solver_->ops->setup   = [](SUNLinearSolver, SUNMatrix) { return 0; };
    solver_->ops->solve = [](SUNLinearSolver s, SUNMatrix, N_Vector x, N_Vector b, sunrealtype) { return apply(map_of(s->content), b, x); };
    solver_->ops->free  = [](SUNLinearSolver s) {
      SUNLinSolFreeEmpty(s);
      return 0;
    };
  }

  SundialsMatrix::~SundialsMatrix()
  {
    SUNLinSolFree(solver_);
    SUNMatDestroy(matrix_);
  }

  void set_error_weights(const ErrorTolerances &tolerances, const FirstOrderForm &form, const double *y, double *weights)
  {
    const std::size_t n    = form.n_free();
    const auto        fill = [&](const ErrorTolerances::Block *block, const double *x, double *w) {
      double sum = 0;
      for (std::size_t i = 0; i < n; ++i)
        sum += x[i] * x[i];
      const double rms    = std::sqrt(dealii::Utilities::MPI::sum(sum, form.communicator()) / form.n_free_of_all_ranks());
      const double weight = block != nullptr ? std::sqrt(2.) / (block->absolute + block->relative * rms) : 0;
      std::fill(w, w + n, weight);
    };
    fill(&tolerances.displacement, y, weights);
    fill(tolerances.velocity ? &*tolerances.velocity : nullptr, y + n, weights + n);
  }

  std::string sundials_version()
  {
    char text[64];
    return SUNDIALSGetVersion(text, sizeof(text)) == 0 ? text : "unknown";
  }

  void require_success(const int flag, const char *call)
  {
    if (flag < 0)
      throw std::runtime_error(std::string(call) + " failed with the flag " + std::to_string(flag));
  }
} // namespace myolines
