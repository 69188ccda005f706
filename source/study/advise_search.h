// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "advise_trial.h"

#include <deque>

namespace myolines::study
{
  /// How far the search has come with one candidate.
  struct Track
  {
    enum class State
    {
      searching,
      found,     ///< the last run meets what the mesh leaves of the accuracy
      dearer,    ///< than the cheapest that does
      failing,   ///< all runs end before their time
      too_coarse ///< with all its rungs
    };
    explicit Track(const Candidate &of)
      : candidate(&of)
    {}

    const Candidate              *candidate;
    State                         state = State::searching;
    std::vector<const PilotRun *> runs;          ///< with its rungs, from the coarsest on
    std::size_t                   rung      = 0; ///< of the run that tells of it: the last that is done
    bool                          confirmed = false;
  };

  /// What is recommended.
  struct Advice
  {
    const Track         *track;
    const Rung          *rung;
    Values               errors;  ///< of the steps, as the pilot predicts them
    double               seconds; ///< CPU time on the mesh that is taken [s], likewise
    std::optional<Trial> trial;   ///< on that mesh; none where that of the pilot is taken

    /// As they were found on that mesh; else predicted.
    const Values &best_errors() const { return trial ? trial->errors : errors; }
    double        best_seconds() const { return trial ? trial->run->seconds() : seconds; }
  };

  /// Runs all candidates with finer and finer steps, see advise_command().
  class Search
  {
  public:
    /// All are borrowed.
    Search(Pilot &pilot, const Choices &choices, TimeReference &reference, const MeshChoice &mesh);

    /// What is advised; @p tried on its mesh, where that is not the one of the pilot. @throws SolveError if no candidate is accurate
    /// enough.
    Advice advice(bool tried);

    const std::deque<Track> &tracks() const { return tracks_; } ///< of candidates that were run

    /// What the mesh leaves of the accuracy: at most 1.
    double allowed() const { return allowed_; }

    double seconds_of(const Track &track) const { return mesh_.seconds_of(*track.runs.at(track.rung)); }

    /// CPU time of the steps of the pilot [s], by which candidates are ranked: what goes before is the same for all.
    static double work_of(const Track &track) { return track.runs.at(track.rung)->seconds_of_steps(); }

  private:
    void            run_all();
    void            note(Track &track, const PilotRun &run);
    Track          *cheapest();
    void            leave_out_dearer();
    bool            good(const PilotRun &run) const;
    bool            confirm(Track &track);
    const PilotRun *finer_than(const Track &track);
    void            reopen(Track &track);
    void            add_those_by_error();
    Advice          best();

    Pilot            &pilot_;
    const Choices    &choices_;
    TimeReference    &reference_;
    const MeshChoice &mesh_;
    double            allowed_;
    std::deque<Track> tracks_;
  };
} // namespace myolines::study
