#include <myolines/cli/commands.h>
#include <myolines/cli/experiment.h>
#include <myolines/output/outputs.h>
#include <myolines/output/text_file.h>

#include <deal.II/base/mpi.h>

namespace myolines
{
  namespace
  {
    /// Makes the folder and tries to write there, on the one rank that writes; all ranks learn the verdict.
    void prepare_folder(const std::filesystem::path &folder)
    {
      std::string problem;
      if (writes_files())
        try
          {
            std::filesystem::create_directories(folder);
            replace_file(folder / "scene.resolved.xml", "");
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
