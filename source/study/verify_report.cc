// SPDX-License-Identifier: LGPL-2.1-or-later
#include "number_text.h"
#include "runs_table.h"
#include "verify_results.h"

#include <myolines/base/names.h>
#include <myolines/output/csv_file.h>
#include <myolines/output/text_file.h>
#include <myolines/study/results.h>

#include <cmath>

namespace myolines::study
{
  namespace
  {
    /// "time/step = 0.0125" has the label "0.0125" on its ladder; the scene is on both.
    const std::string &label(const VerifyRun &run, const Ladder &ladder)
    {
      return run.part == VerifyRun::Part::scene ? ladder.rungs[ladder.scene].label : run.rung.label;
    }

    std::string approach_word(const Approach approach)
    {
      switch (approach)
        {
        case Approach::at_once:
          return "no difference";
        case Approach::as_in_theory:
          return "as in theory";
        case Approach::at_another_rate:
          return "not the rate of theory";
        case Approach::alternating:
          return "alternating";
        case Approach::irregular:
          return "no rate";
        case Approach::unseen:
          break;
        }
      return "two values";
    }

    std::string rate_text(const LadderError &found)
    {
      const DiscretisationError &error  = *found.error;
      const std::string          theory = digits(found.ladder->order, 3), safety = "; factor of safety " + digits(error.safety, 3);
      switch (error.approach)
        {
        case Approach::at_once:
          return "no difference";
        case Approach::as_in_theory:
          return "rate " + digits(*error.rate, 3) + ", theory " + theory;
        case Approach::at_another_rate:
          return "rate " + digits(*error.rate, 3) + ", which is not that of theory, " + theory + safety;
        case Approach::alternating:
          return "differences change sign, rate " + digits(*error.assumed, 3) + " is taken, theory " + theory + safety;
        case Approach::irregular:
          return "no rate: differences do not shrink; the error is three times the range";
        case Approach::unseen:
          break;
        }
      return "two values show no rate, " + digits(*error.assumed, 3) + " is taken" + safety;
    }

    std::string heading_of_line(const std::string &name, const std::optional<double> &error)
    {
      std::string text = "  " + name;
      text.resize(10, ' ');
      if (error)
        text += "+- " + digits(*error, 2);
      text.resize(24, ' ');
      return text;
    }

    std::string ladder_line(const LadderError &found, const double error_of_all)
    {
      const Ladder     &ladder = *found.ladder;
      const std::string note   = ladder.note.empty() ? "" : "; " + ladder.note;
      if (!found.error)
        return heading_of_line(ladder.name, {}) + "no estimate" + (note.empty() ? "; the other runs are not done" : note) + "\n";
      std::vector<std::string> values;
      for (std::size_t i = 0; i < found.runs.size(); ++i)
        values.push_back(label(*found.runs[i], ladder) + ": " + value_text(found.values[i], error_of_all));
      return heading_of_line(ladder.name, found.error->error) + ladder.parameter + " " + join(values) + "; " + rate_text(found) + note +
             "\n";
    }

    std::string degree_line(const VerifiedValue &found, const VerifyRun &run, const Refinements &refinements, const double error_of_all)
    {
      const bool counts = refinements.higher && found.mesh_error > (found.mesh.error ? found.mesh.error->error : 0);
      return heading_of_line("degree", counts ? found.mesh_error : std::nullopt) + refinements.degree_name + " " + run.rung.label + ": " +
             value_text(*found.other_degree, error_of_all) + ", on the mesh of the scene" +
             (counts ? "; its distance is taken for the error of the mesh" : "") + "\n";
    }

    std::string method_line(const VerifiedValue &found, const VerifyRun &run, const Refinements &refinements, const double error_of_all)
    {
      const double distance = std::abs(*found.other_method - found.value);
      const bool   counts   = distance > 0 && distance >= *found.steps_error;
      return heading_of_line("method", counts ? found.steps_error : std::nullopt) + refinements.method_name + " " + run.rung.label + ": " +
             value_text(*found.other_method, error_of_all) + ", with the steps of the scene" +
             (counts ? "; its distance is taken for the error of the steps" : "") + "\n";
    }

    std::string least_damping_line(const VerifiedValue &found, const VerifyRun &run, const Refinements &refinements,
                                   const double error_of_all)
    {
      const auto by        = [&](const double error) { return error > 0 && error >= *found.steps_error; };
      const bool distance  = by(std::abs(*found.least_damped - found.value)),
                 vibration = !distance && *found.vibration > 0 && !by(found.steps.error ? found.steps.error->error : 0) &&
                             !by(found.other_method ? std::abs(*found.other_method - found.value) : 0);
      std::string text = heading_of_line("damping", distance || vibration ? found.steps_error : std::nullopt) + refinements.method_name +
                         " " + refinements.least_damping->label + ", which damps least, " + refinements.steps.parameter + " " +
                         run.rung.label + ": " + value_text(*found.least_damped, error_of_all);
      if (*found.vibration > 0)
        text += ", in a vibration of +- " + digits(*found.vibration, 2);
      if (distance)
        return text + "; its distance is taken for the error of the steps\n";
      return text + (vibration ? "; three times that is in the error of the steps. A mean over time is surer than one instant\n" : "\n");
    }

    /// The ladder of the largest error; nullptr if there is no error.
    const LadderError *largest_error(const VerifiedValue &found)
    {
      const double steps = found.steps_error.value_or(0), mesh = found.mesh_error.value_or(0);
      return steps == 0 && mesh == 0 ? nullptr : steps >= mesh ? &found.steps : &found.mesh;
    }

    std::string halving_line(const VerifiedValue &found, const VerifyRun &scene)
    {
      const LadderError *largest = largest_error(found);
      if (largest == nullptr)
        return "";
      std::string text = "  Largest: " + largest->ladder->name + ". ";
      if (const auto halving = largest->halving(scene))
        {
          text += "To halve it: " + halving->setting;
          if (halving->cpu_seconds)
            text += ", about " + digits(*halving->cpu_seconds, 2) + " CPU s instead of " + digits(*scene.outcome.cpu_seconds, 2);
          return text + "\n";
        }
      return text + "What halves it cannot be told without a rate\n";
    }

    std::string text_of_value(const VerifiedValue &found, const std::vector<VerifyRun> &runs, const Refinements &refinements)
    {
      const double all  = found.steps_error.value_or(0) + found.mesh_error.value_or(0);
      const auto   part = [](const std::string &name, const std::optional<double> &error) {
        return error ? " +- " + digits(*error, 2) + " (" + name + ")" : "";
      };
      const std::string unit = unit_in(found.header);
      std::string       text = found.quantity.file + ", " + found.header + ", " + words_of(found.quantity) + ":\n  " +
                         value_text(found.value, all) + part("steps", found.steps_error) + part("mesh", found.mesh_error) +
                         (unit.empty() ? "" : " " + unit);
      if (all > 0 && found.value != 0)
        text += ", " + digits(100 * all / std::abs(found.value), 2) + " % together";
      text += "\n" + ladder_line(found.steps, all) + ladder_line(found.mesh, all);
      for (const VerifyRun &run : runs)
        if (run.part == VerifyRun::Part::degree && found.other_degree)
          text += degree_line(found, run, refinements, all);
        else if (run.part == VerifyRun::Part::method && found.other_method)
          text += method_line(found, run, refinements, all);
        else if (run.part == VerifyRun::Part::least_damping && found.least_damped)
          text += least_damping_line(found, run, refinements, all);
      return text + halving_line(found, runs.front());
    }

    std::string energy_text(const std::optional<EnergyDrift> &energy)
    {
      if (!energy || energy->exchanged == 0)
        return "Energy: there is no balance of this run.\n";
      return "Energy: the balance of the scene drifts by " + digits(energy->drift, 3) + " J, " +
             digits(100 * energy->drift / energy->exchanged, 2) + " % of the " + digits(energy->exchanged, 3) + " J exchanged.\n";
    }

    std::vector<std::string> cells_of_ladder(const LadderError &found, const std::optional<double> &error)
    {
      return {cell_of(error), cell_of(found.error ? found.error->rate : std::nullopt), exact_text(found.ladder->order),
              found.error ? approach_word(found.error->approach) : found.ladder->note};
    }

    void write_values(const std::vector<VerifiedValue> &values, const VerifyRun &scene, const std::filesystem::path &folder)
    {
      CsvFile           file(OutputFolder(folder), "verify.csv",
                             {"quantity", "column", "value", "error of steps", "rate in steps", "theory in steps", "steps", "error of mesh",
                              "rate in mesh", "theory in mesh", "mesh", "largest error", "to halve it", "CPU then [s]", "CPU [s]",
                              "energy drift over exchanged"});
      const auto        energy = energy_drift(scene);
      const std::string drift  = energy && energy->exchanged > 0 ? exact_text(energy->drift / energy->exchanged) : "";
      for (const VerifiedValue &found : values)
        {
          const LadderError       *largest = largest_error(found);
          const auto               halving = largest != nullptr ? largest->halving(scene) : std::nullopt;
          std::vector<std::string> cells{found.quantity.text, found.header, exact_text(found.value)};
          const auto append = [&cells](const std::vector<std::string> &more) { cells.insert(cells.end(), more.begin(), more.end()); };
          append(cells_of_ladder(found.steps, found.steps_error));
          append(cells_of_ladder(found.mesh, found.mesh_error));
          append({largest != nullptr ? largest->ladder->name : "", halving ? halving->setting : "",
                  cell_of(halving ? halving->cpu_seconds : std::nullopt), cell_of(scene.outcome.cpu_seconds), drift});
          file.row(cells);
        }
      file.close();
    }

    /// The value that the run has for a quantity; none if it is not done.
    std::optional<double> value_of(const VerifyRun &run, const VerifiedValue &found)
    {
      for (const LadderError *ladder : {&found.steps, &found.mesh})
        for (std::size_t i = 0; i < ladder->runs.size(); ++i)
          if (ladder->runs[i] == &run)
            return ladder->values[i];
      if (!run.done())
        return std::nullopt;
      return run.part == VerifyRun::Part::method          ? found.other_method
             : run.part == VerifyRun::Part::least_damping ? found.least_damped
                                                          : found.other_degree;
    }
  } // namespace

  std::string report_text(const std::vector<VerifiedValue> &values, const std::vector<VerifyRun> &runs, const Refinements &refinements)
  {
    std::string text;
    for (const VerifiedValue &found : values)
      text += text_of_value(found, runs, refinements);
    return text + energy_text(energy_drift(runs.front()));
  }

  void write_verify_tables(const std::vector<VerifiedValue> &values, const std::vector<VerifyRun> &runs,
                           const std::filesystem::path &folder)
  {
    write_values(values, runs.front(), folder);
    std::vector<std::string> quantities;
    for (const VerifiedValue &found : values)
      quantities.push_back(found.quantity.text);
    std::vector<RunRow> rows;
    for (const VerifyRun &run : runs)
      {
        rows.push_back({&run.which.name, &run.outcome, {}});
        for (const VerifiedValue &found : values)
          rows.back().values.push_back(value_of(run, found));
      }
    write_runs_table(quantities, rows, folder);
  }
} // namespace myolines::study
