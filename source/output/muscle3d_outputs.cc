#include "places.h"

#include <myolines/base/names.h>
#include <myolines/output/dense_output.h>
#include <myolines/output/markers.h>
#include <myolines/output/muscle3d_fields.h>
#include <myolines/output/muscle3d_files.h>
#include <myolines/output/outputs.h>
#include <myolines/output/periodic_output.h>

#include <algorithm>

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
          .boolean("forces", true,
                   "force_data-3d.csv: x component of the interior-point estimate (6.2.15) on the force face, by part of the stress.")
          .text("force face", moving_face,
                "Face of force_data-3d.csv, by a name of the geometry; the moving face is that of the first condition of type strain, else "
                "x+ (of a mesh, its second face).")
          .boolean("all faces", false, "force_data-3d-NNN.csv: the estimate on all faces, one file per row of the other series.")
          .boolean("reactions", true, "reaction.csv: force with which each prescribed boundary condition pulls on the muscle.")
          .boolean("energies", true, "energy_data-3d.csv: work-like densities (6.2.2)-(6.2.11).")
          .boolean("energy balance", true, "energy_balance.csv: energies, works and the drift of their balance; dynamic systems only.")
          .boolean("stretch and pennation", true, "mean_stretch_pennation_data-3d.csv: slab averages (6.2.22), (6.2.25).")
          .boolean("gearing info", true, "gearing_info-3d.csv: velocities behind the gearing; dynamic systems only.")
          .boolean("gearing", false, "gearing.csv: G of (7.2.13) at every row; dynamic systems only.")
          .boolean("shape", false,
                   "shape.csv: width (y) and thickness (z) of the middle 3/8 L <= X <= 5/8 L, length, volume over that at rest.")
          .boolean("activation and length", true, "activation_muscle_length-3d.csv.")
          .choice("slab", "quadrature points", {"quadrature points", "whole cells"},
                  "Points of the slab averages: 3/8 L <= X <= 5/8 L by quadrature point (6.2.20), or by cell centre as Flexodeal does.");
      add_strain_places(series, "points of the line from the centre of x- to that of x+");
      add_marker_parameters(series);
      return series;
    }

    unsigned int force_face(const Node &series, const Muscle3dParameters &parameters)
    {
      if (series.text("force face") != moving_face)
        return read_face(series, "force face", parameters.geometry);
      for (const BoundaryCondition &condition : parameters.boundary)
        if (condition.type == BoundaryCondition::Type::strain)
          return condition.face;
      return face_names(parameters.geometry).size() > 1 ? 1 : 0;
    }

    std::vector<std::unique_ptr<SeriesFile>> make_files(const Node &series, const Muscle3dSystem &system, const OutputFolder &folder)
    {
      const Muscle3dParameters &p = system.parameters();
      if (series.boolean("gearing") && !p.dynamic)
        series.refuse("gearing", "a quasi-static system has no velocities", "false, or \"dynamic\" as system/inertia");

      std::vector<std::unique_ptr<SeriesFile>> files;
      if (series.boolean("forces"))
        files.push_back(force_file(folder, p, force_face(series, p)));
      if (series.boolean("all faces"))
        files.push_back(all_faces_files(folder, p));
      if (series.boolean("reactions") &&
          std::any_of(p.boundary.begin(), p.boundary.end(), [](const BoundaryCondition &c) { return c.reacts(); }))
        files.push_back(reaction_file(folder, p));
      if (series.boolean("energies"))
        files.push_back(energy_file(folder, p));
      if (series.boolean("energy balance") && p.dynamic)
        files.push_back(energy_balance_file(folder, p));
      if (series.boolean("stretch and pennation"))
        files.push_back(stretch_file(folder));
      if (series.boolean("gearing info") && p.dynamic)
        files.push_back(gearing_info_file(folder, p));
      if (series.boolean("gearing"))
        files.push_back(gearing_file(folder, p));
      if (series.boolean("shape"))
        files.push_back(shape_file(folder, system));
      if (series.boolean("activation and length"))
        files.push_back(activation_file(folder, p));
      if (const std::vector<double> places = read_strain_places(series); !places.empty())
        files.push_back(strain_file(folder, system, places));
      if (const std::vector<Marker> markers = read_markers(series); !markers.empty())
        files.push_back(displacements_file(folder, std::make_shared<MarkerProbe>(system, markers, markers_origin(series))));
      return files;
    }

    class Series : public PeriodicOutput
    {
    public:
      Series(const Node &series, const Muscle3dSystem &system, const OutputFolder &folder, WorkLedger &ledger)
        : PeriodicOutput(series.integer("every"))
        , system_(system)
        , slab_(series.text("slab") == "whole cells" ? SlabRule::whole_cells : SlabRule::quadrature_points)
        , ends_(system, force_face(series, system.parameters()))
        , files_(make_files(series, system, folder))
        , ledger_(ledger)
      {}

      void save(Archive &archive) const override
      {
        for (const auto &file : files_)
          file->save(archive);
      }

    private:
      void write(const State &state, const Side side, const std::size_t step) override
      {
        const WorkLedger::Timer timer(ledger_, "output series");
        const Muscle3dSample    sample(system_, state, side, slab_, ends_, ledger_);
        for (const auto &file : files_)
          file->row(sample, step);
      }

      void pass(const State &state) override
      {
        const WorkLedger::Timer timer(ledger_, "output series");
        const Muscle3dSample    sample(system_, state, Side::left, slab_, ends_, ledger_);
        for (const auto &file : files_)
          file->pass(sample);
      }

      const Muscle3dSystem                    &system_;
      SlabRule                                 slab_;
      EndPoints                                ends_;
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
    if (output.has("fields"))
      observers.push_back(make_fields(output.section("fields"), system, folder, ledger));
    if (output.has("quadrature"))
      observers.push_back(make_point_tables(output.section("quadrature"), system, folder, ledger));
    if (output.has("motion"))
      observers.push_back(motion_of_markers(output, system, folder));
    return observers;
  }
} // namespace myolines
