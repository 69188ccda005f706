// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/output/file_lock.h>
#include <myolines/output/manifest.h>
#include <myolines/output/output_folder.h>

#include <optional>

namespace myolines
{
  /// The output folder of a run, into which no other run writes while the object lives. All members are collective.
  class RunFolder
  {
  public:
    /// Makes the folder if need be. @throws InputError if it cannot be made and written or another run writes there; SystemError if the
    /// disk refuses.
    explicit RunFolder(std::filesystem::path folder);

    const std::filesystem::path &path() const { return path_; } ///< of the folder

    /// For a run from its start: what an earlier run left goes, so that old results never stand beside new ones. Results of the same scene
    /// with other values are moved to the folder earlier-1 (or -2, ...) in this one, unless they are to @p overwrite. Writes the manifest
    /// of the run, as running, before anything else.
    /// @throws InputError, before anything is changed, if these are of another scene and not to @p overwrite, one of them is an input of
    /// this run, a file is not of a run, or the manifest is damaged or not of this program.
    OutputFolder begin(const std::string &resolved, bool overwrite, const RunRecord &record) const;

    /// For a run that goes on with what it @p saved, whatever has become of its manifest, which is written anew.
    OutputFolder resume(const std::string &resolved, const Archive &saved, const RunRecord &record) const;

  private:
    bool                               has_other_results(const std::string &resolved) const;
    std::vector<std::filesystem::path> old_results() const;
    void                               remove_old_results() const;
    void                               move_old_results() const;

    std::filesystem::path   path_;
    std::optional<FileLock> lock_; ///< on the rank that writes
  };

  /// True if the run in @p folder is done, as its manifest says; false if there is none that says so. Collective.
  bool run_is_done(const std::filesystem::path &folder);
} // namespace myolines
