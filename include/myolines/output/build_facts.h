// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <deal.II/base/config.h>

#include <string> // its library tells its own facts

// What two binaries must have in common to hand each other objects of C++, as one literal: a line "what: value" for each fact. Compiler
// options that change the layout of objects, or the arithmetic of a whole process, are among them.

#define MYOLINES_TEXT_OF(x) #x
#define MYOLINES_TEXT(x) MYOLINES_TEXT_OF(x)

#if defined(__AVX512F__)
#  define MYOLINES_INSTRUCTIONS "avx512"
#elif defined(__AVX2__)
#  define MYOLINES_INSTRUCTIONS "avx2"
#elif defined(__AVX__)
#  define MYOLINES_INSTRUCTIONS "avx"
#else
#  define MYOLINES_INSTRUCTIONS "those of every processor"
#endif

#ifdef DEBUG
#  define MYOLINES_ASSERTIONS "on"
#else
#  define MYOLINES_ASSERTIONS "off"
#endif

#ifdef __FAST_MATH__
#  define MYOLINES_ARITHMETIC "fast"
#else
#  define MYOLINES_ARITHMETIC "IEEE 754"
#endif

#ifdef _GLIBCXX_DEBUG
#  define MYOLINES_CONTAINERS "of debug mode"
#else
#  define MYOLINES_CONTAINERS "C++11 ABI " MYOLINES_TEXT(_GLIBCXX_USE_CXX11_ABI)
#endif

/// @p VERSION of Myolines and the checksum of its @p HEADERS are literals.
#define MYOLINES_BUILD_FACTS(VERSION, HEADERS)                                                                                             \
  "version of Myolines: " VERSION "\nheaders of Myolines: " HEADERS "\ndeal.II: " DEAL_II_PACKAGE_VERSION                                  \
  "\nvectors of deal.II: " MYOLINES_TEXT(DEAL_II_VECTORIZATION_WIDTH_IN_BITS) " bits\ncompiler ABI: " MYOLINES_TEXT(                       \
      __GXX_ABI_VERSION) "\ncontainers: " MYOLINES_CONTAINERS "\ninstructions: " MYOLINES_INSTRUCTIONS                                     \
                         "\nassertions: " MYOLINES_ASSERTIONS "\narithmetic: " MYOLINES_ARITHMETIC "\n"
