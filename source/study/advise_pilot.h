// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "verified_quantity.h"

#include <myolines/study/advise.h>
#include <myolines/study/database.h>

#include <chrono>
#include <map>

namespace myolines::study
{
  /// A number for each quantity.
  using Values = std::vector<double>;

  /// A run of a candidate with one of its rungs, on a mesh.
  struct PilotRun
  {
    std::string             name;
    Outcome                 outcome;
    std::vector<NamedValue> values; ///< of the quantities; none unless it is done

    bool   done() const { return !values.empty(); }
    double seconds() const;          ///< CPU time [s]
    double seconds_of_steps() const; ///< of it in the steps [s]
    double start_up() const;         ///< the rest of it [s]
    double steps() const;            ///< how many were taken

    /// That the steps are not those of @p coarser: where all end at kinks, half the size may change none.
    bool   finer_than(const PilotRun &coarser) const { return steps() > 1.2 * coarser.steps(); }
    Values plain_values() const;
  };

  /// What is to be run.
  struct PilotCase
  {
    const Candidate *candidate;
    std::size_t      rung;
    const Rung      *mesh; ///< nullptr: that of the scene
  };

  /// What the accuracy is: a part of the value, or a number in its unit.
  struct Accuracy
  {
    double value;
    bool   relative;
  };
  /// @throws InputError.
  Accuracy read_accuracy(const std::string &text);

  /// Runs what it is asked for, once.
  class Pilot
  {
  public:
    /// The options are borrowed.
    Pilot(const AdviseOptions &options, const std::filesystem::path &folder);

    /// The runs of @p cases, in their order; they stay where they are.
    /// @throws Interrupted by a signal or where the budget is spent; InputError if a run has no such quantity.
    std::vector<const PilotRun *> run(const std::vector<PilotCase> &cases);
    const PilotRun               &run(const PilotCase &which) { return *run(std::vector<PilotCase>{which}).front(); }

    /// Runs that take longer [s] from now on end as "timed out".
    void limit_runs(double seconds) { run_seconds_ = seconds; }

    const std::vector<VerifiedQuantity>   &quantities() const { return quantities_; }
    const std::map<std::string, PilotRun> &runs() const { return runs_; }

    /// The accuracy that is asked for of quantities of these values. @throws InputError if it is a part of 0.
    Values accuracy_of(const Values &values) const;

  private:
    Case     case_of(const PilotCase &which) const;
    PilotRun finished(const Outcome &outcome) const;

    const AdviseOptions                  &options_;
    const std::filesystem::path           folder_;
    std::vector<VerifiedQuantity>         quantities_;
    const Accuracy                        accuracy_;
    Study                                 study_;
    RunnerOptions                         runner_;
    Database                              database_;
    std::map<std::string, PilotRun>       runs_;
    double                                run_seconds_;
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  };
} // namespace myolines::study
