// SPDX-License-Identifier: LGPL-2.1-or-later
#include "hdf5_tables.h"
#include <myolines/muscle3d/forest_order.h>
#include <myolines/muscle3d/point_states.h>

#include <myolines/measures/flexodeal_point_data.h>

#include <map>

namespace myolines
{
  namespace
  {
    /// One row, filled from the left.
    class Row
    {
    public:
      explicit Row(float *first)
        : next_(first)
      {}

      void add(const double x) { *next_++ = static_cast<float>(x); }
      void add(const Vector3 &v)
      {
        for (unsigned int c = 0; c < 3; ++c)
          add(v[c]);
      }
      void add(const Matrix3 &A)
      {
        for (unsigned int i = 0; i < 3; ++i)
          add(A[i]);
      }

    private:
      float *next_;
    };

    /// @p fill(row, position, point) for all points of this rank.
    template <typename Fill>
    void write(const Muscle3dSystem &system, const State &state, const unsigned int n_columns, const std::filesystem::path &file,
               const Fill &fill)
    {
      const Muscle3dDiscretisation       &d     = system.discretisation();
      const std::vector<NodeSpace::Cell>  cells = cells_in_forest_order(d);
      std::map<unsigned int, std::size_t> first_point; // by active cell index
      for (std::size_t i = 0; i < cells.size(); ++i)
        first_point[cells[i]->active_cell_index()] = i * d.element.n_points;
      std::vector<float> values(cells.size() * d.element.n_points * n_columns);
      PointStates(system, state).for_each([&](const NodeSpace::Cell &cell, const int q, const PointState &p) {
        Row row(&values[(first_point.at(cell->active_cell_index()) + q) * n_columns]);
        row.add(Vector3(point_position(d.element, cell, q)));
        row.add(p.JxW);
        row.add(p.J);
        fill(row, p);
        row.add(p.material_id);
      });

      // One file for all ranks, each behind those before it.
      const RowShare rows(cells.size() * d.element.n_points, d.communicator);
      SharedFile     shared(file, d.communicator, SharedFile::Mode::write_anew);
      shared.write(rows.before * n_columns * sizeof(float), values);
      shared.close();
    }
  } // namespace

  void write_main_points(const Muscle3dSystem &system, const State &state, const std::filesystem::path &file)
  {
    write(system, state, n_main_columns, file, [](Row &row, const PointState &p) {
      row.add(p.displacement);
      row.add(p.velocity);
      for (const double x : {p.pressure, p.dilatation, p.stretch, p.isochoric_stretch, p.strain_rate, p.isochoric_strain_rate})
        row.add(x);
      row.add(p.fibre);
    });
  }

  void write_tensor_points(const Muscle3dSystem &system, const State &state, const std::filesystem::path &file)
  {
    const Activation activation = system.activation(state.t);
    write(system, state, n_tensor_columns, file, [&](Row &row, const PointState &p) {
      const Parts<Matrix3> P = stress_parts(system.parameters(), activation, p);
      row.add(p.F);
      for (const Matrix3 &stress : {P.total(), P[volumetric_part], P.isochoric(), P[muscle_active], P[muscle_passive], P[muscle_base]})
        row.add(Matrix3(stress * transpose(p.F)));
    });
  }
} // namespace myolines
