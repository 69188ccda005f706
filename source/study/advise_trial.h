// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "advise_mesh.h"

namespace myolines::study
{
  /// A run on the mesh that is taken.
  struct Trial
  {
    const PilotRun *run;
    Values          errors; ///< of the steps
  };

  /// Tries on the mesh that is taken what the pilot has found on its own, beside runs of the reference there.
  class Trials
  {
  public:
    /// All are borrowed.
    Trials(Pilot &pilot, const Choices &choices, const MeshChoice &mesh);

    /// None if the run does not end. Runs of the reference have finer steps each time until their change is not more than the error.
    std::optional<Trial> trial(const Candidate &candidate, std::size_t rung);

    /// The largest of @p errors over the accuracy.
    double ratio(const Values &errors) const { return largest_ratio(errors, accuracy_); }

  private:
    bool sharpen();

    Pilot            &pilot_;
    const Candidate  &method_;
    const MeshChoice &mesh_;
    std::size_t       rung_; ///< of the reference
    const PilotRun   *run_;
    const Values      accuracy_;
    Values            change_; ///< that its last steps have made
  };
} // namespace myolines::study
