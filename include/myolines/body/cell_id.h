// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace myolines
{
  /// What the material id of a cell stands for, kept by refinement and partition: its tissue (1 to 15) and the number of its group
  /// in a mesh file; 0 in bodies without such groups, where the id is that of the tissue.
  struct CellId
  {
    unsigned int tissue; ///< material id of the tissue, 1 to 15
    unsigned int volume; ///< number of the group, 0: none

    static constexpr unsigned int n_tissues   = 16;       ///< tissues are 1 to 15
    static constexpr unsigned int max_volumes = 1u << 27; ///< as the material id has 32 bits

    unsigned int  material_id() const { return tissue + n_tissues * volume; } ///< of the cell in the mesh
    static CellId of(const unsigned int material_id) { return {material_id % n_tissues, material_id / n_tissues}; } ///< back from that
  };
} // namespace myolines
