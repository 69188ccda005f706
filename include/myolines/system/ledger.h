// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace myolines
{
  /// Counts of work and seconds by phase. Counts do not depend on the machine, so tests assert on them.
  /// Names are lower-case words with spaces ("residual evaluations"); a name never counted is absent and reads 0.
  class WorkLedger
  {
  public:
    void count(std::string_view what, std::uint64_t times = 1) { entry(counts_, what) += times; }   ///< Adds to a count.
    void add_seconds(std::string_view phase, double seconds) { entry(seconds_, phase) += seconds; } ///< Adds to the time of a phase [s].

    /// The count so far.
    std::uint64_t counted(std::string_view what) const
    {
      const auto found = counts_.find(what);
      return found == counts_.end() ? 0 : found->second;
    }

    /// By name; looked up without making strings.
    template <typename Value>
    using Table = std::map<std::string, Value, std::less<>>; // looked up without making strings

    const Table<std::uint64_t> &counts() const { return counts_; }   ///< all counts
    const Table<double>        &seconds() const { return seconds_; } ///< wall-clock time by phase [s]

    /// Adds the wall-clock seconds of its own life to a phase.
    class Timer
    {
    public:
      /// @p phase is a literal, or outlives the timer.
      Timer(WorkLedger &ledger, std::string_view phase)
        : ledger_(ledger)
        , phase_(phase)
        , begin_(std::chrono::steady_clock::now())
      {}
      /// Adds the time that has passed.
      ~Timer() { ledger_.add_seconds(phase_, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count()); }
      Timer(const Timer &)            = delete; ///< A time is added once.
      Timer &operator=(const Timer &) = delete;

    private:
      WorkLedger                           &ledger_;
      std::string_view                      phase_;
      std::chrono::steady_clock::time_point begin_;
    };

  private:
    template <typename Value>
    static Value &entry(Table<Value> &table, const std::string_view name)
    {
      const auto found = table.find(name);
      return found != table.end() ? found->second : table.emplace(name, Value()).first->second;
    }

    Table<std::uint64_t> counts_;
    Table<double>        seconds_;
  };
} // namespace myolines
