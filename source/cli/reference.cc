// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/cli/catalogue.h>
#include <myolines/cli/commands.h>
#include <myolines/cli/reference.h>
#include <myolines/materials/laws.h>
#include <myolines/output/checkpoint_keeper.h>
#include <myolines/scene/markdown.h>
#include <myolines/solve/linear_solver.h>
#include <myolines/study/study.h>
#include <myolines/system/drive.h>
#include <myolines/time/integrator.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <sstream>

namespace myolines
{
  namespace
  {
    using scene::markdown_code;
    using scene::markdown_text;
    using scene::Schema;

    std::vector<std::string> names_of_alternatives(const Schema &schema)
    {
      std::vector<std::string> names;
      if (schema.variant())
        for (const auto &[name, alternative] : schema.variant()->alternatives)
          names.push_back(name);
      return names;
    }

    /// Given functions of time and laws occur at many places and have a page each.
    std::string page_of_its_own(const Schema &schema)
    {
      const std::vector<std::string>        names  = names_of_alternatives(schema);
      static const std::vector<std::string> drives = names_of_alternatives(drive_schema("", "")),
                                            laws   = names_of_alternatives(*laws_schema().named());
      if (names == drives)
        return "A given function of time: [profiles](profiles.md).";
      if (names == laws)
        return "A law: [laws](laws.md).";
      return "";
    }

    /// As on the page of that kind itself.
    std::string in_place(const Schema &) { return ""; }

    std::string described(const Schema &schema, const std::string &path)
    {
      return markdown_text(schema.doc()) + "\n\n" + scene::markdown(schema, path, page_of_its_own);
    }

    void options_table(const CLI::App &command, std::ostream &out)
    {
      out << "| argument | meaning | default |\n|---|---|---|\n";
      for (const CLI::Option *option : command.get_options([](const CLI::Option *) { return true; }))
        {
          const std::string value = option->get_type_name();
          const bool        takes = option->get_positional() || option->get_items_expected_max() > 0;
          const std::string name  = option->get_positional() ? value : option->get_name() + (takes && !value.empty() ? " " + value : "");
          out << "| " << markdown_code(name) << " | " << markdown_text(option->get_description()) << " | "
              << (option->get_default_str().empty() ? "" : markdown_code(option->get_default_str())) << " |\n";
        }
      out << "\n";
    }

    void command_section(const CLI::App &command, const std::string &before, std::ostream &out)
    {
      const std::string name = before + command.get_name();
      out << "## " << name << "\n\n" << markdown_text(command.get_description()) << ".\n\n";
      options_table(command, out);
      for (const CLI::App *nested : command.get_subcommands([](const CLI::App *) { return true; }))
        command_section(*nested, name + " ", out);
    }

    void commands_page(const CLI::App &app, std::ostream &out)
    {
      for (const CLI::App *command : app.get_subcommands([](const CLI::App *) { return true; }))
        command_section(*command, "", out);
      out << "## Exit codes\n\n" << app.get_footer() << "\n\n";
    }

    /// What all scenes have beside system, integrator and outputs.
    void scene_page(const CLI::App &, std::ostream &out)
    {
      const Schema root = root_schema(*system_catalogue().begin());
      Schema       rest(root.doc());
      for (const scene::Entry &entry : root.entries())
        entry.optional ? rest.optional_text(entry.name, entry.doc) : rest.text(entry.name, entry.fallback, entry.doc);
      out << described(rest, "");
      for (const Schema::Section &section : root.sections())
        if (section.name == "time" || section.name == "solver")
          out << "## " << section.name << "\n\n" << described(*section.schema, section.name + "/");
    }

    void systems_page(const CLI::App &, std::ostream &out)
    {
      for (const SystemEntry &entry : system_catalogue())
        out << "## " << entry.name << "\n\n" << described(entry.schema(), "system/");
    }

    void integrators_page(const CLI::App &, std::ostream &out)
    {
      for (const IntegratorEntry &entry : integrator_registry())
        {
          out << "## " << entry.facts.name << "\n\n" << markdown_text(entry.facts.summary) << "\n\n";
          std::istringstream facts(facts_text(entry));
          for (std::string line; std::getline(facts, line);)
            out << "- " << markdown_text(line.substr(line.find_first_not_of(' '))) << "\n";
          out << "\n" << scene::markdown(entry.schema, "integrator/", page_of_its_own);
        }
    }

    void laws_page(const CLI::App &, std::ostream &out)
    {
      out << markdown_text(laws_schema().doc()) << "\n\n" << scene::markdown(*laws_schema().named(), "laws/NAME/", in_place);
    }

    void profiles_page(const CLI::App &, std::ostream &out)
    {
      out << scene::markdown(drive_schema("driven quantity", "unit of the driven quantity"), "", in_place);
    }

    void preconditioners_page(const CLI::App &, std::ostream &out)
    {
      out << described(LinearSolver::preconditioner_schema(), "solver/preconditioner/");
    }

    void outputs_page(const CLI::App &, std::ostream &out)
    {
      out << "## checkpoint\n\n" << described(checkpoint_schema(), "output/checkpoint/");
      for (const SystemEntry &entry : system_catalogue())
        out << "## Outputs of " << entry.name << "\n\n" << described(entry.output(), "output/");
    }

    void studies_page(const CLI::App &, std::ostream &out) { out << described(study::study_schema(), ""); }

    using Page = void (*)(const CLI::App &, std::ostream &);

    const std::vector<std::pair<std::string, Page>> pages{{"commands", commands_page},
                                                          {"scene", scene_page},
                                                          {"systems", systems_page},
                                                          {"integrators", integrators_page},
                                                          {"laws", laws_page},
                                                          {"profiles", profiles_page},
                                                          {"preconditioners", preconditioners_page},
                                                          {"outputs", outputs_page},
                                                          {"studies", studies_page}};
  } // namespace

  std::vector<std::string> reference_topics()
  {
    std::vector<std::string> topics;
    for (const auto &[topic, page] : pages)
      topics.push_back(topic);
    return topics;
  }

  void reference_command(const std::string &topic, const CLI::App &app, std::ostream &out)
  {
    const std::vector<std::string> topics = reference_topics();
    if (!topic.empty() && std::find(topics.begin(), topics.end(), topic) == topics.end())
      throw InputError(InputProblem{"command line", "the reference has no page \"" + topic + "\"", "one of " + join(topics),
                                    nearest_hint(topic, topics, "nearest valid name")});
    for (const auto &[name, page] : pages)
      if (topic.empty() || topic == name)
        {
          if (topic.empty())
            out << "# " << name << "\n\n";
          page(app, out);
        }
  }
} // namespace myolines
