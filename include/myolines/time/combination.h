// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/algebra/vector.h>

#include <initializer_list>

namespace myolines
{
  /// A summand of combine().
  struct Term
  {
    double        factor; ///< of the vector
    const Vector *x;      ///< is not owned
  };

  /// y = sum of factor x over the owned entries, in one pass and without temporaries. @p y has the layout of the x and may be
  /// one of them. Ghosts of @p y are not updated.
  inline void combine(Vector &y, const std::initializer_list<Term> terms)
  {
    double            *out  = y.begin();
    const unsigned int size = y.locally_owned_size();
    for (unsigned int i = 0; i < size; ++i)
      {
        double sum = 0;
        for (const Term &term : terms)
          sum += term.factor * term.x->begin()[i];
        out[i] = sum;
      }
  }
} // namespace myolines
