// SPDX-License-Identifier: LGPL-2.1-or-later
#include "patch_kernels.h"

namespace myolines
{
  extern const PatchKernels patch_kernels_baseline;
  const PatchKernels        patch_kernels_baseline = make_patch_kernels<InstructionSet::baseline>();
} // namespace myolines
