// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

// Private to this room.

#include <Epetra_Map.h>
#include <Epetra_MultiVector.h>
#include <Epetra_Operator.h>

#include <functional>

namespace myolines
{
  /// A linear map of the owned entries of a rank, as Belos and Anasazi see it.
  class ActionOperator : public Epetra_Operator
  {
  public:
    using Action = std::function<void(const double *x, double *y)>;

    ActionOperator(const Epetra_Map &map, Action action)
      : map_(map)
      , action_(std::move(action))
    {}

    int Apply(const Epetra_MultiVector &x, Epetra_MultiVector &y) const override
    {
      for (int column = 0; column < x.NumVectors(); ++column)
        action_(x[column], y[column]);
      return 0;
    }

    int                SetUseTranspose(bool) override { return -1; }
    int                ApplyInverse(const Epetra_MultiVector &, Epetra_MultiVector &) const override { return -1; }
    double             NormInf() const override { return 0; }
    const char        *Label() const override { return "linear map"; }
    bool               UseTranspose() const override { return false; }
    bool               HasNormInf() const override { return false; }
    const Epetra_Comm &Comm() const override { return map_.Comm(); }
    const Epetra_Map  &OperatorDomainMap() const override { return map_; }
    const Epetra_Map  &OperatorRangeMap() const override { return map_; }

  private:
    const Epetra_Map &map_;
    const Action      action_;
  };
} // namespace myolines
