// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/algebra/shared_file.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace myolines
{
  /// A table of an HDF5 file: rows of doubles or, for cells, of unsigned integers.
  struct Hdf5Table
  {
    std::string                                      name;
    std::size_t                                      rows;  ///< of all ranks
    std::size_t                                      width; ///< numbers in a row; 0: the table has one dimension
    bool                                             integers = false;
    std::vector<std::pair<std::string, std::string>> attributes; ///< name and text
  };

  /// The rows of a table that this rank writes, after those of the ranks before it.
  struct RowShare
  {
    RowShare(std::size_t rows_of_this_rank, MPI_Comm communicator); ///< collective
    std::size_t own, before, all;
  };

  /// An HDF5 file of tables that all ranks write together. The library arranges it in memory, and the ranks put head and rows in their
  /// places: where the disk refuses, no library is left with a file that it can neither write nor close. All members are collective.
  /// @throws SystemError as SharedFile does.
  class Hdf5File
  {
  public:
    /// @p numbers: attributes of the file itself.
    Hdf5File(const std::filesystem::path &path, MPI_Comm communicator, const std::vector<Hdf5Table> &tables,
             const std::vector<std::pair<std::string, double>> &numbers = {});

    /// Writes the own @p rows of a table, one after the other in @p values: double or unsigned int, as the table says.
    template <typename Number>
    void write(const std::size_t table, const std::vector<Number> &values, const RowShare &rows)
    {
      const std::size_t row = rows.own > 0 ? values.size() / rows.own * sizeof(Number) : 0;
      file_.write(begins_.at(table) + rows.before * row, values);
    }

    void close() { file_.close(); }

  private:
    SharedFile               file_;
    std::vector<std::size_t> begins_; ///< of the rows of each table in the file [bytes]
  };
} // namespace myolines
