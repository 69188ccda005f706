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

    std::set<std::string> files_of(const std::filesystem::path &folder)
    {
      const auto manifest = read_manifest(folder);
      if (manifest && !manifest->lists_files)
        refuse_folder(folder, "it holds results of a version of the program that kept no list of its files",
                      "remove them, or choose another folder with --out");
      return manifest ? manifest->files : std::set<std::string>();
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
      read_manifest(path_); // before anything is written there
      lock_.emplace(path_ / lock_name, FileLock::Kind::exclusive, "another run");
    });
  }

  OutputFolder RunFolder::begin(const std::string &resolved, const bool overwrite, const RunRecord &record) const
  {
    collectively(path_, [&] {
      refuse_other_results(resolved, overwrite);
      remove_old_results();
    });
    const OutputFolder outputs = OutputFolder::with_foreign_files(path_);
    for (const char *name : {"ledger.json", "run.log", "steps.csv", "checkpoint", "states/state-*", resolved_name})
      outputs.note(name);
    outputs.note("manifest.json");
    write_manifest(outputs, record, "running");
    replace_file(outputs.file(resolved_name), resolved);
    return outputs;
  }

  OutputFolder RunFolder::resume(const std::string &resolved, const Archive &saved) const
  {
    const OutputFolder outputs(path_, &saved);
    collectively(path_, [&] {
      for (const std::string &name : files_of(path_))
        outputs.note(name);
      replace_file(outputs.file(resolved_name), resolved);
    });
    return outputs;
  }

  void RunFolder::refuse_other_results(const std::string &resolved, const bool overwrite) const
  {
    const auto files = files_of(path_);
    const auto scene = path_ / resolved_name;
    if (files.count(resolved_name) == 0 || !std::filesystem::exists(scene) || overwrite)
      return;
    if (read_file(scene) != resolved)
      refuse_folder(
          path_, "it holds the results of a run of another scene, or of this one with other values",
          "another folder with --out; --overwrite removes those results; --resume goes on with a run whose end or output changes");
  }

  void RunFolder::remove_old_results() const
  {
    const auto files = files_of(path_);
    const auto old   = [&files](const std::string &name) {
      return std::any_of(files.begin(), files.end(),
                           [&name](const std::string &listed) { return matches(name, listed) || matches(name, listed + ".new"); });
    };
    for (const std::filesystem::path inside : {"", "states", "pictures"})
      if (std::filesystem::is_directory(path_ / inside))
        {
          std::vector<std::filesystem::path> gone;
          for (const auto &entry : std::filesystem::directory_iterator(path_ / inside))
            if (const auto name = inside / entry.path().filename();
                entry.is_regular_file() && name != lock_name && name != "manifest.json" && old(name.string()))
              gone.push_back(entry.path());
          for (const std::filesystem::path &file : gone)
            std::filesystem::remove(file);
          if (std::error_code holds_others; !inside.empty() && !gone.empty())
            std::filesystem::remove(path_ / inside, holds_others);
        }
    if (old("manifest.json")) // last: whoever is killed before leaves a folder that is known as ours
      std::filesystem::remove(path_ / "manifest.json");
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
