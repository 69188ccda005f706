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
#include <deal.II/numerics/data_out_faces.h>
#include <deal.II/numerics/data_postprocessor.h>

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

    /// A patch of each face that one cell alone has, counter-clockwise seen from outside.
    class SurfaceOut : public dealii::DataOutFaces<3>
    {
    public:
      using dealii::DataOutFaces<3>::build_patches;

      void build_patches(const unsigned int degree) override
      {
        dealii::DataOutFaces<3>::build_patches(degree);
        FaceDescriptor face = first_face(); // in the order of the patches
        for (auto &patch : patches)
          {
            const auto            &corner = patch.vertices;
            const dealii::Point<3> middle((corner[0] + corner[1] + corner[2] + corner[3]) / 4);
            if (cross_product_3d(corner[1] - corner[0], corner[2] - corner[0]) * (middle - face.first->center()) < 0)
              turn_over(patch, degree + 1);
            face = next_face(face);
          }
      }

    private:
      /// Swaps the two directions of the face, along each of which there are @p n points.
      static void turn_over(dealii::DataOutBase::Patch<2, 3> &patch, const unsigned int n)
      {
        std::swap(patch.vertices[1], patch.vertices[2]);
        const auto before = patch.data;
        for (unsigned int row = 0; row < before.n_rows(); ++row)
          for (unsigned int j = 0; j < n; ++j)
            for (unsigned int i = 0; i < n; ++i)
              patch.data(row, i + n * j) = before(row, j + n * i);
      }
    };

    /// Cells of this rank, or faces of its cells that no other cell has.
    std::uint64_t own_patches(const Muscle3dSystem &system, const FieldPart part)
    {
      std::uint64_t n = 0;
      for (const auto &cell : system.discretisation().mesh.active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int face : cell->face_indices())
            n += part == FieldPart::surface ? cell->face(face)->at_boundary() : face == 0;
      return n;
    }

    using Tensor                         = dealii::SymmetricTensor<2, 3>;
    constexpr unsigned int n_of_a_tensor = Tensor::n_independent_components;

    /// Principal directions of a tensor field at the points that are written: those of nodes have no sense, and what lies between two
    /// nodes would be the mean of opposite ones.
    class Directions : public dealii::DataPostprocessorVector<3>
    {
    public:
      Directions(const std::string &name, const unsigned int which)
        : dealii::DataPostprocessorVector<3>(name, dealii::update_values)
        , which_(which)
      {}

      void evaluate_vector_field(const dealii::DataPostprocessorInputs::Vector<3> &inputs,
                                 std::vector<dealii::Vector<double>>              &directions) const override
      {
        for (unsigned int q = 0; q < directions.size(); ++q)
          {
            Tensor tensor;
            for (unsigned int i = 0; i < n_of_a_tensor; ++i)
              tensor.access_raw_entry(i) = inputs.solution_values[q](i);
            const Vector3 direction = principal_direction(tensor, which_);
            for (unsigned int c = 0; c < 3; ++c)
              directions[q](c) = direction[c];
          }
      }

    private:
      const unsigned int which_; ///< 0: of the largest value
    };

    /// The patches of some fields at an instant, and what they borrow. @p Out: DataOut<3> or SurfaceOut.
    template <typename Out>
    class FieldPatches
    {
    public:
      FieldPatches(const Muscle3dSystem &system, const State &state, const std::vector<std::string> &fields)
        : space_(*system.discretisation().space)
        , vectors_(space_.nodes().get_triangulation())
        , point_scalars_(space_.nodes().get_triangulation())
        , point_vectors_(space_.nodes().get_triangulation())
        , point_tensors_(space_.nodes().get_triangulation())
      {
        vectors_.distribute_dofs(dealii::FESystem<3>(dealii::FE_Q<3>(space_.degree()), 3));
        const dealii::FE_DGQ<3> at_points(std::max(1u, space_.degree() - 1));
        point_scalars_.distribute_dofs(dealii::FESystem<3>(at_points, 1));
        point_vectors_.distribute_dofs(dealii::FESystem<3>(at_points, 3));
        if (std::any_of(fields.begin(), fields.end(), [](const std::string &name) { return find_principal_field(name) != nullptr; }))
          point_tensors_.distribute_dofs(dealii::FESystem<3>(at_points, n_of_a_tensor));
        const std::vector<PointField> of_laws = law_fields(system.parameters());
        for (const std::string &name : fields)
          if (const PointField *field = find_point_field(name, of_laws))
            {
              const dealii::DoFHandler<3> &target = field->n_components == 3 ? point_vectors_ : point_scalars_;
              add(name, field->n_components, target, project(system, state, field->value, target));
            }
          else if (const PrincipalField *principal = find_principal_field(name))
            add_directions(name, system, state, *principal);
          else
            add(name, 3, vectors_, to_vector_element(space_, name == "displacement" ? state.u : state.v, vectors_));
      }

      Out out;

    private:
      void add_directions(const std::string &name, const Muscle3dSystem &system, const State &state, const PrincipalField &field)
      {
        const auto components = [&field](const Muscle3dParameters &parameters, const Activation &activation, const PointState &p) {
          const Matrix3                     tensor = field.tensor(parameters, activation, p);
          std::array<double, n_of_a_tensor> values;
          for (unsigned int i = 0; i < n_of_a_tensor; ++i)
            values[i] = tensor[Tensor::unrolled_to_component_indices(i)];
          return values;
        };
        data_.push_back(std::make_unique<Vector>(project(system, state, components, point_tensors_)));
        data_.back()->update_ghost_values();
        directions_.push_back(std::make_unique<Directions>(field_label(name), field.which));
        out.add_data_vector(point_tensors_, *data_.back(), *directions_.back());
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

      const NodeSpace                         &space_;
      dealii::DoFHandler<3>                    vectors_, point_scalars_, point_vectors_, point_tensors_;
      std::vector<std::unique_ptr<Vector>>     data_;
      std::vector<std::unique_ptr<Directions>> directions_;
    };

    std::string number_of_file(const std::string &before, const unsigned int number, const std::string &after)
    {
      std::ostringstream name;
      name << before << std::setw(4) << std::setfill('0') << number << after;
      return name.str();
    }

    using Filter = dealii::DataOutBase::DataOutFilter;

    void write_mesh(const Filter &filter, const unsigned int corners, const std::filesystem::path &file, const MPI_Comm communicator)
    {
      const bool                any = filter.n_nodes() > 0; // a filter without points does not know how many cells it has
      const RowShare            points(filter.n_nodes(), communicator), cells(any ? filter.n_cells() : 0, communicator);
      std::vector<double>       positions;
      std::vector<unsigned int> vertices;
      if (points.own > 0)
        {
          filter.fill_node_data(positions);
          filter.fill_cell_data(points.before, vertices);
        }
      Hdf5File hdf5(file, communicator, {{"nodes", points.all, 3, false, {}}, {"cells", cells.all, corners, true, {}}});
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

    /// What write_fields_vtu() does, see there.
    template <typename Out>
    std::string write_vtu(const Muscle3dSystem &system, const State &state, const FieldChoice &choice, const std::filesystem::path &folder,
                          const unsigned int number)
    {
      const MPI_Comm                communicator = system.discretisation().communicator;
      FieldPatches<Out>             patches(system, state, choice.names);
      dealii::DataOutBase::VtkFlags flags(state.t, number);
      flags.write_higher_order_cells = true;
      for (const std::string &field : choice.names)
        if (const std::string unit = field_unit(field); !unit.empty())
          flags.physical_units[field_label(field)] = unit;
      patches.out.set_flags(flags);
      patches.out.build_patches(system.parameters().degree);
      const auto text_of = [](const auto &write) {
        std::ostringstream text;
        write(text);
        return text.str();
      };
      const auto piece = [number](const unsigned int rank) {
        return number_of_file("fields_", number, "." + std::to_string(rank) + ".vtu");
      };
      const std::string  whole = number_of_file("fields-", number, ".vtu");
      const unsigned int ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
      const unsigned int rank  = dealii::Utilities::MPI::this_mpi_process(communicator);
      const bool         any   = own_patches(system, choice.part) > 0; // a piece without points is none to other readers
      on_all_ranks(communicator, [&] {
        if (any)
          write_file(folder / (ranks == 1 ? whole : piece(rank)), text_of([&](std::ostream &out) { patches.out.write_vtu(out); }));
      });
      if (ranks == 1)
        return whole;
      std::vector<std::string>        pieces;
      const std::vector<unsigned int> have = dealii::Utilities::MPI::all_gather(communicator, any ? 1u : 0u);
      for (unsigned int r = 0; r < ranks; ++r)
        if (have[r] > 0)
          pieces.push_back(piece(r));
      const std::string record = number_of_file("fields_", number, ".pvtu");
      on_all_ranks(communicator, [&] {
        if (rank == 0)
          write_file(folder / record, text_of([&](std::ostream &out) { patches.out.write_pvtu_record(out, pieces); }));
      });
      return record;
    }

    /// What write_fields_hdf5() does, see there.
    template <typename Out>
    void write_hdf5(const Muscle3dSystem &system, const State &state, const FieldChoice &choice, const std::filesystem::path &folder,
                    const std::string &file, const std::optional<std::string> &mesh)
    {
      FieldPatches<Out> patches(system, state, choice.names);
      patches.out.build_patches(system.parameters().degree);
      const MPI_Comm communicator = system.discretisation().communicator;
      // Vertices shared by cells are not merged: discontinuous fields have a value in each cell.
      Filter filter(dealii::DataOutBase::DataOutFilterFlags(/*merge*/ false, /*xdmf*/ true));
      if (own_patches(system, choice.part) > 0)
        patches.out.write_filtered_data(filter);
      if (mesh)
        write_mesh(filter, choice.part == FieldPart::surface ? 4 : 8, folder / *mesh, communicator);
      write_data(filter, choice.names, folder / file, communicator);
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

  std::string write_fields_vtu(const Muscle3dSystem &system, const State &state, const FieldChoice &choice, const std::string &folder,
                               const unsigned int number)
  {
    return choice.part == FieldPart::surface ? write_vtu<SurfaceOut>(system, state, choice, folder, number)
                                             : write_vtu<dealii::DataOut<3>>(system, state, choice, folder, number);
  }

  FieldSizes field_sizes(const Muscle3dSystem &system, const FieldPart part)
  {
    const std::uint64_t patches = dealii::Utilities::MPI::sum(own_patches(system, part), system.discretisation().communicator);
    const std::uint64_t k = system.parameters().degree, inner = part == FieldPart::surface ? 1 : k,
                        outer = part == FieldPart::surface ? 1 : k + 1;
    return {patches * (k + 1) * (k + 1) * outer, patches * k * k * inner};
  }

  void write_fields_hdf5(const Muscle3dSystem &system, const State &state, const FieldChoice &choice, const std::string &folder,
                         const std::string &file, const std::optional<std::string> &mesh)
  {
    if (choice.part == FieldPart::surface)
      write_hdf5<SurfaceOut>(system, state, choice, folder, file, mesh);
    else
      write_hdf5<dealii::DataOut<3>>(system, state, choice, folder, file, mesh);
  }
} // namespace myolines
