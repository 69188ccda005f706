// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/names.h>
#include <myolines/measures/flexodeal_point_data.h>
#include <myolines/measures/point_table.h>
#include <myolines/observers/muscle3d_fields.h>
#include <myolines/output/periodic_output.h>

#include <iomanip>
#include <sstream>

namespace myolines
{
  namespace
  {
    std::vector<std::string> column_names()
    {
      std::vector<std::string> names;
      for (const PointColumn &column : point_columns())
        names.push_back(column.name);
      return names;
    }

    /// Files by the number of accepted steps: quadrature-NNNN.h5, or those of Flexodeal.
    class PointTables : public PeriodicOutput
    {
    public:
      PointTables(const scene::Node &quadrature, const Muscle3dSystem &system, const OutputFolder &folder, WorkLedger &ledger)
        : PeriodicOutput(quadrature.integer("every"))
        , system_(system)
        , as_flexodeal_(quadrature.text("format") == "flexodeal")
        , columns_(quadrature.text("what") == "all" ? column_names() : read_names(quadrature, column_names(), "column"))
        , folder_(folder.path)
        , ledger_(ledger)
      {
        if (as_flexodeal_)
          for (const char *name : {"cell_data_main-3d-*.data", "cell_data_tensors-3d-*.data"})
            folder.note(name);
        else
          folder.note("quadrature-*.h5");
      }

    private:
      void write(const State &state, Side, const std::size_t step) override
      {
        const WorkLedger::Timer timer(ledger_, "output quadrature");
        ledger_.count("quadrature outputs");
        if (as_flexodeal_)
          {
            write_main_points(system_, state, folder_ / ("cell_data_main-3d-" + number(step, 3) + ".data"));
            write_tensor_points(system_, state, folder_ / ("cell_data_tensors-3d-" + number(step, 3) + ".data"));
          }
        else
          write_point_table(system_, state, columns_, (folder_ / ("quadrature-" + number(step, 4) + ".h5")).string());
      }

      static std::string number(const std::size_t step, const int digits)
      {
        std::ostringstream text;
        text << std::setw(digits) << std::setfill('0') << step;
        return text.str();
      }

      const Muscle3dSystem    &system_;
      bool                     as_flexodeal_;
      std::vector<std::string> columns_;
      std::filesystem::path    folder_;
      WorkLedger              &ledger_;
    };
  } // namespace

  scene::Schema point_tables_schema()
  {
    scene::Schema quadrature(
        "Tables of quantities at all quadrature points after step NNNN: quadrature-NNNN.h5 (HDF5), a column by its name, or the files of "
        "Flexodeal, cell_data_main-3d-NNN.data and cell_data_tensors-3d-NNN.data (rows of 32-bit numbers, thesis tables 6.2 and 6.3).");
    quadrature.integer("every", 1, scene::Range::closed(1, 1e9), "At the start, after every so many accepted steps, and at the end.")
        .choice("format", "hdf5", {"hdf5", "flexodeal"}, "Format of the files.")
        .text("what", "all", "Columns of HDF5 files: \"all\", or names separated by commas, of: " + join(column_names()) + ".");
    return quadrature;
  }

  std::unique_ptr<Observer> make_point_tables(const scene::Node &quadrature, const Muscle3dSystem &system, const OutputFolder &folder,
                                              WorkLedger &ledger)
  {
    return std::make_unique<PointTables>(quadrature, system, folder, ledger);
  }
} // namespace myolines
