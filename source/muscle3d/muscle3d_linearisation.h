#pragma once

#include "current_ghosts.h"

#include <myolines/fem/block_matrix.h>
#include <myolines/muscle3d/discretisation.h>
#include <myolines/system/ledger.h>
#include <myolines/system/linearisation.h>

#include <memory>

namespace myolines
{
  /// Ledger counts of the optional terms that a sweep over the body evaluates.
  void count_terms(const KernelModel &model, const char *sweep, WorkLedger &ledger);

  /// K, C and M of the muscle at a state: keeps the state, forms actions and matrices on demand.
  class Muscle3dLinearisation : public Linearisation
  {
  public:
    Muscle3dLinearisation(const Muscle3dParameters &parameters, const Muscle3dDiscretisation &discretisation, WorkLedger &ledger);

    void refill(const Point &point, double activation);

    void                  apply(const WeightsByOrder &weights, const Vector &x, Vector &y) const override;
    const SparseMatrix   &sparse(const WeightsByOrder &weights) override;
    const MultilevelData *multilevel() const override;

  private:
    const Muscle3dParameters               &parameters_;
    const Muscle3dDiscretisation           &discretisation_;
    WorkLedger                             &ledger_;
    KernelModel                             model_;
    Vector                                  u_, v_;
    std::unique_ptr<BlockMatrix>            matrix_;
    Weights                                 assembled_; ///< weights of the matrix, if current_
    bool                                    current_ = false;
    mutable std::unique_ptr<MultilevelData> multilevel_;
  };
} // namespace myolines
