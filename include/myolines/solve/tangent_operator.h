// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/solve/free_unknowns.h>
#include <myolines/system/ledger.h>
#include <myolines/system/linearisation.h>

#include <memory>
#include <string>

namespace myolines
{
  /// C^T J C on the free unknowns, for Krylov methods and preconditioners: as an action of the Linearisation or by a
  /// product with its matrix. Vectors are zero on constrained unknowns.
  class TangentOperator
  {
  public:
    /// How the operator is applied.
    enum class Form
    {
      automatic,   ///< what the Linearisation says costs less
      matrix_free, ///< by actions of the Linearisation
      assembled    ///< by products with its matrix
    };

    static Form form(const std::string &name); ///< that of `solver/linear/operator`

    TangentOperator(Form form, WorkLedger &ledger); ///< Bound to nothing yet.

    /// From here on the operator of @p linearisation, as it stands whenever something is asked, with @p weights.
    /// @p layout is any vector of the system. All are borrowed but for the weights.
    void bind(Linearisation &linearisation, const WeightsByOrder &weights, const Constraints &constraints, const Vector &layout);

    /// y = C^T J C x.
    void apply(const Vector &x, Vector &y) const;

    /// Local unknowns can be kept beside x: the system has some, and actions need no matrix. Their equations, or nullptr.
    const LocalEquations *local() const;

    /// Whether preconditioners work for the system in which they are kept: matrices and levels are then softened.
    void keep_local(const bool kept) { kept_ = kept; }

    /// The left-hand sides of LocalEquations on the free unknowns.
    void apply_with_local(LocalEquations::Digits digits, const Vector &x, const Vector &z, Vector &y, Vector &y_z) const;

    /// The assembled matrix, with unit rows (times a typical entry) for constrained unknowns. @p exact: never softened.
    const SparseMatrix &sparse(bool exact) const;

    const MultilevelData *multilevel() const { return linearisation_->multilevel(); } ///< That of the linearisation, or nullptr.

    /// See Linearisation; nullptr where the system has none.
    TwoLevel *two_level() const;

    /// The operator belongs to this system.
    bool is_of(const Linearisation &linearisation) const { return linearisation_ == &linearisation; }

    const FreeUnknowns &free_unknowns() const { return *free_; } ///< those that relations leave free
    const Vector       &layout() const { return layout_; }       ///< any vector of the system

  private:
    /// act(x with relations and ghosts), then C^T y
    template <typename Action>
    void act(const Action &action, const Vector &x, Vector &y) const;

    bool matrix_free() const;

    const Form                    form_;
    WorkLedger                   &ledger_;
    Linearisation                *linearisation_ = nullptr;
    WeightsByOrder                weights_{};
    std::unique_ptr<FreeUnknowns> free_;
    Vector                        layout_;
    bool                          kept_ = false;
  };
} // namespace myolines
