// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/scene.h>
#include <myolines/solve/tangent_operator.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace myolines
{
  /// An approximate inverse of a TangentOperator. Works on the owned entries of a rank as plain arrays, so that it fits
  /// any vector type. The operator must outlive its use here.
  class Preconditioner
  {
  public:
    virtual ~Preconditioner() = default;

    /// Prepares for @p tangent as it stands. Called again whenever its values have moved on.
    /// @throws std::runtime_error with the reason if the operator does not allow it (singular, zero diagonal).
    virtual void build(const TangentOperator &tangent) = 0;

    /// z = P r, with P close to the inverse of the operator of the last build(). @p r and @p z do not overlap.
    virtual void apply(const double *r, double *z) const = 0;

    /// True if P is the inverse up to round-off.
    virtual bool exact() const { return false; }

    /// What build() costs, in Krylov iterations with this preconditioner: a rough number that decides when a kept one has
    /// become too slow.
    virtual unsigned int set_up_cost() const = 0;
  };

  /// One that is made from the assembled matrix.
  class MatrixPreconditioner : public Preconditioner
  {
  public:
    void build(const TangentOperator &tangent) final { factorise(tangent.sparse(exact()), tangent.multilevel()); }

    /// @p multilevel may be null. The matrix must outlive the use of what was built.
    virtual void factorise(const SparseMatrix &matrix, const MultilevelData *multilevel) = 0;

    /// Whether apply() reads entries of that matrix.
    virtual bool reads_matrix() const { return true; }
  };

  /// What the choice of a preconditioner may depend on.
  struct PreconditionerContext
  {
    std::size_t n_unknowns; ///< on all ranks
    bool        two_levels; ///< Linearisation::has_two_levels()
    WorkLedger &ledger;     ///< for counts of set-ups within
  };

  /// Facts about a preconditioner and how to make one, for `list` and the schema.
  struct PreconditionerEntry
  {
    std::string   name;    ///< `type` in a scene
    std::string   summary; ///< one sentence
    scene::Schema schema;  ///< of its parameters
    /// of its parameters and the context
    std::function<std::unique_ptr<Preconditioner>(const scene::Node &, const PreconditionerContext &)> make;
  };

  /// All preconditioners: automatic, p multigrid, ml, jacobi, direct.
  const std::vector<PreconditionerEntry> &preconditioner_registry();

  /// The preconditioner that "automatic" with these options takes.
  std::string automatic_choice(const scene::Node &options, std::size_t n_unknowns, bool two_levels);

  /// The one that the list @p preconditioner of a scene asks for.
  std::unique_ptr<Preconditioner> make_preconditioner(const scene::Node &preconditioner, const PreconditionerContext &context);

  std::unique_ptr<MatrixPreconditioner> make_direct();                        ///< sparse LU factors of the assembled matrix
  std::unique_ptr<MatrixPreconditioner> make_ml();                            ///< with its defaults
  std::unique_ptr<Preconditioner>       make_p_multigrid(WorkLedger &ledger); ///< with its defaults

  ///@{
  /// The entries of the registry, each in the file of its preconditioner.
  PreconditionerEntry p_multigrid_preconditioner_entry();
  PreconditionerEntry direct_preconditioner_entry();
  PreconditionerEntry ml_preconditioner_entry();
  PreconditionerEntry jacobi_preconditioner_entry();
  ///@}
} // namespace myolines
