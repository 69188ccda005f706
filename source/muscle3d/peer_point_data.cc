#include "forest_order.h"
#include "point_states.h"

#include <myolines/muscle3d/peer_point_data.h>

#include <map>
#include <stdexcept>

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

    void throw_unless(const int error, const std::filesystem::path &file)
    {
      if (error != MPI_SUCCESS)
        throw std::runtime_error("cannot write " + file.string());
    }

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
      const unsigned long long own = values.size();
      unsigned long long       end = 0;
      MPI_Scan(&own, &end, 1, MPI_UNSIGNED_LONG_LONG, MPI_SUM, d.communicator);
      MPI_File handle;
      throw_unless(MPI_File_open(d.communicator, file.c_str(), MPI_MODE_CREATE | MPI_MODE_WRONLY, MPI_INFO_NULL, &handle), file);
      throw_unless(MPI_File_set_size(handle, 0), file);
      const int written =
          MPI_File_write_at_all(handle, (end - own) * sizeof(float), values.data(), static_cast<int>(own), MPI_FLOAT, MPI_STATUS_IGNORE);
      throw_unless(MPI_File_close(&handle), file);
      throw_unless(written, file);
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
