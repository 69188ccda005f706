// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "advise_pilot.h"

namespace myolines::study
{
  /// |a - b| for each quantity.
  Values distance(const Values &a, const Values &b);

  /// The largest of the errors, each over its accuracy.
  double largest_ratio(const Values &errors, const Values &accuracy);

  /// What runs of the pilot are measured against: those of the reference with shorter and shorter steps.
  class TimeReference
  {
  public:
    /// Shortens the steps until they are short enough, see advise_command(). All are borrowed. @throws SolveError if they never are.
    TimeReference(Pilot &pilot, const Choices &choices, const Rung *mesh);

    /// One step size more. False if there is none, or it fails.
    bool sharpen();

    /// The change that the last step size has made is not more than @p part of the accuracy.
    bool changes_less_than(double part) const { return ratio(change_) <= part; }

    /// Of a run that is done, one for each quantity: its distance from the reference, or that change where it is more.
    Values errors_of(const PilotRun &run) const;

    /// The largest of @p errors over the accuracy.
    double ratio(const Values &errors) const { return largest_ratio(errors, accuracy_); }

    const Values   &accuracy() const { return accuracy_; }     ///< that is asked for
    const PilotRun &run() const { return *steps_.back().run; } ///< the reference itself
    std::size_t     rung() const { return steps_.back().rung; }

    /// The longest steps of its method with errors of at most @p part of the accuracy.
    std::size_t rung_within(double part) const;

  private:
    /// A run of the reference.
    struct Step
    {
      std::size_t     rung;
      const PilotRun *run;
    };
    void take(std::size_t rung);

    Pilot            &pilot_;
    const Candidate  &method_;
    const Rung       *mesh_;
    std::vector<Step> steps_; ///< those that failed, too
    Values            accuracy_, change_;
  };
} // namespace myolines::study
