// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "bindings.h"

#include <myolines/solve/linear_solver.h>

#include <memory>

namespace myolines
{
  namespace [[gnu::visibility("hidden")]] python
  {
    class System;

    /// A solver, and what keeps the system alive that it solves for.
    struct Solving
    {
      Solving(std::shared_ptr<void> of, const scene::Node &linear, const scene::Node &preconditioner, WorkLedger &ledger)
        : owner(std::move(of))
        , solver(linear, preconditioner, ledger)
      {}

      std::shared_ptr<void> owner;
      LinearSolver          solver;
    };

    /// K, C and M at one point, and what solves with them.
    class Linearised
    {
    public:
      Linearised(std::shared_ptr<System> system, const Point &point);

      Array    apply(const Array &x, const Weights &weights) const;
      py::dict csr(const Weights &weights);
      py::dict solve(const Array &b, const Weights &weights, double tolerance);

    private:
      std::shared_ptr<System>        system_;
      std::unique_ptr<Linearisation> linearisation_;
      mutable Vector                 x_, y_;
    };

    /// A system as arrays of the owned entries of vectors.
    class System : public std::enable_shared_from_this<System>
    {
    public:
      /// @p owner keeps the system and the solver alive.
      System(std::shared_ptr<void> owner, const SemiDiscreteSystem &system, LinearSolver &solver);

      const SemiDiscreteSystem &system() const { return system_; }
      LinearSolver             &solver() { return solver_; }
      const Vector             &layout() const { return layout_; }

      py::tuple  residual(double t, const Array &u, const Array &v, const Array &a, const std::string &side);
      Linearised linearise(double t, const Array &u, const Array &v, const Array &a, const std::string &side);
      State      initial_state(double t) const { return system_.initial_state(t); }
      Array      free() const;
      py::dict   capabilities() const;
      Array      gathered(const Array &x) const;
      double     dot(const Array &x, const Array &y) const;
      bool       is_spread() const; ///< over several ranks, even if this one owns all

    private:
      std::shared_ptr<void>     owner_;
      const SemiDiscreteSystem &system_;
      LinearSolver             &solver_;
      Vector                    layout_, u_, v_, a_, r_;
    };
  } // namespace python
} // namespace myolines
