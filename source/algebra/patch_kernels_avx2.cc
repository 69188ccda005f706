// SPDX-License-Identifier: LGPL-2.1-or-later
#if defined(__x86_64__)
#  include "patch_kernels.h"

namespace myolines
{
  extern const PatchKernels patch_kernels_avx2;
  const PatchKernels        patch_kernels_avx2 = make_patch_kernels<InstructionSet::avx2>();
} // namespace myolines
#endif
