// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/algebra/band_matrix.h>

#include <algorithm>
#include <cmath>

extern "C" {
void dgbtrf_(const int *m, const int *n, const int *kl, const int *ku, double *ab, const int *ldab, int *ipiv, int *info);
void dgbtrs_(const char *trans, const int *n, const int *kl, const int *ku, const int *nrhs, const double *ab, const int *ldab,
             const int *ipiv, double *b, const int *ldb, int *info);
}

namespace myolines
{
  BandMatrix::BandMatrix(const unsigned int size, const unsigned int bandwidth)
    : size_(size)
    , bandwidth_(std::min(bandwidth, size > 0 ? size - 1 : 0))
    , leading_(3 * bandwidth_ + 1)
    , entries_(static_cast<std::size_t>(leading_) * size)
    , pivots_(size)
  {}

  void BandMatrix::clear() { std::fill(entries_.begin(), entries_.end(), 0.); }

  bool BandMatrix::factorise()
  {
    const int n = size_, k = bandwidth_, leading = leading_;
    int       info = 0;
    dgbtrf_(&n, &n, &k, &k, entries_.data(), &leading, pivots_.data(), &info);
    return info == 0 && std::all_of(entries_.begin(), entries_.end(), [](const double x) { return std::isfinite(x); });
  }

  void BandMatrix::solve(double *x) const
  {
    const int n = size_, k = bandwidth_, leading = leading_, one = 1;
    int       info = 0;
    dgbtrs_("N", &n, &k, &k, &one, entries_.data(), &leading, pivots_.data(), x, &n, &info);
  }
} // namespace myolines
