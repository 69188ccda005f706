#include <myolines/cli/commands.h>
#include <myolines/cli/core_share.h>
#include <myolines/cli/experiment.h>
#include <myolines/cli/resume.h>
#include <myolines/cli/stop_signals.h>
#include <myolines/output/outputs.h>
#include <myolines/output/text_file.h>

#include <ctime>

namespace myolines
{
  namespace
  {
    bool is_series(const std::string &name)
    {
      const std::string peer    = "-3d.csv";
      const bool        of_peer = name.size() > peer.size() && name.compare(name.size() - peer.size(), peer.size(), peer) == 0;
      for (const char *ours : {"reaction.csv", "energy_balance.csv", "gearing.csv", "trajectory.csv", "trace.csv", "motion.csv",
                               "nodal_states.csv", "muscle_tendon.csv", "stretches.csv", "equilibria.csv", "modes.csv", "steps.csv",
                               "ledger.json", "checkpoint", "checkpoint.new"})
        if (name == ours)
          return true;
      return of_peer || (name.rfind("force_data-3d-", 0) == 0 && name.find(".csv") != std::string::npos);
    }

    /// Removes what an earlier run left, so that old series or fields never stand beside new ones: files of our own names
    /// in a folder that holds our manifest.
    void remove_old_results(const std::filesystem::path &folder)
    {
      if (!std::filesystem::exists(folder / "manifest.json"))
        return;
      std::vector<std::filesystem::path> old;
      for (const auto &entry : std::filesystem::directory_iterator(folder))
        {
          const std::string name = entry.path().filename().string(), extension = entry.path().extension().string();
          const bool        field = name.rfind("fields", 0) == 0 && (extension == ".vtu" || extension == ".pvtu" || extension == ".pvd" ||
                                                              extension == ".h5" || extension == ".xdmf");
          const bool        table = name.rfind("quadrature-", 0) == 0 && extension == ".h5";
          if (entry.is_regular_file() && (field || table || is_series(name)))
            old.push_back(entry.path());
        }
      for (const auto &file : kept_state_files(folder))
        old.push_back(file);
      for (const auto &file : old)
        std::filesystem::remove(file);
    }

    /// Makes the folder and tries to write there; what an earlier run left goes, unless this one goes on with it.
    void prepare_folder(const std::filesystem::path &folder, const bool resume, const scene::Node &scene)
    {
      on_writing_rank("output folder " + folder.string(), "a folder that can be made and written", "choose another one with --out", [&] {
        std::filesystem::create_directories(folder);
        replace_file(folder / "scene.resolved.xml", scene::resolved_xml(scene));
        if (!resume)
          remove_old_results(folder);
      });
    }

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

    void run_with_outputs(Experiment &experiment, const OutputFolder &folder, const bool quiet, Tally &tally)
    {
      auto outputs = experiment.assembled().make_outputs(experiment.scene().section("output"), folder);
      outputs.push_back(make_status(folder, experiment.settings().start, experiment.settings().end, quiet));
      outputs.push_back(make_steps_file(folder));
      std::vector<Observer *> observers{&tally};
      for (const auto &output : outputs)
        observers.push_back(output.get());
      const StopSignals  signals;
      const std::clock_t begin = std::clock();
      experiment.run(observers, folder.path, [&] { return signals.noted(); });
      experiment.ledger().add_seconds("CPU of the run", static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    }

    void say_where_to_look(const std::filesystem::path &folder, std::ostream &out)
    {
      out << "Results are in " << folder.string() << ":\n";
      for (const char *series : {"reaction.csv", "trajectory.csv", "muscle_tendon.csv", "stretches.csv"})
        if (std::filesystem::exists(folder / series))
          out << "  *.csv        time series, units in the header, for example\n"
              << "               gnuplot -p -e \"set datafile separator ','; set key autotitle columnhead; plot '"
              << (folder / series).string() << "' using 1:2 with lines\"\n";
      if (std::filesystem::exists(folder / "fields.pvd"))
        out << "  fields.pvd   fields, for ParaView\n";
      if (std::filesystem::exists(folder / "fields.xdmf"))
        out << "  fields.xdmf  fields, for ParaView\n";
      out << "  steps.csv, run.log, ledger.json   steps, iterations and work\n"
          << "  checkpoint   the last state: --resume goes on from it, --set time/end=... extends the run\n"
          << "  scene.resolved.xml, manifest.json   what was run, and with what\n";
    }

    CheckpointReader open_checkpoint(const std::filesystem::path &folder)
    {
      try
        {
          return CheckpointReader(checkpoint_file(folder));
        }
      catch (const InputError &error)
        {
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
      const double t = reader.contents().state.t;
      if (t > experiment.settings().end)
        experiment.scene().section("time").refuse("end", "the run to resume has passed the end: it is at t = " + exact_text(t) + " s",
                                                  "a time that it has not reached");
      return reader.read(*experiment.assembled().system);
    }

    /// "after step 4 at t = 0.1 s; ranks: 2 instead of 1".
    std::string resumed_text(const Checkpoint &checkpoint)
    {
      std::string text = "after step " + std::to_string(checkpoint.step) + " at t = " + exact_text(checkpoint.state.t) + " s";
      for (const std::string &change : changes_of_machine(checkpoint))
        text += "; " + change + " (results agree to solver tolerance)";
      return text;
    }

    std::string how_to_resume(const RunOptions &options, const std::filesystem::path &folder)
    {
      if (!std::filesystem::exists(checkpoint_file(folder)))
        return "";
      return "\nThe last accepted state is saved. To resume: " + options.command_line + (options.resume ? "" : " --resume");
    }
  } // namespace

  void run_command(const RunOptions &options, std::ostream &out)
  {
    const std::string           started = iso8601_now();
    Experiment                  experiment(read_whole_scene(options.scene, options.overrides));
    const std::filesystem::path folder = options.folder.empty() ? std::filesystem::path("results") / options.scene.stem() : options.folder;

    std::optional<Checkpoint> checkpoint;
    std::string               resumed;
    if (options.resume)
      {
        checkpoint = read_checkpoint(experiment, options, folder);
        resumed    = resumed_text(*checkpoint);
        if (checkpoint->state.t == experiment.settings().end && run_is_done(folder))
          {
            if (!options.quiet)
              out << "The run in " << folder.string() << " is finished: " << checkpoint->step
                  << " steps to t = " << exact_text(checkpoint->state.t) << " s. A later end extends it: --set time/end=...\n";
            return;
          }
        experiment.resume(*checkpoint);
        if (!options.quiet)
          out << "Resumed " << resumed << ".\n";
      }

    prepare_folder(folder, options.resume, experiment.scene());
    const auto book = [&](const std::string &reason) { write_manifest(folder, options.command_line, started, resumed, reason); };
    book("running"); // what a killed run leaves
    const auto close = [&](const std::string &reason) {
      book(reason);
      write_ledger(folder, experiment.ledger());
    };
    if (!options.quiet)
      {
        for (const std::string &warning : experiment.warnings())
          out << "Warning: " << warning << "\n";
        if (const auto warning = warning_of_shared_cores())
          out << "Warning: " << *warning << "\n";
      }
    Tally tally;
    try
      {
        run_with_outputs(experiment, {folder, checkpoint ? &checkpoint->outputs : nullptr}, options.quiet, tally);
      }
    catch (const SolveError &error)
      {
        close(error.what());
        throw SolveError(error.what() + how_to_resume(options, folder));
      }
    catch (const Interrupted &error)
      {
        close(error.what());
        throw Interrupted(error.what() + how_to_resume(options, folder));
      }
    catch (const std::exception &error)
      {
        close(error.what());
        throw;
      }
    close("done");
    if (options.quiet)
      return;
    out << "Done: " << tally.steps << " steps to t = " << exact_text(tally.t) << " s, " << tally.rejections << " rejected.\n";
    say_where_to_look(folder, out);
  }
} // namespace myolines
