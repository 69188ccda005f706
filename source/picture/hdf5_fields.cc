// SPDX-License-Identifier: LGPL-2.1-or-later
#include "hdf5_fields.h"

#include <myolines/base/error.h>

#include <cmath>
#include <hdf5.h>

namespace myolines::picture
{
  namespace
  {
    /// An object of the library, closed with this one.
    class Opened
    {
    public:
      Opened(const hid_t id, herr_t (*close)(hid_t), const std::filesystem::path &file)
        : id_(id)
        , close_(close)
      {
        if (id < 0)
          throw InputError(InputProblem{file.string(), "it cannot be read", "an HDF5 file of fields, as runs write it", ""});
      }
      ~Opened() { close_(id_); }
      Opened(const Opened &)            = delete;
      Opened &operator=(const Opened &) = delete;
              operator hid_t() const { return id_; }

    private:
      hid_t id_;
      herr_t (*close_)(hid_t);
    };

    struct Table
    {
      std::size_t         width = 1; ///< numbers in a row
      std::vector<double> values;
    };

    Table read_table(const hid_t file, const std::string &name, const std::filesystem::path &path)
    {
      const Opened set(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose, path);
      const Opened space(H5Dget_space(set), H5Sclose, path);
      hsize_t      shape[2] = {0, 1};
      const int    rank     = H5Sget_simple_extent_ndims(space);
      if (rank < 1 || rank > 2 || H5Sget_simple_extent_dims(space, shape, nullptr) < 0 || H5Dget_storage_size(set) == 0 ||
          shape[0] * shape[1] > H5Dget_storage_size(set)) // a damaged head may announce anything
        throw InputError(InputProblem{path.string(), "the table \"" + name + "\" has no rows of numbers", "a table as runs write it", ""});
      Table table{shape[1], std::vector<double>(shape[0] * shape[1])};
      if (H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, table.values.data()) < 0)
        throw InputError(InputProblem{path.string(), "the table \"" + name + "\" cannot be read", "numbers", "the file is damaged"});
      return table;
    }

    std::vector<std::string> names_in(const hid_t file)
    {
      std::vector<std::string> names;
      const auto               add = [](hid_t, const char *name, const H5L_info_t *, void *all) -> herr_t {
        static_cast<std::vector<std::string> *>(all)->push_back(name);
        return 0;
      };
      H5Literate(file, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names);
      return names;
    }
  } // namespace

  FieldGrid read_hdf5_fields(const std::filesystem::path &mesh, const std::filesystem::path &fields)
  {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); // failures are told once, by us
    FieldGrid    grid;
    const Opened of_mesh(H5Fopen(mesh.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, mesh);
    const Table  nodes = read_table(of_mesh, "nodes", mesh), cells = read_table(of_mesh, "cells", mesh);
    if (nodes.width != 3 || (cells.width != 8 && cells.width != 4))
      throw InputError(InputProblem{mesh.string(), "points or cells have another number of columns", "3, and 8 or 4 of a surface", ""});
    for (std::size_t p = 0; p < nodes.values.size(); p += 3)
      grid.points.push_back({{nodes.values[p], nodes.values[p + 1], nodes.values[p + 2]}});
    const std::vector<std::size_t> corners{0, 1, 3, 2, 4, 5, 7, 6}; // they go round in the file
    for (std::size_t c = 0; c < cells.values.size(); c += cells.width)
      {
        std::vector<unsigned int> cell;
        for (std::size_t v = 0; v < cells.width; ++v)
          {
            const double point = cells.values[c + corners[v]];
            if (!(point >= 0 && point < static_cast<double>(grid.points.size())))
              throw InputError(InputProblem{mesh.string(), "a point of cell " + std::to_string(c / cells.width) + " is not there",
                                            "numbers of points", "the file is damaged"});
            cell.push_back(static_cast<unsigned int>(point));
          }
        (cells.width == 8 ? grid.cells : grid.faces).push_back(cell);
      }
    const Opened of_fields(H5Fopen(fields.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, fields);
    for (const std::string &name : names_in(of_fields))
      {
        Table table = read_table(of_fields, name, fields);
        if (table.values.size() == table.width * grid.points.size())
          grid.fields.push_back({name, static_cast<unsigned int>(table.width), std::move(table.values)});
      }
    return grid;
  }
} // namespace myolines::picture
