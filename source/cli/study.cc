#include <myolines/cli/catalogue.h>
#include <myolines/cli/commands.h>
#include <myolines/cli/stop_signals.h>
#include <myolines/study/processes.h>

#include <unistd.h>

#include <iostream>

namespace myolines
{
  void study_command(study::Options options, const bool quiet, std::ostream &out)
  {
    const StopSignals signals;
    options.program     = study::this_program();
    options.stop_signal = [&signals] { return signals.noted(); };
    options.terminal    = !quiet && isatty(STDOUT_FILENO) ? &std::cout : nullptr;
    options.resolve     = [](const std::filesystem::path &scene, const std::vector<std::string> &settings) {
      return scene::resolved_xml(read_whole_scene(scene, settings));
    };
    std::ostream nowhere(nullptr);
    study::study_command(options, quiet ? nowhere : out);
  }
} // namespace myolines
