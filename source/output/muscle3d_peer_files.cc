// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/muscle3d/fascicles.h>
#include <myolines/output/csv_file.h>
#include <myolines/output/muscle3d_files.h>
#include <myolines/output/text_file.h>

#include <cmath>
#include <limits>
#include <set>

namespace myolines
{
  namespace
  {
    using Force = Parts<dealii::Tensor<1, 3>>;

    class FunctionFile : public SeriesFile
    {
    public:
      FunctionFile(const OutputFolder &folder, const std::string &name, const std::vector<std::string> &columns,
                   std::function<std::vector<double>(const Muscle3dSample &)> values)
        : csv_(folder, name, columns)
        , values_(std::move(values))
      {}

      void row(const Muscle3dSample &sample, std::size_t) override { csv_.row(values_(sample)); }
      void save(Archive &archive) const override { csv_.save(archive); }

    private:
      CsvFile                                                    csv_;
      std::function<std::vector<double>(const Muscle3dSample &)> values_;
    };

    /// The parts that a body has, in the order of the peer's columns: total, volumetric, isochoric, then these.
    class PeerParts
    {
    public:
      explicit PeerParts(const Muscle3dParameters &parameters)
        : chosen_{{muscle_active, "Muscle active"}, {muscle_passive, "Muscle passive"}, {muscle_base, "Muscle base"}}
      {
        if (parameters.tissues.count(aponeurosis_id) + parameters.tissues.count(tendon_id) > 0)
          for (const StressPart part : {aponeurosis_fibre, aponeurosis_base, tendon_fibre, tendon_base})
            chosen_.push_back({part, tendinous(part)});
        if (parameters.has_fat())
          chosen_.push_back({fat_part, "Fat"});
        for (const LawPart &law : parameters.law_parts())
          laws_.push_back(law.name);
      }

      /// The peer writes "Apo" in its files of forces and "Aponeurosis" in that of energies.
      std::vector<std::string> names(const std::string &aponeurosis) const
      {
        std::vector<std::string> all{"Total", "Volumetric", "Isochoric"};
        for (auto [part, name] : chosen_)
          {
            if (part == aponeurosis_fibre || part == aponeurosis_base)
              name.insert(0, aponeurosis);
            all.push_back(name);
          }
        all.insert(all.end(), laws_.begin(), laws_.end());
        return all;
      }

      template <typename T>
      std::vector<T> values(const Parts<T> &parts) const
      {
        std::vector<T> all{parts.total(), parts[volumetric_part], parts.isochoric()};
        for (const auto &[part, name] : chosen_)
          all.push_back(parts[part]);
        all.insert(all.end(), parts.laws.begin(), parts.laws.end());
        return all;
      }

    private:
      static std::string tendinous(const StressPart part)
      {
        return part == aponeurosis_fibre  ? " fibre"
               : part == aponeurosis_base ? " base"
               : part == tendon_fibre     ? "Tendon fibre"
                                          : "Tendon base";
      }

      std::vector<std::pair<StressPart, std::string>> chosen_;
      std::vector<std::string>                        laws_; ///< under the names of the scene
    };

    /// force_data-3d-NNN.csv: one file per row of the other series, one line per face.
    class AllFacesFiles : public SeriesFile
    {
    public:
      AllFacesFiles(const OutputFolder &folder, const Muscle3dParameters &parameters)
        : folder_(folder.path)
        , parts_(parameters)
        , n_faces_(face_names(parameters.geometry).size())
        , columns_{"Boundary ID"}
      {
        for (const std::string &part : parts_.names("Apo"))
          for (const char *axis : {" x [N]", " y [N]", " z [N]"})
            columns_.push_back(part + axis);
        folder.note("force_data-3d-*.csv");
        if (folder.saved != nullptr && folder.saved->has_numbers(memory))
          {
            steps_ = folder.saved->numbers(memory);
            remove_later_files();
          }
      }

      void row(const Muscle3dSample &sample, const std::size_t step) override
      {
        CsvFile csv(folder_, file_name(step), columns_);
        for (unsigned int face = 0; face < n_faces_; ++face)
          {
            std::vector<double> values{static_cast<double>(face)};
            for (const dealii::Tensor<1, 3> &force : parts_.values(sample.face_force(face)))
              values.insert(values.end(), {force[0], force[1], force[2]});
            csv.row(values);
          }
        steps_.push_back(static_cast<double>(step));
      }

      void save(Archive &archive) const override { archive.put_numbers(memory, steps_); }

    private:
      static std::string file_name(const std::size_t step)
      {
        std::string number = std::to_string(step);
        number.insert(0, number.size() < 3 ? 3 - number.size() : 0, '0');
        return "force_data-3d-" + number + ".csv";
      }

      /// Those that were written after what a resumed run goes on from.
      void remove_later_files() const
      {
        std::set<std::string> known;
        for (const double step : steps_)
          known.insert(file_name(static_cast<std::size_t>(step)));
        if (writes_files())
          for (const auto &entry : std::filesystem::directory_iterator(folder_))
            if (const std::string name = entry.path().filename().string(); name.rfind("force_data-3d-", 0) == 0 && known.count(name) == 0)
              std::filesystem::remove(entry.path());
      }

      static constexpr const char *memory = "steps with force_data-3d-NNN.csv";

      std::filesystem::path    folder_;
      PeerParts                parts_;
      std::size_t              n_faces_;
      std::vector<std::string> columns_;
      std::vector<double>      steps_;
    };
  } // namespace

  std::unique_ptr<SeriesFile> make_series_file(const OutputFolder &folder, const std::string &name, const std::vector<std::string> &columns,
                                               std::function<std::vector<double>(const Muscle3dSample &)> values)
  {
    return std::make_unique<FunctionFile>(folder, name, columns, std::move(values));
  }

  std::unique_ptr<SeriesFile> force_file(const OutputFolder &folder, const Muscle3dSystem &system, const unsigned int face)
  {
    const PeerParts            parts(system.parameters());
    const dealii::Tensor<1, 3> along = system.line_of_action().line.value().direction;
    std::vector<std::string>   columns{"Time [s]"};
    for (const std::string &part : parts.names("Apo"))
      columns.push_back(part + " [N]");
    columns.push_back("Volume [m^3]");
    return make_series_file(folder, "force_data-3d.csv", columns, [parts, face, along](const Muscle3dSample &sample) {
      std::vector<double> row{sample.t()};
      for (const dealii::Tensor<1, 3> &force : parts.values(sample.face_force(face)))
        row.push_back(force * along);
      row.push_back(sample.body().volume);
      return row;
    });
  }

  std::unique_ptr<SeriesFile> all_faces_files(const OutputFolder &folder, const Muscle3dParameters &parameters)
  {
    return std::make_unique<AllFacesFiles>(folder, parameters);
  }

  std::unique_ptr<SeriesFile> energy_file(const OutputFolder &folder, const Muscle3dParameters &parameters)
  {
    const PeerParts          parts(parameters);
    std::vector<std::string> columns{"Time [s]", "Kinetic [J/m^3]"};
    for (const std::string &part : parts.names("Aponeurosis"))
      columns.push_back((part == "Total" ? "Internal" : part) + " [J/m^3]");
    columns.push_back("Volume [m^3]");
    return make_series_file(folder, "energy_data-3d.csv", columns, [parts](const Muscle3dSample &sample) {
      const BodyMeasures &body = sample.body();
      std::vector<double> row{sample.t(), body.kinetic / body.volume};
      for (const double density : parts.values(body.work_density))
        row.push_back(density);
      row.push_back(body.volume);
      return row;
    });
  }

  std::unique_ptr<SeriesFile> stretch_file(const OutputFolder &folder)
  {
    return make_series_file(folder, "mean_stretch_pennation_data-3d.csv",
                            {"Time [s]", "Mean stretch", "Mean pennation [deg]", "Volume slab [m^3]"}, [](const Muscle3dSample &sample) {
                              const BodyMeasures &body = sample.body();
                              return std::vector<double>{sample.t(), body.mean_stretch, body.mean_pennation, body.slab_volume};
                            });
  }

  std::unique_ptr<SeriesFile> gearing_info_file(const OutputFolder &folder, const Muscle3dSystem &system)
  {
    const std::vector<std::string> columns{"Time [s]",
                                           "Prescribed velocity x [m/s]",
                                           "Mean muscle velocity x [m/s]",
                                           "Mean muscle velocity y [m/s]",
                                           "Mean muscle velocity z [m/s]",
                                           "Mean muscle velocity norm [m/s]",
                                           "Mean fibre strain rate (non-dim)",
                                           "Initial fibre length [m]",
                                           "Maximum strain rate [1/s]",
                                           "Mean fibre velocity [m/s]",
                                           "Volume slab [m^3]"};
    const double                   fibre = reference_fibre_length(system);
    const double                   e0    = system.parameters().muscle().fibre.maximum_strain_rate;
    return make_series_file(folder, "gearing_info-3d.csv", columns, [fibre, e0](const Muscle3dSample &sample) {
      const BodyMeasures &body = sample.body();
      const auto         &v    = body.mean_velocity;
      return std::vector<double>{sample.t(),      sample.force_face_speed(), v[0],  v[1], v[2],
                                 v.norm(),        body.mean_strain_rate,     fibre, e0,   fibre * e0 * body.mean_strain_rate,
                                 body.slab_volume};
    });
  }

  std::unique_ptr<SeriesFile> activation_file(const OutputFolder &folder, const Muscle3dSystem &system)
  {
    std::vector<std::string> columns{"Time [s]", "Activation (%)", "Muscle length [m]"};
    for (const ActivationRegion &region : system.parameters().regions)
      columns.push_back("Activation of " + region.name + " (%)");
    return make_series_file(folder, "activation_muscle_length-3d.csv", columns, [](const Muscle3dSample &sample) {
      const Activation    a = sample.activation();
      std::vector<double> row{sample.t(), 100 * a.level[0], sample.muscle_length()};
      for (int r = 1; r < a.n_regions; ++r)
        row.push_back(100 * a.level[r]);
      return row;
    });
  }

  std::unique_ptr<SeriesFile> displacements_file(const OutputFolder &folder, std::shared_ptr<const MarkerProbe> probe)
  {
    std::vector<std::string> columns{"Time [s]"};
    for (const Marker &marker : probe->markers())
      for (const char *axis : {"_x [m]", "_y [m]", "_z [m]"})
        columns.push_back(marker.name + axis);
    return make_series_file(folder, "displacements-3d.csv", columns, [probe](const Muscle3dSample &sample) {
      std::vector<double> row{sample.t()};
      for (const dealii::Tensor<1, 3> &u : probe->displacements(sample.state()))
        row.insert(row.end(), {u[0], u[1], u[2]});
      return row;
    });
  }
} // namespace myolines
