// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/algebra/current_ghosts.h>

#include <myolines/fem/block_matrix.h>
#include <myolines/fem/nested_dissection.h>
#include <myolines/fem/vertex_stars.h>
#include <myolines/muscle3d/discretisation.h>
#include <myolines/muscle3d/surface_forces.h>
#include <myolines/system/ledger.h>
#include <myolines/system/linearisation.h>

#include <map>
#include <memory>

namespace myolines
{
  /// Ledger counts of the optional terms that a sweep over the body evaluates.
  void count_terms(const KernelModel &model, const char *sweep, WorkLedger &ledger);

  /// @p model becomes that of the step of @p point from the local array @p before.
  void of_step(const Point &point, const double *before, KernelModel &model);

  /// @p cells with the local unknowns of their batch, which begin at @p at; null: none.
  KernelCells with_local(KernelCells cells, const LocalUnknowns *local, std::size_t at);

  /// K, C and M of the muscle at a state: keeps the state, forms actions and matrices on demand.
  class Muscle3dLinearisation : public Linearisation, public LocalEquations
  {
  public:
    Muscle3dLinearisation(const Muscle3dParameters &parameters, const Muscle3dDiscretisation &discretisation,
                          const PointMaterials &materials, const SurfaceForces &surface, WorkLedger &ledger);

    void refill(const Point &point, const Activation &activation);

    void                             apply(const WeightsByOrder &weights, const Vector &x, Vector &y) const override;
    bool                             action_is_cheap() const override { return true; }
    const SparseMatrix              &sparse(const WeightsByOrder &weights) override { return assemble(weights, false); }
    const SparseMatrix              &softened_sparse(const WeightsByOrder &weights) override { return assemble(weights, true); }
    const MultilevelData            *multilevel() const override;
    bool                             has_two_levels() const override { return discretisation_.space->degree() > 1; }
    std::optional<FactorisationCost> factorisation_cost() const override
    {
      if (!factorisation_cost_)
        factorisation_cost_ = nested_dissection(*discretisation_.space);
      return factorisation_cost_;
    }
    TwoLevel *two_level(const WeightsByOrder &weights, bool softened) override;

    const LocalEquations        *local() const override { return this; }
    Vector                       make_local() const override { return discretisation_.modes->make_vector(); }
    Vector                       local_scale(bool eliminated) const override;
    void                         apply_with_local(const WeightsByOrder &weights, Digits digits, const Vector &x, const Vector &z, Vector &y,
                                                  Vector &y_z) const override;
    void                         local_residual(Vector &g) const override;
    std::unique_ptr<Elimination> eliminate(bool softened) const override;

  private:
    /// Tangents of the owned batches, for actions.
    struct Tangents
    {
      LargeArray<float>  high, low; ///< low only for exact actions (KernelTangent)
      LargeArray<double> volume;
      std::size_t        size = 0, volume_size = 0; ///< of a batch
      bool               current = false;           ///< whether they are those of the state

      const double *volume_of(const unsigned int b) const { return volume.data() + b * volume_size; }
    };
    void          store(const CellSweep &sweep, bool exact, Tangents &tangents) const; ///< unless they are
    void          store_tangents(bool exact) const { store(discretisation_.sweep(materials_), exact, tangents_); }
    void          store_tangents() const { store_tangents(!tangents_.low.empty()); } ///< with low if that was needed before
    KernelTangent tangent(const Tangents &tangents, unsigned int batch, bool exact) const;
    void          apply(const CellSweep &sweep, const Tangents &tangents, bool exact, const KernelModel &model, const Weights &weights,
                        const Vector &x, Vector &y) const;
    const SparseMatrix &assemble(const WeightsByOrder &weights, bool softened);
    KernelModel         model(bool softened) const;

    /// Whether Digits::single would round the columns of pressures, too, which kappa magnifies: they are stored, or made of an F that is.
    bool rounds_pressures() const { return model_.keep_gradient || model_.before != nullptr; }

    /// use(batch, what is stored of its volume)
    template <typename Use>
    void for_each_volume(const Use &use) const;

    KernelCells cells(const CellSweep &sweep, unsigned int batch) const; ///< with the local unknowns of this state

    /// consume(batch, element matrices) for owned and ghost batches.
    template <typename Consumer>
    void for_each_matrix(const CellSweep &sweep, const KernelModel &model, const Weights &weights, const Consumer &consume) const;

    void find_faces(const Point &point);
    /// Adds the tangents of forces on the faces of batch @p b to its element matrices.
    void add_faces(const CellBatches &batches, unsigned int b, const Weights &w, double *element_matrices) const;
    void add_faces(const Weights &w, const Vector &x, Vector &y) const;

    /// Quadrature with as few points as keep the stiffness, for preconditioners of a richer one.
    struct LeanCells
    {
      LeanCells(const Muscle3dDiscretisation &d, const Muscle3dParameters &parameters);
      const Element        element;
      const CellBatches    batches;
      const PointMaterials materials;
      Vector               u, v; ///< the state of the patches
      Tangents             tangents;
    };
    CellSweep lean_sweep() const;
    void      make_two_level();

    const Muscle3dParameters                          &parameters_;
    const Muscle3dDiscretisation                      &discretisation_;
    const PointMaterials                              &materials_;
    const SurfaceForces                               &surface_;
    std::vector<SurfaceForces::Tangent>                faces_; ///< of surface_ at this state
    std::map<dealii::CellId, std::vector<std::size_t>> faces_of_;
    WorkLedger                                        &ledger_;
    KernelModel                                        model_{};
    Vector                                             u_, v_, before_; ///< before_ of a step only
    LocalUnknowns                                      local_;          ///< none: those of u_
    std::unique_ptr<BlockMatrix>                       matrix_;
    Weights                                            assembled_;        ///< weights of the matrix, if current_
    bool                                               softened_ = false; ///< whether it is
    bool                                               current_  = false;
    mutable std::unique_ptr<MultilevelData>            multilevel_;
    mutable std::optional<FactorisationCost>           factorisation_cost_;
    std::unique_ptr<LeanCells>                         lean_; ///< none if the quadrature is lean already
    std::unique_ptr<VertexStars>                       stars_;
    std::unique_ptr<TwoLevel>                          two_level_;
    mutable Tangents                                   tangents_;
  };
} // namespace myolines
