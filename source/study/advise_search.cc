// SPDX-License-Identifier: LGPL-2.1-or-later
#include "advise_search.h"

#include <myolines/base/error.h>
#include <myolines/base/names.h>

#include <algorithm>

namespace myolines::study
{
  namespace
  {
    using State = Track::State;

    constexpr double      dearer_by   = 1.2;  // CPU times of this ratio may be the same
    constexpr double      promising   = 3;    // methods that cost at most so many times the cheapest are tried with steps by error
    constexpr std::size_t most_failed = 5;    // in a row, after which a method is left out
    constexpr double      sharp       = 0.33; // change of the reference over the error that it tells
    constexpr double      patience = 10, least_seconds = 30;
  } // namespace

  Search::Search(Pilot &pilot, const Choices &choices, TimeReference &reference, const MeshChoice &mesh)
    : pilot_(pilot)
    , choices_(choices)
    , reference_(reference)
    , mesh_(mesh)
    , allowed_(1 - reference.ratio(mesh.errors))
  {
    for (const Candidate &candidate : choices.candidates)
      if (!candidate.like)
        tracks_.emplace_back(candidate);
  }

  void Search::note(Track &track, const PilotRun &run)
  {
    track.runs.push_back(&run);
    if (run.outcome.status == "refused" || run.outcome.status == "crashed")
      track.state = State::failing;
    else if (run.outcome.status == "timed out")
      track.state = State::dearer;
    else if (run.done())
      {
        track.rung = track.runs.size() - 1;
        if (good(run))
          track.state = State::found;
      }
    else if (std::none_of(track.runs.begin(), track.runs.end(), [](const PilotRun *each) { return each->done(); }) &&
             track.runs.size() >= most_failed)
      track.state = State::failing;
    if (track.state == State::searching && track.runs.size() == track.candidate->rungs.size())
      track.state = run.done() ? State::too_coarse : State::failing;
  }

  Track *Search::cheapest()
  {
    Track *best = nullptr;
    for (Track &track : tracks_)
      if (track.state == State::found && (best == nullptr || work_of(track) < work_of(*best)))
        best = &track;
    return best;
  }

  void Search::leave_out_dearer()
  {
    const Track *best = cheapest();
    if (best == nullptr)
      return;
    for (Track &track : tracks_)
      if (track.state == State::searching && !track.runs.empty() && track.runs[track.rung]->done() &&
          work_of(track) > dearer_by * work_of(*best))
        track.state = State::dearer;
    pilot_.limit_runs(std::max(least_seconds, patience * best->runs[best->rung]->seconds()));
  }

  void Search::run_all()
  {
    while (true)
      {
        leave_out_dearer();
        std::vector<PilotCase> cases;
        std::vector<Track *>   open;
        for (Track &track : tracks_)
          if (track.state == State::searching)
            {
              open.push_back(&track);
              cases.push_back({track.candidate, track.runs.size(), mesh_.pilot});
            }
        if (open.empty())
          return;
        const auto runs = pilot_.run(cases);
        for (std::size_t i = 0; i < open.size(); ++i)
          note(*open[i], *runs[i]);
      }
  }

  bool Search::good(const PilotRun &run) const { return run.done() && reference_.ratio(reference_.errors_of(run)) <= allowed_; }

  /// The next finer steps are as good: else the value came near the reference by chance, and the search goes on, with those that were
  /// more expensive.
  bool Search::confirm(Track &track)
  {
    const PilotRun *finer = finer_than(track);
    track.confirmed       = good(*track.runs[track.rung]) && (finer == nullptr || good(*finer));
    if (track.confirmed)
      return true;
    reopen(track);
    return false;
  }

  /// The search goes on with finer steps, and with those that were more expensive.
  void Search::reopen(Track &track)
  {
    track.confirmed = false;
    track.state     = track.rung + 1 == track.candidate->rungs.size() ? State::too_coarse : State::searching;
    for (Track &each : tracks_)
      if (each.state == State::dearer && each.runs.back()->done())
        each.state = State::searching;
  }

  /// The next run with other steps; none beyond the finest.
  const PilotRun *Search::finer_than(const Track &track)
  {
    for (std::size_t rung = track.rung + 1; rung < track.candidate->rungs.size(); ++rung)
      if (const PilotRun &run = pilot_.run({track.candidate, rung, mesh_.pilot}); !run.done() || run.finer_than(*track.runs[track.rung]))
        return &run;
    return nullptr;
  }

  void Search::add_those_by_error()
  {
    const Track *best = cheapest();
    for (const Candidate &candidate : choices_.candidates)
      if (candidate.like)
        {
          const Candidate *same = &choices_.candidates[*candidate.like];
          const auto found = std::find_if(tracks_.begin(), tracks_.end(), [same](const Track &track) { return track.candidate == same; });
          if (best == nullptr || (found->state == State::found && work_of(*found) <= promising * work_of(*best)))
            tracks_.emplace_back(candidate);
        }
  }

  Advice Search::best()
  {
    while (true)
      {
        run_all();
        Track *track = cheapest();
        if (track == nullptr)
          return {nullptr, nullptr, {}, 0, {}};
        if (!track->confirmed && !confirm(*track))
          continue;
        Advice advice{
            track, &track->candidate->rungs[track->rung], reference_.errors_of(*track->runs[track->rung]), seconds_of(*track), {}};
        if (const PilotRun *run = finer_than(*track))
          {
            const Values finer = reference_.errors_of(*run);
            for (std::size_t q = 0; q < finer.size(); ++q)
              advice.errors[q] = std::max(advice.errors[q], finer[q]);
          }
        if (reference_.changes_less_than(sharp * reference_.ratio(advice.errors)) || !reference_.sharpen())
          return advice;
        track->confirmed = false;
      }
  }

  Advice Search::advice(const bool tried)
  {
    best();
    add_those_by_error();
    std::optional<Trials> trials;
    while (true)
      {
        Advice found = best();
        if (found.track == nullptr)
          throw SolveError("no method meets the accuracy with any steps that were tried. A larger --accuracy may help");
        if (mesh_.rung == mesh_.pilot || !tried)
          return found;
        if (!trials)
          trials.emplace(pilot_, choices_, mesh_);
        found.trial = trials->trial(*found.track->candidate, found.track->rung);
        if (found.trial && trials->ratio(found.trial->errors) <= allowed_)
          return found;
        for (Track &track : tracks_)
          if (&track == found.track)
            reopen(track);
      }
  }
} // namespace myolines::study
