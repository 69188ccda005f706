// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/solve/nonlinear_solver.h>

#include <string>
#include <vector>

namespace myolines::testing
{
  using Overrides = std::vector<std::string>;

  /// The list that @p schema declares, all defaults but @p overrides ("restart=30").
  inline scene::Node node(const scene::Schema &schema, const Overrides &overrides = {})
  {
    return scene::parse_scene("<ParameterList name=\"scene\"></ParameterList>", schema, "test", ".", overrides);
  }

  /// The solvers as a scene with these entries makes them.
  struct Solvers
  {
    explicit Solvers(const Overrides &nonlinear_entries = {}, const Overrides &linear_entries = {},
                     const Overrides &preconditioner_entries = {})
      : linear(node(LinearSolver::linear_schema(), linear_entries), node(LinearSolver::preconditioner_schema(), preconditioner_entries),
               ledger)
      , nonlinear(node(NonlinearSolver::schema(), nonlinear_entries), linear, ledger)
    {}

    WorkLedger      ledger;
    LinearSolver    linear;
    NonlinearSolver nonlinear;
  };
} // namespace myolines::testing
