// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/solve/tangent_operator.h>

namespace myolines
{
  TangentOperator::TangentOperator(const Form form, WorkLedger &ledger)
    : form_(form)
    , ledger_(ledger)
  {}

  void TangentOperator::bind(Linearisation &linearisation, const WeightsByOrder &weights, const Constraints &constraints,
                             const Vector &layout)
  {
    if (!is_of(linearisation) || layout_.size() != layout.size())
      {
        free_   = std::make_unique<FreeUnknowns>(constraints, layout);
        layout_ = Vector(layout.get_partitioner());
      }
    linearisation_ = &linearisation;
    weights_       = weights;
  }

  bool TangentOperator::matrix_free() const
  {
    return form_ == Form::matrix_free || (form_ == Form::automatic && linearisation_->action_is_cheap());
  }

  const SparseMatrix &TangentOperator::sparse() const
  {
    const WorkLedger::Timer timer(ledger_, "assembly");
    return linearisation_->sparse(weights_);
  }

  TwoLevel *TangentOperator::two_level() const
  {
    const WorkLedger::Timer timer(ledger_, "assembly");
    return linearisation_->two_level(weights_);
  }

  void TangentOperator::apply(const Vector &x, Vector &y) const
  {
    const WorkLedger::Timer timer(ledger_, "tangent action");
    if (!matrix_free())
      {
        sparse().vmult(y, x);
        return;
      }
    if (free_->related())
      {
        Vector all = x;
        free_->distribute(all);
        linearisation_->apply(weights_, all, y);
      }
    else
      {
        x.update_ghost_values();
        linearisation_->apply(weights_, x, y);
        x.zero_out_ghost_values();
      }
    free_->condense(y);
  }
} // namespace myolines
