// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/algebra/interpolation.h>

namespace myolines
{
  void Interpolation::add_row(const std::vector<std::pair<unsigned int, double>> &entries, const bool constrained[3])
  {
    for (const auto &[node, weight] : entries)
      {
        columns_.push_back(3 * node);
        weights_.push_back(weight);
      }
    row_start_.push_back(static_cast<unsigned int>(columns_.size()));
    for (int c = 0; c < 3; ++c)
      free_.push_back(constrained[c] ? 0. : 1.);
  }

  void Interpolation::add(const Vector &coarse, Vector &fine) const
  {
    coarse.update_ghost_values();
    const double *from = coarse.begin();
    double       *to   = fine.begin();
    for (std::size_t node = 0; node + 1 < row_start_.size(); ++node)
      {
        double sum[3] = {0, 0, 0};
        for (unsigned int k = row_start_[node]; k < row_start_[node + 1]; ++k)
          for (int c = 0; c < 3; ++c)
            sum[c] += weights_[k] * from[columns_[k] + c];
        for (int c = 0; c < 3; ++c)
          to[3 * node + c] += free_[3 * node + c] * sum[c];
      }
    coarse.zero_out_ghost_values();
  }

  void Interpolation::restrict_to(const Vector &fine, Vector &coarse) const
  {
    coarse.zero_out_ghost_values();
    coarse             = 0;
    const double *from = fine.begin();
    double       *to   = coarse.begin();
    for (std::size_t node = 0; node + 1 < row_start_.size(); ++node)
      for (unsigned int k = row_start_[node]; k < row_start_[node + 1]; ++k)
        for (int c = 0; c < 3; ++c)
          to[columns_[k] + c] += weights_[k] * free_[3 * node + c] * from[3 * node + c];
    coarse.compress(dealii::VectorOperation::add);
  }
} // namespace myolines
