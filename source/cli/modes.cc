// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/cli/commands.h>
#include <myolines/cli/experiment.h>
#include <myolines/cli/resume.h>
#include <myolines/output/csv_file.h>
#include <myolines/output/manifest.h>
#include <myolines/output/text_file.h>
#include <myolines/solve/modes.h>
#include <myolines/solve/tangent_eigenvalues.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

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

    OutputFolder folder_of(const std::filesystem::path &file)
    {
      const std::filesystem::path folder = file.parent_path();
      return {folder.empty() ? "." : folder};
    }

    /// Told before anything is computed.
    void require_writable(const std::filesystem::path &file)
    {
      on_writing_rank(file.string(), "a file that can be made and written", "choose another one with --out", [&file] {
        if (!std::ofstream(file, std::ios::app))
          throw std::runtime_error("cannot write it");
      });
    }

    /// The kept states of the run in @p folder, all or the one at the time @p at.
    std::vector<CheckpointReader> kept_states(const std::filesystem::path &folder, const std::optional<double> at,
                                              const Experiment &experiment, const std::filesystem::path &scene)
    {
      if (!std::filesystem::is_directory(folder))
        throw InputError(InputProblem{"--along " + folder.string(),
                                      std::filesystem::exists(folder) ? "it is a file, not a folder" : "there is no such folder",
                                      "the output folder of a run with the list output/checkpoint/keep", ""});
      std::vector<CheckpointReader> states;
      std::string                   times;
      for (const std::filesystem::path &file : kept_state_files(folder))
        {
          CheckpointReader reader(file);
          const double     t = reader.contents().state.t;
          times += " " + exact_text(t);
          if (at && std::abs(t - *at) > 1e-9 * std::abs(*at))
            continue;
          refuse_other_run(reader.contents().scene, scene::resolved_xml(experiment.scene()), scene.string());
          states.push_back(std::move(reader));
        }
      if (states.empty())
        throw InputError(InputProblem{folder.string(),
                                      at && !times.empty() ? "no state was kept at " + exact_text(*at) + " s" : "no states were kept",
                                      times.empty() ? "a run with the list output/checkpoint/keep" : "one of the times" + times, ""});
      return states;
    }
  } // namespace

  void modes_command(const std::filesystem::path &scene, const std::vector<std::string> &overrides, const std::filesystem::path &file,
                     std::ostream &out)
  {
    constexpr std::size_t printed = 20;
    const Experiment      experiment(read_whole_scene(scene, overrides));
    if (!file.empty())
      require_writable(file);
    const auto      &system = *experiment.assembled().system;
    const State      state  = system.initial_state(experiment.settings().start);
    Vector           r(state.u);
    const Evaluation evaluation = system.residual({state.t, Side::right, state.u, state.v, state.a}, r);
    if (!evaluation.admissible)
      throw SolveError("The initial state is inadmissible: " + evaluation.reason + ".");
    const auto        all     = modes(system, state);
    const std::size_t growing = std::count_if(all.begin(), all.end(), [](const auto &w) { return w.real() > 1e-9 * std::abs(w); });

    out << "Small motions e^(w t) about the initial state: " << all.size() << ", of which " << growing << " grow\n"
        << "  growth rate Re w [1/s]   Im w [1/s]\n";
    for (std::size_t i = 0; i < std::min(printed, all.size()); ++i)
      out << "  " << all[i].real() + 0. << "   " << all[i].imag() + 0. << "   " /* no -0 */ << kind(all[i]) << "\n";
    if (all.size() > printed)
      out << "  ... and " << all.size() - printed << " with smaller growth rates\n";
    if (file.empty())
      return;
    CsvFile csv(folder_of(file), file.filename().string(), {"growth rate [1/s]", "imaginary part [1/s]"});
    for (const auto &w : all)
      csv.row(std::vector<double>{w.real(), w.imag()});
    csv.close();
  }

  void modes_along_command(const ModesAlongOptions &options, std::ostream &out)
  {
    Experiment               experiment(read_whole_scene(options.scene, options.overrides));
    const auto              &system         = *experiment.assembled().system;
    const scene::Node       &preconditioner = experiment.scene().section("solver").section("preconditioner");
    const std::string        unit           = system.capabilities().inertia ? "[1/s^2]" : "[N/m]";
    const auto               states         = kept_states(options.run, options.at, experiment, options.scene);
    std::vector<std::string> columns{"Time [s]"};
    for (unsigned int i = 1; i <= options.number; ++i)
      columns.push_back("eigenvalue " + std::to_string(i) + " " + unit);

    const std::filesystem::path file = options.file.empty() ? options.run / "modes.csv" : options.file;
    require_writable(file);
    CsvFile csv(folder_of(file), file.filename().string(), columns);
    if (options.file.empty())
      list_in_manifest(options.run, {file.filename().string()});
    out << "Smallest eigenvalues of the tangent " << unit << ", at rest in the configurations of " << options.run.string() << "\n";
    std::optional<std::pair<double, double>> before; // time, smallest eigenvalue
    for (const CheckpointReader &reader : states)
      {
        const State         state  = reader.read(system).state;
        std::vector<double> values = tangent_eigenvalues(system, state, options.number, preconditioner, experiment.ledger());
        out << "  t = " << state.t << " s:";
        for (const double value : values)
          out << " " << value;
        out << "\n";
        if (before && (before->second > 0) != (values.front() > 0))
          out << "  the smallest changes its sign at t = "
              << before->first + (state.t - before->first) * before->second / (before->second - values.front()) << " s, by interpolation\n";
        before = {state.t, values.front()};
        values.insert(values.begin(), state.t);
        csv.row(values);
      }
    csv.close();
  }
} // namespace myolines
