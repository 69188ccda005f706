// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/time/integrator.h>

#include <stdexcept>

namespace myolines
{
#define MYOLINES_INTEGRATOR(name) IntegratorEntry name##_entry();
#include "../../integrators/list.def"
#undef MYOLINES_INTEGRATOR

  Registry<IntegratorEntry> &integrator_registry()
  {
    static Registry<IntegratorEntry> registry("integrator", {
#define MYOLINES_INTEGRATOR(name) name##_entry(),
#include "../../integrators/list.def"
#undef MYOLINES_INTEGRATOR
                                                            });
    return registry;
  }

  const IntegratorEntry &integrator_entry(const std::string &name)
  {
    if (const IntegratorEntry *entry = integrator_registry().find(name))
      return *entry;
    throw std::out_of_range("no integrator is called \"" + name + "\"");
  }
} // namespace myolines
