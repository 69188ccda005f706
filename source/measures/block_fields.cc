// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/muscle3d/point_states.h>

#include <myolines/measures/block_fields.h>

#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>

namespace myolines
{
  namespace
  {
    using Polynomials = std::vector<dealii::Polynomials::Polynomial<double>>;

    /// Lagrange polynomials on the nodes of FE_Q, in their order along the unit interval.
    Polynomials shape_functions(const unsigned int degree)
    {
      return dealii::Polynomials::generate_complete_Lagrange_basis(dealii::QGaussLobatto<1>(degree + 1).get_points());
    }

    /// Degrees (a, b, c) with a + b + c < k.
    std::vector<std::array<unsigned int, 3>> mode_degrees(const unsigned int k)
    {
      std::vector<std::array<unsigned int, 3>> degrees;
      for (unsigned int c = 0; c < k; ++c)
        for (unsigned int b = 0; b + c < k; ++b)
          for (unsigned int a = 0; a + b + c < k; ++a)
            degrees.push_back({{a, b, c}});
      return degrees;
    }
  } // namespace

  BlockFields::BlockFields(const Muscle3dSystem &system, const State &state)
    : size_(system.parameters().geometry.size)
    , degree_(system.parameters().degree)
    , mode_degrees_(mode_degrees(degree_))
  {
    const Geometry &geometry = system.parameters().geometry;
    for (unsigned int d = 0; d < 3; ++d)
      cells_[d] = geometry.cells[d] << geometry.refinement;
    if (system.discretisation().mesh.n_locally_owned_active_cells() != cell_number(0, 0, cells_[2]))
      throw std::logic_error("fields on a block need all its cells on one rank");
    copy_nodes(system, state);
    project_modes(system, state);
  }

  std::size_t BlockFields::number_of(const dealii::Point<3> &centre) const
  {
    std::array<unsigned int, 3> at;
    for (unsigned int d = 0; d < 3; ++d)
      at[d] = static_cast<unsigned int>(centre[d] / size_[d] * cells_[d]);
    return cell_number(at[0], at[1], at[2]);
  }

  void BlockFields::copy_nodes(const Muscle3dSystem &system, const State &state)
  {
    const NodeSpace                             &space = *system.discretisation().space;
    std::vector<dealii::types::global_dof_index> nodes;
    nodes_.resize(system.n_cells() * system.discretisation().element.n_nodes * 6);
    for (const NodeSpace::Cell &cell : space.nodes().active_cell_iterators())
      {
        space.cell_nodes(cell, nodes);
        double *at = &nodes_[number_of(cell->center()) * nodes.size() * 6];
        for (const auto node : nodes)
          for (const Vector *x : {&state.u, &state.v})
            for (unsigned int c = 0; c < 3; ++c)
              *at++ = (*x)(3 * node + c);
      }
  }

  /// p_h and D_h lie in the space of the modes, so that their projection gives them back.
  void BlockFields::project_modes(const Muscle3dSystem &system, const State &state)
  {
    const Element      &element  = system.discretisation().element;
    const Polynomials   legendre = dealii::Polynomials::Legendre::generate_complete_basis(degree_ - 1);
    const int           n        = element.n_points_1d;
    std::vector<double> weighted; // [points][modes]
    for (int q = 0; q < element.n_points; ++q)
      for (const auto &[a, b, c] : mode_degrees_)
        weighted.push_back(element.weights_3d[q] * legendre[a].value(element.point[q % n]) * legendre[b].value(element.point[q / n % n]) *
                           legendre[c].value(element.point[q / (n * n)]));
    modes_.assign(system.n_cells() * mode_degrees_.size() * 2, 0.);
    PointStates(system, state).for_each([&](const NodeSpace::Cell &cell, const int q, const PointState &point) {
      double *at = &modes_[number_of(cell->center()) * mode_degrees_.size() * 2];
      for (std::size_t m = 0; m < mode_degrees_.size(); ++m)
        {
          *at++ += weighted[q * mode_degrees_.size() + m] * point.pressure;
          *at++ += weighted[q * mode_degrees_.size() + m] * point.dilatation;
        }
    });
  }

  BlockFields::Axis BlockFields::axis(const std::vector<Place> &places) const
  {
    const Polynomials shapes = shape_functions(degree_), legendre = dealii::Polynomials::Legendre::generate_complete_basis(degree_ - 1);
    Axis              axis;
    for (const auto &[cell, coordinate] : places)
      {
        axis.cell.push_back(cell);
        for (const auto &shape : shapes)
          axis.shapes.push_back(shape.value(coordinate));
        for (const auto &mode : legendre)
          axis.modes.push_back(mode.value(coordinate));
      }
    return axis;
  }

  BlockFields::Values BlockFields::values(const Axis &x, const std::size_t i, const Axis &y, const std::size_t j, const Axis &z,
                                          const std::size_t k) const
  {
    const unsigned int n1   = degree_ + 1;
    const std::size_t  cell = cell_number(x.cell[i], y.cell[j], z.cell[k]);
    const double      *node = &nodes_[cell * n1 * n1 * n1 * 6], *mode = &modes_[cell * mode_degrees_.size() * 2];
    Values             values{};
    for (unsigned int c = 0; c < n1; ++c)
      for (unsigned int b = 0; b < n1; ++b)
        for (unsigned int a = 0; a < n1; ++a)
          {
            const double shape = x.shapes[i * n1 + a] * y.shapes[j * n1 + b] * z.shapes[k * n1 + c];
            for (unsigned int v = 0; v < 6; ++v)
              values[v] += shape * *node++;
          }
    for (const auto &[a, b, c] : mode_degrees_)
      {
        const double shape = x.modes[i * degree_ + a] * y.modes[j * degree_ + b] * z.modes[k * degree_ + c];
        values[pressure] += shape * *mode++;
        values[dilatation] += shape * *mode++;
      }
    return values;
  }
} // namespace myolines
