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
    CellSweep(const Element &element, const CellBatches &batches, const PointMaterials &materials); ///< Borrows all three.

    KernelCells cells(unsigned int batch) const; ///< one batch as kernels take it

    const Element        &element;   ///< of the displacement
    const CellBatches    &batches;   ///< the cells
    const PointMaterials &materials; ///< at their points
    KernelTables          tables;    ///< of the element
  };

  /// A constrained unknown that depends on others: x = sum of weight * other, constrained ones among them.
  struct Relation
  {
    dealii::types::global_dof_index                                 unknown; ///< x, a global number
    std::vector<std::pair<dealii::types::global_dof_index, double>> others;  ///< each with its weight
  };

  /// What boundary conditions do to the unknowns of a space: lines of the prescribed ones, and relations, each after those that it
  /// needs. A tie that moves the face along n gives u.n = q, where q = u.n at the node of the face that all ranks know, which is free of
  /// it.
  /// @throws InputError, on all ranks, where conditions that meet on an edge contradict each other, and for faces that have not the shape
  /// of their condition.
  struct BoundaryConstraints
  {
    BoundaryConstraints() = default;                                                   ///< nothing is constrained
    BoundaryConstraints(const BoundaryConditions &conditions, const NodeSpace &space); ///< Of @p conditions on @p space. Collective.

    Constraints           lines;     ///< closed
    std::vector<Relation> relations; ///< in an order in which they can be applied one after the other

    /// By name of a condition that ties a face: the components along which it holds.
    std::map<std::string, std::array<bool, 3>> held;
  };

  /// Mesh, nodes, batches and kernels of a muscle: everything that does not change in time.
  struct Muscle3dDiscretisation
  {
    /// Makes the mesh and calls set_up(). Collective. @throws InputError for what the mesh or the conditions do not allow.
    Muscle3dDiscretisation(const Muscle3dParameters &parameters, MPI_Comm communicator,
                           InstructionSet instruction_set = widest_instruction_set());

    MPI_Comm                     communicator;    ///< the ranks that share the mesh
    NodeSpace::Mesh              mesh;            ///< of the reference body
    std::unique_ptr<NodeSpace>   space;           ///< of the displacement
    Element                      element;         ///< shape functions, Gauss points and pressure modes
    std::unique_ptr<CellBatches> batches;         ///< the cells, as kernels take them
    std::unique_ptr<CellModes>   modes;           ///< vectors of local unknowns
    BoundaryConstraints          constraints;     ///< of the unknowns
    std::unique_ptr<Vector>      potential;       ///< of fibres between faces
    InstructionSet               instruction_set; ///< that the kernels are compiled for
    const Kernels               &kernels;         ///< of that set and the degree
    KernelTables                 tables;          ///< of the element

    /// Fills space, batches and constraints from the mesh as it stands; call again after moving mesh vertices.
    void set_up(const Muscle3dParameters &parameters);

    /// Sets the unknowns of the relations to what the others of @p x ask for; ghosts are current on return.
    void apply_relations(Vector &x) const;

    /// the cells with their @p materials, for kernels
    CellSweep sweep(const PointMaterials &materials) const { return {element, *batches, materials}; }

    /// Aligned work storage for the kernels, one caller at a time.
    double *scratch() const { return scratch_.data(); }

  private:
    mutable dealii::AlignedVector<double> scratch_;
  };

  /// The physics of the kernels at an instant with the given activation.
  KernelModel kernel_model(const Muscle3dParameters &parameters, const Activation &activation);
} // namespace myolines
