// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/measures/block_fields.h>
#include <myolines/muscle3d/discretisation.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <functional>

namespace myolines::testing
{
  using VectorField = std::function<dealii::Tensor<1, 3>(const dealii::Point<3> &)>;

  inline dealii::Tensor<1, 3> no_motion(const dealii::Point<3> &) { return {}; }

  /// The cells of a block of 0.03 x 0.01 x 0.02 m and their degree.
  struct Mesh
  {
    unsigned int                degree, refinement;
    std::array<unsigned int, 3> cells{{1, 1, 1}};
  };

  inline Muscle3dParameters block_of(const Mesh &mesh)
  {
    Muscle3dParameters parameters;
    parameters.degree              = mesh.degree;
    parameters.n_points            = mesh.degree + 1;
    parameters.geometry.size       = {{0.03, 0.01, 0.02}};
    parameters.geometry.refinement = mesh.refinement;
    parameters.geometry.cells      = mesh.cells;
    return parameters;
  }

  /// The nodal interpolants of @p u and @p v.
  inline State interpolate(const Muscle3dSystem &system, const VectorField &u, const VectorField &v)
  {
    const NodeSpace &space = *system.discretisation().space;
    State            state{0, space.make_vector(), space.make_vector(), space.make_vector()};
    for (const auto i : space.owned_unknowns())
      {
        state.u(i) = u(space.node_position(i / 3))[i % 3];
        state.v(i) = v(space.node_position(i / 3))[i % 3];
      }
    return state;
  }

  inline BlockFields fields(const Mesh &mesh, const VectorField &u, const VectorField &v = no_motion)
  {
    WorkLedger           ledger;
    const Muscle3dSystem system(block_of(mesh), MPI_COMM_SELF, ledger);
    return BlockFields(system, interpolate(system, u, v));
  }
} // namespace myolines::testing
