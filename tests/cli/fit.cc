// SPDX-License-Identifier: LGPL-2.1-or-later
// Which methods and systems go together: what `list methods` says is what runs do.

#include "program_runner.h"

#include <myolines/cli/commands.h>
#include <myolines/cli/fit.h>

#include <gtest/gtest.h>

using namespace myolines;

namespace
{
  /// Two steps of the smallest example, short enough for explicit methods.
  std::vector<scene::Setting> trial(const SystemEntry &system, const SystemVariant &variant, const IntegratorEntry &integrator)
  {
    std::vector<scene::Setting> settings = example_of(system, variant, integrator);
    const bool                  mass     = integrator.facts.solves == MethodFacts::Solves::mass;
    settings.insert(settings.end(), {{"time/step", mass ? "1e-8" : "1e-4"}, {"time/end", mass ? "2e-8" : "2e-4"}});
    if (system.name == "muscle 3d")
      settings.push_back({"system/geometry/refinement", "0"});
    return settings;
  }

  /// What `list methods` says of each system: "runs", or the reason.
  std::map<std::string, std::string> listed(const std::string &method)
  {
    std::stringstream lines;
    list_command("methods", method, lines);
    std::map<std::string, std::string> all;
    for (std::string line; std::getline(lines, line);)
      {
        const bool runs = line.rfind("    runs ", 0) == 0;
        if (!runs && line.rfind("    not ", 0) != 0)
          continue;
        const std::size_t end  = runs ? line.size() : line.find(": ");
        std::string       rest = line.substr(runs ? 9 : 8, end - (runs ? 9 : 8));
        for (bool more = true; more;)
          {
            const std::size_t next    = rest.find("; ");
            all[rest.substr(0, next)] = runs ? "runs" : line.substr(end + 2);
            more                      = next != std::string::npos;
            rest                      = more ? rest.substr(next + 2) : "";
          }
      }
    return all;
  }

  /// The same of a run of @p settings, of which nothing is left where it is refused.
  std::string outcome(const TestFolder &folder, const std::vector<scene::Setting> &settings, const SystemEntry &system)
  {
    RunOptions run;
    run.scene     = folder.write("scene.xml", scene::written_xml(scene::compose_scene(root_schema(system), settings)));
    run.folder    = folder / "out";
    run.quiet     = true;
    run.overwrite = true;
    std::ostringstream nothing;
    std::filesystem::remove_all(run.folder);
    try
      {
        run_command(run, nothing);
        return "runs";
      }
    catch (const InputError &error)
      {
        EXPECT_FALSE(std::filesystem::exists(run.folder));
        return error.problems().front().what;
      }
  }
} // namespace

TEST(Methods, TheTableOfMethodsAndSystemsIsTrue)
{
  const TestFolder folder;
  std::size_t      pairs = 0;
  for (const IntegratorEntry &integrator : integrator_registry())
    {
      const std::map<std::string, std::string> said = listed(integrator.facts.name);
      for (const SystemEntry &system : system_catalogue())
        for (const SystemVariant &variant : system.variants)
          EXPECT_EQ(outcome(folder, trial(system, variant, integrator), system), said.at(variant_name(system, variant)))
              << integrator.facts.name << " in " << variant_name(system, variant);
      pairs += said.size();
    }
  EXPECT_GT(pairs, 100u);
}

// Methods for unknowns of every order run everything, but the one that ignores inertia.
TEST(Methods, ForUnknownsOfEveryOrderAreTakenByEverySystem)
{
  for (const IntegratorEntry &integrator : integrator_registry())
    if (integrator.facts.dynamic && integrator.facts.unknowns == MethodFacts::Unknowns::every_order)
      for (const SystemEntry &system : system_catalogue())
        for (const SystemVariant &variant : system.variants)
          EXPECT_FALSE(why_refused(system, variant, integrator)) << integrator.facts.name << " in " << variant_name(system, variant);
}
