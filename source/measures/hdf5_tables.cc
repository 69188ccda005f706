// SPDX-License-Identifier: LGPL-2.1-or-later
#include "hdf5_tables.h"

#include <algorithm>
#include <numeric>

#include <hdf5.h>
#include <stdlib.h>
#include <unistd.h>

namespace myolines
{
  namespace
  {
    /// A file in memory for the library to write into; it vanishes with the object.
    class MemoryFile
    {
    public:
      MemoryFile()
      {
        std::string name = "/dev/shm/myolines_XXXXXX";
        const int   file = mkstemp(name.data());
        if (file < 0)
          throw SystemError("make a file in", "/dev/shm", errno);
        ::close(file);
        path = name;
      }
      ~MemoryFile() { unlink(path.c_str()); }
      MemoryFile(const MemoryFile &)            = delete;
      MemoryFile &operator=(const MemoryFile &) = delete;

      std::filesystem::path path;
    };

    /// A number of the library, closed with the object. @throws SystemError where the library gives none.
    class Handle
    {
    public:
      Handle(const hid_t id, herr_t (*close)(hid_t))
        : id_(require(id))
        , close_(close)
      {}
      ~Handle() { close_(id_); }
      Handle(const Handle &)            = delete;
      Handle &operator=(const Handle &) = delete;

      operator hid_t() const { return id_; }

      template <typename Result>
      static Result require(const Result result)
      {
        if (result < 0)
          throw SystemError("HDF5 cannot arrange the tables of a file in memory (/dev/shm)");
        return result;
      }

    private:
      hid_t id_;
      herr_t (*close_)(hid_t);
    };

    void set_text(const hid_t object, const std::string &name, const std::string &text)
    {
      const Handle type(H5Tcopy(H5T_C_S1), H5Tclose), space(H5Screate(H5S_SCALAR), H5Sclose);
      Handle::require(H5Tset_size(type, H5T_VARIABLE));
      Handle::require(H5Tset_cset(type, H5T_CSET_UTF8));
      const Handle      attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
      const char *const first = text.c_str();
      Handle::require(H5Awrite(attribute, type, &first));
    }

    void set_number(const hid_t object, const std::string &name, const double value)
    {
      const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
      const Handle attribute(H5Acreate2(object, name.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
      Handle::require(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value));
    }

    /// Where the rows of the table will be. Room is given to them, but nothing is written there.
    std::size_t add(const hid_t file, const Hdf5Table &table)
    {
      const hsize_t shape[] = {table.rows, table.width};
      const Handle  space(H5Screate_simple(table.width == 0 ? 1 : 2, shape, nullptr), H5Sclose);
      const Handle  how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
      Handle::require(H5Pset_alloc_time(how, H5D_ALLOC_TIME_EARLY));
      Handle::require(H5Pset_fill_time(how, H5D_FILL_TIME_NEVER));
      const hid_t  type = table.integers ? H5T_NATIVE_UINT : H5T_NATIVE_DOUBLE;
      const Handle set(H5Dcreate2(file, table.name.c_str(), type, space, H5P_DEFAULT, how, H5P_DEFAULT), H5Dclose);
      for (const auto &[name, text] : table.attributes)
        set_text(set, name, text);
      return H5Dget_offset(set);
    }

    /// What the library writes around the rows.
    struct Head
    {
      std::vector<std::pair<std::size_t, std::string>> pieces; ///< with their places
      std::vector<std::size_t>                         begins; ///< of the rows of each table
      std::size_t                                      size = 0;
    };

    /// Whether the system will give the library what it needs is found out before: a file that it can neither write nor close it would
    /// try to close until the program ends, and then end with it.
    void require_room(const std::filesystem::path &memory, const std::vector<Hdf5Table> &tables)
    {
      const std::string head(65536 + 4096 * tables.size(), '\0');
      std::size_t       rows = 0;
      for (const Hdf5Table &table : tables)
        rows += table.rows * std::max<std::size_t>(table.width, 1) * sizeof(double);
      File file(memory, File::Mode::write_anew);
      file.resize(head.size() + rows);
      file.write_at(0, head.data(), head.size());
    }

    Head arrange(const std::vector<Hdf5Table> &tables, const std::vector<std::pair<std::string, double>> &numbers)
    {
      const MemoryFile memory;
      Head             head;
      require_room(memory.path, tables);
      H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); // failures are told once, by us
      {
        const Handle file(H5Fcreate(memory.path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
        for (const auto &[name, value] : numbers)
          set_number(file, name, value);
        for (const Hdf5Table &table : tables)
          head.begins.push_back(add(file, table));
        Handle::require(H5Fflush(file, H5F_SCOPE_LOCAL));
      }
      const File written(memory.path, File::Mode::read);
      head.size = written.size();
      for (const auto &[begin, end] : written.written_parts())
        {
          head.pieces.emplace_back(begin, std::string(end - begin, '\0'));
          written.read_at(begin, head.pieces.back().second.data(), end - begin);
        }
      return head;
    }
  } // namespace

  RowShare::RowShare(const std::size_t rows_of_this_rank, const MPI_Comm communicator)
    : own(rows_of_this_rank)
  {
    const std::vector<std::size_t> counts = dealii::Utilities::MPI::all_gather(communicator, own);
    const auto                     mine   = counts.begin() + dealii::Utilities::MPI::this_mpi_process(communicator);
    before                                = std::accumulate(counts.begin(), mine, std::size_t(0));
    all                                   = std::accumulate(mine, counts.end(), before);
  }

  Hdf5File::Hdf5File(const std::filesystem::path &path, const MPI_Comm communicator, const std::vector<Hdf5Table> &tables,
                     const std::vector<std::pair<std::string, double>> &numbers)
    : file_(path, communicator, SharedFile::Mode::write_anew)
  {
    Head head;
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      head = arrange(tables, numbers);
    begins_ = dealii::Utilities::MPI::broadcast(communicator, head.begins);
    file_.write_pieces(head.pieces, head.size);
  }
} // namespace myolines
