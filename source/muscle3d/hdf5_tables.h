#pragma once

#include <deal.II/base/hdf5.h>
#include <deal.II/base/mpi.h>

#include <filesystem>
#include <numeric>

namespace myolines
{
  /// The ranks that have something to write. HDF5 1.10 does not let a rank take part in writing a table without a row of its own.
  class Writers
  {
  public:
    Writers(const bool writes, const MPI_Comm communicator)
    {
      MPI_Comm_split(communicator, writes ? 0 : MPI_UNDEFINED, dealii::Utilities::MPI::this_mpi_process(communicator), &communicator_);
    }
    ~Writers()
    {
      if (this_rank())
        MPI_Comm_free(&communicator_);
    }
    Writers(const Writers &)            = delete;
    Writers &operator=(const Writers &) = delete;

    bool     this_rank() const { return communicator_ != MPI_COMM_NULL; }
    MPI_Comm communicator() const { return communicator_; }

  private:
    MPI_Comm communicator_ = MPI_COMM_NULL;
  };

  /// The rows of a table that this rank writes, after those of the ranks before it.
  struct RowShare
  {
    RowShare(const std::size_t rows_of_this_rank, const MPI_Comm communicator)
      : own(rows_of_this_rank)
    {
      const std::vector<std::size_t> counts = dealii::Utilities::MPI::all_gather(communicator, own);
      const auto                     mine   = counts.begin() + dealii::Utilities::MPI::this_mpi_process(communicator);
      before                                = std::accumulate(counts.begin(), mine, std::size_t(0));
      all                                   = std::accumulate(mine, counts.end(), before);
    }

    std::size_t own, before, all;
  };

  /// Writes the table @p name with rows of the given shape ({}: numbers); @p values holds the own rows, at least one, one after the
  /// other. Collective among writers.
  template <typename Number>
  dealii::HDF5::DataSet write_rows(dealii::HDF5::File &file, const std::string &name, const std::vector<Number> &values,
                                   const RowShare &rows, const std::vector<hsize_t> &row)
  {
    const auto with = [&](const hsize_t first, const bool origin) {
      std::vector<hsize_t> all{first};
      for (const hsize_t n : row)
        all.push_back(origin ? 0 : n);
      return all;
    };
    dealii::HDF5::DataSet table = file.create_dataset<Number>(name, with(rows.all, false));
    table.write_hyperslab(values, with(rows.before, true), with(rows.own, false));
    return table;
  }

  /// The library does not tell in optimised builds whether the disk took everything; a whole file has at least its numbers.
  /// @throws std::runtime_error if @p file is smaller than @p bytes.
  inline void require_size(const std::string &file, const std::size_t bytes)
  {
    std::error_code missing;
    const auto      size = std::filesystem::file_size(file, missing);
    if (missing || size < bytes)
      throw std::runtime_error("cannot write " + file);
  }
} // namespace myolines
