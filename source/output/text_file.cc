#include <myolines/output/text_file.h>

#include <deal.II/base/mpi.h>

#include <array>
#include <charconv>
#include <ctime>
#include <fstream>
#include <stdexcept>

namespace myolines
{
  bool writes_files() { return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0; }

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
