// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/checksum.h>
#include <myolines/base/files.h>
#include <myolines/output/output_folder.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace myolines
{
  /// What a table of a run is called.
  struct TableName
  {
    /// @p title may be empty.
    TableName(std::string file, std::string title = "")
      : file(std::move(file))
      , title(std::move(title))
    {}
    /// Without a title.
    TableName(const char *file)
      : file(file)
    {}

    std::string file;  ///< relative to the folder
    std::string title; ///< what it is about, in words, for pictures: "Energies"
  };

  /// A table on disk, comma-separated, one header line. Every row is on disk when row() returns, so whatever a run
  /// computed before it failed can be read. Ranks that do not write (writes_files()) keep no file.
  class CsvFile
  {
  public:
    /// Starts the table @p name of @p folder anew with the header @p columns (units in brackets: "Time [s]"), or goes on with
    /// the one that a resumed run saved, less the rows written since.
    /// @throws InputError if the file to go on with is not as it was, SystemError if the disk refuses, here and below; a row that it did
    /// not take whole is not there.
    CsvFile(const OutputFolder &folder, const TableName &name, const std::vector<std::string> &columns);

    /// One number per column; numbers read back exactly, and what is not a number leaves its cell empty (OutputFolder::leave_empty()).
    /// The rows of a folder that is read go to its reader instead.
    /// @throws std::logic_error if the count differs from the header.
    void row(const std::vector<double> &values);

    /// One text per column; quoted where a comma, quote or line break asks for it (RFC 4180).
    void row(const std::vector<std::string> &texts);

    /// After the last row of a table that no run of its OutputFolder closes.
    void close();

    /// Remembers how long the file is, and its checksum; that much is on the disk itself.
    void save(Archive &archive) const;

  private:
    void go_on(const Archive &saved, const std::vector<std::string> &columns);
    void write(const std::vector<std::string> &texts);

    OutputFolder             folder_;
    std::string              name_;
    std::filesystem::path    path_;
    std::vector<std::string> columns_;
    std::size_t              size_ = 0; ///< [bytes]
    Checksum                 checksum_;
    std::shared_ptr<File>    file_; ///< on the rank that writes
  };

  /// @throws InputError, on all ranks, that names every table of @p folder that is not as it was when @p saved was.
  void require_tables(const std::filesystem::path &folder, const Archive &saved);
} // namespace myolines
