// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/compare/differences.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace myolines
{
  /// A state that a run has left in its folder, and what its fields need.
  class SavedState
  {
  public:
    /// Reads @p file, which write_checkpoint() wrote, the scene in it included, and makes the system of that scene on every rank.
    /// @throws InputError if there is no such file, it is damaged, or its system has no fields to compare (an oscillator).
    explicit SavedState(const std::filesystem::path &file);
    ~SavedState();

    double                       t() const { return t_; }       ///< [s]
    const std::filesystem::path &file() const { return file_; } ///< that of the constructor

    /// l2_differences() of both; the ranks of all share the work. @throws InputError if the systems are of different types or sizes.
    friend std::vector<FieldDifference> l2_differences(const SavedState &first, const SavedState &second);

  private:
    struct Rod;

    std::filesystem::path              file_;
    double                             t_;
    std::unique_ptr<const BlockFields> muscle_; ///< one of both
    std::unique_ptr<const Rod>         rod_;
  };

  /// Where a run left a state.
  struct StateOnDisk
  {
    std::filesystem::path file; ///< a checkpoint
    double                t;    ///< [s]
  };
  /// States in the folder of a run, ascending in time: those kept (list `output/checkpoint/keep`), the last one at the end.
  /// @throws InputError if there is no checkpoint.
  std::vector<StateOnDisk> states_on_disk(const std::filesystem::path &folder);

  /// Times at which both have a state, up to a relative 1e-9 of the later, as the pairs of their files.
  std::vector<std::pair<StateOnDisk, StateOnDisk>> common_states(const std::vector<StateOnDisk> &first,
                                                                 const std::vector<StateOnDisk> &second);

  /// What `compare` is asked for.
  struct CompareOptions
  {
    std::filesystem::path first;       ///< folder of a run
    std::filesystem::path second;      ///< folder of the run that differences are relative to
    std::optional<double> at;          ///< a time at which both have a state [s]
    bool                  all = false; ///< all times at which both have one
    std::filesystem::path csv;         ///< file to write the table to; empty: none
  };

  /// The command `compare`: the table of l2_differences() at the end of both runs, at a time, or at all common times.
  /// @throws InputError for bad folders, times that one run has not, and different bodies.
  void compare_command(const CompareOptions &options, std::ostream &out);
} // namespace myolines
