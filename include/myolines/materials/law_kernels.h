// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/materials/material.h>

#include <array>
#include <cstddef>

namespace myolines
{
  // Laws on all points of a batch, one call for each. Plain data only: compiled for several instruction sets, as the cell kernels are.

  struct LawKernels;

  /// A law with its parameters, as a part of a tissue.
  struct LawTerm
  {
    const LawKernels *kernels; ///< of the law, by InstructionSet; borrowed
    const void       *law;     ///< its struct; borrowed
    double            weight;  ///< multiplies the stress
    unsigned int      tissue;  ///< material id: points of other tissues have no part in it
  };

  /// Points of a batch; fields of lanes, strides in doubles. Borrowed.
  struct LawPoints
  {
    int                        n;               ///< how many points
    const double              *F;               ///< 9
    std::size_t                F_stride;        ///< from point to point
    const double              *F_rate;          ///< 9 each, one behind the other; nullptr: zero
    const double              *material;        ///< see MaterialValue
    std::size_t                material_stride; ///< from point to point
    const double              *geometry;        ///< 9 of dxi_A/dX_J and det(dX/dxi)
    std::size_t                geometry_stride; ///< from point to point
    const double              *weight;          ///< of the quadrature, one number for each
    const Activation          *activation;      ///< of the regions
    const curves::FibreCurves *curves;          ///< nullptr: those of the thesis
  };

  /// Weights of dP/dF and dP/dF_rate.
  struct LawWeights
  {
    double u;           ///< of dP/dF
    double v;           ///< of dP/dF_rate
    bool   symmetrised; ///< of the moduli the symmetric part only
  };

  /// The kernels of one law, for one instruction set; @p P, @p dP, @p c and @p W are fields of lanes.
  struct LawKernels
  {
    /// P[9 q + i] += the stress [Pa].
    void (*stress)(const LawTerm &, const LawPoints &, double *P);

    /// dP[9 q + i] += the change of the stress along dF[9 q + i], times JxW.
    void (*action)(const LawTerm &, const LawPoints &, const LawWeights &, const double *dF, double *dP);

    /// c[((3 a + b) * 9 + 3 A + B) n + q] += moduli in unit-cell directions A and B, times JxW.
    void (*coefficients)(const LawTerm &, const LawPoints &, const LawWeights &, double *c);

    /// W[q] += the energy [J/m^3]; nullptr: the law has none.
    void (*energy)(const LawTerm &, const LawPoints &, double *W);
  };

  // Those of the laws of the list, by number; each is defined in the unit compiled for that instruction set.
  ///@{
  /// Those of the laws of the list, by number; each is defined in the unit compiled for that instruction set.
  extern const LawKernels law_kernels_baseline[];
  extern const LawKernels law_kernels_avx2[];
  extern const LawKernels law_kernels_avx512[];
  ///@}

  /// Those of one law, by InstructionSet; null for sets that the processors of this system do not know.
  using LawKernelSets = std::array<LawKernels, 3>;

  /// Those of a term, for one of the sets.
  template <InstructionSet isa>
  MYOLINES_INLINE const LawKernels &law_kernels(const LawTerm &term)
  {
    return term.kernels[static_cast<int>(isa)];
  }
} // namespace myolines
