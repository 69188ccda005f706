// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/materials/curves.h>
#include <myolines/scene/scene.h>

#include <array>
#include <memory>
#include <vector>

namespace myolines
{
  /// A curve of cubic pieces that owns its numbers, see curves::Pieces.
  class PiecewiseCurve
  {
  public:
    /// What holds outside of the knots.
    enum class Beyond
    {
      constant, ///< the end values hold outside
      linear    ///< the end slopes hold outside
    };
    /// No curve: that of the thesis holds.
    PiecewiseCurve() = default;
    /// Cubic Hermite pieces; @p s ascends strictly and has at least two entries.
    PiecewiseCurve(std::vector<double> s, const std::vector<double> &values, const std::vector<double> &slopes, Beyond beyond);

    curves::Pieces pieces() const; ///< for kernels; borrowed from this object

  private:
    std::vector<double>                knots_;
    std::vector<std::array<double, 4>> cubics_;
  };

  /// The curves of fibres that a scene names instead of those of the thesis.
  struct CurveSet
  {
    PiecewiseCurve active;         ///< sA over isochoric stretch
    PiecewiseCurve passive;        ///< sP over isochoric stretch
    PiecewiseCurve force_velocity; ///< sV over strain rate
    PiecewiseCurve tendon;         ///< sT over isochoric stretch

    /// Borrowed from this object.
    curves::FibreCurves view() const { return {active.pieces(), passive.pieces(), force_velocity.pieces(), tendon.pieces()}; }
  };

  /// Cubic splines with continuous second derivative through the curves of the thesis: at stretches 0.02 apart (active, passive), at
  /// strain rates 0.01 apart, at stretches 0.002 apart (tendon). Rest (stretch 1, rate 0) is a knot, so isometric values there are
  /// those of the thesis.
  CurveSet smooth_curves();

  /// Declaration of the list `curves`, and its reading: nullptr for the curves of the thesis.
  scene::Schema                   curves_schema();
  std::shared_ptr<const CurveSet> read_curves(const scene::Node &node); ///< Reads that list. @throws InputError
} // namespace myolines
