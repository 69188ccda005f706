// SPDX-License-Identifier: LGPL-2.1-or-later
#if defined(__x86_64__)
#  include <myolines/materials/law_batch.h>

#  include <laws_of_list.h>

namespace myolines
{
  const LawKernels law_kernels_avx2[] = {
#  define MYOLINES_LAW(file, law) make_law_kernels<InstructionSet::avx2, law>(),
#  include <myolines/materials/laws/list.def>
#  undef MYOLINES_LAW
  };
} // namespace myolines
#endif
