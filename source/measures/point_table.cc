// SPDX-License-Identifier: LGPL-2.1-or-later
#include "hdf5_tables.h"
#include <myolines/measures/point_table.h>
#include <myolines/muscle3d/forest_order.h>
#include <myolines/muscle3d/point_states.h>

#include <map>

namespace myolines
{
  namespace
  {
    using Position = dealii::Point<3>;

    struct Column
    {
      PointColumn                                                 facts;
      std::function<double(const Position &, const PointState &)> value;
    };

    const std::vector<Column> &table()
    {
      using X = const Position &;
      using P = const PointState &;
      static const std::vector<Column> columns{
          {{"qp_x", "m", "reference position"}, [](X x, P) { return x[0]; }},
          {{"qp_y", "m", "reference position"}, [](X x, P) { return x[1]; }},
          {{"qp_z", "m", "reference position"}, [](X x, P) { return x[2]; }},
          {{"JxW", "m^3", "reference volume of the point"}, [](X, P p) { return p.JxW; }},
          {{"det_F", "-", "determinant of the deformation gradient"}, [](X, P p) { return p.J; }},
          {{"u1", "m", "displacement"}, [](X, P p) { return p.displacement[0]; }},
          {{"u2", "m", "displacement"}, [](X, P p) { return p.displacement[1]; }},
          {{"u3", "m", "displacement"}, [](X, P p) { return p.displacement[2]; }},
          {{"v1", "m/s", "velocity"}, [](X, P p) { return p.velocity[0]; }},
          {{"v2", "m/s", "velocity"}, [](X, P p) { return p.velocity[1]; }},
          {{"v3", "m/s", "velocity"}, [](X, P p) { return p.velocity[2]; }},
          {{"p", "Pa", "pressure"}, [](X, P p) { return p.pressure; }},
          {{"D", "-", "dilatation"}, [](X, P p) { return p.dilatation; }},
          {{"stretch", "-", "of the fibre, |F a0|"}, [](X, P p) { return p.stretch; }},
          {{"stretch_bar", "-", "isochoric stretch of the fibre"}, [](X, P p) { return p.isochoric_stretch; }},
          {{"strain_rate", "-", "rate of the stretch over the maximum strain rate"}, [](X, P p) { return p.strain_rate; }},
          {{"strain_rate_bar", "-", "rate of the isochoric stretch over the maximum strain rate"},
           [](X, P p) { return p.isochoric_strain_rate; }},
          {{"orientation_x", "-", "current fibre vector, F a0"}, [](X, P p) { return p.fibre[0]; }},
          {{"orientation_y", "-", "current fibre vector, F a0"}, [](X, P p) { return p.fibre[1]; }},
          {{"orientation_z", "-", "current fibre vector, F a0"}, [](X, P p) { return p.fibre[2]; }}};
      return columns;
    }

    const Column &column(const std::string &name)
    {
      for (const Column &column : table())
        if (column.facts.name == name)
          return column;
      throw std::out_of_range("there is no column " + name);
    }

    /// Values of the owned points, [column][point], in the order of the file.
    std::vector<std::vector<double>> values(const Muscle3dSystem &system, const State &state, const std::vector<const Column *> &columns)
    {
      const Muscle3dDiscretisation       &d     = system.discretisation();
      const std::vector<NodeSpace::Cell>  cells = cells_in_forest_order(d);
      std::map<unsigned int, std::size_t> first_point; // by active cell index
      for (std::size_t i = 0; i < cells.size(); ++i)
        first_point[cells[i]->active_cell_index()] = i * d.element.n_points;

      std::vector<std::vector<double>> all(columns.size(), std::vector<double>(cells.size() * d.element.n_points));
      PointStates(system, state).for_each([&](const NodeSpace::Cell &cell, const int q, const PointState &p) {
        const std::size_t point = first_point.at(cell->active_cell_index()) + q;
        const Position    x     = point_position(d.element, cell, q);
        for (std::size_t c = 0; c < columns.size(); ++c)
          all[c][point] = columns[c]->value(x, p);
      });
      return all;
    }
  } // namespace

  const std::vector<PointColumn> &point_columns()
  {
    static const std::vector<PointColumn> columns = [] {
      std::vector<PointColumn> list;
      for (const Column &column : table())
        list.push_back(column.facts);
      return list;
    }();
    return columns;
  }

  void write_point_table(const Muscle3dSystem &system, const State &state, const std::vector<std::string> &names, const std::string &file)
  {
    const MPI_Comm              communicator = system.discretisation().communicator;
    std::vector<const Column *> columns;
    for (const std::string &name : names)
      columns.push_back(&column(name));
    const std::vector<std::vector<double>> own = values(system, state, columns);
    const RowShare                         rows(own.front().size(), communicator);
    std::vector<Hdf5Table>                 tables;
    for (const Column *column : columns)
      tables.push_back({column->facts.name, rows.all, 0, false, {{"unit", column->facts.unit}, {"meaning", column->facts.meaning}}});
    Hdf5File hdf5(file, communicator, tables, {{"Time [s]", state.t}});
    for (std::size_t c = 0; c < columns.size(); ++c)
      hdf5.write(c, own[c], rows);
    hdf5.close();
  }
} // namespace myolines
