// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/fem/potential.h>
#include <myolines/muscle3d/discretisation.h>

namespace myolines
{
  namespace
  {
    std::vector<dealii::types::boundary_id> faces_that_move_as_one(const Muscle3dParameters &parameters)
    {
      std::vector<dealii::types::boundary_id> faces;
      for (const auto &condition : parameters.boundary)
        if (condition->facts().moves_as_one)
          faces.push_back(condition->facts().face);
      return faces;
    }

    KernelTables kernel_tables(const Element &e)
    {
      return {e.n_points_1d, e.n_modes, e.value.data(), e.derivative.data(), e.weights_3d.data(), e.modes.data()};
    }
  } // namespace

  Muscle3dDiscretisation::Muscle3dDiscretisation(const Muscle3dParameters &parameters, const MPI_Comm comm, const InstructionSet set)
    : communicator(comm)
    , mesh(comm)
    , element(parameters.degree, parameters.n_points)
    , instruction_set(set)
    , kernels(myolines::kernels(set, parameters.degree))
    , tables(kernel_tables(element))
    , scratch_(kernels.scratch_size(element.n_points_1d, element.n_modes))
  {
    make_mesh(parameters.geometry, mesh);
    set_up(parameters);
  }

  void Muscle3dDiscretisation::set_up(const Muscle3dParameters &parameters)
  {
    modes.reset();
    batches.reset();
    space       = std::make_unique<NodeSpace>(mesh, parameters.degree, faces_that_move_as_one(parameters));
    batches     = std::make_unique<CellBatches>(*space, element);
    modes       = std::make_unique<CellModes>(*space, *batches, element.n_modes);
    constraints = BoundaryConstraints(parameters.boundary, *space);
    if (const auto &between = parameters.fields.laplace)
      potential = std::make_unique<Vector>(laplace_potential(*space, between->from, between->to));
  }

  void Muscle3dDiscretisation::apply_relations(Vector &x) const
  {
    x.update_ghost_values();
    for (const Relation &relation : constraints.relations)
      {
        double value = 0;
        for (const auto &[index, weight] : relation.others)
          value += weight * x(index);
        x.local_element(x.get_partitioner()->global_to_local(relation.unknown)) = value;
      }
    x.update_ghost_values();
  }

  CellSweep::CellSweep(const Element &element, const CellBatches &batches, const PointMaterials &materials)
    : element(element)
    , batches(batches)
    , materials(materials)
    , tables(kernel_tables(element))
  {}

  KernelCells CellSweep::cells(const unsigned int b) const
  {
    const PointMaterials::Laws laws = materials.laws(b);
    return {batches.nodes(b),
            batches.geometry(b),
            batches.geometry_stride(b),
            batches.inverse_mode_mass(b),
            materials.values(b),
            materials.stride(b),
            materials.muscle(b),
            materials.tendon(b),
            static_cast<int>(batches.n_filled(b)),
            laws.terms,
            laws.n,
            laws.shear};
  }

  KernelModel kernel_model(const Muscle3dParameters &parameters, const Activation &activation)
  {
    KernelModel model;
    model.activation    = activation;
    model.active        = parameters.active() && !activation.zero();
    model.rate          = model.active && parameters.force_velocity();
    model.inertia       = parameters.dynamic;
    model.exact_tangent = parameters.exact_tangent;
    model.rate_tangent  = parameters.rate_tangent;
    model.viscous       = parameters.viscous();
    model.softened      = false;
    model.keep_gradient = false;
    model.volume_limit  = 100; // measured, see doc/decisions/kept-pressures.md
    model.volume_form   = parameters.volume_form;
    model.curves        = parameters.fibre_curves();
    model.before        = nullptr;
    model.dissipation   = 0;
    return model;
  }
} // namespace myolines
