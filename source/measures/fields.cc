// SPDX-License-Identifier: LGPL-2.1-or-later
#include "hdf5_tables.h"
#include "point_fields.h"

#include <myolines/measures/fields.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_tools.h>
#include <deal.II/numerics/data_out.h>

#include <algorithm>
#include <cctype>
#include <iomanip>
#include <sstream>

namespace myolines
{
  namespace
  {
    /// Cell-wise L2 projection of value(parameters, activation, point), which has the components of @p target, onto its discontinuous
    /// polynomials.
    template <typename Value>
    Vector project(const Muscle3dSystem &system, const State &state, const Value &value, const dealii::DoFHandler<3> &target)
    {
      const dealii::FiniteElement<3> &fe = target.get_fe(), &scalar = fe.base_element(0);
      const dealii::QGauss<3>         rule(system.discretisation().element.n_points_1d);
      dealii::FullMatrix<double>      projection(scalar.n_dofs_per_cell(), rule.size());
      dealii::FETools::compute_projection_from_quadrature_points_matrix(scalar, rule, rule, projection);

      Vector values(target.locally_owned_dofs(), target.locally_owned_dofs(), target.get_communicator());
      std::vector<dealii::types::global_dof_index> numbers(fe.n_dofs_per_cell());
      const Activation                             activation = system.activation(state.t);
      PointStates(system, state).for_each([&](const NodeSpace::Cell &cell, const int q, const PointState &p) {
        const typename dealii::DoFHandler<3>::active_cell_iterator there(&target.get_triangulation(), cell->level(), cell->index(),
                                                                         &target);
        there->get_dof_indices(numbers);
        const auto x = value(system.parameters(), activation, p);
        for (unsigned int i = 0; i < numbers.size(); ++i)
          {
            const auto [component, node] = fe.system_to_component_index(i);
            values(numbers[i]) += projection(node, q) * x[component];
          }
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
        , point_scalars_(space_.nodes().get_triangulation())
        , point_vectors_(space_.nodes().get_triangulation())
      {
        vectors_.distribute_dofs(dealii::FESystem<3>(dealii::FE_Q<3>(space_.degree()), 3));
        const dealii::FE_DGQ<3> at_points(std::max(1u, space_.degree() - 1));
        point_scalars_.distribute_dofs(dealii::FESystem<3>(at_points, 1));
        point_vectors_.distribute_dofs(dealii::FESystem<3>(at_points, 3));
        const std::vector<PointField> of_laws = law_fields(system.parameters());
        for (const std::string &name : fields)
          if (const PointField *field = find_point_field(name, of_laws))
            {
              const dealii::DoFHandler<3> &target = field->n_components == 3 ? point_vectors_ : point_scalars_;
              add(name, field->n_components, target, project(system, state, field->value, target));
            }
          else if (const PrincipalField *principal = find_principal_field(name))
            add(name, 3, point_vectors_, project_direction(system, state, *principal));
          else
            add(name, 3, vectors_, to_vector_element(space_, name == "displacement" ? state.u : state.v, vectors_));
      }

      dealii::DataOut<3> out;

    private:
      Vector project_direction(const Muscle3dSystem &system, const State &state, const PrincipalField &field) const
      {
        using Tensor             = dealii::SymmetricTensor<2, 3>;
        constexpr unsigned int n = Tensor::n_independent_components;
        dealii::DoFHandler<3>  tensors(point_vectors_.get_triangulation());
        tensors.distribute_dofs(dealii::FESystem<3>(point_vectors_.get_fe().base_element(0), n));
        const auto components = [&field](const Muscle3dParameters &parameters, const Activation &activation, const PointState &p) {
          const Matrix3         tensor = field.tensor(parameters, activation, p);
          std::array<double, n> values;
          for (unsigned int i = 0; i < n; ++i)
            values[i] = tensor[Tensor::unrolled_to_component_indices(i)];
          return values;
        };
        const Vector projected = project(system, state, components, tensors);
        Vector       values(point_vectors_.locally_owned_dofs(), point_vectors_.locally_owned_dofs(), point_vectors_.get_communicator());
        const dealii::FiniteElement<3>              &fe = point_vectors_.get_fe();
        std::vector<dealii::types::global_dof_index> from(tensors.get_fe().n_dofs_per_cell()), to(fe.n_dofs_per_cell());
        auto                                         there = tensors.begin_active();
        for (auto cell = point_vectors_.begin_active(); cell != point_vectors_.end(); ++cell, ++there)
          if (cell->is_locally_owned())
            {
              there->get_dof_indices(from);
              cell->get_dof_indices(to);
              for (unsigned int node = 0; node < fe.base_element(0).n_dofs_per_cell(); ++node)
                {
                  Tensor tensor;
                  for (unsigned int i = 0; i < n; ++i)
                    tensor.access_raw_entry(i) = projected(from[tensors.get_fe().component_to_system_index(i, node)]);
                  const Vector3 direction = principal_direction(tensor, field.which);
                  for (unsigned int c = 0; c < 3; ++c)
                    values(to[fe.component_to_system_index(c, node)]) = direction[c];
                }
            }
        return values;
      }

      void add(const std::string &name, const unsigned int n_components, const dealii::DoFHandler<3> &handler, Vector x)
      {
        using Kind = dealii::DataComponentInterpretation::DataComponentInterpretation;
        data_.push_back(std::make_unique<Vector>(std::move(x)));
        data_.back()->update_ghost_values();
        const Kind kind = n_components == 3 ? Kind::component_is_part_of_vector : Kind::component_is_scalar;
        out.add_data_vector(handler, *data_.back(), std::vector<std::string>(n_components, field_label(name)),
                            std::vector<Kind>(n_components, kind));
      }

      const NodeSpace                     &space_;
      dealii::DoFHandler<3>                vectors_, point_scalars_, point_vectors_;
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
      for (const PrincipalField &field : principal_fields())
        list.push_back(field.name);
      return list;
    }();
    return names;
  }

  std::vector<std::string> field_names(const Muscle3dParameters &parameters)
  {
    std::vector<std::string> names = field_names();
    for (const PointField &field : law_fields(parameters))
      names.push_back(field.name);
    return names;
  }

  bool is_vector_field(const std::string &field)
  {
    const PointField *point_field = find_point_field(field);
    return point_field != nullptr ? point_field->n_components == 3
                                  : field == "displacement" || field == "velocity" || find_principal_field(field) != nullptr;
  }

  std::string field_unit(const std::string &field)
  {
    if (const PointField *point_field = find_point_field(field))
      return point_field->unit;
    if (field.rfind(stress_of_law, 0) == 0)
      return "Pa";
    return field == "displacement" ? "m" : field == "velocity" ? "m/s" : "";
  }

  std::string field_label(const std::string &field)
  {
    std::string label = field;
    for (char &c : label)
      if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '.')
        c = '_';
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
