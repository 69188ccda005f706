// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/lanes.h>

namespace myolines
{
  InstructionSet widest_instruction_set()
  {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
      return InstructionSet::avx512;
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
      return InstructionSet::avx2;
#endif
    return InstructionSet::baseline;
  }

  const char *name(const InstructionSet instruction_set)
  {
    switch (instruction_set)
      {
      case InstructionSet::avx512:
        return "AVX-512";
      case InstructionSet::avx2:
        return "AVX2";
      default:
        return "baseline";
      }
  }
} // namespace myolines
