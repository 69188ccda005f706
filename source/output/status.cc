// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/output/status.h>
#include <myolines/output/step_records.h>
#include <myolines/output/text_file.h>

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <iostream>
#include <sstream>

namespace myolines
{
  std::string duration_text(const double seconds)
  {
    const long long whole = std::llround(seconds);
    char            text[64];
    if (whole < 60)
      std::snprintf(text, sizeof text, "%lld s", whole);
    else if (whole < 3600)
      std::snprintf(text, sizeof text, "%lld min %02lld s", whole / 60, whole % 60);
    else
      std::snprintf(text, sizeof text, "%lld h %02lld min", whole / 3600, whole / 60 % 60);
    return text;
  }

  std::string outcome_text(const StepReport::Outcome outcome)
  {
    switch (outcome)
      {
      case StepReport::Outcome::accepted:
        return "accepted";
      case StepReport::Outcome::not_converged:
        return "not converged";
      case StepReport::Outcome::inadmissible:
        return "inadmissible";
      case StepReport::Outcome::error_too_large:
        return "error too large";
      case StepReport::Outcome::energy_gained:
        return "energy gained";
      }
    throw std::logic_error("unknown outcome of a step");
  }

  std::string step_text(const StepRecord &record)
  {
    std::ostringstream text;
    text << "step " << record.number << "  t " << record.t << " s  dt " << record.dt << " s  Newton " << record.report.newton_iterations
         << "  linear " << record.report.linear_iterations;
    text.precision(2);
    text << std::scientific;
    if (record.report.initial_residual && record.report.final_residual)
      text << "  residual " << *record.report.initial_residual << " -> " << *record.report.final_residual;
    if (record.report.error_estimate)
      text << "  error " << *record.report.error_estimate << " of the tolerance";
    return text.str();
  }

  Status::Status(const OutputFolder &folder, const double start, const double end, std::ostream *terminal, Warn warn)
    : start_(start)
    , end_(end)
    , terminal_(writes_files() ? terminal : nullptr)
    , begin_(std::chrono::steady_clock::now())
    , pace_(end)
    , warn_(std::move(warn))
  {
    const std::filesystem::path file = folder.file("run.log");
    if (folder.saved == nullptr && writes_files())
      write_file(file, "");
    log_ = folder.open("run.log", File::Mode::append);
  }

  void Status::begin(const State &state)
  {
    from_  = state.t;
    begin_ = std::chrono::steady_clock::now();
    log(iso8601_now() + "  from t " + exact_text(state.t) + " s to " + exact_text(end_) + " s");
  }

  void Status::resume(const State &state, const std::size_t step)
  {
    begin(state);
    log("resumed after step " + std::to_string(step));
  }

  void Status::accepted(const State &, const StepRecord &record)
  {
    log(step_text(record));
    if (terminal_)
      show(record);
    const std::optional<std::string> warning = pace_.accepted(record, elapsed());
    if (!warning || !log_)
      return;
    log("warning: " + *warning);
    if (terminal_)
      *terminal_ << std::endl;
    if (warn_)
      warn_(*warning);
  }

  void Status::rejected(const StepRecord &record)
  {
    pace_.rejected(record);
    log(step_text(record) + "  rejected: " + outcome_text(record.report.outcome) +
        (record.report.reason.empty() ? "" : ", " + record.report.reason));
  }

  void Status::end(const std::string &reason)
  {
    log(iso8601_now() + (reason.empty() ? "  done" : "  stopped: " + reason) + " after " + duration_text(elapsed()));
    if (terminal_ && shown_width_ > 0)
      *terminal_ << std::endl;
  }

  void Status::log(const std::string &line)
  {
    if (log_)
      log_->write(line + "\n");
  }

  double Status::elapsed() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }

  void Status::show(const StepRecord &record)
  {
    const double       fraction = (record.t - start_) / (end_ - start_);
    std::ostringstream line;
    line << static_cast<int>(std::floor(100 * fraction + 1e-9)) << " %  " << step_text(record);
    if (record.t > from_ && record.t < end_)
      line << "  remaining " << duration_text(elapsed() * (end_ - record.t) / (record.t - from_));
    std::string text = line.str();
    // Blanks wipe what a longer line before this one left behind.
    const std::size_t width = text.size();
    text.resize(std::max(width, shown_width_), ' ');
    shown_width_ = width;
    *terminal_ << '\r' << text << std::flush;
  }

  std::unique_ptr<Observer> make_status(const OutputFolder &folder, const double start, const double end, const bool quiet, Warn warn)
  {
    const bool show = !quiet && isatty(STDOUT_FILENO);
    return std::make_unique<Status>(folder, start, end, show ? &std::cout : nullptr, std::move(warn));
  }
} // namespace myolines
