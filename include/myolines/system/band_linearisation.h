#pragma once

#include <myolines/algebra/band_matrix.h>
#include <myolines/system/linearisation.h>

#include <cstdint>

namespace myolines
{
  /// A linearisation whose matrices are narrow bands on one rank (one-dimensional bodies, a few unknowns). Newton's method
  /// then solves directly and without the set-up that large problems need.
  class BandLinearisation : public Linearisation
  {
  public:
    virtual unsigned int bandwidth() const = 0;

    /// As sparse(), into @p matrix of this bandwidth.
    virtual void fill(const WeightsByOrder &weights, BandMatrix &matrix) const = 0;

    /// Changes with every linearise(): equal versions, equal matrices for equal weights.
    virtual std::uint64_t version() const = 0;
  };
} // namespace myolines
