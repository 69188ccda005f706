// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle3d/muscle3d_system.h>

#include <array>
#include <utility>
#include <vector>

namespace myolines
{
  /// A state of a muscle as functions on its reference block: displacement U and velocity V, continuous of degree k, pressure p_h and
  /// dilatation D_h, discontinuous polynomials of total degree k - 1. The block is cut into equal cells, so a place on an axis is a cell
  /// and a coordinate in [0, 1] within it, and a point of the block is a place on each of the three.
  class BlockFields
  {
  public:
    /// Places of the fields in Values.
    enum Value
    {
      displacement = 0, ///< 3 [m]
      velocity     = 3, ///< 3 [m/s]
      pressure     = 6, ///< [Pa]
      dilatation   = 7, ///< [-]
      n_values     = 8  ///< how many numbers there are
    };
    using Values = std::array<double, n_values>; ///< All fields at one point.

    /// A cell along an axis and the coordinate in it.
    using Place = std::pair<unsigned int, double>;

    /// Copies what it needs. The @p system is whole on this rank (MPI_COMM_SELF) and its mesh was not moved.
    BlockFields(const Muscle3dSystem &system, const State &state);

    const std::array<double, 3>       &size() const { return size_; }     ///< of the block [m]
    const std::array<unsigned int, 3> &cells() const { return cells_; }   ///< along each axis
    unsigned int                       degree() const { return degree_; } ///< k, of the displacement

    /// Shape functions at places on an axis, computed once for all points that share them.
    struct Axis
    {
      std::vector<unsigned int> cell;   ///< of each place
      std::vector<double>       shapes; ///< [places][k + 1]
      std::vector<double>       modes;  ///< [places][k], Legendre polynomials
    };
    Axis axis(const std::vector<Place> &places) const; ///< The @p places in the order given, for values().

    /// The fields at place @p i of @p x, @p j of @p y and @p k of @p z.
    Values values(const Axis &x, std::size_t i, const Axis &y, std::size_t j, const Axis &z, std::size_t k) const;

  private:
    std::size_t cell_number(unsigned int i, unsigned int j, unsigned int k) const
    {
      return i + static_cast<std::size_t>(cells_[0]) * (j + static_cast<std::size_t>(cells_[1]) * k);
    }
    std::size_t number_of(const dealii::Point<3> &centre) const;
    void        copy_nodes(const Muscle3dSystem &system, const State &state);
    void        project_modes(const Muscle3dSystem &system, const State &state);

    std::array<double, 3>                    size_;
    std::array<unsigned int, 3>              cells_;
    unsigned int                             degree_;
    std::vector<std::array<unsigned int, 3>> mode_degrees_; ///< of each product of Legendre polynomials
    std::vector<double>                      nodes_;        ///< [cells][(k + 1)^3][6]
    std::vector<double>                      modes_;        ///< [cells][modes][2], coefficients of p_h and D_h
  };
} // namespace myolines
