#pragma once

#include <myolines/fem/cell_batches.h>
#include <myolines/fem/element.h>
#include <myolines/fem/node_space.h>
#include <myolines/muscle3d/kernels.h>
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
    Constraints                  constraints;
    std::unique_ptr<Vector>      potential; ///< of fibres between faces
    InstructionSet               instruction_set;
    const Kernels               &kernels;
    KernelTables                 tables;

    /// Fills space, batches and constraints from the mesh as it stands; call again after moving mesh vertices.
    void set_up(const Muscle3dParameters &parameters);

    CellSweep sweep(const PointMaterials &materials) const { return {element, *batches, materials}; }

    /// Aligned work storage for the kernels, one caller at a time.
    double *scratch() const { return scratch_.data(); }

  private:
    mutable dealii::AlignedVector<double> scratch_;
  };

  /// The physics of the kernels at an instant with the given activation.
  KernelModel kernel_model(const Muscle3dParameters &parameters, const Activation &activation);
} // namespace myolines
