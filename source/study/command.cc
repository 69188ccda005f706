// SPDX-License-Identifier: LGPL-2.1-or-later
#include "batch_script.h"

#include <myolines/base/counted.h>
#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/output/file_lock.h>
#include <myolines/output/text_file.h>
#include <myolines/scene/numbers.h>
#include <myolines/study/command.h>
#include <myolines/study/results.h>
#include <myolines/study/runner.h>

#include <nlohmann/json.hpp>

#include <iomanip>
#include <set>

namespace myolines::study
{
  namespace
  {
    const std::string another_study = "another study, or a part of one,";

    std::vector<Case> cases_of_part(const std::vector<Case> &cases, const Part &part)
    {
      std::vector<Case> mine;
      for (std::size_t i = part.number - 1; i < cases.size(); i += part.of)
        mine.push_back(cases[i]);
      return mine;
    }

    void copy_outcomes(const std::filesystem::path &from, Database &to)
    {
      std::vector<Outcome> outcomes;
      for (auto &[name, outcome] : Database(from).outcomes())
        outcomes.push_back(outcome);
      to.store(outcomes);
    }

    /// What parts have found becomes known to the whole; their files go.
    void take_over_parts(const std::filesystem::path &folder, Database &whole)
    {
      std::vector<std::filesystem::path> parts;
      for (const auto &entry : std::filesystem::directory_iterator(folder))
        if (entry.path().filename().string().rfind("part-", 0) == 0 && entry.path().extension() == ".sqlite")
          parts.push_back(entry.path());
      for (const std::filesystem::path &file : parts)
        {
          copy_outcomes(file, whole);
          std::filesystem::remove(file);
          std::filesystem::remove(std::filesystem::path(file).replace_extension(".lock"));
        }
    }

    /// Versions of the program that computed the cases, as their manifests say.
    std::set<std::string> versions(const std::vector<Row> &rows)
    {
      std::set<std::string> all;
      for (const Row &row : rows)
        if (const auto manifest = nlohmann::json::parse(row.outcome.manifest, nullptr, false); manifest.is_object())
          {
            const auto text = [&manifest = manifest](const char *name, const char *other) {
              return manifest.contains(name) && manifest[name].is_string() ? manifest[name].get<std::string>() : other;
            };
            all.insert(text("version", "?") + " " + text("git hash", ""));
          }
      return all;
    }

    void print_counts(const std::vector<Row> &rows, std::ostream &out)
    {
      std::map<std::string, std::size_t> statuses, classes;
      for (const Row &row : rows)
        {
          ++statuses[row.outcome.status];
          if (!row.stability.empty())
            ++classes[row.stability];
        }
      const auto line = [&out](const std::map<std::string, std::size_t> &counts) {
        std::vector<std::string> words;
        for (const auto &[name, n] : counts)
          words.push_back(std::to_string(n) + " " + name);
        out << join(words) << "\n";
      };
      out << counted(rows.size(), "case") << ": ";
      line(statuses);
      if (!classes.empty())
        {
          out << "Classes: ";
          line(classes);
        }
    }

    /// Quantities without a value in any case that is done, with the first reason that a case gives.
    void print_missing(const Study &study, const std::vector<Row> &rows, std::ostream &out)
    {
      for (std::size_t q = 0; q < study.quantities.size(); ++q)
        {
          std::string reason;
          bool        valued = false;
          for (const Row &row : rows)
            if (row.outcome.status == "done")
              {
                valued = valued || row.values[q].value;
                reason = reason.empty() ? row.values[q].note : reason;
              }
          if (!valued && !reason.empty())
            out << "Warning: \"" << study.quantities[q].name << "\" has no value in any case: " << reason << "\n";
        }
    }

    void print_unequal_repeats(const Study &study, const std::vector<Row> &rows, std::ostream &out)
    {
      for (const Row &row : rows)
        for (std::size_t q = 0; q < row.values.size(); ++q)
          if (row.values[q].note.rfind(repeats_differ, 0) == 0)
            out << "Warning: " << row.outcome.name << ", \"" << study.quantities[q].name << "\": " << row.values[q].note << "\n";
    }

    void print_cross_checks(const Study &study, const std::vector<Row> &rows, std::ostream &out)
    {
      for (const Row &row : rows)
        if (row.which->role == Case::Role::cross_check)
          for (std::size_t q = 0; q < study.quantities.size(); ++q)
            if (study.quantities[q].is_error() && row.values[q].value)
              out << "Reference and cross check differ: " << study.quantities[q].name << " = " << std::setprecision(3)
                  << *row.values[q].value << (row.which->coordinates.empty() ? "" : " (" + row.which->name + ")") << "\n";
    }

    void print_equal_error(const Study &study, const std::vector<Row> &rows, std::ostream &out)
    {
      if (!study.view.target)
        return;
      out << "At " << study.view.precision << " = " << *study.view.target << ", " << study.view.work << ":\n";
      for (const EqualError &cost : equal_error(study, rows))
        {
          out << "  " << cost.method << ": " << std::setprecision(3);
          if (cost.work.value)
            out << *cost.work.value;
          else if (cost.at_most.value)
            out << "at most " << *cost.at_most.value << ", ";
          if (cost.ratio.value)
            out << " (" << *cost.ratio.value << " times the least)";
          out << cost.work.note << "\n";
        }
    }

    /// The resolved scene of a case. What is wrong with it is told with the study and the point that it is.
    std::string resolved(const Options &options, const Study &study, const Case &which)
    {
      try
        {
          return options.resolve(study.scene, which.settings);
        }
      catch (const InputError &error)
        {
          std::vector<std::string> point;
          for (const auto &[axis, coordinate] : which.coordinates)
            point.push_back(axis + " = " + coordinate.label);
          std::vector<InputProblem> problems = error.problems();
          for (InputProblem &problem : problems)
            problem.where = options.file.string() + ": " + role_name(which.role) + " " + which.name +
                            (point.empty() ? "" : " (" + join(point) + ")") + ": " + problem.where;
          throw InputError(problems);
        }
    }

    void list_cases(const Options &options, const Study &study, const std::vector<Case> &cases, std::ostream &out)
    {
      for (const Case &each : cases)
        {
          std::vector<std::string> words{"run", study.scene.string()};
          for (const std::string &setting : each.settings)
            words.insert(words.end(), {"--set", setting});
          for (const std::filesystem::path &file : options.plugins)
            words.insert(words.end(), {"--plugin", file.string()});
          resolved(options, study, each); // refuses what a run would refuse
          out << each.name << "\n  " << shell_text(words) << "\n";
        }
      out << counted(cases.size(), "case") << "\n";
    }

    void write_script(const Options &options, const Study &study, const std::filesystem::path &folder, std::ostream &out)
    {
      const BatchCall call{options.program,
                           std::filesystem::absolute(options.file),
                           std::filesystem::absolute(folder),
                           options.overrides,
                           options.plugins,
                           options.tasks,
                           study.ranks};
      const auto      file = folder / ("study." + options.emit + ".sh");
      replace_file(file, options.emit == "slurm" ? slurm_script(call) : mpi_script(call));
      out << "Wrote " << file.string() << "; its first lines say how to use it.\n";
    }

    void run_part(const std::vector<Case> &cases, const Study &study, const Part &part, const RunnerOptions &runner)
    {
      const std::string name = "part-" + std::to_string(part.number) + "-of-" + std::to_string(part.of);
      const FileLock    whole(runner.folder / "study.lock", FileLock::Kind::shared, another_study),
          own(runner.folder / (name + ".lock"), FileLock::Kind::exclusive, another_study);
      Database database(runner.folder / (name + ".sqlite"));
      if (const auto known = runner.folder / "study.sqlite"; std::filesystem::exists(known))
        copy_outcomes(known, database);
      throw_if_open(run_cases(study, cases_of_part(cases, part), database, runner));
    }

    void run_whole(const std::vector<Case> &cases, const Study &study, const RunnerOptions &runner, const std::function<void()> &start_mpi,
                   std::ostream &out)
    {
      const FileLock lock(runner.folder / "study.lock", FileLock::Kind::exclusive, another_study);
      Database       database(runner.folder / "study.sqlite");
      take_over_parts(runner.folder, database);
      const RunnerReport report = run_cases(study, cases, database, runner);
      start_mpi(); // fields of several runs are compared by parallel vectors
      const std::vector<Row> rows = evaluate(study, cases, database.outcomes(), runner.folder);
      write_tables(study, rows, runner.folder, database);
      print_counts(rows, out);
      print_missing(study, rows, out);
      print_unequal_repeats(study, rows, out);
      throw_if_open(report);
      print_cross_checks(study, rows, out);
      print_equal_error(study, rows, out);
      if (const auto all = versions(rows); all.size() > 1)
        out << "Warning: the cases were computed by different versions of the program: "
            << join(std::vector<std::string>(all.begin(), all.end())) << "\n";
      out << "Results are in " << runner.folder.string()
          << ": study.csv, seconds.csv, study.sqlite; pictures: " << shell_text({runner.program.string(), "plot", runner.folder.string()})
          << "\n";
    }
  } // namespace

  Part read_part(const std::string &text)
  {
    const auto slash  = text.find('/');
    const auto number = scene::parse_integer(text.substr(0, slash)),
               of     = scene::parse_integer(slash == std::string::npos ? "" : text.substr(slash + 1));
    if (!number || !of || *number < 1 || *number > *of)
      throw InputError(InputProblem{"--part", "\"" + text + "\" is no part", "NUMBER/OF with 1 <= NUMBER <= OF, for example 2/8", ""});
    return {static_cast<unsigned int>(*number), static_cast<unsigned int>(*of)};
  }

  void study_command(const Options &options, std::ostream &out)
  {
    require_one_process("study", "--emit mpi writes a script for many ranks");
    const scene::Node       node  = read_study_file(options.file, options.overrides);
    const Study             study = read_study(node);
    const std::vector<Case> cases = expand(study);
    if (options.list)
      return list_cases(options, study, cases, out);

    const std::filesystem::path folder = options.folder.empty() ? std::filesystem::path("results") / options.file.stem() : options.folder;
    on_writing_rank("output folder " + folder.string(), "a folder that can be made and written", "choose another one with --out", [&] {
      std::filesystem::create_directories(folder);
      if (options.part.empty()) // parts would write it at the same time
        replace_file(folder / "study.resolved.xml", scene::resolved_xml(node, "study"));
    });
    if (!options.emit.empty())
      return write_script(options, study, folder, out);
    RunnerOptions runner = runner_options(options, study, folder);
    runner.resolve       = [&options, &study](const Case &which) { return resolved(options, study, which); };
    if (!options.part.empty())
      return run_part(cases, study, read_part(options.part), runner);
    run_whole(cases, study, runner, options.start_mpi, out);
  }
} // namespace myolines::study
