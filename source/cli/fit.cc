// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/names.h>
#include <myolines/cli/experiment.h>
#include <myolines/cli/fit.h>
#include <myolines/cli/plugins.h>

#include <algorithm>
#include <set>

namespace myolines
{
  std::string variant_name(const SystemEntry &system, const SystemVariant &variant)
  {
    return system.name + (variant.name.empty() ? "" : ", " + variant.name);
  }

  std::vector<scene::Setting> example_of(const SystemEntry &system, const SystemVariant &variant, const IntegratorEntry &integrator)
  {
    std::vector<scene::Setting> settings{{"system/type", system.name}, {"integrator/type", integrator.facts.name}};
    for (const std::vector<scene::Setting> &more : {system.example, variant.settings})
      settings.insert(settings.end(), more.begin(), more.end());
    std::set<std::string> plugins{plugin_of("system " + system.name), plugin_of("integrator " + integrator.facts.name)};
    plugins.erase("");
    if (!plugins.empty())
      settings.push_back({"plug-ins", join({plugins.begin(), plugins.end()}, " ")});
    if (!integrator.make)
      settings.push_back({"time/control/type", "error"});
    return settings;
  }

  std::optional<InputProblem> why_refused(const SystemEntry &system, const SystemVariant &variant, const IntegratorEntry &integrator)
  {
    try
      {
        const Experiment made(scene::compose_scene(root_schema(system), example_of(system, variant, integrator)));
        return std::nullopt;
      }
    catch (const InputError &error)
      {
        return error.problems().front();
      }
  }

  std::vector<const IntegratorEntry *> methods_for_every_system()
  {
    std::vector<const IntegratorEntry *> methods;
    for (const IntegratorEntry &entry : integrator_registry())
      if (const MethodFacts &facts = entry.facts; facts.unknowns == MethodFacts::Unknowns::every_order && facts.error_exponent > 0 &&
                                                  facts.estimates_velocity && plugin_of("integrator " + facts.name).empty())
        methods.push_back(&entry);
    std::stable_sort(methods.begin(), methods.end(),
                     [](const IntegratorEntry *a, const IntegratorEntry *b) { return a->facts.order > b->facts.order; });
    return methods;
  }

  const IntegratorEntry &method_of_least_damping()
  {
    const auto &all = integrator_registry();
    return *std::find_if(all.begin(), all.end(), [](const IntegratorEntry &entry) { return entry.facts.least_damping; });
  }
} // namespace myolines
