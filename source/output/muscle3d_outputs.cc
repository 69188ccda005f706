// SPDX-License-Identifier: LGPL-2.1-or-later
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
                   "force_data-3d.csv: part along the line of action of the interior-point estimate (6.2.15) of the force on the force face, by "
                   "part of the stress; reaction.csv has the force that balances the body.")
          .text("force face", moving_face,
                "Face of force_data-3d.csv, by a name of the geometry; the moving face is that of the first condition of type strain, else "
                "that at the end of the line of action.")
          .boolean("all faces", false, "force_data-3d-NNN.csv: the estimate on all faces, one file per row of the other series.")
          .boolean("reactions", true, "reaction.csv: force with which each prescribed boundary condition pulls on the muscle.")
          .boolean("energies", true, "energy_data-3d.csv: work-like densities (6.2.2)-(6.2.11).")
          .boolean("energy balance", true, "energy_balance.csv: energies, works and the drift of their balance; dynamic systems only.")
          .boolean("stretch and pennation", true, "mean_stretch_pennation_data-3d.csv: slab averages (6.2.22), (6.2.25).")
          .boolean("gearing info", true, "gearing_info-3d.csv: velocities behind the gearing; dynamic systems only.")
          .boolean("gearing", false, "gearing.csv: G of (7.2.13) at every row; dynamic systems only.")
          .boolean("shape", false,
                   "shape.csv: width and thickness of the slab, length along the line of action, volume over that at rest.")
          .boolean("momenta", false,
                   "momenta.csv: centre of mass, momentum, and angular momentum about the centre of mass; dynamic systems only.")
          .boolean("activation and length", true, "activation_muscle_length-3d.csv.")
          .choice("slab", "quadrature points", {"quadrature points", "whole cells"},
                  "Points of the slab averages, from 3/8 to 5/8 of the line of action: by quadrature point (6.2.20), or by cell centre as "
                  "Flexodeal does.")
          .integer("fascicles", 0, Range::closed(0, 100000),
                   "fascicles.csv: lengths and shapes of at most so many lines along the fibres, through cells of the slab; 0: no such file.");
      add_strain_places(series, "points of the line from the centre of the face where the line of action begins to that where it ends");
      add_marker_parameters(series);
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

    /// What is measured along a line of action cannot be without one.
    void refuse_without_line(const Node &series, const std::string &what, const Muscle3dSystem &system)
    {
      if (!system.line_of_action().line)
        series.refuse(what, "the body has no line of action: " + system.line_of_action().why_none,
                      "a list \"line of action\" in \"system\", with two faces \"from\" and \"to\"");
    }

    std::vector<std::unique_ptr<SeriesFile>> make_files(const Node &series, const Muscle3dSystem &system, const OutputFolder &folder,
                                                        const EnergyBalance *balance)
    {
      const Muscle3dParameters &p = system.parameters();
      for (const char *of_velocities : {"gearing", "momenta"})
        if (series.boolean(of_velocities) && !p.dynamic)
          series.refuse(of_velocities, "a quasi-static system has no velocities", "false, or \"dynamic\" as system/inertia");

      const bool                               line = system.line_of_action().line.has_value();
      std::vector<std::unique_ptr<SeriesFile>> files;
      if (series.boolean("forces") && line)
        files.push_back(force_file(folder, system, force_face(series, system).value()));
      if (series.boolean("all faces"))
        files.push_back(all_faces_files(folder, p));
      if (series.boolean("reactions") &&
          std::any_of(p.boundary.begin(), p.boundary.end(), [](const auto &condition) { return condition->facts().reacts(); }))
        files.push_back(reaction_file(folder, system));
      if (series.boolean("energies"))
        files.push_back(energy_file(folder, p));
      if (balance != nullptr)
        files.push_back(energy_balance_file(folder, p, *balance));
      if (series.boolean("stretch and pennation") && line)
        files.push_back(stretch_file(folder));
      if (series.boolean("gearing info") && p.dynamic && line)
        files.push_back(gearing_info_file(folder, system));
      if (series.boolean("gearing"))
        {
          refuse_without_line(series, "gearing", system);
          files.push_back(gearing_file(folder, system));
        }
      if (series.boolean("shape"))
        {
          refuse_without_line(series, "shape", system);
          const auto thickness = thickness_direction(system);
          if (!thickness)
            series.refuse("shape", "thickness has no direction: the fibres of the slab do not lean from the line of action, or lean to all sides",
                          "a \"thickness\" in \"system/line of action\"");
          files.push_back(shape_file(folder, system, *thickness));
        }
      if (series.boolean("activation and length"))
        files.push_back(activation_file(folder, system));
      if (series.boolean("momenta"))
        files.push_back(momenta_file(folder));
      if (const int number = series.integer("fascicles"); number > 0)
        files.push_back(fascicles_file(folder, system, number));
      if (const std::vector<double> places = read_strain_places(series); !places.empty())
        {
          refuse_without_line(series, "strain places", system);
          files.push_back(strain_file(folder, system, places));
        }
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
        , ends_(system, force_face(series, system))
        , balance_(followed_balance(series, system, folder))
        , files_(make_files(series, system, folder, balance_ ? &*balance_ : nullptr))
        , ledger_(ledger)
      {}

      const EnergyBalance *energy_balance() const override { return balance_ ? &*balance_ : nullptr; }

      void save(Archive &archive) const override
      {
        for (const auto &file : files_)
          file->save(archive);
        if (balance_)
          balance_->save(archive);
      }

    private:
      static std::optional<EnergyBalance> followed_balance(const Node &series, const Muscle3dSystem &system, const OutputFolder &folder)
      {
        if (!series.boolean("energy balance") || !system.parameters().dynamic)
          return std::nullopt;
        EnergyBalance balance;
        if (folder.saved != nullptr)
          balance.load(*folder.saved);
        return balance;
      }

      void write(const State &state, const Side side, const std::size_t step) override
      {
        const WorkLedger::Timer timer(ledger_, "output series");
        const Muscle3dSample    sample(system_, state, side, slab_, ends_, ledger_);
        if (balance_)
          balance_->accepted(state.t, sample.energetics());
        for (const auto &file : files_)
          file->row(sample, step);
      }

      void pass(const State &state) override
      {
        if (!balance_)
          return;
        const WorkLedger::Timer timer(ledger_, "output series");
        const Muscle3dSample    sample(system_, state, Side::left, slab_, ends_, ledger_);
        balance_->started() ? balance_->accepted(state.t, sample.energy_rates()) : balance_->accepted(state.t, sample.energetics());
      }

      void restarting(const State &state) override
      {
        if (!balance_ || balance_->looked_at(state.t))
          return;
        const WorkLedger::Timer timer(ledger_, "output series");
        balance_->accepted(state.t, Muscle3dSample(system_, state, Side::left, slab_, ends_, ledger_).energetics());
      }

      void restarted(const State &state) override
      {
        if (!balance_)
          return;
        const WorkLedger::Timer timer(ledger_, "output series");
        balance_->restarted(state.t, Muscle3dSample(system_, state, Side::right, slab_, ends_, ledger_).energetics());
      }

      const Muscle3dSystem                    &system_;
      SlabRule                                 slab_;
      EndPoints                                ends_;
      std::optional<EnergyBalance>             balance_;
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
