// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/counted.h>
#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/output/manifest.h>
#include <myolines/output/text_file.h>
#include <myolines/picture/command.h>
#include <myolines/picture/fibre_lines.h>
#include <myolines/picture/figure.h>
#include <myolines/scene/numbers.h>

#include <algorithm>
#include <cstdio>

namespace myolines::picture
{
  namespace
  {
    std::string file_name(std::string text)
    {
      std::replace_if(
          text.begin(), text.end(), [](const unsigned char c) { return !std::isalnum(c) && c != '-' && c != '.'; }, '_');
      return text;
    }

    std::string time_text(const double t)
    {
      char text[40];
      std::snprintf(text, sizeof text, "t = %.4g s", t);
      return text;
    }

    std::string name_of(const std::filesystem::path &folder) { return (folder / "").lexically_normal().parent_path().filename().string(); }

    void require(const bool right, const std::string &option, const std::string &what, const std::string &expected)
    {
      if (!right)
        throw InputError(InputProblem{option, what, expected, ""});
    }

    const char *const whole_body = "fields of the whole body: a run without output/fields/surface only";

    Cut cut_of(const std::string &text, const Body &body)
    {
      const double place = text.size() > 2 ? scene::parse_number(text.substr(2)).value_or(-1) : -1;
      require(place > 0 && place < 1 && text[0] >= 'x' && text[0] <= 'z' && text[1] == ':', "--cut", "\"" + text + "\" is no cut",
              "an axis and a part of the body's extent along it, between 0 and 1: \"z:0.5\"");
      require(!body.is_surface(), "--cut", "the run wrote its surface alone, in which there is nothing to cut", whole_body);
      const auto   axis = static_cast<unsigned int>(text[0] - 'x');
      const auto   less = [axis](const Vec &a, const Vec &b) { return a[axis] < b[axis]; };
      const auto   ends = std::minmax_element(body.rest.begin(), body.rest.end(), less);
      const double low = (*ends.first)[axis], high = (*ends.second)[axis];
      return {axis, low + place * (high - low)};
    }

    void check(const PictureOptions &options)
    {
      require(options.range.empty() || options.range[0] < options.range[1], "--range", "the range is empty", "a lower and a higher number");
      require(options.width >= 300 && options.width <= 8000, "--width", std::to_string(options.width) + " pixels",
              "an integer in [300, 8000]");
      require(options.fibres <= 2000, "--fibres", std::to_string(options.fibres) + " lines", "at most 2000");
      require(options.rate > 0, "--rate", "no frames in a second", "a number > 0");
      require(!options.frames || options.at.empty(), "--frames", "all times are drawn", "--at or --frames, not both");
      require(options.view.empty() || std::abs(options.view[1]) <= 90, "--view", "an elevation beyond the pole", "at most 90 degrees");
    }

    /// The runs, read piece by piece.
    class Pictures
    {
    public:
      explicit Pictures(const PictureOptions &options)
        : options_(options)
      {
        check(options);
        for (const std::filesystem::path &folder : options.folders)
          runs_.emplace_back(folder);
        const Body body = runs_.front().read(0);
        style_.field    = options.field.empty() ? first_field(body) : options.field;
        style_.width    = options.width;
        if (!options.view.empty())
          {
            style_.azimuth   = options.view[0];
            style_.elevation = options.view[1];
          }
        if (!options.range.empty())
          style_.range = {options.range[0], options.range[1]};
        if (!options.cut.empty())
          style_.cut = cut_of(options.cut, body);
        if (options.fibres > 0)
          for (std::size_t r = 0; r < runs_.size(); ++r)
            lines_.push_back(lines_of(r));
      }

      /// One sheet: all times of the only run, or all runs at all times.
      std::vector<Panel> side_by_side() const
      {
        std::vector<Panel> panels;
        for (std::size_t r = 0; r < runs_.size(); ++r)
          {
            std::vector<std::size_t> instants;
            for (const double t : options_.at)
              instants.push_back(instant(r, t));
            if (options_.at.empty() && runs_.size() == 1 && runs_[r].size() > 1)
              instants.push_back(0);
            if (options_.at.empty())
              instants.push_back(runs_[r].size() - 1);
            for (const std::size_t i : instants)
              panels.push_back(panel(r, i));
          }
        return panels;
      }

      /// Those at which any of the runs wrote fields, ascending. Times of two runs that differ by rounding are one.
      std::vector<double> frame_times() const
      {
        std::vector<double> all, times;
        for (const RunFields &run : runs_)
          for (std::size_t i = 0; i < run.size(); ++i)
            all.push_back(run.time(i));
        std::sort(all.begin(), all.end());
        const double rounding = 1e-9 * std::max(std::abs(all.front()), std::abs(all.back()));
        for (const double t : all)
          if (times.empty() || t - times.back() > rounding)
            times.push_back(t);
        return times;
      }

      /// All runs at the instant of each that is nearest to @p t.
      std::vector<Panel> frame(const double t) const
      {
        std::vector<Panel> panels;
        for (std::size_t r = 0; r < runs_.size(); ++r)
          panels.push_back(panel(r, runs_[r].nearest(t)));
        return panels;
      }

      const Style &style() const { return style_; }

      /// "stretch_fibres".
      std::string name() const
      {
        return file_name(style_.field) + (options_.fibres > 0 ? "_fibres" : "") +
               (options_.cut.empty() ? "" : "_cut_" + file_name(options_.cut));
      }

    private:
      /// That of run @p r nearest to @p t. @throws InputError for times before its first or behind its last one.
      std::size_t instant(const std::size_t r, const double t) const
      {
        const RunFields &run   = runs_[r];
        const double     first = run.time(0), last = run.time(run.size() - 1), rounding = 1e-9 * (std::abs(first) + std::abs(last));
        require(t >= first - rounding && t <= last + rounding, "--at",
                "the run \"" + name_of(options_.folders[r]) + "\" has no fields at " + scene::format_number(t) + " s",
                "a time from " + scene::format_number(first) + " s to " + scene::format_number(last) + " s");
        return run.nearest(t);
      }

      std::vector<std::vector<Vec>> lines_of(const std::size_t r) const
      {
        const Body body = runs_[r].read(0);
        require(!body.is_surface(), "--fibres", "the run \"" + name_of(options_.folders[r]) + "\" wrote its surface alone", whole_body);
        if (!has_fibres(body))
          throw InputError(InputProblem{"--fibres", "the run \"" + name_of(options_.folders[r]) + "\" wrote no directions of fibres",
                                        "the field \"fibre direction\"", "run it again with it in output/fields/what"});
        return fibre_lines(body, options_.fibres);
      }

      Panel panel(const std::size_t r, const std::size_t i) const
      {
        const std::string run = runs_.size() > 1 ? name_of(options_.folders[r]) + ", " : "";
        return {run + time_text(runs_[r].time(i)), std::make_shared<const Body>(runs_[r].read(i)),
                lines_.empty() ? std::vector<std::vector<Vec>>() : lines_[r]};
      }

      const PictureOptions                      &options_;
      std::vector<RunFields>                     runs_;
      std::vector<std::vector<std::vector<Vec>>> lines_; ///< of each run
      Style                                      style_;
    };

    /// Writes files of pictures and notes their names.
    struct Folder
    {
      std::filesystem::path    path;
      std::vector<std::string> names;

      void write(const std::string &name, const std::string &bytes)
      {
        replace_file(path / name, bytes);
        names.push_back("pictures/" + name);
      }
    };

    void draw_frames(const Pictures &pictures, const double rate, Folder &folder)
    {
      const std::vector<double> times = pictures.frame_times();
      Frame                     frame = frame_of(pictures.frame(times.front()), pictures.style());
      for (const double t : times)
        widen(frame, frame_of(pictures.frame(t), pictures.style()));
      std::vector<Pixels> all;
      for (std::size_t i = 0; i < times.size(); ++i)
        {
          all.push_back(pixels_of(sheet_of(pictures.frame(times[i]), pictures.style(), frame)));
          char number[32];
          std::snprintf(number, sizeof number, "-%04zu.png", i);
          folder.write(pictures.name() + number, png_of(all.back()));
        }
      folder.write(pictures.name() + "_animation.png", animated_png_of(all, 1 / rate));
    }
  } // namespace

  void picture_command(const PictureOptions &options, std::ostream &out)
  {
    const Pictures pictures(options);
    const bool     own = options.folders.size() == 1 && options.out.empty();
    Folder         folder{!options.out.empty() ? options.out : own ? options.folders.front() / "pictures" : "pictures", {}};
    on_writing_rank("output folder " + folder.path.string(), "a folder that can be made and written", "choose another one with --out",
                    [&] { std::filesystem::create_directories(folder.path); });
    if (options.frames)
      draw_frames(pictures, options.rate, folder);
    else
      {
        const std::vector<Panel> panels = pictures.side_by_side();
        const Sheet              sheet  = sheet_of(panels, pictures.style(), frame_of(panels, pictures.style()));
        folder.write(pictures.name() + ".png", png_of(pixels_of(sheet)));
        folder.write(pictures.name() + ".svg", svg_of(sheet));
      }
    if (own)
      list_in_manifest(options.folders.front(), folder.names);
    out << counted(folder.names.size(), "picture") << ", coloured by " << pictures.style().field << ", in " << folder.path.string()
        << ".\n";
  }
} // namespace myolines::picture
