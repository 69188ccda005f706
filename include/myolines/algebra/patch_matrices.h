// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/algebra/vector.h>
#include <myolines/base/lanes.h>
#include <myolines/base/large_array.h>

#include <vector>

namespace myolines
{
  struct PatchKernels;

  /// Symmetric dense matrices A_p on overlapping sets of unknowns (patches), and the additive Schwarz operator
  ///
  ///     S = sum_p R_p^T A_p^(-1) R_p,
  ///
  /// R_p restricts to the unknowns of patch p. If the A_p are principal submatrices of a positive definite A, the
  /// eigenvalues of S A do not exceed the overlap, the largest number of patches that share an unknown.
  ///
  /// Applying S is bound by the memory that streams by. What is kept of an inverse is X, triangular, of A^(-1) = X^T X, each row scaled, in
  /// half precision where the instruction set converts it, else in single; n_lanes patches of about equal size interleaved. Rounding of X
  /// by eps changes the eigenvalues of X^T X A by about eps (n cond A)^(1/2), that of A^(-1) by eps cond A, and X^T X stays positive
  /// definite. Matrices are added up in double precision and kept only as long as something is missing of them.
  class PatchMatrices
  {
  public:
    /// @p patches: the unknowns of each, as local numbers (ghosts included) of vectors with the layout of @p layout.
    PatchMatrices(const std::vector<std::vector<unsigned int>> &patches, const Vector &layout,
                  InstructionSet instruction_set = widest_instruction_set());

    /// Sets all matrices to zero.
    void clear();

    /// Where entry (i, j) and (j, i), i >= j, of patch @p p is added up; before it is complete().
    double &entry(const unsigned int p, const unsigned int i, const unsigned int j) { return matrix(p)[place(i, j)]; }

    /// The same for many entries: that at place(i, j) behind the pointer.
    double *matrix(const unsigned int p)
    {
      if (matrices_[p] == nullptr)
        open(p);
      return matrices_[p];
    }
    /// Offset of entry (i, j), i >= j, in a lower triangle row by row.
    static std::size_t place(const unsigned int i, const unsigned int j) { return std::size_t(i) * (i + 1) / 2 + j; }

    /// Nothing more is added to patch @p p. Its memory is free for others once that holds for those beside it, which are patches of about
    /// equal size with about equal numbers.
    void complete(unsigned int p);

    /// Completes all. A matrix that is not positive definite is replaced by the diagonal of its row sums in magnitude. Returns how many
    /// were since clear().
    unsigned int invert();

    /// z = S r, after invert().
    void apply(const Vector &r, Vector &z) const;

    /// Largest number of patches, on any rank, that share an unknown.
    double overlap() const { return overlap_; }

    unsigned int n_patches() const { return static_cast<unsigned int>(group_of_.size()); } ///< On this rank.

    /// Bytes held.
    std::size_t memory() const;

    /// Bytes that were held at most while matrices were added up, beyond that.
    std::size_t largest_work() const { return largest_work_; }

  private:
    struct Group
    {
      unsigned int n;             ///< unknowns of its largest patch
      unsigned int n_filled;      ///< patches in it
      unsigned int size[n_lanes]; ///< unknowns of each
      std::size_t  entries;       ///< where its factors begin: [n (n + 1) / 2] lanes, lower triangle row by row
      std::size_t  unknowns;      ///< where its lists begin, one patch after the other
      std::size_t  weights;       ///< where its weights begin: [n] lanes
      unsigned int missing;       ///< patches that are not complete
      unsigned int patches[n_lanes];
    };

    void open(unsigned int p);
    void factorise(Group &group);

    const PatchKernels             *kernels_;
    std::vector<Group>              groups_;
    std::vector<unsigned int>       group_of_; ///< each patch
    std::vector<unsigned int>       unknowns_;
    LargeArray<char>                packed_;
    LargeArray<float>               weights_;
    std::vector<double *>           matrices_; ///< of each patch, while they are added up: lower triangle row by row
    std::vector<LargeArray<double>> work_;     ///< where they are
    std::vector<double *>           free_;     ///< in it
    std::size_t                     largest_work_ = 0;
    unsigned int                    n_refused_    = 0;
    unsigned int                    largest_      = 0; ///< unknowns of the largest patch
    double                          overlap_;
  };
} // namespace myolines
