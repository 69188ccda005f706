// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/base/files.h>
#include <myolines/output/refused_name.h>
#include <myolines/output/text_file.h>

#include <deal.II/base/mpi.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <ctime>

namespace myolines
{
  bool writes_files()
  {
    return !dealii::Utilities::MPI::job_supports_mpi() || dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  }

  void replace_file(const std::filesystem::path &file, const std::string &text)
  {
    if (writes_files())
      write_file(file, text);
  }

  void make_folder(const std::filesystem::path &folder)
  {
    std::error_code refused;
    std::filesystem::create_directories(folder, refused);
    if (refused)
      throw SystemError("make", folder, refused.value());
  }

  void remove_file(const std::filesystem::path &file)
  {
    std::error_code refused;
    std::filesystem::remove(file, refused);
    if (refused)
      throw SystemError("remove", file, refused.value());
  }

  void sync_to_disk(const std::filesystem::path &file) { File(file, File::Mode::read).sync(); }

  namespace
  {
    /// What one rank tells all.
    struct Refusal
    {
      enum Kind : int
      {
        none,
        input,
        system
      };
      int                      kind = none, error_number = 0;
      std::vector<std::string> words; ///< four for each problem, or what the system said
    };

    void tell(Refusal &refusal, const InputProblem &problem)
    {
      refusal.kind = Refusal::input;
      refusal.words.insert(refusal.words.end(), {problem.where, problem.what, problem.expected, problem.hint});
    }

    void tell(Refusal &refusal, InputProblem problem, const std::string &what, const int error)
    {
      if (is_of_the_name(error))
        {
          problem.what = what;
          tell(refusal, problem);
          return;
        }
      refusal.kind         = Refusal::system;
      refusal.error_number = error;
      refusal.words        = {what};
    }

    Refusal refusal_of(const std::function<void()> &action, const InputProblem &frame)
    {
      Refusal refusal;
      try
        {
          action();
        }
      catch (const InputError &error)
        {
          for (const InputProblem &problem : error.problems())
            tell(refusal, problem);
        }
      catch (const SystemError &error)
        {
          tell(refusal, frame, error.what(), error.error_number());
        }
      catch (const std::filesystem::filesystem_error &error)
        {
          tell(refusal, frame, "cannot use " + error.path1().string() + ": " + error.code().message(), error.code().value());
        }
      catch (const std::exception &error)
        {
          tell(refusal, frame, error.what(), 0);
        }
      return refusal;
    }
  } // namespace

  void on_writing_rank(const std::string &where, const std::string &expected, const std::string &hint, const std::function<void()> &action)
  {
    Refusal refusal;
    if (writes_files())
      refusal = refusal_of(action, {where, "", expected, hint});
    if (dealii::Utilities::MPI::job_supports_mpi()) // a study calls this before MPI starts
      {
        refusal.kind         = dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, refusal.kind);
        refusal.error_number = dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, refusal.error_number);
        refusal.words        = dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, refusal.words);
      }
    const std::vector<std::string> &words = refusal.words;
    if (refusal.kind == Refusal::none)
      return;
    if (refusal.kind == Refusal::system)
      throw SystemError(words.front(), refusal.error_number);
    std::vector<InputProblem> problems;
    for (std::size_t i = 0; i + 4 <= words.size(); i += 4)
      problems.push_back({words[i], words[i + 1], words[i + 2], words[i + 3]});
    throw InputError(problems);
  }

  std::string exact_text(const double value)
  {
    std::array<char, 32> text{};
    const auto           end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return std::string(text.data(), end);
  }

  std::string iso8601_now()
  {
    const std::time_t now = std::time(nullptr);
    std::tm           utc{};
    gmtime_r(&now, &utc);
    std::array<char, 32> text{};
    const std::size_t    length = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
    return std::string(text.data(), length);
  }
} // namespace myolines
