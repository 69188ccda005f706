// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/files.h>
#include <myolines/output/output_folder.h>
#include <myolines/output/pace.h>
#include <myolines/output/step_records.h>
#include <myolines/time/loop.h>

#include <chrono>
#include <iosfwd>
#include <optional>

namespace myolines
{
  /// Tells how far a run is: one line per attempted step in a log file and, on a terminal, one line that is overwritten
  /// with the progress and an estimate of the time remaining (from the wall-clock time per simulated second so far).
  class Status : public Observer
  {
  public:
    /// Times in seconds; @p terminal may be nullptr (not a terminal, or the user wants quiet). Only the rank that
    /// writes files logs, in run.log, and shows; there @p warn, which may be empty, hears of what Pace has to tell. The log of a resumed
    /// run goes on. @throws SystemError, here and below, where the log cannot be written.
    Status(const OutputFolder &folder, double start, double end, std::ostream *terminal, Warn warn = {});

    void begin(const State &state) override;
    void resume(const State &state, std::size_t step) override;
    void accepted(const State &state, const StepRecord &record) override;
    void rejected(const StepRecord &record) override;
    void end(const std::string &reason) override;

  private:
    void   log(const std::string &line);
    double elapsed() const; ///< [s]
    void   show(const StepRecord &record);

    std::shared_ptr<File>                 log_; ///< on the rank that writes
    double                                start_;
    double                                end_;
    double                                from_ = 0; ///< where this run began or was resumed [s]
    std::ostream                         *terminal_;
    std::size_t                           shown_width_ = 0;
    std::chrono::steady_clock::time_point begin_;
    Pace                                  pace_;
    const Warn                            warn_;
  };

  /// "7 s", "3 min 05 s", "2 h 07 min".
  std::string duration_text(double seconds);

  /// "step 12  t 0.15 s  dt 0.0125 s  Newton 5  linear 34  residual 3.1e+02 -> 1.2e-09".
  std::string step_text(const StepRecord &record);

  /// "accepted", "not converged", "inadmissible", "error too large", "energy gained".
  std::string outcome_text(StepReport::Outcome outcome);
} // namespace myolines
