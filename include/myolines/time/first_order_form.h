// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/time/stage.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace myolines
{
  class FreeUnknowns;

  /// A system of second order as solvers of first-order equations see it: M a + F(t, u, v) = 0 with y = (u, v) of the free
  /// unknowns only,
  ///
  ///     u' = v,    M v' = -F.
  ///
  /// A system of first order, F(t, u, v) = 0, is served by the same equations with M = 0: v is then algebraic.
  ///
  /// Constrained unknowns are known functions of time and of the free ones: they have no equation, no error and no error weight.
  /// They move with exact rates. All arrays are of this rank: those called y first the free displacements, then the free velocities,
  /// others one entry for each free unknown.
  class FirstOrderForm
  {
  public:
    /// A system of @p context that has inertia, and unknowns of second order only, or no inertia and unknowns of first order only;
    /// @p layout is any state of it.
    FirstOrderForm(const IntegratorContext &context, const State &layout);
    ~FirstOrderForm();

    /// A smooth piece begins at @p t: drives take their right limits then, later their left ones.
    void begin_piece(double t) { piece_begin_ = t; }

    /// A smooth piece begins at @p state, which gets its boundary velocities and consistent accelerations (start.h), or without inertia
    /// consistent velocities of the free unknowns. @throws SolveError if there are none.
    void start_piece(State &state);
    bool begins_piece(double t) const { return piece_begin_ == t; } ///< whether @p t is that beginning, bit for bit

    std::size_t n_free() const { return free_.size(); }                         ///< of this rank
    std::size_t n_free_of_all_ranks() const { return n_free_of_all_ranks_; }    ///< the sum of n_free()
    MPI_Comm    communicator() const { return full_.u.get_mpi_communicator(); } ///< the ranks that share the system

    /// u, v and, where @p a is given, a of the free unknowns.
    void gather(const State &state, double *y, double *a = nullptr) const;

    /// The state at (t, y) with the accelerations @p a of the free unknowns (nullptr: zero). Valid until the next call of another
    /// function of this class.
    State &state(double t, const double *y, const double *a);

    /// r = R(t, u, v, a), C^T R in the rows of the free unknowns. False: inadmissible, see take_reason().
    bool residual(double t, const double *y, const double *a, double *r);

    /// Linearises at (t, y, a), where the residual is admissible.
    void linearise(double t, const double *y, const double *a);

    /// x with (w.u K + w.v C + w.a M) x = b of the last linearise(), to `forcing maximum`. False: see take_reason().
    bool solve(const Weights &w, const double *b, double *x);

    /// y = (w.u K + w.v C + w.a M) x of the last linearise().
    void apply(const Weights &w, const double *x, double *y);

    /// For the two below. The mass is that at the point of the first call.
    void linearise_mass(double t, const double *y);
    /// x with M x = b, to twelve digits. False: see take_reason().
    bool solve_mass(const double *b, double *x);
    void apply_mass(const double *x, double *y); ///< y = M x

    /// For what else is to be solved in the same storage.
    StageSolver &stage_solver() { return solver_; }

    bool has_reason() const { return !reason_.empty(); } ///< whether take_reason() has something

    /// Why the last call that failed did so, and forgets it; empty if none has.
    std::string take_reason() { return std::exchange(reason_, {}); }

    /// Iterations and residuals since the last call.
    StepReport take_counts();

  private:
    class Mass;

    void consistent_rates(State &state);
    Side side(double t) const { return begins_piece(t) ? Side::right : Side::left; }
    void scatter(const double *values, Vector &x) const;
    void gather(const Vector &x, double *values) const;
    bool solve(StageSolver &solver, const Weights &w, const double *b, double *x, bool roughly);
    void apply(const StageSolver &solver, const Weights &w, const double *x, double *y);

    const IntegratorContext       context_;
    StageSolver                   solver_;
    std::unique_ptr<Mass>         mass_;
    std::unique_ptr<FreeUnknowns> constraints_;
    std::vector<unsigned int>     free_; ///< local numbers
    std::size_t                   n_free_of_all_ranks_;
    std::optional<double>         piece_begin_; ///< [s]
    State                         full_;
    Vector                        in_, out_;
    StepReport                    counts_;
    std::string                   reason_;
  };
} // namespace myolines
