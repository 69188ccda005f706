#pragma once

#include <myolines/output/output_folder.h>

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
    /// Starts the file @p name of @p folder anew with the header @p columns (units in brackets: "Time [s]"), or goes on with
    /// the one that a resumed run saved, less the rows written since.
    /// @throws InputError if the file to go on with is not as it was, std::runtime_error with the path if the disk refuses, here
    /// and below.
    CsvFile(const OutputFolder &folder, const std::string &name, const std::vector<std::string> &columns);

    /// One number per column; numbers read back exactly. @throws std::logic_error if the count differs from the header.
    void row(const std::vector<double> &values);

    /// One text per column; quoted where a comma, quote or line break asks for it (RFC 4180).
    void row(const std::vector<std::string> &texts);

    /// Remembers how long the file is, and that much is on the disk itself.
    void save(Archive &archive) const;

  private:
    void go_on(std::uintmax_t bytes, const std::vector<std::string> &columns);
    void write(const std::vector<std::string> &texts);

    std::string           name_;
    std::filesystem::path path_;
    std::size_t           n_columns_;
    std::ofstream         stream_;
  };
} // namespace myolines
