// SPDX-License-Identifier: LGPL-2.1-or-later
#include "advise_trial.h"

#include <algorithm>
#include <limits>

namespace myolines::study
{
  namespace
  {
    constexpr double   left_by_reference = 0.3; // of the change of its last steps, which are of high order
    constexpr unsigned most_refinements  = 4;
  } // namespace

  Trials::Trials(Pilot &pilot, const Choices &choices, const MeshChoice &mesh)
    : pilot_(pilot)
    , method_(choices.candidates.at(choices.reference))
    , mesh_(mesh)
    , rung_(mesh.rung_of_reference)
    , run_(&pilot.run({&method_, rung_, mesh.rung}))
    , accuracy_(pilot.accuracy_of(run_->plain_values()))
  {}

  /// To steps that are others.
  bool Trials::sharpen()
  {
    for (std::size_t rung = rung_ + 1; rung < method_.rungs.size(); ++rung)
      {
        const PilotRun &finer = pilot_.run({&method_, rung, mesh_.rung});
        if (!finer.done())
          return false;
        if (!finer.finer_than(*run_))
          continue;
        change_ = distance(finer.plain_values(), run_->plain_values());
        rung_   = rung;
        run_    = &finer;
        return true;
      }
    return false;
  }

  std::optional<Trial> Trials::trial(const Candidate &candidate, const std::size_t rung)
  {
    pilot_.limit_runs(std::numeric_limits<double>::infinity());
    Trial tried{&pilot_.run({&candidate, rung, mesh_.rung}), {}};
    if (!tried.run->done())
      return std::nullopt;
    for (unsigned int i = 0; i <= most_refinements; ++i)
      {
        if (change_.empty() && !sharpen())
          return std::nullopt;
        tried.errors = distance(tried.run->plain_values(), run_->plain_values());
        if (ratio(change_) <= ratio(tried.errors) || !sharpen())
          break;
      }
    for (std::size_t q = 0; q < tried.errors.size(); ++q)
      tried.errors[q] = std::max(tried.errors[q], left_by_reference * change_[q]);
    return tried;
  }
} // namespace myolines::study
