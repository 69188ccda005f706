// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/algebra/vector.h>

#include <memory>

namespace myolines
{
  /// Read access to a vector whose ghosts are current: the vector itself, or an updated copy only if its own are not.
  class CurrentGhosts
  {
  public:
    /// Of @p x, which outlives the object. Without @p wanted its ghosts are taken as they are. Collective.
    explicit CurrentGhosts(const Vector &x, const bool wanted = true)
      : x_(x)
    {
      if (wanted && !x.has_ghost_elements())
        {
          copy_ = std::make_unique<Vector>(x);
          copy_->update_ghost_values();
        }
    }

    const Vector &vector() const { return copy_ ? *copy_ : x_; } ///< The vector with its ghosts.
    const double *begin() const { return vector().begin(); }     ///< Its first entry; that with local number i stands i behind.

  private:
    const Vector           &x_;
    std::unique_ptr<Vector> copy_;
  };
} // namespace myolines
