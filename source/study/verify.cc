// SPDX-License-Identifier: LGPL-2.1-or-later
#include "verify_results.h"

#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/output/file_lock.h>
#include <myolines/output/text_file.h>
#include <myolines/study/runner.h>
#include <myolines/study/verify.h>

#include <algorithm>
#include <sstream>

namespace myolines::study
{
  namespace
  {

    VerifyRun run_of(const VerifyOptions &options, const VerifyRun::Part part, const std::string &parameter, const Rung &rung)
    {
      VerifyRun run{{}, part, rung, {}};
      run.which.name     = part == VerifyRun::Part::scene ? "scene" : case_name("", {{parameter, rung.label}});
      run.which.settings = options.overrides;
      run.which.settings.insert(run.which.settings.end(), rung.settings.begin(), rung.settings.end());
      run.outcome.status = "open";
      return run;
    }

    /// Three neighbours, the scene among them: the finest that are not too expensive. What is left out is noted.
    void add_rungs(const VerifyOptions &options, const VerifyRun::Part part, Ladder &ladder, std::vector<VerifyRun> &runs)
    {
      std::size_t finest = ladder.scene;
      while (finest < std::min(ladder.scene + 2, ladder.rungs.size() - 1) && ladder.rungs[finest + 1].cost <= options.at_most)
        ++finest;
      if (finest == ladder.scene && finest + 1 < ladder.rungs.size())
        {
          std::ostringstream note;
          note.precision(2);
          note << ladder.rungs[finest + 1].label << " would take about " << ladder.rungs[finest + 1].cost
               << " times the CPU time of the scene, more than --at-most";
          ladder.note = note.str();
        }
      for (std::size_t i = finest < 2 ? 0 : finest - 2; i <= finest; ++i)
        if (i != ladder.scene)
          runs.push_back(run_of(options, part, ladder.parameter, ladder.rungs[i]));
    }

    /// With the shortest steps that are run.
    VerifyRun run_of_least_damping(const VerifyOptions &options, const Refinements &refinements, const std::vector<VerifyRun> &runs)
    {
      const VerifyRun *finest = &runs.front();
      for (const VerifyRun &run : runs)
        if (run.part == VerifyRun::Part::steps && run.rung.size < finest->rung.size)
          finest = &run;
      const Rung &method = *refinements.least_damping;
      Rung        rung   = finest->rung;
      rung.settings.insert(rung.settings.begin(), method.settings.begin(), method.settings.end());
      VerifyRun run  = run_of(options, VerifyRun::Part::least_damping, refinements.steps.parameter, rung);
      run.which.name = case_name("", {{refinements.method_name, method.label}, {refinements.steps.parameter, rung.label}});
      return run;
    }

    std::vector<VerifyRun> plan(const VerifyOptions &options, Refinements &refinements)
    {
      std::vector<VerifyRun> runs{run_of(options, VerifyRun::Part::scene, "", {"", {}, 1, 1})};
      for (auto [part, ladder] :
           {std::pair{VerifyRun::Part::steps, &refinements.steps}, std::pair{VerifyRun::Part::mesh, &refinements.mesh}})
        if (!ladder->rungs.empty())
          add_rungs(options, part, *ladder, runs);
      if (refinements.degree && refinements.degree->cost <= options.at_most)
        runs.push_back(run_of(options, VerifyRun::Part::degree, refinements.degree_name, *refinements.degree));
      if (refinements.method && refinements.method->cost <= options.at_most)
        runs.push_back(run_of(options, VerifyRun::Part::method, refinements.method_name, *refinements.method));
      if (refinements.least_damping)
        runs.push_back(run_of_least_damping(options, refinements, runs));
      return runs;
    }

    void take_outcomes(const Database &database, std::vector<VerifyRun> &runs)
    {
      const auto outcomes = database.outcomes();
      for (VerifyRun &run : runs)
        if (const auto found = outcomes.find(run.which.name); found != outcomes.end())
          run.outcome = found->second;
    }

    /// The cheapest run comes first, so that a quantity that the runs do not have is told before the expensive ones.
    void run_all(const VerifyOptions &options, const Study &study, const std::vector<VerifiedQuantity> &quantities,
                 const std::filesystem::path &folder, std::vector<VerifyRun> &runs)
    {
      Database            database(folder / "verify.sqlite");
      const RunnerOptions runner = runner_options(options, study, folder);
      const auto          cheapest =
          std::min_element(runs.begin(), runs.end(), [](const VerifyRun &a, const VerifyRun &b) { return a.rung.cost < b.rung.cost; });
      throw_if_open(run_cases(study, {cheapest->which}, database, runner));
      take_outcomes(database, runs);
      if (cheapest->done())
        for (const VerifiedQuantity &quantity : quantities)
          value_in_run(quantity, case_folder(folder, cheapest->which.name));
      std::vector<Case> cases;
      for (const VerifyRun &run : runs)
        cases.push_back(run.which);
      throw_if_open(run_cases(study, cases, database, runner));
      take_outcomes(database, runs);
    }

    std::string failures(const std::vector<VerifyRun> &runs)
    {
      std::vector<std::string> all;
      for (const VerifyRun &run : runs)
        if (!run.done())
          all.push_back("the run \"" + run.which.name + "\" " + (run.outcome.status == "failed" ? "failed" : "was " + run.outcome.status) +
                        ": " + run.outcome.reason);
      return join(all, "; ");
    }
  } // namespace

  void verify_command(const VerifyOptions &options, std::ostream &out)
  {
    require_one_process("verify", "--ranks gives its runs several");
    std::vector<VerifiedQuantity> quantities;
    for (const std::string &text : options.quantities)
      quantities.push_back(read_verified_quantity(text));
    Refinements                 refinements = options.refinements(options.scene, options.overrides);
    std::vector<VerifyRun>      runs        = plan(options, refinements);
    const std::filesystem::path folder      = made_folder(options, "verify");
    const FileLock              lock(folder / "verify.lock", FileLock::Kind::exclusive, "another verification");

    run_all(options, study_of(options), quantities, folder, runs);
    if (!runs.front().done())
      throw SolveError(failures(runs));
    std::vector<VerifiedValue> values;
    for (const VerifiedQuantity &quantity : quantities)
      values.push_back(verified_value(quantity, runs, refinements, folder));
    const std::string text = report_text(values, runs, refinements);
    replace_file(folder / "verify.txt", text);
    write_verify_tables(values, runs, folder);
    out << text << "Results are in " << folder.string() << ": verify.txt, verify.csv, runs.csv\n";
    if (const std::string failed = failures(runs); !failed.empty())
      throw SolveError(failed + ". What is told above is of the other runs");
  }
} // namespace myolines::study
