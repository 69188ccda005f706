// SPDX-License-Identifier: LGPL-2.1-or-later
#include "hdf5_tables.h"
#include "point_states.h"

#include <myolines/muscle3d/field_units.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_tools.h>
#include <deal.II/numerics/data_out.h>

#include <numeric>

namespace myolines
{
  namespace
  {
    /// A field that lives at quadrature points: its name and unit, and which number.
    struct PointField
    {
      std::string                                                                               name, unit;
      std::function<double(const Muscle3dParameters &, const Activation &, const PointState &)> value;
    };

    Matrix3 cauchy(const Matrix3 &P, const PointState &p) { return P * transpose(p.F) / p.J; }

    double size_of(const std::optional<StressPart> part, const Parts<Matrix3> &P, const PointState &p)
    {
      return part ? cauchy(P[*part], p).norm() : 0.;
    }

    double size_of_laws(const Parts<Matrix3> &P, const PointState &p)
    {
      return cauchy(std::accumulate(P.laws.begin(), P.laws.end(), Matrix3()), p).norm();
    }

    double shear_modulus(const Muscle3dParameters &m, const PointState &p)
    {
      return 2 * p.material[material_yeoh] + (1 - p.material[material_fat]) * m.tissue(p.material_id).shear_modulus_of_laws();
    }

    /// Cauchy stress of all parts together [Pa].
    Matrix3 whole_stress(const Muscle3dParameters &m, const Activation &a, const PointState &p)
    {
      return cauchy(stress_parts(m, a, p).total(), p);
    }

    /// sqrt(3/2 s : s) of the deviator s.
    double von_mises(const Matrix3 &stress)
    {
      const double mean = (stress[0][0] + stress[1][1] + stress[2][2]) / 3;
      double       sum  = 0;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          sum += (stress[i][j] - (i == j ? mean : 0)) * (stress[i][j] - (i == j ? mean : 0));
      return std::sqrt(1.5 * sum);
    }

    /// Green's strain (F^T F - 1) / 2.
    Matrix3 green_strain(const PointState &p)
    {
      Matrix3 strain = transpose(p.F) * p.F;
      for (unsigned int i = 0; i < 3; ++i)
        strain[i][i] -= 1;
      return strain / 2;
    }

    /// Of a symmetric matrix, the largest first.
    double principal_value(const Matrix3 &matrix, const unsigned int which)
    {
      dealii::SymmetricTensor<2, 3> symmetric;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = i; j < 3; ++j)
          symmetric[i][j] = (matrix[i][j] + matrix[j][i]) / 2;
      return dealii::eigenvalues(symmetric)[which];
    }

    /// Components and principal values of Cauchy's stress and Green's strain, and what follows from them.
    void add_tensor_fields(std::vector<PointField> &fields)
    {
      using Parameters = Muscle3dParameters;
      for (const auto &[name, i, j] :
           {std::tuple<const char *, int, int>{"xx", 0, 0}, {"yy", 1, 1}, {"zz", 2, 2}, {"xy", 0, 1}, {"yz", 1, 2}, {"zx", 2, 0}})
        {
          const int row = i, column = j;
          fields.push_back(
              {std::string("stress ") + name, "Pa", [row, column](const Parameters &m, const Activation &a, const PointState &p) {
                 return whole_stress(m, a, p)[row][column];
               }});
          fields.push_back(
              {std::string("green strain ") + name, "",
               [row, column](const Parameters &, const Activation &, const PointState &p) { return green_strain(p)[row][column]; }});
        }
      for (const unsigned int which : {0u, 1u, 2u})
        {
          const std::string number = std::to_string(which + 1);
          fields.push_back({"principal stress " + number, "Pa", [which](const Parameters &m, const Activation &a, const PointState &p) {
                              return principal_value(whole_stress(m, a, p), which);
                            }});
          fields.push_back({"principal green strain " + number, "", [which](const Parameters &, const Activation &, const PointState &p) {
                              return principal_value(green_strain(p), which);
                            }});
        }
      fields.push_back({"von mises stress", "Pa",
                        [](const Parameters &m, const Activation &a, const PointState &p) { return von_mises(whole_stress(m, a, p)); }});
    }

    std::vector<PointField> all_point_fields()
    {
      using Parameters = Muscle3dParameters;
      std::vector<PointField> fields{
          {"pressure", "Pa", [](const Parameters &, const Activation &, const PointState &p) { return p.pressure; }},
          {"dilatation", "", [](const Parameters &, const Activation &, const PointState &p) { return p.dilatation; }},
          {"jacobian", "", [](const Parameters &, const Activation &, const PointState &p) { return p.J; }},
          {"stretch", "", [](const Parameters &, const Activation &, const PointState &p) { return p.stretch; }},
          {"strain rate", "", [](const Parameters &, const Activation &, const PointState &p) { return p.strain_rate; }},
          {"pennation", "degree", [](const Parameters &, const Activation &, const PointState &p) { return p.pennation; }},
          {"fibre direction x", "", [](const Parameters &, const Activation &, const PointState &p) { return p.fibre[0] / p.stretch; }},
          {"fibre direction y", "", [](const Parameters &, const Activation &, const PointState &p) { return p.fibre[1] / p.stretch; }},
          {"fibre direction z", "", [](const Parameters &, const Activation &, const PointState &p) { return p.fibre[2] / p.stretch; }},
          {"active stress", "Pa",
           [](const Parameters &m, const Activation &a, const PointState &p) {
             return cauchy(stress_parts(m, a, p)[muscle_active], p).norm();
           }},
          {"passive stress", "Pa",
           [](const Parameters &m, const Activation &a, const PointState &p) {
             return size_of(passive_fibre_part(p.material_id), stress_parts(m, a, p), p);
           }},
          {"base stress", "Pa",
           [](const Parameters &m, const Activation &a, const PointState &p) {
             return size_of(base_part(p.material_id), stress_parts(m, a, p), p);
           }},
          {"law stress", "Pa",
           [](const Parameters &m, const Activation &a, const PointState &p) { return size_of_laws(stress_parts(m, a, p), p); }},
          {"tissue", "", [](const Parameters &, const Activation &, const PointState &p) { return p.material[material_tissue]; }},
          {"maximum isometric stress", "Pa",
           [](const Parameters &, const Activation &, const PointState &p) { return p.material[material_passive]; }},
          {"shear modulus", "Pa", [](const Parameters &m, const Activation &, const PointState &p) { return shear_modulus(m, p); }},
          {"bulk modulus", "Pa", [](const Parameters &, const Activation &, const PointState &p) { return p.material[material_bulk]; }},
          {"density", "kg/m^3", [](const Parameters &, const Activation &, const PointState &p) { return p.material[material_density]; }},
          {"fat fraction", "", [](const Parameters &, const Activation &, const PointState &p) { return p.material[material_fat]; }},
          {"activation", "",
           [](const Parameters &, const Activation &a, const PointState &p) {
             return p.material[material_active] == 0 ? 0. : a.at(p.material[material_region]);
           }},
          {"acoustic eigenvalue", "Pa",
           [](const Parameters &m, const Activation &a, const PointState &p) { return smallest_acoustic_eigenvalue(m, a, p); }}};
      add_tensor_fields(fields);
      return fields;
    }

    const std::vector<PointField> &point_fields()
    {
      static const std::vector<PointField> fields = all_point_fields();
      return fields;
    }

    /// Cell-wise L2 projection of a point field onto discontinuous polynomials of the degree of the pressure, at least one.
    Vector project(const Muscle3dSystem &system, const State &state, const PointField &field, const dealii::DoFHandler<3> &target)
    {
      const dealii::FiniteElement<3> &fe = target.get_fe();
      const dealii::QGauss<3>         rule(system.discretisation().element.n_points_1d);
      dealii::FullMatrix<double>      projection(fe.n_dofs_per_cell(), rule.size());
      dealii::FETools::compute_projection_from_quadrature_points_matrix(fe, rule, rule, projection);

      Vector values(target.locally_owned_dofs(), target.locally_owned_dofs(), target.get_communicator());
      std::vector<dealii::types::global_dof_index> numbers(fe.n_dofs_per_cell());
      const Activation                             activation = system.activation(state.t);
      PointStates(system, state).for_each([&](const NodeSpace::Cell &cell, const int q, const PointState &p) {
        const typename dealii::DoFHandler<3>::active_cell_iterator there(&target.get_triangulation(), cell->level(), cell->index(),
                                                                         &target);
        there->get_dof_indices(numbers);
        const double x = field.value(system.parameters(), activation, p);
        for (unsigned int i = 0; i < numbers.size(); ++i)
          values(numbers[i]) += projection(i, q) * x;
      });
      values.compress(dealii::VectorOperation::add);
      return values;
    }

    /// Copies a nodal vector to the numbering of a vector-valued element for output.
    Vector to_vector_element(const NodeSpace &space, const Vector &x, const dealii::DoFHandler<3> &target)
    {
      const dealii::FiniteElement<3> &fe = target.get_fe();
      dealii::IndexSet                relevant;
      dealii::DoFTools::extract_locally_relevant_dofs(target, relevant);
      Vector y(target.locally_owned_dofs(), relevant, target.get_communicator()), ghosted(x);
      ghosted.update_ghost_values();
      std::vector<dealii::types::global_dof_index> from(space.nodes().get_fe().n_dofs_per_cell()), to(fe.n_dofs_per_cell());
      for (const auto &cell : space.nodes().active_cell_iterators())
        if (cell->is_locally_owned())
          {
            cell->get_dof_indices(from);
            const typename dealii::DoFHandler<3>::active_cell_iterator there(&target.get_triangulation(), cell->level(), cell->index(),
                                                                             &target);
            there->get_dof_indices(to);
            for (unsigned int i = 0; i < to.size(); ++i)
              if (target.locally_owned_dofs().is_element(to[i]))
                {
                  const auto [component, node] = fe.system_to_component_index(i);
                  y(to[i])                     = ghosted(3 * from[node] + component);
                }
          }
      y.update_ghost_values();
      return y;
    }

    /// The patches of some fields at an instant, and what they borrow.
    class FieldPatches
    {
    public:
      FieldPatches(const Muscle3dSystem &system, const State &state, const std::vector<std::string> &fields)
        : space_(*system.discretisation().space)
        , vectors_(space_.nodes().get_triangulation())
        , scalars_(space_.nodes().get_triangulation())
      {
        vectors_.distribute_dofs(dealii::FESystem<3>(dealii::FE_Q<3>(space_.degree()), 3));
        scalars_.distribute_dofs(dealii::FE_DGQ<3>(std::max(1u, space_.degree() - 1)));
        for (const std::string &name : fields)
          if (is_vector_field(name))
            add_vector(name, name == "displacement" ? state.u : state.v);
          else
            for (const PointField &field : point_fields())
              if (field.name == name)
                add_scalar(name, project(system, state, field, scalars_));
      }

      dealii::DataOut<3> out;

    private:
      void add_vector(const std::string &name, const Vector &x)
      {
        data_.push_back(std::make_unique<Vector>(to_vector_element(space_, x, vectors_)));
        out.add_data_vector(vectors_, *data_.back(), std::vector<std::string>(3, name),
                            std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation>(
                                3, dealii::DataComponentInterpretation::component_is_part_of_vector));
      }

      void add_scalar(const std::string &name, Vector x)
      {
        data_.push_back(std::make_unique<Vector>(std::move(x)));
        data_.back()->update_ghost_values();
        out.add_data_vector(scalars_, *data_.back(), field_label(name));
      }

      const NodeSpace                     &space_;
      dealii::DoFHandler<3>                vectors_, scalars_;
      std::vector<std::unique_ptr<Vector>> data_;
    };

    std::string number_of_file(const std::string &before, const unsigned int number, const std::string &after)
    {
      std::ostringstream name;
      name << before << std::setw(4) << std::setfill('0') << number << after;
      return name.str();
    }

    using Filter = dealii::DataOutBase::DataOutFilter;

    void write_mesh(const Filter &filter, const std::filesystem::path &file, const MPI_Comm communicator)
    {
      const RowShare            points(filter.n_nodes(), communicator), cells(filter.n_cells(), communicator);
      std::vector<double>       positions;
      std::vector<unsigned int> vertices;
      if (points.own > 0)
        {
          filter.fill_node_data(positions);
          filter.fill_cell_data(points.before, vertices);
        }
      Hdf5File hdf5(file, communicator, {{"nodes", points.all, 3, false, {}}, {"cells", cells.all, 8, true, {}}});
      hdf5.write(0, positions, points);
      hdf5.write(1, vertices, cells);
      hdf5.close();
    }

    void write_data(const Filter &filter, const std::vector<std::string> &fields, const std::filesystem::path &file,
                    const MPI_Comm communicator)
    {
      const RowShare         points(filter.n_nodes(), communicator);
      std::vector<Hdf5Table> tables;
      for (const std::string &field : fields)
        tables.push_back({field_label(field), points.all, is_vector_field(field) ? 3u : 1u, false, {{"unit", field_unit(field)}}});
      Hdf5File hdf5(file, communicator, tables);
      for (unsigned int i = 0; i < fields.size(); ++i)
        {
          const double *values = points.own > 0 ? filter.get_data_set(i) : nullptr;
          hdf5.write(i, std::vector<double>(values, values + tables[i].width * points.own), points);
        }
      hdf5.close();
    }
  } // namespace

  const std::vector<std::string> &field_names()
  {
    static const std::vector<std::string> names = [] {
      std::vector<std::string> list{"displacement", "velocity"};
      for (const PointField &field : point_fields())
        list.push_back(field.name);
      return list;
    }();
    return names;
  }

  bool is_vector_field(const std::string &field) { return field == "displacement" || field == "velocity"; }

  std::string field_unit(const std::string &field)
  {
    if (is_vector_field(field))
      return field == "velocity" ? "m/s" : "m";
    for (const PointField &each : point_fields())
      if (each.name == field)
        return each.unit;
    return "";
  }

  std::string field_label(const std::string &field)
  {
    std::string label = field;
    std::replace(label.begin(), label.end(), ' ', '_');
    return label;
  }

  std::string write_fields_vtu(const Muscle3dSystem &system, const State &state, const std::vector<std::string> &fields,
                               const std::string &folder, const unsigned int number)
  {
    const MPI_Comm                communicator = system.discretisation().communicator;
    FieldPatches                  patches(system, state, fields);
    dealii::DataOutBase::VtkFlags flags(state.t, number);
    flags.write_higher_order_cells = true;
    patches.out.set_flags(flags);
    patches.out.build_patches(system.parameters().degree);
    const auto text_of = [](const auto &write) {
      std::ostringstream text;
      write(text);
      return text.str();
    };
    const auto piece = [number](const unsigned int rank) { return number_of_file("fields_", number, "." + std::to_string(rank) + ".vtu"); };
    const std::string           whole = number_of_file("fields-", number, ".vtu");
    const unsigned int          ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
    const unsigned int          rank  = dealii::Utilities::MPI::this_mpi_process(communicator);
    const std::filesystem::path place(folder);
    on_all_ranks(communicator, [&] {
      write_file(place / (ranks == 1 ? whole : piece(rank)), text_of([&](std::ostream &out) { patches.out.write_vtu(out); }));
    });
    if (ranks == 1)
      return whole;
    std::vector<std::string> pieces;
    for (unsigned int r = 0; r < ranks; ++r)
      pieces.push_back(piece(r));
    const std::string record = number_of_file("fields_", number, ".pvtu");
    on_all_ranks(communicator, [&] {
      if (rank == 0)
        write_file(place / record, text_of([&](std::ostream &out) { patches.out.write_pvtu_record(out, pieces); }));
    });
    return record;
  }

  FieldSizes field_sizes(const Muscle3dSystem &system)
  {
    const std::uint64_t degree = system.parameters().degree, cells = system.n_cells();
    return {cells * (degree + 1) * (degree + 1) * (degree + 1), cells * degree * degree * degree};
  }

  void write_fields_hdf5(const Muscle3dSystem &system, const State &state, const std::vector<std::string> &fields,
                         const std::string &folder, const std::string &file, const std::optional<std::string> &mesh)
  {
    FieldPatches patches(system, state, fields);
    patches.out.build_patches(system.parameters().degree);
    const MPI_Comm communicator = system.discretisation().communicator;
    // Vertices shared by cells are not merged: discontinuous fields have a value in each cell.
    dealii::DataOutBase::DataOutFilter filter(dealii::DataOutBase::DataOutFilterFlags(/*merge*/ false, /*xdmf*/ true));
    if (system.discretisation().batches->n_owned_batches() > 0)
      patches.out.write_filtered_data(filter);
    const std::filesystem::path place(folder);
    if (mesh)
      write_mesh(filter, place / *mesh, communicator);
    write_data(filter, fields, place / file, communicator);
  }
} // namespace myolines
