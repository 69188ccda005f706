// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/base/named_instruction_set.h>

#include <utility>

namespace myolines
{
  InstructionSet widest_instruction_set()
  {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("f16c"))
      return InstructionSet::avx512;
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("f16c"))
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

  InstructionSet instruction_set_named(const std::string &word)
  {
    constexpr std::pair<const char *, InstructionSet> all[] = {
        {"baseline", InstructionSet::baseline}, {"avx2", InstructionSet::avx2}, {"avx512", InstructionSet::avx512}};
    std::string available;
    bool        known = false;
    for (const auto &[name, set] : all)
      {
        const bool here = set <= widest_instruction_set(), meant = word == name;
        if (here && meant)
          return set;
        known = known || meant;
        if (here)
          available += (available.empty() ? "" : ", ") + std::string(name);
      }
    throw InputError(InputProblem{"--instruction-set", known ? "this processor does not have " + word : "there is no \"" + word + "\"",
                                  "one of " + available, ""});
  }
} // namespace myolines
