# SPDX-License-Identifier: LGPL-2.1-or-later
# Instruction sets that kernels are compiled for, and options of the compiler: for all of them, and for each. For the program and for the
# laws of plug-ins.
set(kernel_options -O3 -fno-math-errno -fno-trapping-math -Wno-psabi)
set(instruction_sets baseline)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
  list(APPEND instruction_sets avx2 avx512)
endif()
set(options_baseline "")
set(options_avx2 -mavx2 -mfma -ffp-contract=fast)
set(options_avx512 -mavx512f -mavx512dq -mavx512vl -mfma -ffp-contract=fast)
