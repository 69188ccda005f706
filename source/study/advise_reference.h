// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "advise_pilot.h"

namespace myolines::study
{
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
    double ratio(const Values &errors) const;

    const Values   &accuracy() const { return accuracy_; } ///< that is asked for
    const PilotRun &run() const { return *runs_.back(); }  ///< the reference itself
    std::size_t     rung() const { return rung_; }

    /// The longest steps of its method with errors of at most @p part of the accuracy.
    std::size_t rung_within(double part) const;

  private:
    void take(const PilotRun &run);

    Pilot                        &pilot_;
    const Candidate              &method_;
    const Rung                   *mesh_;
    std::size_t                   rung_ = 0;
    std::vector<const PilotRun *> runs_; ///< up to rung_; those that failed, too
    Values                        accuracy_, change_;
  };
} // namespace myolines::study
