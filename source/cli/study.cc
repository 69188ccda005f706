// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/cli/candidates.h>
#include <myolines/cli/catalogue.h>
#include <myolines/cli/commands.h>
#include <myolines/cli/memory.h>
#include <myolines/cli/program.h>
#include <myolines/cli/refinements.h>
#include <myolines/cli/stop_signals.h>
#include <myolines/study/processes.h>

#include <unistd.h>

#include <algorithm>
#include <iostream>

namespace myolines
{
  namespace
  {
    /// How this program starts its own runs. The object lives as long as the driver is used.
    class RunsOfThisProgram
    {
    public:
      explicit RunsOfThisProgram(MpiSession &mpi)
        : mpi_(mpi)
      {}

      void set_up(study::Driver &driver, const bool quiet)
      {
        driver.program   = study::this_program();
        driver.start_mpi = [this] { mpi_.start(); };
        if (!mpi_.started())
          driver.run_in_copy = [this](const std::vector<std::string> &command) {
            std::vector<const char *> words;
            for (const std::string &word : command)
              words.push_back(word.c_str());
            const int exit_code = program(static_cast<int>(words.size()), words.data(), mpi_);
            mpi_.end();
            return exit_code;
          };
        driver.stop_signal = [this] { return signals_.noted(); };
        driver.terminal    = !quiet && isatty(STDOUT_FILENO) ? &std::cout : nullptr;
        driver.resolve     = [this](const std::filesystem::path &scene, const std::vector<std::string> &settings) {
          const scene::Node node = read_whole_scene(scene, settings);
          largest_               = std::max(largest_, memory_of_a_rank(node));
          return scene::resolved_xml(node);
        };
        driver.fitting_jobs = [this](const unsigned int wanted, const unsigned int ranks, const bool asked_for) {
          return jobs_that_fit(largest_ + (ranks - 1) * memory_of_the_program, wanted, asked_for);
        };
      }

    private:
      MpiSession       &mpi_;
      const StopSignals signals_;
      double            largest_ = 0; ///< memory of a rank of a case
    };
  } // namespace

  void study_command(study::Options options, const bool quiet, MpiSession &mpi, std::ostream &out)
  {
    RunsOfThisProgram runs(mpi);
    runs.set_up(options, quiet);
    std::ostream nowhere(nullptr);
    study::study_command(options, quiet ? nowhere : out);
  }

  void verify_command(study::VerifyOptions options, const bool quiet, MpiSession &mpi, std::ostream &out)
  {
    RunsOfThisProgram runs(mpi);
    runs.set_up(options, quiet);
    options.refinements = refinements_of;
    std::ostream nowhere(nullptr);
    study::verify_command(options, quiet ? nowhere : out);
  }

  void advise_command(study::AdviseOptions options, const bool quiet, MpiSession &mpi, std::ostream &out)
  {
    RunsOfThisProgram runs(mpi);
    runs.set_up(options, quiet);
    options.choices    = choices_of;
    options.scene_text = [](const std::filesystem::path &scene, const std::vector<std::string> &settings) {
      return scene::written_xml(read_whole_scene(scene, settings));
    };
    std::ostream nowhere(nullptr);
    study::advise_command(options, quiet ? nowhere : out);
  }
} // namespace myolines
