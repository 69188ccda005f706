// SPDX-License-Identifier: LGPL-2.1-or-later
#include "patch_kernels.h"

#include <myolines/algebra/patch_matrices.h>

#include <deal.II/base/aligned_vector.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace myolines
{
  extern const PatchKernels patch_kernels_baseline;
  extern const PatchKernels patch_kernels_avx2;
  extern const PatchKernels patch_kernels_avx512;

  namespace
  {
    const PatchKernels &patch_kernels(const InstructionSet instruction_set)
    {
#if defined(__x86_64__)
      if (instruction_set == InstructionSet::avx512)
        return patch_kernels_avx512;
      if (instruction_set == InstructionSet::avx2)
        return patch_kernels_avx2;
#endif
      (void) instruction_set;
      return patch_kernels_baseline;
    }

    double largest_overlap(const std::vector<std::vector<unsigned int>> &patches, const Vector &layout)
    {
      Vector counts(layout);
      counts.zero_out_ghost_values();
      counts = 0;
      for (const auto &patch : patches)
        for (const unsigned int unknown : patch)
          counts.local_element(unknown) += 1;
      counts.compress(dealii::VectorOperation::add);
      return counts.linfty_norm();
    }
  } // namespace

  PatchMatrices::PatchMatrices(const std::vector<std::vector<unsigned int>> &patches, const Vector &layout,
                               const InstructionSet instruction_set)
    : kernels_(&patch_kernels(instruction_set))
    , group_of_(patches.size())
    , matrices_(patches.size(), nullptr)
    , overlap_(largest_overlap(patches, layout))
  {
    // Lanes of a group run as long as the largest: patches of one size stand together, else in their order.
    std::vector<unsigned int> order(patches.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](const unsigned int a, const unsigned int b) { return patches[a].size() > patches[b].size(); });

    std::size_t n_entries = 0, n_weights = 0;
    for (std::size_t first = 0; first < order.size(); first += n_lanes)
      {
        Group group{};
        group.n        = static_cast<unsigned int>(patches[order[first]].size());
        group.n_filled = static_cast<unsigned int>(std::min<std::size_t>(n_lanes, order.size() - first));
        group.entries  = n_entries;
        group.unknowns = unknowns_.size();
        group.weights  = n_weights;
        group.missing  = group.n_filled;
        for (unsigned int lane = 0; lane < group.n_filled; ++lane)
          {
            const auto &patch              = patches[order[first + lane]];
            group.size[lane]               = static_cast<unsigned int>(patch.size());
            group.patches[lane]            = order[first + lane];
            group_of_[order[first + lane]] = static_cast<unsigned int>(groups_.size());
            unknowns_.insert(unknowns_.end(), patch.begin(), patch.end());
          }
        largest_ = std::max(largest_, group.n);
        n_entries += place(group.n, 0) * n_lanes;
        n_weights += std::size_t(group.n) * n_lanes;
        groups_.push_back(group);
      }
    unknowns_.shrink_to_fit();
    packed_.resize(n_entries * kernels_->entry_size);
    weights_.resize(n_weights);
  }

  void PatchMatrices::clear()
  {
    for (double *&matrix : matrices_)
      {
        if (matrix != nullptr)
          free_.push_back(matrix);
        matrix = nullptr;
      }
    for (Group &group : groups_)
      group.missing = group.n_filled;
    n_refused_ = 0;
  }

  /// Matrices that are added up at the same time are few, as patches are completed on the way: their memory goes from one to the next. It
  /// is asked of the system in pieces that fill a large page.
  void PatchMatrices::open(const unsigned int p)
  {
    const std::size_t size = place(largest_, 0);
    if (free_.empty())
      {
        const std::size_t together = 1 + LargeMemory::large_page / (size * sizeof(double));
        work_.emplace_back(together * size);
        for (std::size_t i = 0; i < together; ++i)
          free_.push_back(work_.back().data() + i * size);
        largest_work_ = std::max(largest_work_, work_.size() * work_.back().memory());
      }
    matrices_[p] = free_.back();
    free_.pop_back();
    std::fill_n(matrices_[p], size, 0.);
  }

  void PatchMatrices::complete(const unsigned int p)
  {
    Group &group = groups_[group_of_[p]];
    if (--group.missing == 0)
      factorise(group);
  }

  void PatchMatrices::factorise(Group &group)
  {
    const std::size_t             size = place(group.n, 0);
    dealii::AlignedVector<double> together(size * n_lanes), sums(std::size_t(group.n) * n_lanes), scratch(std::size_t(group.n) * n_lanes);
    double                       *matrices = together.data();
    const auto at = [](const unsigned int i, const unsigned int j, const unsigned int lane) { return place(i, j) * n_lanes + lane; };
    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      {
        if (lane < group.n_filled)
          {
            double *&from = matrices_[group.patches[lane]];
            if (from != nullptr)
              {
                for (std::size_t k = 0; k < place(group.size[lane], 0); ++k)
                  matrices[k * n_lanes + lane] = from[k];
                free_.push_back(from);
              }
            from = nullptr;
          }
        // Rows that this lane does not have are those of the identity: the factor of the smaller matrix is not touched by them.
        for (unsigned int i = group.size[lane]; i < group.n; ++i)
          matrices[at(i, i, lane)] = 1;
      }
    const unsigned int refused = kernels_->factorise(group.n, matrices, sums.data(), scratch.data());
    for (unsigned int lane = 0; lane < group.n_filled; ++lane)
      if (refused >> lane & 1)
        {
          // The diagonal of row sums is above the matrix in the sense of quadratic forms: S stays bounded by the overlap.
          ++n_refused_;
          for (unsigned int i = 0; i < group.n; ++i)
            {
              for (unsigned int j = 0; j < i; ++j)
                matrices[at(i, j, lane)] = 0;
              const double sum         = sums[i * n_lanes + lane];
              matrices[at(i, i, lane)] = sum > 0 ? 1 / std::sqrt(sum) : 0;
            }
        }
    kernels_->pack(group.n, matrices, packed_.data() + group.entries * kernels_->entry_size, weights_.data() + group.weights);
    group.missing = 0;
  }

  unsigned int PatchMatrices::invert()
  {
    for (Group &group : groups_)
      if (group.missing > 0)
        factorise(group);
    free_.clear();
    work_.clear();
    return n_refused_;
  }

  void PatchMatrices::apply(const Vector &r, Vector &z) const
  {
    r.update_ghost_values();
    z.zero_out_ghost_values();
    z = 0;
    // Factors have half or single precision, so vectors need no more.
    dealii::AlignedVector<float> work(2 * std::size_t(largest_) * n_lanes);
    float                       *x = work.data(), *y = x + std::size_t(largest_) * n_lanes;
    const double                *from = r.begin();
    double                      *to   = z.begin();
    for (const Group &group : groups_)
      {
        const unsigned int *unknown = unknowns_.data() + group.unknowns;
        for (unsigned int lane = 0; lane < group.n_filled; unknown += group.size[lane], ++lane)
          {
            for (unsigned int i = 0; i < group.size[lane]; ++i)
              x[i * n_lanes + lane] = static_cast<float>(from[unknown[i]]);
            for (unsigned int i = group.size[lane]; i < group.n; ++i)
              x[i * n_lanes + lane] = 0;
          }
        kernels_->multiply(group.n, packed_.data() + group.entries * kernels_->entry_size, weights_.data() + group.weights, x, y);
        unknown = unknowns_.data() + group.unknowns;
        for (unsigned int lane = 0; lane < group.n_filled; unknown += group.size[lane], ++lane)
          for (unsigned int i = 0; i < group.size[lane]; ++i)
            to[unknown[i]] += y[i * n_lanes + lane];
      }
    z.compress(dealii::VectorOperation::add);
    r.zero_out_ghost_values();
  }

  std::size_t PatchMatrices::memory() const
  {
    return packed_.memory() + weights_.memory() + unknowns_.size() * sizeof(unsigned int) + group_of_.size() * sizeof(unsigned int) +
           matrices_.size() * sizeof(double *) + groups_.size() * sizeof(Group);
  }
} // namespace myolines
