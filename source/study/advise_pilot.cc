// SPDX-License-Identifier: LGPL-2.1-or-later
#include "advise_pilot.h"

#include <myolines/base/error.h>
#include <myolines/scene/numbers.h>
#include <myolines/study/runner.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace myolines::study
{
  namespace
  {
    [[noreturn]] void refuse_accuracy(const std::string &text, const std::string &what)
    {
      throw InputError(
          InputProblem{"--accuracy \"" + text + "\"", what, "a part of the value, \"1 %\", or a number in its unit, \"0.05\"", ""});
    }

    /// An entry of the ledger of a run.
    std::optional<double> in_ledger(const Outcome &outcome, const std::string &table, const std::string &name)
    {
      const auto json = nlohmann::json::parse(outcome.ledger, nullptr, /*allow_exceptions*/ false);
      if (!json.is_object() || !json.contains(table) || !json[table].contains(name))
        return std::nullopt;
      return json[table][name].get<double>();
    }

    std::vector<VerifiedQuantity> read_quantities(const std::vector<std::string> &texts)
    {
      std::vector<VerifiedQuantity> quantities;
      for (const std::string &text : texts)
        quantities.push_back(read_verified_quantity(text));
      return quantities;
    }
  } // namespace

  double PilotRun::seconds() const { return outcome.cpu_seconds.value_or(outcome.wall_seconds); }

  double PilotRun::seconds_of_steps() const { return in_ledger(outcome, "seconds", "CPU of the run").value_or(seconds()); }

  double PilotRun::start_up() const { return std::max(0., seconds() - seconds_of_steps()); }

  double PilotRun::steps() const { return in_ledger(outcome, "counts", "accepted steps").value_or(0); }

  Values PilotRun::plain_values() const
  {
    Values plain;
    for (const NamedValue &value : values)
      plain.push_back(value.value);
    return plain;
  }

  Accuracy read_accuracy(const std::string &text)
  {
    std::string number   = scene::trimmed(text);
    const bool  relative = !number.empty() && number.back() == '%';
    if (relative)
      number.pop_back();
    const auto value = scene::parse_number(scene::trimmed(number));
    if (!value)
      refuse_accuracy(text, "this is no accuracy");
    if (!(*value > 0))
      refuse_accuracy(text, "an accuracy is positive");
    return {relative ? *value / 100 : *value, relative};
  }

  Pilot::Pilot(const AdviseOptions &options, const std::filesystem::path &folder)
    : options_(options)
    , folder_(folder)
    , quantities_(read_quantities(options.quantities))
    , accuracy_(read_accuracy(options.accuracy))
    , study_(study_of(options))
    , runner_(runner_options(options, study_, folder))
    , database_(folder / "advise.sqlite")
    , run_seconds_(options.budget)
  {}

  Case Pilot::case_of(const PilotCase &which) const
  {
    const Rung                                      &rung = which.candidate->rungs.at(which.rung);
    std::vector<std::pair<std::string, std::string>> labels{{"method", which.candidate->name}, {which.candidate->parameter, rung.label}};
    Case                                             made;
    made.settings  = options_.overrides;
    const auto add = [&made](const std::vector<std::string> &settings) {
      made.settings.insert(made.settings.end(), settings.begin(), settings.end());
    };
    if (which.mesh != nullptr)
      {
        labels.insert(labels.begin(), {"mesh", which.mesh->label});
        add(which.mesh->settings);
      }
    add(which.candidate->settings);
    add(rung.settings);
    made.name = case_name("", labels);
    return made;
  }

  PilotRun Pilot::finished(const Outcome &outcome) const
  {
    PilotRun run{outcome.name, outcome, {}};
    if (outcome.status == "done")
      for (const VerifiedQuantity &quantity : quantities_)
        run.values.push_back(value_in_run(quantity, case_folder(folder_, outcome.name)));
    return run;
  }

  std::vector<const PilotRun *> Pilot::run(const std::vector<PilotCase> &cases)
  {
    std::vector<Case> wanted, open;
    for (const PilotCase &which : cases)
      {
        wanted.push_back(case_of(which));
        if (runs_.count(wanted.back().name) == 0)
          open.push_back(wanted.back());
      }
    if (!open.empty())
      {
        const double spent        = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
        study_.total_seconds      = options_.budget - spent;
        study_.case_seconds       = std::max(1., std::min(run_seconds_, study_.total_seconds));
        const RunnerReport report = run_cases(study_, open, database_, runner_);
        if (!report.why_open.empty() && options_.stop_signal() == 0)
          throw Interrupted("stopped: the " + scene::format_number(options_.budget) +
                            " s of --budget are spent. The same command goes on with what is not done");
        throw_if_open(report);
        const auto outcomes = database_.outcomes();
        for (const Case &each : open)
          runs_.emplace(each.name, finished(outcomes.at(each.name)));
      }
    std::vector<const PilotRun *> found;
    for (const Case &each : wanted)
      found.push_back(&runs_.at(each.name));
    return found;
  }

  Values Pilot::accuracy_of(const Values &values) const
  {
    Values accuracies;
    for (std::size_t q = 0; q < values.size(); ++q)
      {
        accuracies.push_back(accuracy_.relative ? accuracy_.value * std::abs(values[q]) : accuracy_.value);
        if (accuracies.back() == 0)
          refuse_accuracy(options_.accuracy, "the quantity \"" + quantities_[q].text + "\" is 0, of which there is no part");
      }
    return accuracies;
  }
} // namespace myolines::study
