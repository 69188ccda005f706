// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/base/files.h>
#include <myolines/output/manifest.h>
#include <myolines/output/run_folder.h>
#include <myolines/output/text_file.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <climits>
#include <stdexcept>

namespace myolines
{
  namespace
  {
    constexpr const char *lock_name     = "run.lock";
    constexpr const char *resolved_name = "scene.resolved.xml";
    constexpr std::size_t longest_name  = 64; ///< of a file in the folder, with what is put behind it while it is written

    const std::string results_of_one = "a folder for the results of one run";
    const std::string elsewhere      = "choose another one with --out";

    void refuse_folder(const std::filesystem::path &folder, const std::string &what, const std::string &hint)
    {
      throw InputError(InputProblem{"output folder " + folder.string(), what, results_of_one, hint});
    }

    /// Runs @p action on the rank that writes; what it throws as InputError or SystemError, all throw.
    void collectively(const std::filesystem::path &folder, const std::function<void()> &action)
    {
      on_writing_rank("output folder " + folder.string(), "a folder that can be made and written", elsewhere, action);
    }

    /// Old results must not go that the run reads. The scene itself may: it has been read, and is written again as it was resolved.
    void refuse_inputs(const std::filesystem::path &folder, const std::vector<std::filesystem::path> &old, const RunRecord &record)
    {
      const auto is = [](const std::filesystem::path &file, const std::filesystem::path &other) {
        std::error_code not_there;
        return std::filesystem::equivalent(file, other, not_there);
      };
      for (const std::filesystem::path &name : old)
        for (const auto &[input, checksum] : record.inputs)
          if (is(folder / name, input) && !is(input, record.scene))
            refuse_folder(folder, "the scene reads the file " + name.string() + " there, which is of an earlier run and would go",
                          "choose another folder with --out, or copy that file to a place of its own");
    }

    std::set<std::string> files_of(const std::filesystem::path &folder)
    {
      const auto manifest = read_manifest(folder);
      if (manifest && !manifest->lists_files)
        refuse_folder(folder, "it holds results of a version of the program that kept no list of its files",
                      "remove them, or choose another folder with --out");
      return manifest ? manifest->files : std::set<std::string>();
    }

    /// Of a run that goes on. Its checkpoint says that the folder is ours: a manifest that the end of a machine has emptied or halved tells
    /// nothing, and is written anew.
    std::set<std::string> files_known_before(const std::filesystem::path &folder)
    {
      try
        {
          return files_of(folder);
        }
      catch (const InputError &)
        {
          return {};
        }
    }

    /// Of the files in the folders of a run, relative to it.
    std::vector<std::filesystem::path> names_inside(const std::filesystem::path &folder)
    {
      std::vector<std::filesystem::path> names;
      for (const std::filesystem::path inside : {"", "states", "pictures"})
        if (std::filesystem::is_directory(folder / inside))
          for (const auto &entry : std::filesystem::directory_iterator(folder / inside))
            if (entry.is_regular_file())
              names.push_back(inside / entry.path().filename());
      return names;
    }

    /// What a run that was killed had begun to write, maybe with a name that this one does not use, being on other ranks.
    void remove_unfinished(const OutputFolder &outputs)
    {
      for (const std::filesystem::path &name : names_inside(outputs.path))
        for (const std::string &noted : outputs.noted())
          if (matches(name.string(), unfinished(noted)))
            {
              std::filesystem::remove(outputs.path / name);
              break;
            }
    }

    /// Files of every run; outputs note their own.
    void note_own_files(const OutputFolder &outputs)
    {
      for (const char *name : {"ledger.json", "run.log", "steps.csv", "checkpoint", "states/state-*", resolved_name, "manifest.json"})
        outputs.note(name);
    }
    /// With the names of all files before any of them is there: a run that is killed leaves no files of nobody.
    void write_first_manifest(const OutputFolder &outputs, const RunRecord &record)
    {
      for (const std::string &name : record.outputs)
        outputs.note(name);
      write_manifest(outputs, record, "running");
    }
  } // namespace

  RunFolder::RunFolder(std::filesystem::path folder)
    : path_(std::move(folder))
  {
    collectively(path_, [this] {
      if (path_.string().size() + longest_name >= PATH_MAX)
        throw std::runtime_error("its path has " + std::to_string(path_.string().size()) + " characters, the system takes " +
                                 std::to_string(PATH_MAX) + " with the names of files in it");
      std::filesystem::create_directories(path_);
      if (!std::filesystem::is_directory(path_))
        throw std::runtime_error("it is a file, not a folder");
      lock_.emplace(path_ / lock_name, FileLock::Kind::exclusive, "another run");
    });
  }

  OutputFolder RunFolder::begin(const std::string &resolved, const bool overwrite, const RunRecord &record) const
  {
    collectively(path_, [&] {
      refuse_inputs(path_, old_results(), record);
      if (overwrite || !has_other_results(resolved))
        return remove_old_results();
      if (read_manifest(path_)->scene != record.scene)
        refuse_folder(path_, "it holds the results of a run of another scene",
                      "another folder with --out; --overwrite removes those results");
      move_old_results();
    });
    const OutputFolder outputs = OutputFolder::with_foreign_files(path_);
    note_own_files(outputs);
    write_first_manifest(outputs, record);
    replace_file(outputs.file(resolved_name), resolved);
    return outputs;
  }

  OutputFolder RunFolder::resume(const std::string &resolved, const Archive &saved, const RunRecord &record) const
  {
    const OutputFolder outputs(path_, &saved);
    note_own_files(outputs);
    collectively(path_, [&] {
      for (const std::string &name : files_known_before(path_))
        outputs.note(name);
      remove_unfinished(outputs);
      replace_file(outputs.file(resolved_name), resolved);
    });
    write_first_manifest(outputs, record);
    return outputs;
  }

  bool RunFolder::has_other_results(const std::string &resolved) const
  {
    const auto scene = path_ / resolved_name;
    return files_of(path_).count(resolved_name) > 0 && std::filesystem::exists(scene) && read_file(scene) != resolved;
  }

  /// Names relative to the folder. The last ones are the resolved scene and the manifest: whoever is killed before leaves a folder that is
  /// known as ours, with results that are known as those of other values.
  std::vector<std::filesystem::path> RunFolder::old_results() const
  {
    const auto files = files_of(path_);
    const auto old   = [&files](const std::string &name) {
      return std::any_of(files.begin(), files.end(),
                           [&name](const std::string &listed) { return matches(name, listed) || matches(name, unfinished(listed)); });
    };
    std::vector<std::filesystem::path> all;
    for (const std::filesystem::path &name : names_inside(path_))
      if (name != lock_name && name != resolved_name && name != "manifest.json" && old(name.string()))
        all.push_back(name);
    for (const char *last : {resolved_name, "manifest.json"})
      if (old(last) && std::filesystem::exists(path_ / last))
        all.push_back(last);
    return all;
  }

  namespace
  {
    void remove_if_empty(const std::filesystem::path &folder)
    {
      std::error_code holds_others;
      std::filesystem::remove(folder, holds_others);
    }
  } // namespace

  void RunFolder::remove_old_results() const
  {
    for (const std::filesystem::path &name : old_results())
      {
        std::filesystem::remove(path_ / name);
        if (name.has_parent_path())
          remove_if_empty(path_ / name.parent_path());
      }
  }

  void RunFolder::move_old_results() const
  {
    unsigned int n = 1;
    while (std::filesystem::exists(path_ / ("earlier-" + std::to_string(n))))
      ++n;
    const std::filesystem::path aside = path_ / ("earlier-" + std::to_string(n));
    for (const std::filesystem::path &name : old_results())
      {
        std::filesystem::create_directories((aside / name).parent_path());
        std::filesystem::rename(path_ / name, aside / name);
        if (name.has_parent_path())
          remove_if_empty(path_ / name.parent_path());
      }
  }

  bool run_is_done(const std::filesystem::path &folder)
  {
    bool done = false;
    if (writes_files())
      try
        {
          const auto manifest = read_manifest(folder);
          done                = manifest && manifest->exit_reason == "done";
        }
      catch (const InputError &)
        {} // a manifest that says nothing does not say that it is done
    return dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, done);
  }
} // namespace myolines
