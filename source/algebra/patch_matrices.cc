// SPDX-License-Identifier: LGPL-2.1-or-later
#include "patch_kernels.h"

#include <myolines/algebra/patch_matrices.h>

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

    std::size_t at(const unsigned int i, const unsigned int j, const unsigned int lane)
    {
      return (std::size_t(i) * (i + 1) / 2 + j) * n_lanes + lane;
    }

    /// The matrix of one lane becomes the inverse of the diagonal of its row sums in magnitude.
    void replace_by_row_sums(const unsigned int n, float *entries)
    {
      std::vector<double> sums(n, 0.);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j <= i; ++j)
          {
            const double magnitude = std::abs(entries[at(i, j, 0)]);
            sums[i] += magnitude;
            if (i != j)
              sums[j] += magnitude;
            entries[at(i, j, 0)] = 0;
          }
      for (unsigned int i = 0; i < n; ++i)
        entries[at(i, i, 0)] = sums[i] > 0 ? static_cast<float>(1 / sums[i]) : 0.f;
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
    , places_(patches.size())
    , overlap_(largest_overlap(patches, layout))
  {
    // Lanes of a group run as long as the largest: patches of one size stand together, else in their order.
    std::vector<unsigned int> order(patches.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](const unsigned int a, const unsigned int b) { return patches[a].size() > patches[b].size(); });

    std::size_t n_entries = 0;
    for (std::size_t first = 0; first < order.size(); first += n_lanes)
      {
        Group group{};
        group.n        = static_cast<unsigned int>(patches[order[first]].size());
        group.n_filled = static_cast<unsigned int>(std::min<std::size_t>(n_lanes, order.size() - first));
        group.entries  = n_entries;
        group.unknowns = unknowns_.size();
        for (unsigned int lane = 0; lane < group.n_filled; ++lane)
          {
            const auto &patch            = patches[order[first + lane]];
            group.size[lane]             = static_cast<unsigned int>(patch.size());
            places_[order[first + lane]] = {n_entries, lane};
            unknowns_.insert(unknowns_.end(), patch.begin(), patch.end());
          }
        largest_ = std::max(largest_, group.n);
        n_entries += std::size_t(group.n) * (group.n + 1) / 2 * n_lanes;
        groups_.push_back(group);
      }
    entries_.resize(n_entries);
  }

  void PatchMatrices::clear() { std::fill(entries_.begin(), entries_.end(), 0.f); }

  unsigned int PatchMatrices::invert()
  {
    unsigned int                  n_refused = 0;
    dealii::AlignedVector<double> matrix(std::size_t(largest_) * (largest_ + 1) / 2 * n_lanes), column(largest_ * n_lanes);
    for (const Group &group : groups_)
      {
        float *entries = entries_.data() + group.entries;
        std::copy_n(entries, at(group.n, 0, 0), matrix.begin());
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          for (unsigned int i = group.size[lane]; i < group.n; ++i) // rows that this lane does not have
            matrix[at(i, i, lane)] = 1;
        const unsigned int refused = kernels_->invert(group.n, matrix.data(), column.data());

        for (unsigned int lane = 0; lane < group.n_filled; ++lane)
          {
            if (refused >> lane & 1)
              {
                ++n_refused;
                replace_by_row_sums(group.size[lane], entries + lane);
                continue;
              }
            for (unsigned int i = 0; i < group.size[lane]; ++i)
              for (unsigned int j = 0; j <= i; ++j)
                entries[at(i, j, lane)] = static_cast<float>(matrix[at(i, j, lane)]);
          }
      }
    return n_refused;
  }

  void PatchMatrices::apply(const Vector &r, Vector &z) const
  {
    r.update_ghost_values();
    z.zero_out_ghost_values();
    z = 0;
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
        kernels_->multiply(group.n, entries_.data() + group.entries, x, y);
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
    return entries_.memory_consumption() + unknowns_.size() * sizeof(unsigned int) + places_.size() * sizeof(Place) +
           groups_.size() * sizeof(Group);
  }
} // namespace myolines
