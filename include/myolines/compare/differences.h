// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/measures/block_fields.h>
#include <myolines/rod1d/rod1d_system.h>

#include <mpi.h>

#include <optional>
#include <string>
#include <vector>

namespace myolines
{
  /// L2 norms over the reference body B_0 of one field of two states, and of their difference.
  struct FieldDifference
  {
    std::string field;          ///< "displacement", "velocity", "pressure", "dilatation"
    std::string unit;           ///< of the norms: "m^2.5"
    double      first      = 0; ///< ||x_1||
    double      second     = 0; ///< ||x_2||
    double      difference = 0; ///< ||x_1 - x_2||

    /// ||x_1 - x_2|| / ||x_2||, thesis (6.3.2) and (6.3.4); none if x_2 is zero.
    std::optional<double> relative() const;
  };

  /// Fields of two muscles on the same block, each on cells of its own and of its own degree. They are integrated over the pieces into
  /// which the faces of both meshes cut the block, where all are polynomials, with as many Gauss points as their degree asks for: the
  /// norms are exact but for rounding, whatever the meshes. Thesis (6.3.1) instead takes the points of the coarser mesh, which
  /// sees less of the finer solution. The ranks of @p communicator share the pieces; each has both fields.
  std::vector<FieldDifference> l2_differences(const BlockFields &first, const BlockFields &second, MPI_Comm communicator);

  /// The same of displacement and velocity of two rods of equal length; norms [m^1.5], [m^1.5/s].
  std::vector<FieldDifference> l2_differences(const Rod1dSystem &first, const State &first_state, const Rod1dSystem &second,
                                              const State &second_state);

  /// A piece of an axis on which two equal divisions, into n_1 and n_2 cells, have no cut.
  struct CommonPiece
  {
    double       begin;  ///< of the piece, over the length of the axis
    double       length; ///< likewise
    unsigned int first;  ///< cell of the first division that it lies in
    unsigned int second; ///< cell of the second
  };
  /// Pieces from left to right; those of nested divisions are the cells of the finer one.
  std::vector<CommonPiece> common_pieces(unsigned int n_first, unsigned int n_second);
} // namespace myolines
