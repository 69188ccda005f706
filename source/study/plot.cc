// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/output/manifest.h>
#include <myolines/output/text_file.h>
#include <myolines/study/csv_table.h>
#include <myolines/study/plot.h>
#include <myolines/study/plot_page.h>
#include <myolines/study/results.h>

#include <algorithm>
#include <cctype>

namespace myolines::study
{
  namespace
  {
    const std::string time_header = "Time [s]";

    struct NamedTable
    {
      std::string file, title;
      CsvTable    table;
    };

    /// What the table @p file is about, in the words of its run; its name with blanks where the run has none.
    std::string title_of(const std::string &file, const std::optional<Manifest> &manifest)
    {
      if (manifest && manifest->titles.count(file) > 0)
        return manifest->titles.at(file);
      std::string stem = std::filesystem::path(file).stem().string();
      std::replace(stem.begin(), stem.end(), '_', ' ');
      return stem;
    }

    /// The series in @p folder, in the order of their names: those of its run, if there is a manifest that lists them.
    std::vector<NamedTable> series_in(const std::filesystem::path &folder, const std::string &only)
    {
      std::vector<NamedTable> all;
      const auto              manifest = read_manifest(folder);
      const auto              is_of_it = [&manifest](const std::string &name) {
        return !manifest || !manifest->lists_files ||
               std::any_of(manifest->files.begin(), manifest->files.end(),
                                        [&name](const std::string &listed) { return matches(name, listed); });
      };
      for (const auto &entry : std::filesystem::directory_iterator(folder))
        {
          const std::string name = entry.path().filename().string();
          if (entry.path().extension() != ".csv" || (!only.empty() && name != only) || !is_of_it(name))
            continue;
          const std::optional<CsvTable> table = read_csv(entry.path());
          if (table && table->header.front() == time_header && !table->rows.empty())
            all.push_back({name, title_of(name, manifest), *table});
        }
      std::sort(all.begin(), all.end(), [](const NamedTable &a, const NamedTable &b) { return a.file < b.file; });
      return all;
    }

    std::string name_of_file(std::string text)
    {
      for (char &c : text)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '.')
          c = '_';
      return text;
    }

    Curve curve_of(const std::string &title, const Series &series)
    {
      Curve curve{title, {}};
      for (std::size_t i = 0; i < series.t.size(); ++i)
        curve.points.emplace_back(series.t[i], series.x[i]);
      return curve;
    }

    Picture empty_series(const std::string &name, const std::string &title, const std::string &y_label)
    {
      Picture picture;
      picture.name    = name_of_file(name);
      picture.title   = title;
      picture.x_label = "time [s]";
      picture.y_label = y_label;
      picture.marks   = false;
      return picture;
    }

    /// "force [N]": what a unit measures, where it is but one thing.
    std::string label_of(const std::string &unit)
    {
      for (const auto &[of, what] : {std::pair<const char *, const char *>{"N", "force"},
                                     {"m", "length"},
                                     {"J", "energy or work"},
                                     {"J/m^3", "energy density"},
                                     {"m/s", "velocity"},
                                     {"deg", "angle"},
                                     {"Pa", "stress"},
                                     {"m^3", "volume"}})
        if (unit == of)
          return std::string(what) + " [" + unit + "]";
      return "[" + (unit.empty() ? "-" : unit) + "]";
    }

    /// Columns of one unit share a picture.
    std::vector<Picture> pictures_of_table(const NamedTable &named)
    {
      std::vector<Picture>     pictures;
      std::vector<std::string> units;
      const std::string        stem = std::filesystem::path(named.file).stem().string();
      for (std::size_t c = 1; c < named.table.header.size(); ++c)
        {
          const std::string header = named.table.header[c], unit = unit_in(header);
          auto              found = std::find(units.begin(), units.end(), unit);
          if (found == units.end())
            {
              units.push_back(unit);
              pictures.push_back(empty_series(stem + (unit.empty() ? "" : "_" + unit), named.title, label_of(unit)));
              found = units.end() - 1;
            }
          pictures[found - units.begin()].curves.push_back(curve_of(header, series_of(named.table, header)));
        }
      return pictures;
    }

    /// Shortest names that tell the folders apart: their last parts.
    std::vector<std::string> titles(const std::vector<std::filesystem::path> &folders)
    {
      std::vector<std::string> names;
      for (const std::filesystem::path &folder : folders)
        {
          const std::filesystem::path clean = (folder / "").lexically_normal().parent_path();
          names.push_back(clean.filename().string());
        }
      auto sorted = names;
      std::sort(sorted.begin(), sorted.end());
      if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
        std::transform(folders.begin(), folders.end(), names.begin(), [](const auto &folder) { return folder.string(); });
      return names;
    }

    void require_run(const std::filesystem::path &folder, const std::string &file)
    {
      if (!std::filesystem::is_directory(folder))
        throw InputError(InputProblem{folder.empty() ? "\"\"" : folder.string(),
                                      std::filesystem::exists(folder) ? "it is a file, not a folder" : "there is no such folder",
                                      "the output folder of a run or of a study", ""});
      if (series_in(folder, file).empty())
        throw InputError(InputProblem{folder.string(), file.empty() ? "there is no time series" : "there is no time series " + file,
                                      "the output folder of a run, or one study", "studies are plotted one at a time"});
    }
  } // namespace

  std::vector<Picture> pictures_of_runs(const std::vector<std::filesystem::path> &folders, const std::string &file)
  {
    for (const std::filesystem::path &folder : folders)
      require_run(folder, file);
    std::vector<Picture> pictures;
    if (folders.size() == 1)
      {
        for (const NamedTable &named : series_in(folders.front(), file))
          for (Picture &picture : pictures_of_table(named))
            pictures.push_back(std::move(picture));
        return pictures;
      }
    const std::vector<std::string> names = titles(folders);
    for (const NamedTable &first : series_in(folders.front(), file))
      for (std::size_t c = 1; c < first.table.header.size(); ++c)
        {
          const std::string header = first.table.header[c], stem = std::filesystem::path(first.file).stem().string();
          Picture           picture = empty_series(stem + "_" + header.substr(0, header.find(" [")), stem, header);
          for (std::size_t r = 0; r < folders.size(); ++r)
            if (const auto table = read_csv(folders[r] / first.file); table && table->column(header))
              picture.curves.push_back(curve_of(names[r], series_of(*table, header)));
          if (picture.curves.size() > 1)
            pictures.push_back(std::move(picture));
        }
    return pictures;
  }

  void plot_command(const PlotOptions &options, std::ostream &out)
  {
    const bool one   = options.folders.size() == 1;
    const bool study = one && std::filesystem::exists(options.folders.front() / "study.resolved.xml");
    if (study && !options.file.empty())
      throw InputError(InputProblem{"--file", "a study has one table", "no such option", "name the folder of a run, in cases/"});
    std::vector<Picture> pictures = study ? pictures_of_study(options.folders.front()) : pictures_of_runs(options.folders, options.file);
    const std::vector<Constant> constants = study ? std::vector<Constant>() : without_constants(pictures);
    if (std::none_of(pictures.begin(), pictures.end(), has_points))
      throw InputError(InputProblem{options.folders.front().string(), "there is nothing to draw",
                                    study ? "a study with numbers in its table: its column \"notes\" says why there are none"
                                          : "runs that have a table in common, with numbers that change",
                                    constants.empty() ? "" : "all values stay as they are at the start"});
    const std::filesystem::path folder = !options.out.empty() ? options.out : one ? options.folders.front() / "pictures" : "pictures";
    const std::size_t           n      = draw(pictures, folder);
    replace_file(folder / "index.html", index_page(join(titles(options.folders), " and "), pictures, constants));
    if (one && options.out.empty() && !study)
      {
        std::vector<std::string> names{"pictures/index.html"};
        for (const Picture &picture : pictures)
          for (const char *extension : {".gp", ".png", ".svg"})
            names.push_back("pictures/" + picture.name + extension);
        list_in_manifest(options.folders.front(), names);
      }
    out << n << " pictures, as PNG and SVG, are in " << folder.string()
        << "; index.html shows them, each NAME.gp is what gnuplot draws one from.\n";
    if (!constants.empty())
      out << "Columns that do not change have no picture: " << constants.size() << ", with their values in index.html.\n";
  }
} // namespace myolines::study
