// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/solve/free_unknowns.h>
#include <myolines/system/ledger.h>
#include <myolines/system/linearisation.h>

#include <memory>

namespace myolines
{
  /// C^T J C on the free unknowns, for Krylov methods and preconditioners: as an action of the Linearisation or by a
  /// product with its matrix. Vectors are zero on constrained unknowns.
  class TangentOperator
  {
  public:
    enum class Form
    {
      automatic, ///< what the Linearisation says costs less
      matrix_free,
      assembled
    };

    TangentOperator(Form form, WorkLedger &ledger);

    /// From here on the operator of @p linearisation, as it stands whenever something is asked, with @p weights.
    /// @p layout is any vector of the system. All are borrowed but for the weights.
    void bind(Linearisation &linearisation, const WeightsByOrder &weights, const Constraints &constraints, const Vector &layout);

    /// y = C^T J C x.
    void apply(const Vector &x, Vector &y) const;

    /// Whether apply() needs no matrix.
    bool matrix_free() const;

    /// The assembled matrix, with unit rows (times a typical entry) for constrained unknowns.
    const SparseMatrix &sparse() const;

    const MultilevelData *multilevel() const { return linearisation_->multilevel(); }

    /// See Linearisation; nullptr where the system has none.
    TwoLevel *two_level() const;

    /// The operator belongs to this system.
    bool is_of(const Linearisation &linearisation) const { return linearisation_ == &linearisation; }

    const FreeUnknowns &free_unknowns() const { return *free_; }
    const Vector       &layout() const { return layout_; }

  private:
    const Form                    form_;
    WorkLedger                   &ledger_;
    Linearisation                *linearisation_ = nullptr;
    WeightsByOrder                weights_{};
    std::unique_ptr<FreeUnknowns> free_;
    Vector                        layout_;
  };
} // namespace myolines
