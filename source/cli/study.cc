#include <myolines/cli/catalogue.h>
#include <myolines/cli/commands.h>
#include <myolines/cli/memory.h>
#include <myolines/cli/program.h>
#include <myolines/cli/stop_signals.h>
#include <myolines/study/processes.h>

#include <unistd.h>

#include <algorithm>
#include <iostream>

namespace myolines
{
  void study_command(study::Options options, const bool quiet, MpiSession &mpi, std::ostream &out)
  {
    const StopSignals signals;
    options.program   = study::this_program();
    options.start_mpi = [&mpi] { mpi.start(); };
    if (!mpi.started())
      options.run_in_copy = [&mpi](const std::vector<std::string> &command) {
        std::vector<const char *> words;
        for (const std::string &word : command)
          words.push_back(word.c_str());
        const int exit_code = program(static_cast<int>(words.size()), words.data(), mpi);
        mpi.end();
        return exit_code;
      };
    options.stop_signal = [&signals] { return signals.noted(); };
    options.terminal    = !quiet && isatty(STDOUT_FILENO) ? &std::cout : nullptr;
    double largest      = 0; // memory of a rank of a case
    options.resolve     = [&largest](const std::filesystem::path &scene, const std::vector<std::string> &settings) {
      const scene::Node node = read_whole_scene(scene, settings);
      largest                = std::max(largest, memory_of_a_rank(node));
      return scene::resolved_xml(node);
    };
    options.fitting_jobs = [&largest](const unsigned int wanted, const unsigned int ranks, const bool asked_for) {
      return jobs_that_fit(largest + (ranks - 1) * memory_of_the_program, wanted, asked_for);
    };
    std::ostream nowhere(nullptr);
    study::study_command(options, quiet ? nowhere : out);
  }
} // namespace myolines
