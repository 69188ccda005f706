// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/fem/rigid_body_modes.h>
#include <myolines/measures/rigid_motions.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>

namespace myolines
{
  namespace
  {
    constexpr unsigned int n_modes = 6;
    using ModeRow                  = std::array<double, n_modes>; ///< what a condition sees of each mode
    using Matrix6                  = std::array<ModeRow, n_modes>;

    void add_square(Matrix6 &sum, const ModeRow &row, const double weight = 1)
    {
      for (unsigned int i = 0; i < n_modes; ++i)
        for (unsigned int j = 0; j < n_modes; ++j)
          sum[i][j] += weight * row[i] * row[j];
    }

    /// Number of directions of the first @p n modes in which the positive semi-definite @p a vanishes: Cholesky with complete pivoting.
    unsigned int nullity(Matrix6 a, const unsigned int n)
    {
      constexpr double rounding = 1e-14;
      double           largest  = 0;
      for (unsigned int i = 0; i < n_modes; ++i)
        largest = std::max(largest, a[i][i]);
      std::array<bool, n_modes> used{};
      for (unsigned int rank = 0; rank < n; ++rank)
        {
          unsigned int pivot = n;
          for (unsigned int i = 0; i < n; ++i)
            if (!used[i] && (pivot == n || a[i][i] > a[pivot][pivot]))
              pivot = i;
          if (!(a[pivot][pivot] > rounding * largest))
            return n - rank;
          used[pivot] = true;
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < n; ++j)
              if (!used[i] && !used[j])
                a[i][j] -= a[i][pivot] * a[pivot][j] / a[pivot][pivot];
        }
      return 0;
    }

    /// Translations and rotations about the middle, both of size 1 at most; ghosts are current.
    std::vector<Vector> modes_of_size_one(const NodeSpace &space)
    {
      std::vector<Vector> modes = rigid_body_modes(space, Constraints());
      for (Vector &mode : modes)
        {
          mode /= mode.linfty_norm();
          mode.update_ghost_values();
        }
      return modes;
    }

    /// How far the modes break the relations between unknowns.
    void add_relations(const Constraints &constraints, const NodeSpace &space, const std::vector<Vector> &modes, Matrix6 &sum)
    {
      for (const auto &line : constraints.get_lines())
        if (space.owned_unknowns().is_element(line.index))
          {
            ModeRow row{};
            for (unsigned int m = 0; m < n_modes; ++m)
              {
                row[m] = modes[m](line.index);
                for (const auto &[other, weight] : line.entries)
                  row[m] -= weight * modes[m](other);
              }
            add_square(sum, row);
          }
    }

    /// Work that the springs of @p condition would do, each as stiff as any other.
    void add_springs(const BoundaryCondition &condition, const NodeSpace &space, const std::vector<Vector> &modes, Matrix6 &sum)
    {
      const dealii::FiniteElement<3>              &element = space.nodes().get_fe();
      dealii::FEFaceValues<3>                      values(element, dealii::QGauss<2>(2),
                                                          dealii::update_values | dealii::update_normal_vectors | dealii::update_JxW_values);
      std::vector<dealii::types::global_dof_index> nodes(element.n_dofs_per_cell());
      for (const auto &cell : space.nodes().active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int f : cell->face_indices())
            if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == condition.facts().face)
              {
                values.reinit(cell, f);
                cell->get_dof_indices(nodes);
                const double size = std::pow(cell->diameter(), 2);
                for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
                  {
                    std::array<Vector3, n_modes> motion;
                    for (unsigned int m = 0; m < n_modes; ++m)
                      for (unsigned int c = 0; c < 3; ++c)
                        for (unsigned int i = 0; i < nodes.size(); ++i)
                          motion[m][c] += values.shape_value(i, q) * modes[m](3 * nodes[i] + c);
                    for (const Vector3 &direction : condition.held_directions(values.normal_vector(q)))
                      {
                        ModeRow pulled;
                        for (unsigned int m = 0; m < n_modes; ++m)
                          pulled[m] = motion[m] * direction;
                        add_square(sum, pulled, values.JxW(q) / size);
                      }
                  }
              }
    }

    std::string number_of(const unsigned int number, const std::string &what)
    {
      return std::to_string(number) + " " + what + (number == 1 ? "" : "s");
    }
  } // namespace

  std::string FreeMotions::words() const
  {
    if (translations == 0 || rotations == 0)
      return translations == 0 ? number_of(rotations, "rotation") : number_of(translations, "translation");
    return number_of(translations, "translation") + " and " + number_of(rotations, "rotation");
  }

  FreeMotions free_motions(const Muscle3dParameters &parameters, const Muscle3dDiscretisation &discretisation)
  {
    const NodeSpace          &space = *discretisation.space;
    const std::vector<Vector> modes = modes_of_size_one(space);
    Matrix6                   sum{};
    add_relations(discretisation.constraints.lines, space, modes, sum);
    for (const auto &condition : parameters.boundary)
      if (condition->facts().supports)
        add_springs(*condition, space, modes, sum);
    for (ModeRow &row : sum)
      for (double &x : row)
        x = dealii::Utilities::MPI::sum(x, space.communicator());
    const unsigned int translations = nullity(sum, 3);
    return {translations, nullity(sum, n_modes) - translations};
  }
} // namespace myolines
