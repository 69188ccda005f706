// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/boundary/boundary.h>
#include <myolines/cli/catalogue.h>
#include <myolines/cli/commands.h>
#include <myolines/cli/fit.h>
#include <myolines/cli/plugins.h>
#include <myolines/cli/reference.h>
#include <myolines/materials/laws.h>
#include <myolines/output/checkpoint_keeper.h>
#include <myolines/solve/linear_solver.h>
#include <myolines/study/study.h>
#include <myolines/system/drive.h>
#include <myolines/time/integrator.h>

#include <algorithm>

namespace myolines
{
  namespace
  {
    using scene::Schema;

    struct Item
    {
      std::string name;
      std::string summary;
      std::string details; ///< indented lines
    };
    using Items = std::vector<Item>;

    std::string unknowns_text(const MethodFacts::Unknowns unknowns)
    {
      switch (unknowns)
        {
        case MethodFacts::Unknowns::second_order:
          return "  for unknowns of second order, in systems with inertia (`myolines list methods`)\n";
        case MethodFacts::Unknowns::first_or_second_order:
          return "  for unknowns of second order, in systems with inertia, or all of first order\n";
        case MethodFacts::Unknowns::every_order_if_damped:
          return "  for unknowns of second order, in systems with inertia; with a spectral radius at infinity below 1 of every order\n";
        default:
          return "  for unknowns of every order\n";
        }
    }

    Items integrators()
    {
      Items items;
      for (const IntegratorEntry &entry : integrator_registry())
        items.push_back({entry.facts.name, entry.facts.summary, facts_text(entry) + describe(entry.schema)});
      return items;
    }

    Items systems()
    {
      Items items;
      for (const SystemEntry &entry : system_catalogue())
        {
          const Schema schema = entry.schema();
          items.push_back({entry.name, schema.doc(), describe(schema)});
        }
      return items;
    }

    /// Systems that the run of @p integrator takes, with what makes them of the example, and what it says of those that it refuses.
    Item systems_of(const IntegratorEntry &integrator)
    {
      std::vector<std::string>                                      taken;
      std::vector<std::pair<std::string, std::vector<std::string>>> refused; ///< by reason
      std::string                                                   details;
      for (const SystemEntry &system : system_catalogue())
        for (const SystemVariant &variant : system.variants)
          {
            const std::string name    = variant_name(system, variant);
            const auto        problem = why_refused(system, variant, integrator);
            if (!problem)
              {
                taken.push_back(name);
                for (const auto &[path, text] : variant.settings)
                  details += "  " + name + ": " + path + "=" + text + "\n";
              }
            else if (refused.empty() || refused.back().first != problem->what)
              refused.push_back({problem->what, {name}});
            else
              refused.back().second.push_back(name);
          }
      std::string summary = "runs " + join(taken, "; ");
      for (const auto &[why, names] : refused)
        summary += "\n    not " + join(names, "; ") + ": " + why;
      return {integrator.facts.name, summary, details};
    }

    /// Of all methods, or of @p only one.
    Items methods(const std::string &only)
    {
      Items items;
      for (const IntegratorEntry &integrator : integrator_registry())
        items.push_back(only.empty() || only == integrator.facts.name ? systems_of(integrator) : Item{integrator.facts.name, "", ""});
      return items;
    }

    Items sections(const Schema &schema)
    {
      Items items;
      for (const Schema::Section &section : schema.sections())
        items.push_back({section.name, section.schema->doc(), describe(*section.schema)});
      return items;
    }

    Items tissues()
    {
      const Schema muscle = system_entry("muscle 3d", "catalogue").schema();
      for (const Schema::Section &section : muscle.sections())
        if (section.name == "tissues")
          return sections(*section.schema);
      throw std::logic_error("the muscle has no list of tissues");
    }

    /// The alternatives of the variant of @p schema; its own parameters, which all of them share, follow each.
    Items alternatives(const Schema &schema)
    {
      Items items;
      for (const auto &[name, alternative] : schema.variant()->alternatives)
        items.push_back({name, alternative->doc(), describe(*alternative)});
      return items;
    }

    Items outputs()
    {
      Items items{{"checkpoint", checkpoint_schema().doc(), describe(checkpoint_schema())}};
      for (const SystemEntry &entry : system_catalogue())
        for (const Item &item : sections(entry.output()))
          items.push_back({item.name + " of " + entry.name, item.summary, item.details});
      return items;
    }

    /// The kinds, and the whole file.
    Items studies()
    {
      Items items = alternatives(study::study_schema());
      items.push_back({"file", study::study_schema().doc(), describe(study::study_schema())});
      return items;
    }

    Items plugin_items(const std::vector<std::pair<std::string, std::string>> &refused)
    {
      Items items;
      for (const Plugin &plugin : plugins())
        items.push_back({plugin.name, join(plugin.brings), "  file: " + plugin.file.string() + "\n"});
      for (const auto &[name, why] : refused)
        items.push_back({name, "refused: " + why, ""});
      return items;
    }

    using Topic = std::function<Items(const std::string &only)>;

    const std::vector<std::pair<std::string, Topic>> &topics()
    {
      const auto all_of = [](const std::function<Items()> &items) -> Topic { return [items](const std::string &) { return items(); }; };
      static const std::vector<std::pair<std::string, Topic>> all{
          {"integrators", all_of(integrators)},
          {"methods", methods},
          {"systems", all_of(systems)},
          {"tissues", all_of(tissues)},
          {"laws", all_of([] { return alternatives(*laws_schema().named()); })},
          {"boundary conditions", all_of([] { return alternatives(*boundary_schema().named()); })},
          {"profiles", all_of([] { return alternatives(drive_schema("driven quantity", "unit of the driven quantity")); })},
          {"preconditioners", all_of([] { return alternatives(LinearSolver::preconditioner_schema()); })},
          {"outputs", all_of(outputs)},
          {"plug-ins", all_of([] { return plugin_items(load_all_plugins()); })},
          {"studies", all_of(studies)}};
      return all;
    }

    [[noreturn]] void refuse(const std::string &what, const std::string &name, const std::vector<std::string> &known)
    {
      throw InputError(InputProblem{"command line", "unknown " + what + " \"" + name + "\"",
                                    known.empty() ? "no name, as there is none" : "one of " + join(known),
                                    nearest_hint(name, known, "nearest valid name")});
    }

    template <typename Things, typename NameOf>
    std::vector<std::string> names_of(const Things &things, const NameOf &name_of)
    {
      std::vector<std::string> names;
      for (const auto &thing : things)
        names.push_back(name_of(thing));
      return names;
    }
  } // namespace

  std::string facts_text(const IntegratorEntry &entry)
  {
    const MethodFacts &facts = entry.facts;
    std::string        text;
    if (facts.order > 0)
      text += "  order " + std::to_string(facts.order) + ", " + facts.stability + "\n";
    if (entry.make_self_paced)
      text += std::string("  steps: ") + (entry.make ? "given, or " : "") +
              "chosen by error, by the method itself; its own Newton iteration (of solver/nonlinear only \"forcing maximum\" counts)\n";
    else if (facts.error_exponent > 0)
      text += std::string("  error of a step: estimated, of ") + (facts.estimates_velocity ? "u and v" : "u") + "\n";
    else if (facts.order > 0)
      text += std::string("  error of a step: ") + (facts.doubles ? "by step doubling" : "not estimated, steps cannot be chosen by error") +
              "\n";
    text += facts.dynamic ? "" : "  ignores inertia and rates\n";
    text += unknowns_text(facts.unknowns);
    if (facts.solves == MethodFacts::Solves::linear_systems)
      text += "  solves linear systems and does not iterate\n";
    if (facts.solves == MethodFacts::Solves::mass)
      text += "  explicit: solves with the mass\n";
    text += "  reference: " + facts.reference + "\n";
    text += facts.restart == MethodFacts::Restart::exact ? "  restart: exact\n" : "  restart: reinitialised, the history is lost\n";
    return text;
  }

  std::vector<std::string> list_topics()
  {
    return names_of(topics(), [](const auto &topic) { return topic.first; });
  }

  void list_command(const std::string &topic, const std::string &name, std::ostream &out)
  {
    load_all_plugins();
    for (const auto &[known, make_items] : topics())
      if (known == topic)
        {
          const Items items = make_items(name);
          for (const Item &item : items)
            if (name.empty() || name == item.name)
              out << item.name << "\n    " << item.summary << "\n" << (name.empty() ? "" : item.details);
          const std::vector<std::string> names = names_of(items, [](const Item &item) { return item.name; });
          if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end())
            refuse("name in " + topic + ":", name, names);
          return;
        }
    refuse("topic", topic, list_topics());
  }

  void template_command(const std::string &system, const std::string &integrator, std::ostream &out)
  {
    load_all_plugins();
    const SystemEntry             &entry   = system_entry(system, "command line");
    const std::vector<std::string> methods = names_of(integrator_registry(), [](const IntegratorEntry &e) { return e.facts.name; });
    if (!integrator.empty() && std::find(methods.begin(), methods.end(), integrator) == methods.end())
      refuse("integrator", integrator, methods);

    const IntegratorEntry      &method = integrator.empty() ? *methods_for_every_system().front() : integrator_entry(integrator);
    std::optional<InputProblem> refused;
    for (const SystemVariant &variant : entry.variants)
      {
        const auto problem = why_refused(entry, variant, method);
        if (!problem)
          {
            std::vector<scene::Setting> settings = example_of(entry, variant, method);
            if (integrator.empty())
              settings.push_back({"time/control/type", "error"});
            out << scene::template_xml(root_schema(entry), settings);
            return;
          }
        refused = refused.value_or(*problem);
      }
    throw InputError(*refused);
  }
} // namespace myolines
