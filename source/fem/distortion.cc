// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/fem/distortion.h>

#include <deal.II/grid/grid_tools.h>

#include <cmath>
#include <cstdint>

namespace myolines
{
  namespace
  {
    /// Of [-1, 1), from the finaliser of MurmurHash3: every bit of @p key changes half of the bits of the result.
    double scattered(std::uint64_t key)
    {
      for (const std::uint64_t factor : {0xff51afd7ed558ccdULL, 0xc4ceb9fe1a85ec53ULL})
        key = (key ^ key >> 33) * factor;
      key ^= key >> 33;
      return static_cast<double>(key >> 11) / (std::uint64_t{1} << 52) - 1;
    }
  } // namespace

  void distort_block(NodeSpace::Mesh &mesh, const std::array<double, 3> &size, const std::array<unsigned int, 3> &cells,
                     const unsigned int refinement, const double amount)
  {
    dealii::GridTools::transform(
        [&](const dealii::Point<3> &vertex) {
          std::array<std::uint64_t, 3> n, place; // cells along each direction, index of the vertex
          for (unsigned int d = 0; d < 3; ++d)
            {
              n[d]     = std::uint64_t{cells[d]} << refinement;
              place[d] = std::llround(vertex[d] / size[d] * n[d]);
            }
          dealii::Point<3> moved = vertex;
          for (unsigned int d = 0; d < 3; ++d)
            if (place[d] != 0 && place[d] != n[d])
              moved[d] += amount * size[d] / n[d] * scattered(1 + d + 3 * (place[0] + (n[0] + 1) * (place[1] + (n[1] + 1) * place[2])));
          return moved;
        },
        mesh);
  }
} // namespace myolines
