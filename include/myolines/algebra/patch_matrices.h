// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/algebra/vector.h>
#include <myolines/base/lanes.h>

#include <deal.II/base/aligned_vector.h>

#include <vector>

namespace myolines
{
  struct PatchKernels;

  /// Symmetric dense matrices A_p on overlapping sets of unknowns (patches), and the additive Schwarz operator
  ///
  ///     S = sum_p R_p^T A_p^(-1) R_p,
  ///
  /// R_p restricts to the unknowns of patch p. If the A_p are principal submatrices of a positive definite A, the
  /// eigenvalues of S A do not exceed the overlap, the largest number of patches that share an unknown. Stored in single
  /// precision, half of each matrix, n_lanes patches of about equal size interleaved: applying S is bound by the memory that
  /// streams by.
  class PatchMatrices
  {
  public:
    /// @p patches: the unknowns of each, as local numbers (ghosts included) of vectors with the layout of @p layout.
    PatchMatrices(const std::vector<std::vector<unsigned int>> &patches, const Vector &layout,
                  InstructionSet instruction_set = widest_instruction_set());

    /// Sets all entries to zero.
    void clear();

    /// Adds @p value to the entries (i, j) and (j, i) of patch @p p, i >= j.
    void add(const unsigned int p, const unsigned int i, const unsigned int j, const double value)
    {
      const Place place = places_[p];
      entries_[place.begin + (std::size_t(i) * (i + 1) / 2 + j) * n_lanes + place.lane] += static_cast<float>(value);
    }

    /// Replaces each A_p by its inverse, computed in double precision. A matrix that is not positive definite is replaced
    /// by the diagonal of its row sums in magnitude. Returns how many were.
    unsigned int invert();

    /// z = S r, after invert().
    void apply(const Vector &r, Vector &z) const;

    /// Largest number of patches, on any rank, that share an unknown.
    double overlap() const { return overlap_; }

    unsigned int n_patches() const { return static_cast<unsigned int>(places_.size()); }

    /// Bytes held.
    std::size_t memory() const;

  private:
    struct Group
    {
      unsigned int n;             ///< unknowns of its largest patch
      unsigned int n_filled;      ///< patches in it
      unsigned int size[n_lanes]; ///< unknowns of each
      std::size_t  entries;       ///< where its matrices begin: [n (n + 1) / 2] lanes, lower triangle row by row
      std::size_t  unknowns;      ///< where its lists begin, one patch after the other
    };
    struct Place
    {
      std::size_t  begin;
      unsigned int lane;
    };

    const PatchKernels          *kernels_;
    std::vector<Group>           groups_;
    std::vector<Place>           places_; ///< of each patch
    std::vector<unsigned int>    unknowns_;
    dealii::AlignedVector<float> entries_;
    unsigned int                 largest_ = 0; ///< unknowns of the largest patch
    double                       overlap_;
  };
} // namespace myolines
