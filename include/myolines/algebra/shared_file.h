// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/error.h>
#include <myolines/base/files.h>

#include <deal.II/base/mpi.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace myolines
{
  /// Runs @p action on every rank; what the system refuses one of them is thrown on all, as SystemError. Collective.
  void on_all_ranks(MPI_Comm communicator, const std::function<void()> &action);

  /// A binary file that all ranks of a communicator read or write together, each its own part. What the system refuses one rank is thrown
  /// on all, as SystemError. What is written has the name unfinished(path) until it is closed, and is removed where it is refused.
  /// All members are collective.
  class SharedFile
  {
  public:
    /// What the file is opened for.
    enum class Mode
    {
      read,      ///< one that is there
      write_anew ///< in place of one that is there
    };

    SharedFile(const std::filesystem::path &path, MPI_Comm communicator, Mode mode); ///< Opens the file at @p path.

    /// Writes @p text at the beginning, on the first rank.
    void write_head(const std::string &text);

    /// Writes texts at their places and makes the file @p size bytes long, on the first rank.
    void write_pieces(const std::vector<std::pair<std::size_t, std::string>> &pieces, std::size_t size);

    /// Writes this rank's @p values from byte @p begin on.
    template <typename Number>
    void write(const std::size_t begin, const std::vector<Number> &values)
    {
      agree([&] { file_->write_at(begin, values.data(), values.size() * sizeof(Number)); });
    }

    /// False on all ranks if the file ends before what one of them wants.
    template <typename Values>
    bool read(const std::size_t begin, Values &values) const
    {
      bool whole = true;
      agree([&] { whole = file_->read_at(begin, values.data(), values.size() * sizeof(values[0])); });
      return dealii::Utilities::MPI::min(whole ? 1 : 0, communicator_) == 1;
    }

    /// Returns once everything is on the disk itself.
    void sync();
    void close(); ///< tells what the destructor would not: some systems refuse at the end only; a new file then has its name

  private:
    /// As on_all_ranks(); what was to be written is removed if it cannot be.
    void agree(const std::function<void()> &action) const;

    std::filesystem::path path_; ///< of the file once it is closed
    MPI_Comm              communicator_;
    Mode                  mode_;
    std::unique_ptr<File> file_;
  };
} // namespace myolines
