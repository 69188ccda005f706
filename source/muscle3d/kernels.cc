#include <myolines/muscle3d/kernels.h>

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

  InstructionSet widest_instruction_set()
  {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"))
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
