// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/solve/tangent_operator.h>

#include <algorithm>

namespace myolines
{
  TangentOperator::Form TangentOperator::form(const std::string &name)
  {
    return name == "automatic" ? Form::automatic : name == "assembled" ? Form::assembled : Form::matrix_free;
  }

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

  const LocalEquations *TangentOperator::local() const
  {
    const bool stiff = std::any_of(weights_.begin(), weights_.end(), [](const Weights &w) { return w.u != 0; });
    return stiff && matrix_free() ? linearisation_->local() : nullptr;
  }

  const SparseMatrix &TangentOperator::sparse(const bool exact) const
  {
    const WorkLedger::Timer timer(ledger_, "assembly");
    return kept_ && !exact ? linearisation_->softened_sparse(weights_) : linearisation_->sparse(weights_);
  }

  TwoLevel *TangentOperator::two_level() const
  {
    const WorkLedger::Timer timer(ledger_, "assembly");
    return linearisation_->two_level(weights_, kept_);
  }

  template <typename Action>
  void TangentOperator::act(const Action &action, const Vector &x, Vector &y) const
  {
    if (free_->related())
      {
        Vector all = x;
        free_->distribute(all);
        action(all);
      }
    else
      {
        x.update_ghost_values();
        action(x);
        x.zero_out_ghost_values();
      }
    free_->condense(y);
  }

  void TangentOperator::apply(const Vector &x, Vector &y) const
  {
    const WorkLedger::Timer timer(ledger_, "tangent action");
    if (matrix_free())
      act([&](const Vector &all) { linearisation_->apply(weights_, all, y); }, x, y);
    else
      sparse(true).vmult(y, x);
  }

  void TangentOperator::apply_with_local(const LocalEquations::Digits digits, const Vector &x, const Vector &z, Vector &y,
                                         Vector &y_z) const
  {
    const WorkLedger::Timer timer(ledger_, "tangent action");
    act([&](const Vector &all) { linearisation_->local()->apply_with_local(weights_, digits, all, z, y, y_z); }, x, y);
  }
} // namespace myolines
