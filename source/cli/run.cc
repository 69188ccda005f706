// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/checksum.h>
#include <myolines/base/counted.h>
#include <myolines/base/named_instruction_set.h>
#include <myolines/base/names.h>
#include <myolines/base/on_one_rank.h>
#include <myolines/cli/commands.h>
#include <myolines/cli/core_share.h>
#include <myolines/cli/experiment.h>
#include <myolines/cli/plan.h>
#include <myolines/cli/plugins.h>
#include <myolines/cli/resume.h>
#include <myolines/cli/stop_signals.h>
#include <myolines/observers/outputs.h>
#include <myolines/output/csv_file.h>
#include <myolines/output/energy_watch.h>
#include <myolines/output/manifest.h>
#include <myolines/output/run_folder.h>
#include <myolines/output/step_records.h>
#include <myolines/output/text_file.h>

#include <ctime>

namespace myolines
{
  namespace
  {
    /// Counts what happened, for the closing words.
    class Tally : public Observer
    {
    public:
      void resume(const State &state, const std::size_t step) override
      {
        t     = state.t;
        steps = step;
      }
      void accepted(const State &state, const StepRecord &record) override { resume(state, record.number); }
      void rejected(const StepRecord &) override { ++rejections; }

      double      t     = 0;
      std::size_t steps = 0, rejections = 0;
    };

    using Outputs = std::vector<std::unique_ptr<Observer>>;

    std::optional<EnergyReport> energy_of_run(const Outputs &outputs)
    {
      for (const auto &output : outputs)
        if (const EnergyBalance *balance = output->energy_balance(); balance != nullptr && balance->started())
          return balance->report();
      return std::nullopt;
    }

    void run_with_outputs(Experiment &experiment, const OutputFolder &folder, const RunOptions &options, Tally &tally, Outputs &outputs,
                          const StopSignals &signals, const Warn &warn)
    {
      outputs = experiment.make_outputs(folder);
      outputs.push_back(make_status(folder, experiment.settings().start, experiment.settings().end, options.quiet, warn));
      outputs.push_back(make_steps_file(folder));
      std::vector<Observer *> observers{&tally};
      for (const auto &output : outputs)
        observers.push_back(output.get());
      observers.insert(observers.end(), options.watchers.begin(), options.watchers.end());
      const std::clock_t begin = std::clock();
      experiment.run(observers, folder.path, [&] { return signals.noted(); });
      folder.close();
      experiment.ledger().add_seconds("CPU of the run", static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    }

    void say_where_to_look(const std::string &program, const OutputFolder &folder, std::ostream &out)
    {
      const auto is_written = [&folder](const std::string &name) { return folder.noted().count(name) > 0; };
      out << "Results are in " << shell_text({folder.path.string()}) << ":\n"
          << "  *.csv        time series, units in the header; pictures of them:\n"
          << "               " << shell_text({program, "plot", folder.path.string()}) << "\n"
          << "               all in one page: " << shell_text({program, "report", folder.path.string()}) << "\n";
      for (const char *fields : {"fields.pvd", "fields.xdmf"})
        if (is_written(fields))
          out << "  " << fields << std::string(13 - std::string(fields).size(), ' ')
              << "fields, for ParaView and: " << shell_text({program, "picture", folder.path.string()}) << "\n";
      out << "  steps.csv, run.log, ledger.json   steps, iterations and work\n"
          << "  checkpoint   the last state: --resume goes on from it, --set time/end=... extends the run\n"
          << "  scene.resolved.xml, manifest.json   what was run, and with what\n";
    }

    /// "Not defined, and left empty: gearing.csv (Gearing)".
    void say_what_is_empty(const OutputFolder &folder, std::ostream &out)
    {
      std::vector<std::string> tables;
      for (const auto &[file, columns] : folder.left_empty())
        tables.push_back(file + " (" + join({columns.begin(), columns.end()}) + ")");
      if (!tables.empty())
        out << "Some cells are empty, as there is no such number there: " << join(tables, "; ") << "\n";
    }

    InstructionSet chosen_set(const RunOptions &options)
    {
      return options.instruction_set.empty() ? widest_instruction_set() : instruction_set_named(options.instruction_set);
    }

    CheckpointReader open_checkpoint(const std::filesystem::path &folder)
    {
      try
        {
          return CheckpointReader(checkpoint_file(folder));
        }
      catch (const InputError &error)
        {
          if (std::filesystem::exists(checkpoint_file(folder)))
            throw; // it is damaged
          InputProblem problem = error.problems().front();
          problem.hint         = "name the folder of the run with --out; a run that has no checkpoint yet is started without --resume";
          throw InputError(problem);
        }
    }

    /// The checkpoint in @p folder, if it is one of this scene that has not passed its end.
    Checkpoint read_checkpoint(const Experiment &experiment, const RunOptions &options, const std::filesystem::path &folder)
    {
      const CheckpointReader reader = open_checkpoint(folder);
      refuse_other_run(reader.contents().scene, scene::resolved_xml(experiment.scene()), options.scene.string());
      refuse_other_mesh(experiment.scene(), reader.contents().inputs);
      const double t = reader.contents().state.t;
      if (t > experiment.settings().end)
        experiment.scene().section("time").refuse("end", "the run to resume has passed the end: it is at t = " + exact_text(t) + " s",
                                                  "a time that it has not reached");
      return reader.read(*experiment.assembled().system);
    }

    /// The same file, or the plug-in of the same name, which may lie elsewhere by now.
    bool is_same_input(const std::filesystem::path &one, const std::filesystem::path &other)
    {
      return one == other || (one.extension() == ".so" && one.filename() == other.filename());
    }

    /// Files that the scene names, and plug-ins, that are not as they were when the run was kept: its past was computed with others.
    std::vector<std::string> changed_inputs(const Checkpoint &checkpoint, const std::map<std::string, std::string> &now)
    {
      std::vector<std::string> changed;
      for (const auto &[file, checksum] : checkpoint.inputs)
        if (const auto found = std::find_if(now.begin(), now.end(), [&](const auto &input) { return is_same_input(input.first, file); });
            found != now.end() && found->second != checksum)
          changed.push_back(found->first + " has changed since: what comes before was computed with another content");
      return changed;
    }

    /// "after step 4 at t = 0.1 s; ranks: 2 instead of 1".
    std::string resumed_text(const Checkpoint &checkpoint, const InstructionSet set, const std::vector<std::string> &changed)
    {
      std::string text = "after step " + std::to_string(checkpoint.step) + " at t = " + exact_text(checkpoint.state.t) + " s";
      for (const std::string &change : changes_of_machine(checkpoint, set))
        text += "; " + change + " (results agree to solver tolerance)";
      for (const std::string &change : changed)
        text += "; " + change;
      return text;
    }

    /// @p error with a @p hint behind it.
    template <typename Error>
    [[noreturn]] void pass_on(const Error &error, const std::string &hint)
    {
      if (dynamic_cast<const OnOneRank<Error> *>(&error) != nullptr)
        throw OnOneRank<Error>(error.what() + hint);
      throw Error(error.what() + hint);
    }

    std::string how_to_resume(const RunOptions &options, const std::filesystem::path &folder)
    {
      if (!std::filesystem::exists(checkpoint_file(folder)))
        return "";
      std::string command = options.command_line;
      if (const std::string once = " --overwrite"; options.overwrite)
        command.erase(command.find(once), once.size());
      return "\nA state is saved. To resume: " + command + (options.resume ? "" : " --resume");
    }
  } // namespace

  void run_command(const RunOptions &options, std::ostream &out)
  {
    const StopSignals signals; // one that comes before the first step ends the run there, with a state to go on from
    RunRecord         record{options.command_line, "", iso8601_now(), "", {}, {}};
    Experiment        experiment(options.made ? *options.made : read_whole_scene(options.scene, options.overrides), chosen_set(options));
    const std::filesystem::path path = options.folder.empty() ? std::filesystem::path("results") / options.scene.stem() : options.folder;
    const std::string           resolved = scene::resolved_xml(experiment.scene());
    record.scene                         = options.made ? options.scene.string() : std::filesystem::absolute(options.scene).string();
    record.inputs                        = experiment.inputs();
    record.instruction_set               = name(experiment.instruction_set());
    record.plan                          = plan_of(experiment);
    record.warnings                      = experiment.warnings();
    record.outputs                       = experiment.output_files();
    for (const Plugin &plugin : plugins())
      record.plugins[plugin.file.string()] = plugin.brings;
    if (writes_files() && !options.made)
      record.inputs[options.scene.string()] = checksum_of_file(options.scene);

    if (options.resume)
      open_checkpoint(path); // or nothing is made there
    const RunFolder           folder(path);
    std::optional<Checkpoint> checkpoint;
    if (options.resume)
      {
        checkpoint         = read_checkpoint(experiment, options, path);
        const auto changed = changed_inputs(*checkpoint, experiment.inputs());
        record.resumed     = resumed_text(*checkpoint, experiment.instruction_set(), changed);
        for (const std::string &change : changed)
          out << "Warning: " << change << "\n";
        if (checkpoint->state.t == experiment.settings().end && run_is_done(path))
          {
            if (!options.quiet)
              out << "The run in " << path.string() << " is finished: " << counted(checkpoint->step, "step")
                  << " to t = " << exact_text(checkpoint->state.t) << " s. A later end extends it: --set time/end=...\n";
            return;
          }
        require_tables(path, checkpoint->outputs);
        experiment.resume(*checkpoint);
        if (!options.quiet)
          out << "Resumed " << record.resumed << ".\n";
      }

    const OutputFolder outputs =
        checkpoint ? folder.resume(resolved, checkpoint->outputs, record) : folder.begin(resolved, options.overwrite, record);
    Outputs    observers;
    const auto close = [&](const std::string &reason) {
      record.energy = energy_of_run(observers);
      write_manifest(outputs, record, reason);
      write_ledger(outputs, experiment.ledger());
    };
    const auto close_failed = [&](const std::string &reason) {
      try
        {
          close(reason);
        }
      catch (const SystemError &)
        {} // never in place of the first reason
    };
    const auto tell_energy = [&] {
      if (record.energy && !options.quiet)
        for (const std::string &line : energy_lines(*record.energy, experiment.method().name))
          out << line << "\n";
    };
    if (!options.quiet)
      {
        for (const std::string &warning : record.warnings)
          out << "Warning: " << warning << "\n";
        if (const auto warning = warning_of_shared_cores())
          out << "Warning: " << *warning << "\n";
      }
    const auto warn = [&](const std::string &warning) {
      record.warnings.push_back(warning);
      if (!options.quiet)
        out << "Warning: " << warning << "\n" << std::flush;
    };
    Tally tally;
    try
      {
        run_with_outputs(experiment, outputs, options, tally, observers, signals, warn);
      }
    catch (const SolveError &error)
      {
        close_failed(error.what());
        tell_energy();
        pass_on(error, how_to_resume(options, path));
      }
    catch (const Interrupted &error)
      {
        close_failed(error.what());
        pass_on(error, how_to_resume(options, path));
      }
    catch (const SystemError &error)
      {
        close_failed(std::string("the system refused: ") + error.what());
        throw SystemError(error.what() + how_to_resume(options, path), error.error_number());
      }
    catch (const std::exception &error)
      {
        close_failed(error.what());
        throw;
      }
    close("done");
    if (options.quiet)
      return;
    out << "Done: " << counted(tally.steps, "step") << " to t = " << exact_text(tally.t) << " s, " << tally.rejections << " rejected.\n";
    tell_energy();
    say_what_is_empty(outputs, out);
    say_where_to_look(options.program, outputs, out);
  }
} // namespace myolines
