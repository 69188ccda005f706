// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/picture/view.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>

namespace myolines::picture
{
  namespace
  {
    constexpr double pi = 3.14159265358979323846;

    /// The main axis of the points at rest, or x where none is longer than the others.
    Vec longest_axis(const Body &body)
    {
      Vec centre;
      for (const Vec &x : body.rest)
        centre += x / static_cast<double>(body.rest.size());
      dealii::SymmetricTensor<2, 3> spread;
      for (const Vec &x : body.rest)
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = i; j < 3; ++j)
            spread[i][j] += (x - centre)[i] * (x - centre)[j];
      const auto axes = dealii::eigenvectors(spread); // the largest first
      if (!(axes[0].first > 1.2 * axes[1].first))
        return Vec({1, 0, 0});
      Vec          axis = axes[0].second;
      unsigned int main = 0;
      for (unsigned int c = 1; c < 3; ++c)
        if (std::abs(axis[c]) > std::abs(axis[main]) + 1e-6)
          main = c;
      return axis[main] < 0 ? -axis : axis;
    }
  } // namespace

  View view_of(const Body &body, const double azimuth, const double elevation)
  {
    const Vec  axis   = longest_axis(body), z({0, 0, 1});
    const bool stands = std::abs(axis * z) > 0.8;
    Vec        across = stands ? Vec({1, 0, 0}) : axis, up = stands ? axis : z;
    across -= (stands ? (across * up) : 0.) * up;
    across /= across.norm();
    up -= (up * across) * across;
    up /= up.norm();
    const Vec    front = cross_product_3d(across, up); // towards the viewer who sees `across` to the right
    const double a = azimuth * pi / 180, e = elevation * pi / 180;
    View         view;
    view.right   = std::cos(a) * across - std::sin(a) * front;
    const Vec to = std::sin(a) * across + std::cos(a) * front;
    view.towards = std::cos(e) * to + std::sin(e) * up;
    view.up      = cross_product_3d(view.towards, view.right);
    return view;
  }
} // namespace myolines::picture
