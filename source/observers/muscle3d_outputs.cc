// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/measures/marker_probe.h>
#include <myolines/observers/markers.h>
#include <myolines/observers/muscle3d_fields.h>
#include <myolines/observers/muscle3d_series.h>
#include <myolines/observers/outputs.h>
#include <myolines/output/dense_output.h>
#include <myolines/output/periodic_output.h>

#include <functional>

namespace myolines
{
  namespace
  {
    using scene::Node;
    using scene::Range;
    using scene::Schema;

    const std::string moving_face = "moving face";

    Schema series_schema()
    {
      Schema series("Time series in CSV files; what no file asks for is not measured.");
      series.integer("every", 1, Range::closed(1, 1e9), "A row at the start, after every so many accepted steps, and at the end.")
          .text("force face", moving_face,
                "Face of force_data-3d.csv, by a name of the geometry; the moving face is that of the first condition of type strain, else "
                "that at the end of the line of action.")
          .choice("slab", "quadrature points", {"quadrature points", "whole cells"},
                  "Points of the slab averages, from 3/8 to 5/8 of the line of action: by quadrature point (6.2.20), or by cell centre as "
                  "Flexodeal does.");
      for (const SeriesEntry &entry : series_registry())
        entry.declare(series);
      return series;
    }

    std::optional<unsigned int> force_face(const Node &series, const Muscle3dSystem &system)
    {
      if (series.text("force face") != moving_face)
        return read_face(series, "force face", system.parameters().geometry);
      for (const auto &condition : system.parameters().boundary)
        if (condition->facts().strains)
          return condition->facts().face;
      if (const auto &line = system.line_of_action().line)
        return line->to;
      return std::nullopt;
    }

    class Series : public PeriodicOutput
    {
    public:
      Series(const Node &series, const Muscle3dSystem &system, const OutputFolder &folder, WorkLedger &ledger)
        : PeriodicOutput(series.integer("every"))
        , system_(system)
        , slab_(series.text("slab") == "whole cells" ? SlabRule::whole_cells : SlabRule::quadrature_points)
        , ends_(system, force_face(series, system))
        , fibre_(system)
        , files_(make_series({series, system, folder, fibre_, force_face(series, system)}))
        , ledger_(ledger)
      {}

      const EnergyBalance *energy_balance() const override
      {
        for (const auto &file : files_)
          if (const EnergyBalance *balance = file->energy_balance())
            return balance;
        return nullptr;
      }

      void save(Archive &archive) const override
      {
        for (const auto &file : files_)
          file->save(archive);
      }

    private:
      void write(const State &state, const Side side, const std::size_t step) override
      {
        visit(state, side, [step](SeriesFile &file, const Muscle3dSample &sample) { file.row(sample, step); });
      }
      void pass(const State &state) override
      {
        visit(state, Side::left, [](SeriesFile &file, const Muscle3dSample &sample) { file.pass(sample); });
      }
      void restarting(const State &state) override
      {
        visit(state, Side::left, [](SeriesFile &file, const Muscle3dSample &sample) { file.restarting(sample); });
      }
      void restarted(const State &state) override
      {
        visit(state, Side::right, [](SeriesFile &file, const Muscle3dSample &sample) { file.restarted(sample); });
      }

      /// All files with one sample, so that nothing is measured twice.
      void visit(const State &state, const Side side, const std::function<void(SeriesFile &, const Muscle3dSample &)> &with)
      {
        const WorkLedger::Timer timer(ledger_, "output series");
        const Muscle3dSample    sample(system_, state, side, slab_, ends_, ledger_);
        for (const auto &file : files_)
          with(*file, sample);
      }

      const Muscle3dSystem                    &system_;
      SlabRule                                 slab_;
      EndPoints                                ends_;
      ReferenceFibre                           fibre_;
      std::vector<std::unique_ptr<SeriesFile>> files_;
      WorkLedger                              &ledger_;
    };

    std::unique_ptr<Observer> motion_of_markers(const Node &output, const Muscle3dSystem &system, const OutputFolder &folder)
    {
      const Node               &series  = output.section("series");
      const std::vector<Marker> markers = read_markers(series);
      if (markers.empty())
        output.refuse("motion", "there are no markers whose motion could be written",
                      "\"markers\" or \"markers file\" in \"output/series\"");
      std::vector<std::string> columns;
      for (const Marker &marker : markers)
        for (const char *axis : {"_x [m]", "_y [m]", "_z [m]"})
          columns.push_back(marker.name + axis);
      const auto probe = std::make_shared<MarkerProbe>(system, markers, markers_origin(series));
      return make_motion(
          output.section("motion"), columns,
          [probe](const State &state) {
            std::vector<double> row;
            for (const dealii::Tensor<1, 3> &u : probe->displacements(state))
              row.insert(row.end(), {u[0], u[1], u[2]});
            return row;
          },
          folder, system.capabilities().inertia);
    }
  } // namespace

  Schema muscle3d_output_schema()
  {
    return Schema("What to write.")
        .section("series", series_schema())
        .optional_section("fields", field_output_schema())
        .optional_section("quadrature", point_tables_schema())
        .optional_section("motion", motion_schema("displacements of the markers of the series"));
  }

  std::vector<std::unique_ptr<Observer>> make_outputs(const Node &output, const Muscle3dSystem &system, const OutputFolder &folder,
                                                      WorkLedger &ledger)
  {
    std::vector<std::unique_ptr<Observer>> observers;
    observers.push_back(std::make_unique<Series>(output.section("series"), system, folder, ledger));
    if (output.has("fields") && !folder.rows_are_read())
      observers.push_back(make_fields(output.section("fields"), system, folder, ledger));
    if (output.has("quadrature") && !folder.rows_are_read())
      observers.push_back(make_point_tables(output.section("quadrature"), system, folder, ledger));
    if (output.has("motion"))
      observers.push_back(motion_of_markers(output, system, folder));
    return observers;
  }
} // namespace myolines
