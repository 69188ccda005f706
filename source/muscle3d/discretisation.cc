#include <myolines/fem/potential.h>
#include <myolines/muscle3d/discretisation.h>

namespace myolines
{
  namespace
  {
    /// u = 0 relations for all prescribed components; g(t) is added by Muscle3dSystem::prescribed.
    void constrain(const Muscle3dParameters &parameters, const NodeSpace &space, Constraints &constraints)
    {
      constraints.reinit(space.relevant_unknowns());
      for (const BoundaryCondition &condition : parameters.boundary)
        for (const auto node : space.face_nodes(condition.face))
          for (unsigned int c = 0; c < 3; ++c)
            if (condition.components[c])
              constraints.add_line(3 * node + c);
      constraints.close();
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
    batches.reset();
    space   = std::make_unique<NodeSpace>(mesh, parameters.degree);
    batches = std::make_unique<CellBatches>(*space, element);
    constrain(parameters, *space, constraints);
    if (const auto &between = parameters.fields.laplace)
      potential = std::make_unique<Vector>(laplace_potential(*space, between->from, between->to));
  }

  CellSweep::CellSweep(const Element &element, const CellBatches &batches, const PointMaterials &materials)
    : element(element)
    , batches(batches)
    , materials(materials)
    , tables(kernel_tables(element))
  {}

  KernelCells CellSweep::cells(const unsigned int b) const
  {
    return {batches.nodes(b),    batches.geometry(b), batches.geometry_stride(b), batches.inverse_mode_mass(b),         materials.values(b),
            materials.stride(b), materials.muscle(b), materials.tendon(b),        static_cast<int>(batches.n_filled(b))};
  }

  KernelModel kernel_model(const Muscle3dParameters &parameters, const Activation &activation)
  {
    KernelModel model;
    model.activation    = activation;
    model.active        = parameters.active() && !activation.zero();
    model.rate          = model.active && parameters.dynamic && parameters.muscle().fibre.force_velocity;
    model.inertia       = parameters.dynamic;
    model.exact_tangent = parameters.exact_tangent;
    model.curves        = parameters.fibre_curves();
    return model;
  }
} // namespace myolines
