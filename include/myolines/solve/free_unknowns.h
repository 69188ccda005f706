// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/algebra/vector.h>

#include <utility>
#include <vector>

namespace myolines
{
  /// The owned unknowns that homogeneous relations u = C q leave free, and C, C^T applied to vectors.
  /// Unknowns that a relation names must be owned or ghosts of the vectors used here.
  class FreeUnknowns
  {
  public:
    /// @p layout is any vector of the size and distribution of those used later.
    FreeUnknowns(const Constraints &constraints, const Vector &layout);

    /// Whether constrained unknowns depend on others, on any rank.
    bool related() const { return related_; }

    /// f <- C^T f, with zeros in the rows of constrained unknowns: its l2 norm is that over the free ones.
    void condense(Vector &f) const;

    /// Zeros in the rows of constrained unknowns.
    void clear_constrained(Vector &x) const;

    /// x_c <- (C x_free)_c; zero for unknowns that depend on none. Ghosts are current on return.
    void distribute(Vector &x) const;

  private:
    struct Relation
    {
      unsigned int                                                    row; ///< local number of the constrained unknown
      std::vector<std::pair<dealii::types::global_dof_index, double>> entries;
    };
    std::vector<unsigned int> rows_;      ///< local numbers of all owned constrained unknowns
    std::vector<Relation>     relations_; ///< of those that depend on others
    bool                      related_;   ///< whether any rank has such relations
  };
} // namespace myolines
