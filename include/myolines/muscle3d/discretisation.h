// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/fem/cell_batches.h>
#include <myolines/fem/cell_modes.h>
#include <myolines/fem/element.h>
#include <myolines/fem/node_space.h>
#include <myolines/kernels/kernels.h>
#include <myolines/muscle3d/parameters.h>
#include <myolines/muscle3d/point_materials.h>

#include <deal.II/base/aligned_vector.h>

namespace myolines
{
  /// What a sweep of kernels over the cells needs; borrowed.
  struct CellSweep
  {
    CellSweep(const Element &element, const CellBatches &batches, const PointMaterials &materials);

    KernelCells cells(unsigned int batch) const;

    const Element        &element;
    const CellBatches    &batches;
    const PointMaterials &materials;
    KernelTables          tables;
  };

  /// A constrained unknown that depends on others: x = sum of weight * other, constrained ones among them.
  struct Relation
  {
    dealii::types::global_dof_index                                 unknown;
    std::vector<std::pair<dealii::types::global_dof_index, double>> others;
  };

  /// What boundary conditions do to the unknowns of a space: lines of the prescribed ones, and relations, each after those that it
  /// needs. A tie that moves the face along n gives u.n = q, where q = u.n at the node of the face that all ranks know, which is free of
  /// it.
  /// @throws InputError, on all ranks, where conditions that meet on an edge contradict each other, and for faces that have not the shape
  /// of their condition.
  struct BoundaryConstraints
  {
    BoundaryConstraints() = default;
    BoundaryConstraints(const BoundaryConditions &conditions, const NodeSpace &space);

    Constraints           lines; ///< closed
    std::vector<Relation> relations;

    /// By name of a condition that ties a face: the components along which it holds.
    std::map<std::string, std::array<bool, 3>> held;
  };

  /// Mesh, nodes, batches and kernels of a muscle: everything that does not change in time.
  struct Muscle3dDiscretisation
  {
    Muscle3dDiscretisation(const Muscle3dParameters &parameters, MPI_Comm communicator,
                           InstructionSet instruction_set = widest_instruction_set());

    MPI_Comm                     communicator;
    NodeSpace::Mesh              mesh;
    std::unique_ptr<NodeSpace>   space;
    Element                      element;
    std::unique_ptr<CellBatches> batches;
    std::unique_ptr<CellModes>   modes; ///< vectors of local unknowns
    BoundaryConstraints          constraints;
    std::unique_ptr<Vector>      potential; ///< of fibres between faces
    InstructionSet               instruction_set;
    const Kernels               &kernels;
    KernelTables                 tables;

    /// Fills space, batches and constraints from the mesh as it stands; call again after moving mesh vertices.
    void set_up(const Muscle3dParameters &parameters);

    /// Sets the unknowns of the relations to what the others of @p x ask for; ghosts are current on return.
    void apply_relations(Vector &x) const;

    CellSweep sweep(const PointMaterials &materials) const { return {element, *batches, materials}; }

    /// Aligned work storage for the kernels, one caller at a time.
    double *scratch() const { return scratch_.data(); }

  private:
    mutable dealii::AlignedVector<double> scratch_;
  };

  /// The physics of the kernels at an instant with the given activation.
  KernelModel kernel_model(const Muscle3dParameters &parameters, const Activation &activation);
} // namespace myolines
