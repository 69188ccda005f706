// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/compare/differences.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace myolines
{
  namespace
  {
    /// Gauss points of the common pieces of an axis, as places of both divisions.
    struct Points
    {
      Points(const unsigned int n_first, const unsigned int n_second, const unsigned int n_gauss)
      {
        const dealii::QGauss<1> gauss(n_gauss);
        for (const CommonPiece &piece : common_pieces(n_first, n_second))
          for (unsigned int q = 0; q < n_gauss; ++q)
            {
              position.push_back(piece.begin + piece.length * gauss.point(q)[0]);
              weight.push_back(piece.length * gauss.weight(q));
              first.push_back({piece.first, position.back() * n_first - piece.first});
              second.push_back({piece.second, position.back() * n_second - piece.second});
            }
      }

      std::vector<double>             position, weight; ///< over the length of the axis
      std::vector<BlockFields::Place> first, second;
    };

    /// Integrals of the squares of a field of both states and of their difference.
    struct Squares
    {
      void add(const double weight, const double x, const double y)
      {
        first += weight * x * x;
        second += weight * y * y;
        difference += weight * (x - y) * (x - y);
      }

      FieldDifference norms(const std::string &field, const std::string &unit, const MPI_Comm communicator) const
      {
        const auto norm = [&](const double own) { return std::sqrt(dealii::Utilities::MPI::sum(own, communicator)); };
        return {field, unit, norm(first), norm(second), norm(difference)};
      }

      double first = 0, second = 0, difference = 0;
    };

    /// The three axes of a block, for one of two fields on it.
    using Axes = std::array<BlockFields::Axis, 3>;
  } // namespace

  std::optional<double> FieldDifference::relative() const { return second > 0 ? std::optional<double>(difference / second) : std::nullopt; }

  std::vector<CommonPiece> common_pieces(const unsigned int n_first, const unsigned int n_second)
  {
    // Cuts are compared as integers, multiples of 1 / (n_first n_second), so that equal ones are found equal.
    const std::uint64_t      whole = static_cast<std::uint64_t>(n_first) * n_second;
    std::vector<CommonPiece> pieces;
    unsigned int             i = 0, j = 0;
    for (std::uint64_t begin = 0; begin < whole;)
      {
        const std::uint64_t end_first = (i + std::uint64_t(1)) * n_second, end_second = (j + std::uint64_t(1)) * n_first;
        const std::uint64_t end = std::min(end_first, end_second);
        pieces.push_back({static_cast<double>(begin) / whole, static_cast<double>(end - begin) / whole, i, j});
        i += end == end_first ? 1 : 0;
        j += end == end_second ? 1 : 0;
        begin = end;
      }
    return pieces;
  }

  std::vector<FieldDifference> l2_differences(const BlockFields &first, const BlockFields &second, const MPI_Comm communicator)
  {
    // A square of a field of degree k has degree 2 k along an axis, which k + 1 Gauss points integrate.
    const unsigned int    n_gauss = std::max(first.degree(), second.degree()) + 1;
    std::array<Points, 3> points{{{first.cells()[0], second.cells()[0], n_gauss},
                                  {first.cells()[1], second.cells()[1], n_gauss},
                                  {first.cells()[2], second.cells()[2], n_gauss}}};
    Axes                  of_first, of_second;
    for (unsigned int d = 0; d < 3; ++d)
      {
        of_first[d]  = first.axis(points[d].first);
        of_second[d] = second.axis(points[d].second);
      }
    const double       volume  = first.size()[0] * first.size()[1] * first.size()[2];
    const unsigned int rank    = dealii::Utilities::MPI::this_mpi_process(communicator),
                       n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);

    std::array<Squares, BlockFields::n_values> sums;
    for (std::size_t k = rank; k < points[2].weight.size(); k += n_ranks)
      for (std::size_t j = 0; j < points[1].weight.size(); ++j)
        for (std::size_t i = 0; i < points[0].weight.size(); ++i)
          {
            const double              weight = volume * points[0].weight[i] * points[1].weight[j] * points[2].weight[k];
            const BlockFields::Values x      = first.values(of_first[0], i, of_first[1], j, of_first[2], k),
                                      y      = second.values(of_second[0], i, of_second[1], j, of_second[2], k);
            for (unsigned int v = 0; v < BlockFields::n_values; ++v)
              sums[v].add(weight, x[v], y[v]);
          }
    const auto of_vector = [&sums](const unsigned int begin) {
      Squares sum;
      for (unsigned int c = begin; c < begin + 3; ++c)
        {
          sum.first += sums[c].first;
          sum.second += sums[c].second;
          sum.difference += sums[c].difference;
        }
      return sum;
    };
    return {of_vector(BlockFields::displacement).norms("displacement", "m^2.5", communicator),
            of_vector(BlockFields::velocity).norms("velocity", "m^2.5/s", communicator),
            sums[BlockFields::pressure].norms("pressure", "Pa m^1.5", communicator),
            sums[BlockFields::dilatation].norms("dilatation", "m^1.5", communicator)};
  }

  std::vector<FieldDifference> l2_differences(const Rod1dSystem &first, const State &first_state, const Rod1dSystem &second,
                                              const State &second_state)
  {
    const Rod1dParameters &one = first.parameters(), &other = second.parameters();
    const Points           points(one.n_elements, other.n_elements, std::max(one.degree, other.degree) + 1);
    const double           length = one.length;
    Squares                u, v;
    for (std::size_t q = 0; q < points.weight.size(); ++q)
      {
        const double x = length * points.position[q], weight = length * points.weight[q];
        u.add(weight, first.value(first_state.u, x), second.value(second_state.u, x));
        v.add(weight, first.value(first_state.v, x), second.value(second_state.v, x));
      }
    return {u.norms("displacement", "m^1.5", MPI_COMM_SELF), v.norms("velocity", "m^1.5/s", MPI_COMM_SELF)};
  }
} // namespace myolines
