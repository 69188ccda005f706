// SPDX-License-Identifier: LGPL-2.1-or-later
#include "kernels_impl.h"

namespace myolines
{
  extern const Kernels kernels_baseline[3];
  const Kernels        kernels_baseline[3] = {make_kernels<InstructionSet::baseline, 2>(), make_kernels<InstructionSet::baseline, 3>(),
                                              make_kernels<InstructionSet::baseline, 4>()};
} // namespace myolines
