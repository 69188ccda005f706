// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/observers/muscle3d_series.h>
#include <myolines/observers/stress_columns.h>
#include <myolines/output/csv_file.h>
#include <myolines/output/text_file.h>

#include <set>

namespace myolines
{
  namespace
  {
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
        csv.close();
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
              remove_file(entry.path());
      }

      static constexpr const char *memory = "steps with force_data-3d-NNN.csv";

      std::filesystem::path    folder_;
      StressParts              parts_;
      std::size_t              n_faces_;
      std::vector<std::string> columns_;
      std::vector<double>      steps_;
    };
  } // namespace

  SeriesEntry all_faces_series()
  {
    return switched_series("all faces", false, SeriesNeeds::nothing,
                           "force_data-3d-NNN.csv: the estimate on all faces, one file per row of the other series.",
                           [](const SeriesContext &context) -> std::unique_ptr<SeriesFile> {
                             return std::make_unique<AllFacesFiles>(context.folder, context.system.parameters());
                           });
  }
} // namespace myolines
