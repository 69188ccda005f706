#include <myolines/cli/commands.h>
#include <myolines/cli/experiment.h>
#include <myolines/output/outputs.h>
#include <myolines/output/text_file.h>

#include <deal.II/base/mpi.h>

namespace myolines
{
  namespace
  {
    bool is_series(const std::string &name)
    {
      const std::string peer    = "-3d.csv";
      const bool        of_peer = name.size() > peer.size() && name.compare(name.size() - peer.size(), peer.size(), peer) == 0;
      for (const char *ours : {"reaction.csv", "energy_balance.csv", "gearing.csv", "trajectory.csv", "trace.csv", "nodal_states.csv", "steps.csv", "ledger.json"})
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
          const bool        field = name.rfind("fields", 0) == 0 && (extension == ".vtu" || extension == ".pvtu" || extension == ".pvd");
          if (entry.is_regular_file() && (field || is_series(name)))
            old.push_back(entry.path());
        }
      for (const auto &file : old)
        std::filesystem::remove(file);
    }

    /// Makes the folder and tries to write there, on the one rank that writes; all ranks learn the verdict.
    void prepare_folder(const std::filesystem::path &folder)
    {
      std::string problem;
      if (writes_files())
        try
          {
            std::filesystem::create_directories(folder);
            replace_file(folder / "scene.resolved.xml", "");
            remove_old_results(folder);
          }
        catch (const std::exception &error)
          {
            problem = error.what();
          }
      problem = dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, problem);
      if (!problem.empty())
        throw InputError(InputProblem{"output folder " + folder.string(), problem, "a folder that can be made and written",
                                      "choose another one with --out"});
    }

    /// Counts what happened, for the closing words.
    class Tally : public Observer
    {
    public:
      void accepted(const State &state, const StepRecord &record) override
      {
        t     = state.t;
        steps = record.number;
      }
      void rejected(const StepRecord &) override { ++rejections; }

      double      t     = 0;
      std::size_t steps = 0, rejections = 0;
    };

    void run_with_outputs(Experiment &experiment, const std::filesystem::path &folder, const bool quiet, Tally &tally)
    {
      auto outputs = experiment.assembled().make_outputs(experiment.scene().section("output"), folder);
      outputs.push_back(make_status(folder, experiment.settings().start, experiment.settings().end, quiet));
      outputs.push_back(make_steps_file(folder));
      std::vector<Observer *> observers{&tally};
      for (const auto &output : outputs)
        observers.push_back(output.get());
      experiment.run(observers);
    }

    void say_where_to_look(const std::filesystem::path &folder, std::ostream &out)
    {
      out << "Results are in " << folder.string() << ":\n";
      for (const char *series : {"reaction.csv", "trajectory.csv"})
        if (std::filesystem::exists(folder / series))
          out << "  *.csv        time series, units in the header, for example\n"
              << "               gnuplot -p -e \"set datafile separator ','; set key autotitle columnhead; plot '"
              << (folder / series).string() << "' using 1:2 with lines\"\n";
      if (std::filesystem::exists(folder / "fields.pvd"))
        out << "  fields.pvd   fields, for ParaView\n";
      out << "  steps.csv, run.log, ledger.json   steps, iterations and work\n"
          << "  scene.resolved.xml, manifest.json   what was run, and with what\n";
    }
  } // namespace

  void run_command(const RunOptions &options, std::ostream &out)
  {
    const std::string           started = iso8601_now();
    Experiment                  experiment(read_whole_scene(options.scene, options.overrides));
    const std::filesystem::path folder = options.folder.empty() ? std::filesystem::path("results") / options.scene.stem() : options.folder;
    prepare_folder(folder);
    replace_file(folder / "scene.resolved.xml", scene::resolved_xml(experiment.scene()));

    write_manifest(folder, options.command_line, started, "running"); // what a killed run leaves

    const auto close = [&](const std::string &reason) {
      write_manifest(folder, options.command_line, started, reason);
      write_ledger(folder, experiment.ledger());
    };
    Tally tally;
    try
      {
        run_with_outputs(experiment, folder, options.quiet, tally);
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
