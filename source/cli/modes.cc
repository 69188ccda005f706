#include <myolines/cli/commands.h>
#include <myolines/cli/experiment.h>
#include <myolines/output/csv_file.h>
#include <myolines/solve/modes.h>

#include <algorithm>
#include <cmath>

namespace myolines
{
  namespace
  {
    /// "oscillates", "grows", ...: what a small motion e^(w t) does.
    std::string kind(const std::complex<double> &w)
    {
      const double rounding = 1e-9 * std::abs(w);
      const char  *size     = w.real() > rounding ? "grows" : w.real() < -rounding ? "decays" : "stays";
      return std::string(size) + (std::abs(w.imag()) > rounding ? ", oscillates" : "");
    }
  } // namespace

  void modes_command(const std::filesystem::path &scene, const std::vector<std::string> &overrides, const std::filesystem::path &file,
                     std::ostream &out)
  {
    constexpr std::size_t printed = 20;
    const Experiment      experiment(read_whole_scene(scene, overrides));
    const auto           &system = *experiment.assembled().system;
    const State           state  = system.initial_state(experiment.settings().start);
    Vector                r(state.u);
    const Evaluation      evaluation = system.residual({state.t, Side::right, state.u, state.v, state.a}, r);
    if (!evaluation.admissible)
      throw SolveError("The initial state is inadmissible: " + evaluation.reason + ".");
    const auto        all     = modes(system, state);
    const std::size_t growing = std::count_if(all.begin(), all.end(), [](const auto &w) { return w.real() > 1e-9 * std::abs(w); });

    out << "Small motions e^(w t) about the initial state: " << all.size() << ", of which " << growing << " grow\n"
        << "  growth rate Re w [1/s]   Im w [1/s]\n";
    for (std::size_t i = 0; i < std::min(printed, all.size()); ++i)
      out << "  " << all[i].real() << "   " << all[i].imag() << "   " << kind(all[i]) << "\n";
    if (all.size() > printed)
      out << "  ... and " << all.size() - printed << " more that decay faster\n";
    if (file.empty())
      return;
    const std::filesystem::path folder = file.parent_path();
    CsvFile csv({folder.empty() ? "." : folder}, file.filename().string(), {"growth rate [1/s]", "imaginary part [1/s]"});
    for (const auto &w : all)
      csv.row(std::vector<double>{w.real(), w.imag()});
  }
} // namespace myolines
