// SPDX-License-Identifier: LGPL-2.1-or-later
#include "krylov_system.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace myolines
{
  KrylovSystem::KrylovSystem(const TangentOperator &tangent, const Vector *scale, const bool rounded)
    : tangent_(tangent)
    , scale_(scale)
    , digits_(rounded ? LocalEquations::Digits::single : LocalEquations::Digits::all)
    , x_(tangent.layout())
    , y_(x_)
  {
    if (scale != nullptr)
      z_ = y_z_ = Vector(scale->get_partitioner());
  }

  /// x_ and z_ of an array of unknowns, or of a right-hand side.
  void KrylovSystem::split(const double *all, const bool unknowns) const
  {
    const unsigned int n = x_.locally_owned_size();
    std::copy_n(all, n, x_.begin());
    if (scale_ == nullptr)
      return;
    z_.zero_out_ghost_values();
    for (unsigned int i = 0; i < z_.locally_owned_size(); ++i)
      z_.local_element(i) = unknowns ? all[n + i] * scale_->local_element(i) : all[n + i] / scale_->local_element(i);
  }

  void KrylovSystem::apply(const double *x, double *y) const
  {
    const unsigned int n = x_.locally_owned_size();
    split(x, true);
    if (scale_ == nullptr)
      tangent_.apply(x_, y_);
    else
      {
        tangent_.apply_with_local(digits_, x_, z_, y_, y_z_);
        for (unsigned int i = 0; i < y_z_.locally_owned_size(); ++i)
          y[n + i] = y_z_.local_element(i) * scale_->local_element(i);
      }
    std::copy_n(y_.begin(), n, y);
  }

  void KrylovSystem::precondition(const Preconditioner &preconditioner, const LocalEquations::Elimination *elimination, const double weight,
                                  const double *r, double *z) const
  {
    if (scale_ == nullptr)
      {
        preconditioner.apply(r, z);
        return;
      }
    const FreeUnknowns &free = tangent_.free_unknowns();
    const unsigned int  n    = x_.locally_owned_size();
    split(r, false);
    elimination->condense(z_, x_);
    free.condense(x_); // rows of constrained unknowns were zero
    preconditioner.apply(x_.begin(), z);
    std::copy_n(z, n, x_.begin());
    if (free.related())
      {
        y_ = x_;
        free.distribute(y_);
        elimination->recover(weight, y_, z_, y_z_);
        y_.zero_out_ghost_values();
      }
    else
      {
        x_.update_ghost_values();
        elimination->recover(weight, x_, z_, y_z_);
        x_.zero_out_ghost_values();
      }
    for (unsigned int i = 0; i < y_z_.locally_owned_size(); ++i)
      z[n + i] = y_z_.local_element(i) / scale_->local_element(i);
  }

  double KrylovSystem::norm(const Entries &x) const
  {
    return std::sqrt(dealii::Utilities::MPI::sum(std::inner_product(x.begin(), x.end(), x.begin(), 0.), communicator()));
  }

  KrylovSystem::Entries KrylovSystem::right(const Vector &b, const Vector *b_z) const
  {
    Entries all(x_.locally_owned_size() + (scale_ != nullptr ? scale_->locally_owned_size() : 0));
    auto    z = std::copy_n(b.begin(), b.locally_owned_size(), all.begin());
    if (b_z != nullptr)
      for (unsigned int i = 0; i < b_z->locally_owned_size(); ++i)
        z[i] = b_z->local_element(i) * scale_->local_element(i);
    return all;
  }

  void KrylovSystem::take(const Entries &all, Vector &x, Vector *z) const
  {
    x.zero_out_ghost_values();
    std::copy_n(all.begin(), x.locally_owned_size(), x.begin());
    if (z == nullptr)
      return;
    z->zero_out_ghost_values();
    for (unsigned int i = 0; i < z->locally_owned_size(); ++i)
      z->local_element(i) = all[x.locally_owned_size() + i] * scale_->local_element(i);
  }
} // namespace myolines
