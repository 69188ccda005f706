// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace myolines
{
  /// Memory that this program may take on this node.
  struct MemoryLimit
  {
    double      bytes;  ///< on this node
    std::string origin; ///< "physical memory of the node", "limit of its control group", "of the batch job (SLURM_MEM_PER_NODE)"
  };

  /// The least of physical memory, the limits of the control groups that this process is in (versions 1 and 2 of the kernel's), and what a
  /// batch system of the kind Slurm has granted on the node.
  MemoryLimit memory_limit();

  /// What a single process may take [bytes]: its resource limits (ulimit -v, -d); infinity if there are none.
  double memory_limit_of_a_process();
} // namespace myolines
