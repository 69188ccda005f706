// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/fem/potential.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/diagonal_matrix.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/solver_cg.h>

namespace myolines
{
  namespace
  {
    /// The stiffness of the Laplacian, cell by cell; the identity at fixed nodes.
    class Laplacian
    {
    public:
      explicit Laplacian(const dealii::DoFHandler<3> &nodes)
        : n_(nodes.get_fe().n_dofs_per_cell())
      {
        const dealii::QGauss<3> rule(nodes.get_fe().degree + 1);
        dealii::FEValues<3>     values(nodes.get_fe(), rule, dealii::update_gradients | dealii::update_JxW_values);
        for (const auto &cell : nodes.active_cell_iterators())
          if (cell->is_locally_owned())
            {
              values.reinit(cell);
              numbers_.emplace_back(n_);
              cell->get_dof_indices(numbers_.back());
              matrices_.emplace_back(n_, n_);
              for (unsigned int q = 0; q < rule.size(); ++q)
                for (unsigned int i = 0; i < n_; ++i)
                  for (unsigned int j = 0; j < n_; ++j)
                    matrices_.back()(i, j) += values.shape_grad(i, q) * values.shape_grad(j, q) * values.JxW(q);
            }
      }

      /// y = K x, all nodes free.
      void apply(const Vector &x, Vector &y) const
      {
        Vector current(x);
        current.update_ghost_values();
        y.zero_out_ghost_values();
        y = 0;
        for (std::size_t cell = 0; cell < numbers_.size(); ++cell)
          for (unsigned int i = 0; i < n_; ++i)
            {
              double sum = 0;
              for (unsigned int j = 0; j < n_; ++j)
                sum += matrices_[cell](i, j) * current(numbers_[cell][j]);
              y(numbers_[cell][i]) += sum;
            }
        y.compress(dealii::VectorOperation::add);
      }

      Vector diagonal(const Vector &like) const
      {
        Vector d(like);
        d.zero_out_ghost_values();
        d = 0;
        for (std::size_t cell = 0; cell < numbers_.size(); ++cell)
          for (unsigned int i = 0; i < n_; ++i)
            d(numbers_[cell][i]) += matrices_[cell](i, i);
        d.compress(dealii::VectorOperation::add);
        return d;
      }

      std::vector<dealii::types::global_dof_index> fixed; ///< that this rank owns

      void vmult(Vector &y, const Vector &x) const
      {
        Vector free(x);
        for (const auto i : fixed)
          free(i) = 0;
        apply(free, y);
        for (const auto i : fixed)
          y(i) = x(i);
      }

    private:
      unsigned int                                              n_;
      std::vector<std::vector<dealii::types::global_dof_index>> numbers_;
      std::vector<dealii::FullMatrix<double>>                   matrices_;
    };
  } // namespace

  Vector laplace_potential(const NodeSpace &space, const dealii::types::boundary_id from, const dealii::types::boundary_id to)
  {
    const dealii::DoFHandler<3> &nodes = space.nodes();
    dealii::IndexSet             relevant;
    dealii::DoFTools::extract_locally_relevant_dofs(nodes, relevant);
    Vector    phi(nodes.locally_owned_dofs(), relevant, space.communicator());
    Laplacian laplacian(nodes);
    for (const auto face : {from, to})
      for (const auto node : space.face_nodes(face))
        if (nodes.locally_owned_dofs().is_element(node))
          {
            laplacian.fixed.push_back(node);
            phi(node) = face == to ? 1 : 0;
          }

    Vector r(phi), x(phi), inverse = laplacian.diagonal(phi);
    laplacian.apply(phi, r);
    r *= -1;
    for (const auto i : laplacian.fixed)
      {
        r(i)       = 0;
        inverse(i) = 1;
      }
    for (double &d : inverse)
      d = 1 / d;
    x = 0;
    const dealii::DiagonalMatrix<Vector> jacobi(inverse);
    dealii::SolverControl                control(10000, 1e-12 * r.l2_norm());
    dealii::SolverCG<Vector>             solver(control);
    solver.solve(laplacian, x, r, jacobi);
    phi += x;
    phi.update_ghost_values();
    return phi;
  }
} // namespace myolines
