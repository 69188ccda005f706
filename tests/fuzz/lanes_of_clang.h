// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

// Included before all else where the compiler is clang: lanes.h hands GCC's own functions on as arguments, and clang only calls them.
#include <algorithm>
#include <cmath>
#include <functional>

#define __builtin_sqrt [](const double x) { return std::sqrt(x); }
#define __builtin_cbrt [](const double x) { return std::cbrt(x); }
#define __builtin_exp [](const double x) { return std::exp(x); }
#define __builtin_log [](const double x) { return std::log(x); }
#define __builtin_sin [](const double x) { return std::sin(x); }
#define __builtin_cos [](const double x) { return std::cos(x); }
#include <myolines/base/lanes.h>
#undef __builtin_sqrt
#undef __builtin_cbrt
#undef __builtin_exp
#undef __builtin_log
#undef __builtin_sin
#undef __builtin_cos
