// SPDX-License-Identifier: LGPL-2.1-or-later
#if defined(__x86_64__)
#  include "kernels_impl.h"

namespace myolines
{
  extern const Kernels kernels_avx2[3];
  const Kernels        kernels_avx2[3] = {make_kernels<InstructionSet::avx2, 2>(), make_kernels<InstructionSet::avx2, 3>(),
                                          make_kernels<InstructionSet::avx2, 4>()};
} // namespace myolines
#endif
