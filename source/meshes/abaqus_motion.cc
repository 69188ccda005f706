// SPDX-License-Identifier: LGPL-2.1-or-later
#include "abaqus_motion.h"

#include <cmath>

namespace myolines
{
  void AbaqusMotion::add(const std::vector<double> &numbers, const Cursor &cursor)
  {
    const std::size_t expected[] = {3, 7};
    if (n_lines_ > 1 || numbers.size() != expected[n_lines_])
      cursor.refuse("line " + std::to_string(n_lines_ + 1) + " of the motion of an instance has " + std::to_string(numbers.size()) +
                        " numbers",
                    "3 of a translation in the first line, 7 of a rotation in the second, and no more lines");
    if (++n_lines_ == 1)
      {
        for (std::size_t c = 0; c < 3; ++c)
          translation_[c] = numbers[c];
        return;
      }
    for (std::size_t c = 0; c < 3; ++c)
      {
        origin_[c] = numbers[c];
        axis_[c]   = numbers[c + 3] - numbers[c];
      }
    const double length = std::hypot(axis_[0], axis_[1], axis_[2]);
    if (!(length > 0))
      cursor.refuse("both points of the axis of a rotation are the same", "two points");
    for (double &c : axis_)
      c /= length;
    // multiples of a right angle without the rounding of pi
    const double angle = std::remainder(numbers[6], 360), turns = std::nearbyint(angle / 90),
                 rest    = (angle - 90 * turns) * std::acos(-1) / 180;
    const int    quarter = (static_cast<int>(turns) + 4) % 4;
    const double c = std::cos(rest), s = std::sin(rest), cosines[] = {c, -s, -c, s}, sines[] = {s, c, -s, -c};
    cosine_ = cosines[quarter];
    sine_   = sines[quarter];
  }

  /// The formula of Rodrigues: x cos + (k x x) sin + k (k . x) (1 - cos), relative to a point of the axis k.
  PlainMesh::Position AbaqusMotion::of(const PlainMesh::Position &x) const
  {
    PlainMesh::Position r;
    for (std::size_t c = 0; c < 3; ++c)
      r[c] = x[c] + translation_[c] - origin_[c];
    const double        along = axis_[0] * r[0] + axis_[1] * r[1] + axis_[2] * r[2];
    PlainMesh::Position moved;
    for (std::size_t c = 0; c < 3; ++c)
      {
        const std::size_t d = (c + 1) % 3, e = (c + 2) % 3;
        moved[c] = origin_[c] + cosine_ * r[c] + sine_ * (axis_[d] * r[e] - axis_[e] * r[d]) + (1 - cosine_) * along * axis_[c];
      }
    return n_lines_ < 2 ? PlainMesh::Position{{x[0] + translation_[0], x[1] + translation_[1], x[2] + translation_[2]}} : moved;
  }
} // namespace myolines
