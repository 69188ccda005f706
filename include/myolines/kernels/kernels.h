// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/lanes.h>
#include <myolines/materials/law_kernels.h>
#include <myolines/materials/volume_energy.h>

#include <cstddef>

namespace myolines
{
  // Cell kernels of the 3D muscle, on batches of n_lanes cells. Plain data only: the same source is compiled for several
  // instruction sets, and nothing of a heavy library may be compiled with a wide one.

  /// Tables of the element (see Element); borrowed.
  struct KernelTables
  {
    int           n_points_1d; ///< Gauss points in one direction
    int           n_modes;     ///< of pressure and dilatation
    const double *value;       ///< [n_points_1d][n_nodes_1d]
    const double *derivative;  ///< [n_points_1d][n_nodes_1d]
    const double *weight;      ///< [n_points_1d^3]
    const double *modes;       ///< [n_points_1d^3][n_modes]
  };

  /// What the tangent takes of a change of the rate of stretch lam-dot = G : Fdot, on which active stress depends,
  /// d(lam-dot) = by_velocity G : dFdot + by_gradient (L : Fdot) : dF + by_stretch (lam-dot/lam) G : dF. That of the defaults is exact.
  struct RateTangent
  {
    double by_velocity = 1; ///< of the change of the rate
    double by_gradient = 1; ///< of G at a fixed rate
    double by_stretch  = 0; ///< in its place, by thesis (5.7.14) and (5.7.15)
  };

  /// The physics of all batches at one instant.
  struct KernelModel
  {
    Activation          activation;    ///< of the regions
    bool                active;        ///< active stress takes part
    bool                rate;          ///< ... and depends on the strain rate
    bool                inertia;       ///< M a takes part
    bool                exact_tangent; ///< else its symmetric part
    bool                viscous;       ///< some law depends on the rate of strain
    bool                softened;      ///< Psi_vol'' in actions and matrices is that of preconditioners
    bool                keep_gradient; ///< tangents of a state have F, which actions find again from the displacement otherwise
    double              volume_limit;  ///< N: Psi_vol'' is 1/(1/Psi_vol'' + 1/(N (mu + |p|))), mu = 2 dPsi/dI1; as it is where mu = 0
    VolumeForm          volume_form;   ///< what Psi_vol is
    curves::FibreCurves curves;        ///< of the user, where there are any; borrowed
    const double       *before;        ///< local array of displacements, as u: forces are those of the step from there to u; or nullptr
    RateTangent         rate_tangent;  ///< of the force-velocity relation
    double              dissipation;   ///< of such a step, see Point::dissipation

    bool velocities() const { return rate || viscous; } ///< whether stresses depend on them
  };

  /// One batch of cells (see CellBatches and PointMaterials); borrowed.
  struct KernelCells
  {
    const unsigned int *nodes;             ///< [n_nodes][n_lanes]
    const double       *geometry;          ///< per point 9 + 1 lanes
    unsigned int        geometry_stride;   ///< doubles between points, 0 if affine
    const double       *inverse_mode_mass; ///< [n_modes][n_modes] lanes
    const double       *material;          ///< per point n_material_values lanes
    unsigned int        material_stride;   ///< doubles between points, 0 if all points are alike
    bool                muscle;            ///< whether some point has fibres of muscle
    bool                tendon;            ///< whether some point has tendinous fibres
    int                 n_filled;          ///< cells in the batch, 1..n_lanes

    const LawTerm *laws;      ///< of the tissues that the points are made of
    int            n_laws;    ///< how many
    double         law_shear; ///< their shear modulus at rest together [Pa]

    const double *local = nullptr; ///< D and p of the state, [2][n_modes] lanes; none: D_h = Pi(J), p_h = Pi(Psi_vol'(D_h))
  };

  /// Squares [N^2] of the size of internal forces, before neighbours cancel, and of what rounding leaves of them. A cell of volume V
  /// under stress P exerts nodal forces of the size |P| V^(2/3); displacements that are rounded to eps |u| change F by eps (1 + |u|/h).
  struct KernelForces
  {
    double internal = 0; ///< of all stresses
    double volume   = 0; ///< of a stress mu (Pi(J) - D), mu = 2 dPsi/dI1: what the D that is given misses
    double rounding = 0; ///< of the displacement
  };

  /// State of one batch at its Gauss points, one lane per cell: what measurements and fields are made of.
  enum PointValue
  {
    point_F            = 0,  ///< 9: deformation gradient, row by row
    point_F_rate       = 9,  ///< 9: its time derivative [1/s]
    point_displacement = 18, ///< 3 [m]
    point_velocity     = 21, ///< 3 [m/s]
    point_pressure     = 24, ///< p_h [Pa]
    point_dilatation   = 25, ///< D_h
    point_JxW          = 26, ///< weight times det(dX/dxi) [m^3]
    n_point_values     = 27  ///< fields of lanes at a point
  };

  /// The tangent at a Gauss point, compactly, beside F, which actions find again from the displacement or read behind it
  /// (KernelModel::keep_gradient): a few products of stress derivatives with w = weight det(dX/dxi); the entries from tangent_C on only if
  /// the stress depends on the strain rate. Fields of lanes.
  enum TangentValue
  {
    tangent_p         = 0, ///< p_h J w
    tangent_psi1      = 1, ///< dPsi/dI1 w
    tangent_psi2      = 2, ///< d2Psi/dI1^2 w
    tangent_power     = 3, ///< J^(-2/3)
    tangent_g         = 4, ///< g lam w
    tangent_stretch   = 5, ///< dg/dlam lam^2 w
    tangent_size_0    = 6, ///< fields of a point without strain rate
    tangent_C         = 6, ///< dg/d(lam-dot) lam^2 w
    tangent_rate      = 7, ///< 9: dg/d(lam-dot) lam w (L : Fdot)
    tangent_size_rate = 16 ///< fields of a point with it
  };

  /// The tangent of a step at a Gauss point, derivatives of its stress without the volumetric rank, times w. Fields of lanes.
  enum StepTangentValue
  {
    step_by_F     = 0,  ///< 81: dP/dF_1 at fixed pressure, rows of P, columns of F_1
    step_volume   = 81, ///< 9: F_m V, by which the pressure enters P
    step_cofactor = 90, ///< 9: cof F_1 = dJ_1/dF_1
    step_by_rate  = 99  ///< 81: dP/dF_rate, only if stresses depend on it
  };

  /// Narrow vectors wait for arithmetic, wide ones for memory: measured, see doc/decisions/what-solvers-keep.md.
  inline bool keeps_gradient(const InstructionSet set) { return set != InstructionSet::avx512; }

  /// Fields of a point in the tangent of a batch.
  inline int point_tangent_size(const KernelModel &model)
  {
    if (model.before != nullptr)
      return step_by_rate + (model.velocities() ? 81 : 0);
    return (model.rate ? tangent_size_rate : tangent_size_0) + (model.keep_gradient ? 9 : 0);
  }

  /// The volume in the tangent of a batch. S is M_p^(-1) [int Psi_vol'' phi phi^T] M_p^(-1), phi the modes and M_p their
  /// mass; the orthonormal modes are R phi. The linearised equation of the pressure is B du - C dp + g = 0, with dp in the orthonormal
  /// modes. In a step Psi_vol'' is the derivative of the secant of Psi_vol by the dilatation at the end.
  struct VolumeLayout
  {
    /// Places for @p n_modes modes of pressure and dilatation.
    explicit VolumeLayout(const int n_modes)
      : stiffness(0)
      , softened(n_modes * n_modes)
      , orthonormal(2 * n_modes * n_modes)
      , compliance(3 * n_modes * n_modes)
      , residual(4 * n_modes * n_modes)
      , shear(residual + n_modes)
      , size(shear + 2)
    {}
    int stiffness;   ///< S
    int softened;    ///< S of the softened Psi_vol''
    int orthonormal; ///< R
    int compliance;  ///< C
    int residual;    ///< g
    int shear;       ///< mean mu h^(1/2) and mean Psi_vol'' h^(1/2) [Pa m^(1/2)], h the size of the cell
    int size;        ///< lanes of all
  };

  /// Numbers of the points in the tangent of one batch.
  inline std::size_t tangent_size(const int n_points, const KernelModel &model)
  {
    return std::size_t(n_lanes) * n_points * point_tangent_size(model);
  }

  /// What actions read of the tangent of a batch. A number of a point is the sum of two in single precision, which leaves it 48 bits. What
  /// need not be exact, as preconditioners, does with the first.
  struct KernelTangent
  {
    const double *u;      ///< local array of the displacement
    const double *v;      ///< and of the velocity
    const float  *high;   ///< [n_points][point_tangent_size()] lanes
    const float  *low;    ///< the same, or nullptr
    const double *volume; ///< VolumeLayout
  };

  /// A change of pressure that is given to an action, and the rows of its equation.
  struct KernelPressure
  {
    const double *dp;   ///< [n_modes] lanes, orthonormal modes
    double       *rows; ///< [n_modes] lanes: B x - C dp
  };

  /// The kernels for one instruction set and one degree. u, v, a, x, y, r are the local arrays of vectors (ghosts
  /// included); scratch is aligned storage of scratch_size(n_points_1d, n_modes) doubles.
  struct Kernels
  {
    /// r += R(u, v, a) without external loads, forces += their sizes. False if det F <= 0, D <= 0 or NaN anywhere in the batch; r is
    /// then unchanged.
    bool (*residual)(const KernelTables &, const KernelModel &, const KernelCells &, const double *u, const double *v, const double *a,
                     double *r, KernelForces &forces, double *scratch);

    /// z = D and p of u.
    void (*local)(const KernelTables &, const KernelModel &, const KernelCells &, const double *u, double *z, double *scratch);

    /// From D and p of the cells to trial_z, the part alpha of a Newton step further, with the dp of that step in orthonormal modes:
    ///     p_t = p + alpha dp,   p_t = (1 - alpha) p + Pi(alpha Psi' + Psi'' (D_t - D)),
    /// Psi_vol' and Psi_vol'' at D, those of a step in one. NaN in D_t where det F, Pi(J), at trial_u, or D_t is not positive.
    void (*advance)(const KernelTables &, const KernelModel &, const KernelCells &, const double *dp, const double *trial_u, double alpha,
                    double *trial_z, double *scratch);

    /// What KernelTangent says of (u, v); @p low may be null.
    void (*linearise)(const KernelTables &, const KernelModel &, const KernelCells &, const double *u, const double *v, float *high,
                      float *low, double *volume, double *scratch);

    /// y += (w_u K + w_v C + w_a M) x. @p tangent comes from linearise() with the same model; mass alone needs none. With a @p pressure K
    /// is that of a fixed one, and y += w_u A^T dp; A = B but in a step.
    void (*apply)(const KernelTables &, const KernelModel &, const KernelCells &, const double weights[3], const KernelTangent &tangent,
                  const double *x, double *y, const KernelPressure *pressure, double *scratch);

    /// W = Psi_vol'' of matrices at u, [n_modes][n_modes] lanes, as all that follows in orthonormal modes.
    void (*stiffness)(const KernelTables &, const KernelModel &, const KernelCells &, const double *u, double *W, double *scratch);

    /// y += A^T W b at u; A = B but in a step. @p b: [n_modes] lanes.
    void (*condense)(const KernelTables &, const KernelModel &, const KernelCells &, const double *u, const double *W, const double *b,
                     double *y, double *scratch);

    /// z = W (B x - b / weight) at u. @p b and @p z: [n_modes] lanes.
    void (*recover)(const KernelTables &, const KernelModel &, const KernelCells &, const double *u, const double *W, double weight,
                    const double *x, const double *b, double *z, double *scratch);

    /// matrices = w_u K + w_v C + w_a M at (u, v): [9][n_nodes][n_nodes] lanes, block (a, c) at 3 a + c.
    void (*element_matrices)(const KernelTables &, const KernelModel &, const KernelCells &, const double weights[3], const double *u,
                             const double *v, double *matrices, double *scratch);

    /// values: [n_points][n_point_values] lanes. Velocity may be nullptr (then rates are zero).
    void (*points)(const KernelTables &, const KernelModel &, const KernelCells &, const double *u, const double *v, double *values,
                   double *scratch);

    std::size_t (*scratch_size)(int n_points_1d, int n_modes); ///< Doubles of the scratch storage.
  };

  /// Kernels of degree 1..3 for an instruction set that this processor has.
  const Kernels &kernels(InstructionSet instruction_set, unsigned int degree);
} // namespace myolines
