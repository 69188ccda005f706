// SPDX-License-Identifier: LGPL-2.1-or-later
#include "direct_takeover.h"

#include <myolines/solve/linear_solver.h>
#include <myolines/solve/preconditioner.h>
#include <myolines/system/band_linearisation.h>

namespace myolines
{
  scene::Schema LinearSolver::linear_schema()
  {
    using scene::Range;
    scene::Schema schema("Krylov solver for the linear systems of Newton's method.");
    schema
        .choice("type", "automatic", {"automatic", "cg", "gmres"},
                "Method; automatic: cg if the operator is symmetric and has no pressures of its own, else gmres. A cg that fails falls "
                "back to gmres.")
        .choice("operator", "automatic", {"automatic", "matrix-free", "assembled"},
                "How the tangent is applied; automatic: matrix-free where the system has a fast action, else by its matrix.")
        .integer("maximum iterations", 1000, Range::closed(1, 100000), "Largest number of iterations of one solve.")
        .integer("restart", 60, Range::closed(1, 1000), "gmres starts anew after this many iterations; it stores twice as many vectors.");
    return schema;
  }

  scene::Schema LinearSolver::preconditioner_schema()
  {
    using scene::Range;
    std::vector<std::pair<std::string, scene::Schema>> alternatives;
    for (const PreconditionerEntry &entry : preconditioner_registry())
      alternatives.emplace_back(entry.name, entry.schema);
    scene::Schema schema("Preconditioner of the Krylov solver.");
    schema.variant("type", "automatic", alternatives, "Kind of preconditioner.")
        .choice("rebuild", "automatic", {"automatic", "every step", "when slow"},
                "When to set it up anew: for every nonlinear solve and when keeping it has cost as much as a set-up, or only then; "
                "automatic: for every solve if a set-up costs less than 20 iterations.")
        .optional_number("slow iterations", "-", Range::closed(1, 100000),
                         "Iterations that keeping it may cost, beyond those of a fresh one; not given: about what a set-up costs.");
    return schema;
  }

  namespace
  {
    std::string rebuilding(const std::string &rebuild)
    {
      const std::string cost = "when keeping it has cost as much as a set-up";
      if (rebuild == "when slow")
        return "renewed " + cost;
      return std::string("renewed for every nonlinear solve") + (rebuild == "automatic" ? " if a set-up is cheap, and " : ", and ") + cost;
    }
  } // namespace

  std::vector<std::string> LinearSolver::plan(const scene::Node &linear, const scene::Node &preconditioner,
                                              const Linearisation &linearisation, const std::size_t n_unknowns, const bool constant)
  {
    const bool        two_levels = linearisation.has_two_levels();
    const std::string wanted     = preconditioner.text("type");
    if (wanted == "p multigrid" && !two_levels)
      preconditioner.refuse("type", "p multigrid needs a coarser level, which this system does not have",
                            "another preconditioner, or a muscle of degree 2 or 3");
    const std::string jacobian  = constant ? "Jacobian: constant, made once" : "Jacobian: made anew at every iteration";
    const bool        automatic = wanted == "automatic";
    if (automatic && dynamic_cast<const BandLinearisation *>(&linearisation) != nullptr)
      return {jacobian, "linear solves: banded and direct, factors kept while Jacobian and step size stay; no Krylov solver is set up"};

    const std::string  type  = automatic ? automatic_choice(preconditioner, n_unknowns, two_levels) : wanted;
    const std::string  form  = linear.text("operator");
    const bool         free  = form == "matrix-free" || (form == "automatic" && linearisation.action_is_cheap());
    const unsigned int ranks = dealii::Utilities::MPI::job_supports_mpi() ? dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) : 1;
    const std::string  why   = form == "automatic" ? (free ? " (its action is cheaper)" : " (no fast action)") : " (as asked)";
    return {jacobian, "tangent in Krylov solves: " + std::string(free ? "matrix-free" : "assembled") + why,
            "preconditioner: " + type +
                (automatic ? " (automatic: " + std::to_string(n_unknowns) + " unknowns, " + (two_levels ? "two levels" : "one level") + ")"
                           : " (as asked)") +
                (free && type == "p multigrid" ? "; no matrix of the fine level is assembled" : "") +
                DirectTakeover(preconditioner, linearisation, n_unknowns, ranks).words(),
            "preconditioner: " + rebuilding(preconditioner.text("rebuild"))};
  }
} // namespace myolines
