// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

// What differs between SUNDIALS 6.4 and 7: how a session is told its ranks, who hears of errors, and the name of success. From 7 on
// sessions have one handler of errors; before, each solver has its own.
#include <mpi.h>
#include <sundials/sundials_config.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_nonlinearsolver.h>

#include <string>

namespace myolines
{
#if SUNDIALS_VERSION_MAJOR >= 7

  constexpr int sundials_solved = SUN_SUCCESS; ///< what a nonlinear solver returns that has converged

  /// A session on the ranks of @p communicator. The flag of SUNDIALS, 0: done.
  inline int create_sundials_context(MPI_Comm &communicator, SUNContext &context) { return SUNContext_Create(communicator, &context); }

  /// Writes the text of an error into the std::string @p kept.
  inline void keep_sundials_error(int, const char *, const char *, const char *text, SUNErrCode, void *kept, SUNContext)
  {
    *static_cast<std::string *>(kept) = text;
  }

  /// Text of the last failure of a solver goes to the std::string @p kept; PREFIX is that of the solver's functions, such as CVode.
#  define MYOLINES_KEEP_SUNDIALS_ERRORS(PREFIX, memory, context, kept)                                                                     \
    (SUNContext_ClearErrHandlers(context), SUNContext_PushErrHandler(context, keep_sundials_error, &(kept)))

#else

  constexpr int sundials_solved = SUN_NLS_SUCCESS; ///< what a nonlinear solver returns that has converged

  /// A session on the ranks of @p communicator. The flag of SUNDIALS, 0: done.
  inline int create_sundials_context(MPI_Comm &communicator, SUNContext &context) { return SUNContext_Create(&communicator, &context); }

  /// Writes the text of an error into the std::string @p kept.
  inline void keep_sundials_error(int, const char *, const char *, char *text, void *kept) { *static_cast<std::string *>(kept) = text; }

#  define MYOLINES_KEEP_SUNDIALS_ERRORS(PREFIX, memory, context, kept) PREFIX##SetErrHandlerFn(memory, keep_sundials_error, &(kept))

#endif
} // namespace myolines
