// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/algebra/current_ghosts.h>

#include <myolines/muscle3d/body_measures.h>
#include <myolines/muscle3d/discretisation.h>
#include <myolines/muscle3d/muscle3d_system.h>

#include <deal.II/base/tensor.h>

namespace myolines
{
  using Vector3 = dealii::Tensor<1, 3>; ///< a vector in space
  using Matrix3 = dealii::Tensor<2, 3>; ///< a tensor of second order in space

  /// Everything about one quadrature point that outputs are made of, in plain numbers.
  struct PointState
  {
    Vector3      displacement;          ///< [m]
    Vector3      velocity;              ///< [m/s]
    Matrix3      F;                     ///< deformation gradient
    Matrix3      F_rate;                ///< its time derivative [1/s]
    double       pressure;              ///< p_h [Pa]
    double       dilatation;            ///< D_h
    double       JxW;                   ///< reference volume that the point stands for [m^3]
    double       J;                     ///< det F
    Vector3      fibre;                 ///< a = F a0
    double       stretch;               ///< |a|
    double       isochoric_stretch;     ///< lam
    double       isochoric_rate;        ///< lam-dot [1/s]
    double       strain_rate;           ///< d|a|/dt / e0 [-]
    double       isochoric_strain_rate; ///< lam-dot / e0 [-]
    double       pennation;             ///< angle between a and the line of action [degree], (6.2.24); not a number without one
    unsigned int material_id;           ///< of the tissue, see TissueNames
    Material     material;              ///< the numbers that decide the stress
  };

  /// Walks over the quadrature points of the cells of this rank, batch by batch.
  class PointStates
  {
  public:
    /// @p system and @p state outlive the object. Updates ghosts: collective.
    PointStates(const Muscle3dSystem &system, const State &state);

    /// visit(cell, q, point) for every point of every owned cell.
    template <typename Visitor>
    void for_each(const Visitor &visit)
    {
      for (unsigned int b = 0; b < d_.batches->n_owned_batches(); ++b)
        {
          evaluate(b);
          for (unsigned int lane = 0; lane < d_.batches->n_filled(b); ++lane)
            for (int q = 0; q < d_.element.n_points; ++q)
              visit(d_.batches->cell(b, lane), q, point(q, lane));
        }
    }

    /// Fills the values of one batch; then point(q, lane) is of that batch.
    void       evaluate(unsigned int batch);
    PointState point(int q, unsigned int lane) const; ///< point @p q of the cell in @p lane

    const Muscle3dDiscretisation &discretisation() const { return d_; } ///< that of the system

  private:
    const Muscle3dParameters          &parameters_;
    const std::optional<LineOfAction> &line_;
    const Muscle3dDiscretisation      &d_;
    KernelModel                        model_;
    CellSweep                          sweep_;
    unsigned int                       batch_ = 0;
    CurrentGhosts                      u_, v_; ///< the state outlives this object
    dealii::AlignedVector<double>      values_;
  };

  /// Part of the stress that the base material, and that passive fibres, of a printed tissue are; none of another one.
  std::optional<StressPart> base_part(unsigned int material_id);
  std::optional<StressPart> passive_fibre_part(unsigned int material_id); ///< Part of the stress that passive fibres of a tissue are.

  /// The point as laws see it.
  Deformation<double> deformation(const Muscle3dParameters &parameters, const Activation &activation, const PointState &point,
                                  const curves::FibreCurves &curves);
  /// Weight of a part of the tissue at the point: fat takes its share from all.
  inline double weight_of(const TissuePart &part, const PointState &point) { return part.weight * (1 - point.material[material_fat]); }

  /// Parts of the first Piola-Kirchhoff stress at a point [Pa].
  Parts<Matrix3> stress_parts(const Muscle3dParameters &parameters, const Activation &activation, const PointState &point);
} // namespace myolines
