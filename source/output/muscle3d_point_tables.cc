#include <myolines/base/names.h>
#include <myolines/output/muscle3d_fields.h>
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

    /// quadrature-NNNN.h5, NNNN the number of accepted steps.
    class PointTables : public PeriodicOutput
    {
    public:
      PointTables(const scene::Node &quadrature, const Muscle3dSystem &system, const OutputFolder &folder, WorkLedger &ledger)
        : PeriodicOutput(quadrature.integer("every"))
        , system_(system)
        , columns_(quadrature.text("what") == "all" ? column_names() : read_names(quadrature, column_names(), "column"))
        , folder_(folder.path)
        , ledger_(ledger)
      {}

    private:
      void write(const State &state, Side, const std::size_t step) override
      {
        const WorkLedger::Timer timer(ledger_, "output quadrature");
        ledger_.count("quadrature outputs");
        std::ostringstream name;
        name << "quadrature-" << std::setw(4) << std::setfill('0') << step << ".h5";
        write_point_table(system_, state, columns_, (folder_ / name.str()).string());
      }

      const Muscle3dSystem    &system_;
      std::vector<std::string> columns_;
      std::filesystem::path    folder_;
      WorkLedger              &ledger_;
    };
  } // namespace

  scene::Schema point_tables_schema()
  {
    scene::Schema quadrature(
        "Tables of quantities at all quadrature points: quadrature-NNNN.h5 (HDF5) after step NNNN, a column by its name.");
    quadrature.integer("every", 1, scene::Range::closed(1, 1e9), "At the start, after every so many accepted steps, and at the end.")
        .text("what", "all", "\"all\", or names separated by commas, of: " + join(column_names()) + ".");
    return quadrature;
  }

  std::unique_ptr<Observer> make_point_tables(const scene::Node &quadrature, const Muscle3dSystem &system, const OutputFolder &folder,
                                              WorkLedger &ledger)
  {
    return std::make_unique<PointTables>(quadrature, system, folder, ledger);
  }
} // namespace myolines
