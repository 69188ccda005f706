// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/integrator.h>

#include <stdexcept>

namespace myolines
{
#define MYOLINES_INTEGRATOR(name) IntegratorEntry name##_entry();
#include "../../integrators/list.def"
#undef MYOLINES_INTEGRATOR

  const std::vector<IntegratorEntry> &integrator_registry()
  {
    static const std::vector<IntegratorEntry> entries = {
#define MYOLINES_INTEGRATOR(name) name##_entry(),
#include "../../integrators/list.def"
#undef MYOLINES_INTEGRATOR
    };
    return entries;
  }

  const IntegratorEntry &integrator_entry(const std::string &name)
  {
    for (const IntegratorEntry &entry : integrator_registry())
      if (entry.facts.name == name)
        return entry;
    throw std::out_of_range("no integrator is called \"" + name + "\"");
  }
} // namespace myolines
