#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace myolines
{
  /// A table on disk, comma-separated, one header line. Every row is on disk when row() returns, so whatever a run
  /// computed before it failed can be read. Ranks that do not write (writes_files()) keep no file.
  class CsvFile
  {
  public:
    /// Starts @p file anew with the header @p columns (units in brackets: "Time [s]").
    /// @throws std::runtime_error with the path if the disk refuses, here and below.
    CsvFile(const std::filesystem::path &file, const std::vector<std::string> &columns);

    /// One number per column; numbers read back exactly. @throws std::logic_error if the count differs from the header.
    void row(const std::vector<double> &values);

    /// One text per column; quoted where a comma, quote or line break asks for it (RFC 4180).
    void row(const std::vector<std::string> &texts);

  private:
    void write(const std::vector<std::string> &texts);

    std::filesystem::path path_;
    std::size_t           n_columns_;
    std::ofstream         stream_;
  };
} // namespace myolines
