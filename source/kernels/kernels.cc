// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/kernels/kernels.h>

namespace myolines
{
  // Each is defined in the unit compiled for that instruction set.
  extern const Kernels kernels_baseline[3];
  extern const Kernels kernels_avx2[3];
  extern const Kernels kernels_avx512[3];

  const Kernels &kernels(const InstructionSet instruction_set, const unsigned int degree)
  {
#if defined(__x86_64__)
    if (instruction_set == InstructionSet::avx512)
      return kernels_avx512[degree - 1];
    if (instruction_set == InstructionSet::avx2)
      return kernels_avx2[degree - 1];
#endif
    return kernels_baseline[degree - 1];
  }
} // namespace myolines
