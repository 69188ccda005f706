#pragma once

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <stdexcept>
#include <vector>

namespace myolines
{
  /// A binary file that all ranks of a communicator read or write together. What fails on one rank is thrown on all.
  class SharedFile
  {
  public:
    SharedFile(const std::filesystem::path &path, const MPI_Comm communicator, const int mode)
      : path_(path)
      , communicator_(communicator)
    {
      agree(MPI_File_open(communicator, path.c_str(), mode, MPI_INFO_NULL, &file_) == MPI_SUCCESS, "open");
    }
    ~SharedFile()
    {
      if (file_ != MPI_FILE_NULL)
        MPI_File_close(&file_);
    }
    SharedFile(const SharedFile &)            = delete;
    SharedFile &operator=(const SharedFile &) = delete;

    void resize(const std::size_t bytes) { agree(MPI_File_set_size(file_, bytes) == MPI_SUCCESS, "write"); }

    /// Writes @p text at the beginning, on the first rank.
    void write_head(const std::string &text)
    {
      bool done = true;
      if (dealii::Utilities::MPI::this_mpi_process(communicator_) == 0)
        {
          MPI_Status status;
          done = MPI_File_write_at(file_, 0, text.data(), text.size(), MPI_CHAR, &status) == MPI_SUCCESS &&
                 transferred(status, MPI_CHAR) == text.size();
        }
      agree(done, "write");
    }

    void write(const std::size_t at, const std::vector<double> &values)
    {
      MPI_Status status;
      const bool done = MPI_File_write_at_all(file_, at, values.data(), values.size(), MPI_DOUBLE, &status) == MPI_SUCCESS &&
                        transferred(status, MPI_DOUBLE) == values.size();
      agree(done, "write");
    }

    void read(const std::size_t at, std::vector<double> &values) const
    {
      MPI_Status status;
      const bool done = MPI_File_read_at_all(file_, at, values.data(), values.size(), MPI_DOUBLE, &status) == MPI_SUCCESS &&
                        transferred(status, MPI_DOUBLE) == values.size();
      agree(done, "read");
    }

    /// Returns once everything is on the disk itself.
    void close()
    {
      const bool synced = MPI_File_sync(file_) == MPI_SUCCESS;
      agree(MPI_File_close(&file_) == MPI_SUCCESS && synced, "write");
    }

  private:
    static std::size_t transferred(const MPI_Status &status, const MPI_Datatype type)
    {
      int count = 0;
      MPI_Get_count(&status, type, &count);
      return count;
    }

    void agree(const bool done, const char *verb) const
    {
      if (dealii::Utilities::MPI::min(done ? 1 : 0, communicator_) == 0)
        throw std::runtime_error(std::string("cannot ") + verb + " " + path_.string());
    }

    std::filesystem::path path_;
    MPI_Comm              communicator_;
    MPI_File              file_ = MPI_FILE_NULL;
  };
} // namespace myolines
