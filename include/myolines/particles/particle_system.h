// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/system/semi_discrete_system.h>

#include <string>
#include <vector>

namespace myolines
{
  /// A few masses on springs, on one rank, whose unknowns have names.
  class ParticleSystem : public SemiDiscreteSystem
  {
  public:
    /// "mass 1", by number of the unknown, for columns of tables.
    virtual std::vector<std::string> names() const = 0;
  };
} // namespace myolines
