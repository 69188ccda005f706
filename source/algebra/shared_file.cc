// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/algebra/shared_file.h>

namespace myolines
{
  SharedFile::SharedFile(const std::filesystem::path &path, const MPI_Comm communicator, const Mode mode)
    : path_(path)
    , communicator_(communicator)
    , mode_(mode)
  {
    const bool                  first = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    const std::filesystem::path place = mode == Mode::write_anew ? unfinished(path) : path;
    const auto                  open  = [&](const File::Mode how) { file_ = std::make_unique<File>(place, how); };
    if (mode == Mode::write_anew) // emptied once, before others write
      agree([&] {
        if (first)
          open(File::Mode::write_anew);
      });
    agree([&] {
      if (!file_)
        open(mode == Mode::read ? File::Mode::read : File::Mode::write);
    });
  }

  void SharedFile::write_head(const std::string &text)
  {
    agree([&] {
      if (dealii::Utilities::MPI::this_mpi_process(communicator_) == 0)
        file_->write_at(0, text.data(), text.size());
    });
  }

  void SharedFile::write_pieces(const std::vector<std::pair<std::size_t, std::string>> &pieces, const std::size_t size)
  {
    agree([&] {
      if (dealii::Utilities::MPI::this_mpi_process(communicator_) != 0)
        return;
      file_->resize(size);
      for (const auto &[begin, text] : pieces)
        file_->write_at(begin, text.data(), text.size());
    });
  }

  void SharedFile::sync()
  {
    agree([&] { file_->sync(); });
  }

  void SharedFile::close()
  {
    agree([&] { file_->close(); });
    if (mode_ == Mode::write_anew)
      agree([&] {
        if (dealii::Utilities::MPI::this_mpi_process(communicator_) == 0)
          finish_file(path_);
      });
  }

  void SharedFile::agree(const std::function<void()> &action) const
  {
    try
      {
        on_all_ranks(communicator_, action);
      }
    catch (const SystemError &)
      {
        std::error_code ignored; // the first failure is the one to tell
        if (mode_ == Mode::write_anew && dealii::Utilities::MPI::this_mpi_process(communicator_) == 0)
          std::filesystem::remove(unfinished(path_), ignored);
        throw;
      }
  }

  void on_all_ranks(const MPI_Comm communicator, const std::function<void()> &action)
  {
    std::string refusal;
    int         error = 0;
    try
      {
        action();
      }
    catch (const SystemError &refused)
      {
        refusal = refused.what();
        error   = refused.error_number();
      }
    const unsigned int ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
    const unsigned int mine  = refusal.empty() ? ranks : dealii::Utilities::MPI::this_mpi_process(communicator);
    const unsigned int first = dealii::Utilities::MPI::min(mine, communicator);
    if (first < ranks)
      throw SystemError(dealii::Utilities::MPI::broadcast(communicator, refusal, first),
                        dealii::Utilities::MPI::broadcast(communicator, error, first));
  }
} // namespace myolines
