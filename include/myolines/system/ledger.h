#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>

namespace myolines
{
  /// Counts of work and seconds by phase. Counts do not depend on the machine, so tests assert on them.
  /// Names are lower-case words with spaces ("residual evaluations"); a name never counted is absent and reads 0.
  class WorkLedger
  {
  public:
    void count(const std::string &what, std::uint64_t times = 1) { counts_[what] += times; }
    void add_seconds(const std::string &phase, double seconds) { seconds_[phase] += seconds; }

    std::uint64_t counted(const std::string &what) const
    {
      const auto found = counts_.find(what);
      return found == counts_.end() ? 0 : found->second;
    }

    const std::map<std::string, std::uint64_t> &counts() const { return counts_; }
    const std::map<std::string, double>        &seconds() const { return seconds_; }

    /// Adds the wall-clock seconds of its own life to a phase.
    class Timer
    {
    public:
      Timer(WorkLedger &ledger, std::string phase)
        : ledger_(ledger)
        , phase_(std::move(phase))
        , begin_(std::chrono::steady_clock::now())
      {}
      ~Timer() { ledger_.add_seconds(phase_, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count()); }
      Timer(const Timer &)            = delete;
      Timer &operator=(const Timer &) = delete;

    private:
      WorkLedger                           &ledger_;
      std::string                           phase_;
      std::chrono::steady_clock::time_point begin_;
    };

  private:
    std::map<std::string, std::uint64_t> counts_;
    std::map<std::string, double>        seconds_;
  };
} // namespace myolines
