#include <myolines/base/error.h>
#include <myolines/output/text_file.h>

#include <deal.II/base/mpi.h>

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <ctime>
#include <fstream>
#include <stdexcept>

namespace myolines
{
  bool writes_files()
  {
    return !dealii::Utilities::MPI::job_supports_mpi() || dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  }

  void replace_file(const std::filesystem::path &file, const std::string &text)
  {
    if (!writes_files())
      return;
    std::filesystem::path fresh = file;
    fresh += ".new";
    {
      std::ofstream stream(fresh, std::ios::binary);
      stream << text << std::flush;
      if (!stream)
        throw std::runtime_error("cannot write " + fresh.string());
    }
    std::filesystem::rename(fresh, file);
  }

  void sync_to_disk(const std::filesystem::path &file)
  {
    const int  descriptor = open(file.c_str(), O_RDONLY);
    const bool synced     = descriptor >= 0 && fsync(descriptor) == 0;
    if (descriptor >= 0)
      close(descriptor);
    if (!synced)
      throw std::runtime_error("cannot write " + file.string() + ": " + std::strerror(errno));
  }

  void on_writing_rank(const std::string &where, const std::string &expected, const std::string &hint, const std::function<void()> &action)
  {
    std::string problem;
    if (writes_files())
      try
        {
          action();
        }
      catch (const std::exception &error)
        {
          problem = error.what();
        }
    if (dealii::Utilities::MPI::job_supports_mpi())
      problem = dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, problem);
    if (!problem.empty())
      throw InputError(InputProblem{where, problem, expected, hint});
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
