// SPDX-License-Identifier: LGPL-2.1-or-later
#include "progress.h"

#include <myolines/base/checksum.h>
#include <myolines/base/counted.h>
#include <myolines/base/error.h>
#include <myolines/base/files.h>
#include <myolines/base/names.h>
#include <myolines/output/checkpoint.h>
#include <myolines/output/manifest.h>
#include <myolines/scene/numbers.h>
#include <myolines/study/processes.h>
#include <myolines/study/runner.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <deque>
#include <sstream>

namespace myolines::study
{
  namespace
  {
    using Clock = std::chrono::steady_clock;

    constexpr double grace          = 20;      ///< between the request to end and the end, for a run that saves its state [s]
    constexpr int    request_to_end = SIGUSR1; ///< mpirun hands it on to all ranks and waits; at SIGTERM it kills them

    double seconds_since(const Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

    /// Of a file that a run may not have left. @throws SystemError if it is there and cannot be read.
    std::string text_of(const std::filesystem::path &file) { return std::filesystem::exists(file) ? read_file(file) : ""; }

    std::string on_one_line(const std::string &text)
    {
      std::istringstream       lines(text);
      std::vector<std::string> parts;
      for (std::string line; std::getline(lines, line);)
        if (line = scene::trimmed(line); !line.empty())
          parts.push_back(line);
      return join(parts, "; ");
    }

    /// What the manifest says of a run that failed.
    std::string exit_reason(const std::string &manifest)
    {
      const auto json = nlohmann::json::parse(manifest, nullptr, /*allow_exceptions*/ false);
      return json.is_object() && json.contains("exit reason") && json["exit reason"].is_string() ? json["exit reason"].get<std::string>()
                                                                                                 : "";
    }

    /// A manifest that the end of a machine has emptied or halved does not say whose the folder is.
    bool has_manifest(const std::filesystem::path &folder)
    {
      try
        {
          return read_manifest(folder).has_value();
        }
      catch (const InputError &)
        {
          return false;
        }
    }

    /// Removes what an earlier run of a case left. @throws InputError if the folder is not of one: every case has a console there.
    void clear_case(const std::filesystem::path &folder)
    {
      std::error_code none;
      if (std::filesystem::is_directory(folder, none) && !std::filesystem::exists(folder / "console.txt") && !has_manifest(folder))
        for (const auto &entry : std::filesystem::directory_iterator(folder))
          if (const std::string name = entry.path().filename().string(); name != "console.txt" && name != "run.lock")
            throw InputError(InputProblem{entry.path().string(), "this file is not of a run, and a case of the study would go here",
                                          "a folder for the results of this study alone", "choose another one with --out"});
      std::filesystem::remove_all(folder);
    }

    struct Job
    {
      const Case       *which;
      std::string       scene, command;
      Clock::time_point begin;
      bool              resumed = false, timed_out = false, killed = false;
    };

    class Runner
    {
    public:
      Runner(const Study &study, Database &database, const RunnerOptions &options)
        : study_(study)
        , database_(database)
        , options_(options)
        , begin_(Clock::now())
      {}

      RunnerReport run(const std::vector<Case> &cases)
      {
        find_open(cases);
        const unsigned int jobs = options_.fitting_jobs ? options_.fitting_jobs(options_.jobs) : options_.jobs;
        RunnerReport       report;
        report.n_known = cases.size() - open_.size();
        Progress progress(options_.folder, cases.size(), report.n_known, jobs, options_.terminal);
        while (!open_.empty() || !running_.empty())
          {
            report.why_open = why_stop();
            if (!report.why_open.empty())
              break;
            while (running_.size() < jobs && !open_.empty())
              start();
            for (const Ended &end : processes_.wait(wait_at_most()))
              {
                const Outcome outcome = close(end);
                database_.store({outcome});
                progress.ended(outcome.name, outcome.status + (outcome.reason.empty() ? "" : ": " + outcome.reason), outcome.wall_seconds);
                ++report.n_run;
              }
            end_late_ones();
          }
        report.n_open = open_.size() + running_.size();
        if (!report.why_open.empty())
          progress.say("stopped: " + report.why_open + "; " + counted(report.n_open, "case") + " open");
        stop_running();
        progress.close();
        return report;
      }

    private:
      /// Where the file of @p input is today: plug-ins may be named anew.
      std::filesystem::path place_of(const std::filesystem::path &input) const
      {
        const auto same_name = [&](const std::filesystem::path &plugin) { return plugin.filename() == input.filename(); };
        const auto found     = std::find_if(options_.plugins.begin(), options_.plugins.end(), same_name);
        return found != options_.plugins.end() ? *found : input;
      }

      /// Whether the files that a run read, plug-ins among them, are as they were; of the scene itself it matters what it resolves to.
      bool read_the_same_files(const std::string &manifest)
      {
        const auto json = nlohmann::json::parse(manifest, nullptr, /*allow_exceptions*/ false);
        if (!json.is_object() || !json.contains("inputs") || !json["inputs"].is_object())
          return true;
        for (const auto &[input, checksum] : json["inputs"].items())
          {
            const std::filesystem::path file = place_of(input);
            if (input == study_.scene.string() || !std::filesystem::is_regular_file(file))
              continue;
            const auto [known, is_new] = checksums_.try_emplace(file.string());
            if (is_new)
              known->second = checksum_of_file(file);
            if (checksum != known->second)
              return false;
          }
        return true;
      }

      /// Resolves all scenes before the first run: a misspelt axis is told at once.
      void find_open(const std::vector<Case> &cases)
      {
        const std::map<std::string, Outcome> known = database_.outcomes();
        for (const Case &each : cases)
          {
            const std::string scene = options_.resolve(each);
            const auto        found = known.find(each.name);
            const bool        ended = found != known.end() && found->second.scene == scene && read_the_same_files(found->second.manifest) &&
                               std::filesystem::exists(case_folder(options_.folder, each.name)) &&
                               !(options_.retry && found->second.status != "done");
            if (!ended)
              open_.push_back({&each, scene, "", {}});
          }
      }

      std::string why_stop() const
      {
        if (const int signal = options_.stop_signal(); signal != 0)
          return "signal " + std::to_string(signal);
        if (seconds_since(begin_) > study_.total_seconds)
          return "the total budget of " + scene::format_number(study_.total_seconds) + " s is spent";
        return "";
      }

      void start()
      {
        Job job = open_.front();
        open_.pop_front();
        const std::filesystem::path folder = case_folder(options_.folder, job.which->name);
        job.resumed =
            study_.resumes && std::filesystem::exists(checkpoint_file(folder)) && text_of(folder / "scene.resolved.xml") == job.scene;
        if (!job.resumed)
          clear_case(folder);
        std::filesystem::create_directories(folder);

        const std::vector<std::string> command = command_of(job, folder);
        job.command                            = shell_text(command);
        job.begin                              = Clock::now();
        const std::filesystem::path console    = folder / "console.txt";
        const bool                  in_copy    = options_.run_in_copy && study_.ranks == 1;
        running_.emplace(
            in_copy ? processes_.start([&] { return options_.run_in_copy(command); }, console) : processes_.start(command, console), job);
      }

      std::vector<std::string> command_of(const Job &job, const std::filesystem::path &folder) const
      {
        std::vector<std::string> command;
        if (study_.ranks > 1) // ranks die with mpirun, which dies with this process; they share the cores with other runs
          command = {"/usr/bin/env", "mpirun", "--bind-to", "none", "-np", std::to_string(study_.ranks), "setpriv", "--pdeathsig", "KILL"};
        command.insert(command.end(), {options_.program.string(), "run", study_.scene.string()});
        for (const std::string &setting : job.which->settings)
          command.insert(command.end(), {"--set", setting});
        for (const std::filesystem::path &file : options_.plugins)
          command.insert(command.end(), {"--plugin", file.string()});
        command.insert(command.end(), {"--out", folder.string(), "--quiet"});
        if (job.resumed)
          command.push_back("--resume");
        return command;
      }

      Outcome close(const Ended &end)
      {
        const Job                   job    = running_.extract(end.process).mapped();
        const std::filesystem::path folder = case_folder(options_.folder, job.which->name);
        Outcome                     outcome;
        outcome.name         = job.which->name;
        outcome.scene        = job.scene;
        outcome.command      = job.command;
        outcome.manifest     = text_of(folder / "manifest.json");
        outcome.ledger       = text_of(folder / "ledger.json");
        outcome.wall_seconds = seconds_since(job.begin);
        if (!job.resumed)
          outcome.cpu_seconds = end.cpu_seconds;
        tell_status(end, job, text_of(folder / "console.txt"), outcome);
        return outcome;
      }

      void tell_status(const Ended &end, const Job &job, const std::string &console, Outcome &outcome) const
      {
        if (end.exit_code == static_cast<int>(ExitCode::done))
          outcome.status = "done";
        else if (job.timed_out)
          {
            outcome.status = "timed out";
            outcome.reason = "not done after " + scene::format_number(study_.case_seconds) + " s";
          }
        else if (end.exit_code == static_cast<int>(ExitCode::solve_failed))
          {
            outcome.status = "failed";
            outcome.reason = on_one_line(exit_reason(outcome.manifest));
          }
        else if (end.exit_code == static_cast<int>(ExitCode::system_refused))
          {
            outcome.status = "failed";
            outcome.reason = on_one_line(console);
          }
        else if (end.exit_code == static_cast<int>(ExitCode::invalid_input))
          {
            outcome.status = "refused";
            outcome.reason = on_one_line(console);
          }
        else
          {
            outcome.status = "crashed";
            outcome.reason =
                end.signal != 0 ? "signal " + std::to_string(end.signal) + " (" + strsignal(end.signal) + ")" : on_one_line(console);
          }
      }

      void end_late_ones()
      {
        for (auto &[process, job] : running_)
          if (const double seconds = seconds_since(job.begin); seconds > study_.case_seconds)
            {
              if (!job.timed_out)
                processes_.send(process, request_to_end);
              else if (!job.killed && seconds > study_.case_seconds + grace)
                {
                  processes_.send(process, SIGKILL);
                  job.killed = true;
                }
              job.timed_out = true;
            }
      }

      /// Until the next time-out, but looking at signals twice a second.
      double wait_at_most() const
      {
        double seconds = 0.5;
        for (const auto &[process, job] : running_)
          if (!job.timed_out)
            seconds = std::min(seconds, std::max(0.001, study_.case_seconds - seconds_since(job.begin)));
        return seconds;
      }

      /// Runs that may be resumed get the time to save their state; the others are begun anew anyway.
      void stop_running()
      {
        if (!study_.resumes)
          return;
        for (const auto &[process, job] : running_)
          processes_.send(process, request_to_end);
        for (const Clock::time_point begin = Clock::now(); !running_.empty() && seconds_since(begin) < grace;)
          for (const Ended &end : processes_.wait(0.5))
            running_.erase(end.process);
      }

      const Study         &study_;
      Database            &database_;
      const RunnerOptions &options_;
      Clock::time_point    begin_;
      std::deque<Job>      open_;
      Processes            processes_;
      std::map<pid_t, Job> running_;

      std::map<std::string, std::string> checksums_; ///< of files that runs read
    };
  } // namespace

  std::filesystem::path case_folder(const std::filesystem::path &study_folder, const std::string &case_name)
  {
    return study_folder / "cases" / case_name;
  }

  RunnerReport run_cases(const Study &study, const std::vector<Case> &cases, Database &database, const RunnerOptions &options)
  {
    return Runner(study, database, options).run(cases);
  }
} // namespace myolines::study
