// SPDX-License-Identifier: LGPL-2.1-or-later
#include "flexodeal_profiles.h"

#include <myolines/base/names.h>
#include <myolines/scene/numbers.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace myolines
{
  namespace
  {
    using scene::format_number;
    using scene::parse_number;

    std::string control_point(const double t, const double value) { return format_number(t) + " " + format_number(value); }

    [[noreturn]] void refuse_row(const std::filesystem::path &file, const PrmRow &row, const std::string &what, const std::string &expected,
                                 const std::string &hint = "")
    {
      throw InputError(InputProblem{file.string() + ", line " + std::to_string(row.line), what, expected, hint});
    }

    /// Times are in the first column.
    void refuse_unsorted(const std::filesystem::path &file, const std::vector<PrmRow> &rows)
    {
      for (std::size_t i = 1; i < rows.size(); ++i)
        if (const double t = *parse_number(rows[i].words[0]), before = *parse_number(rows[i - 1].words[0]); !(t > before))
          refuse_row(file, rows[i],
                     "unsorted: time " + rows[i].words[0] + " follows time " + rows[i - 1].words[0] + " of line " +
                         std::to_string(rows[i - 1].line),
                     "strictly ascending times", t == before ? "a jump must be written as a short ramp" : "sort the lines by time");
    }

    /// Lines "t value value ..." in the order of time.
    void check_control_points(const std::filesystem::path &file, const std::vector<PrmRow> &rows, const std::size_t n_words,
                              const std::string &expected)
    {
      if (rows.empty())
        throw InputError(InputProblem{file.string(), "there is no control point", expected, ""});
      for (const PrmRow &row : rows)
        refuse_odd_row(file, row, 0, n_words, expected);
      refuse_unsorted(file, rows);
    }
  } // namespace

  FlexodealProfile read_control_points(const std::filesystem::path &file, const std::string &quantity, const scene::Range &range)
  {
    const std::vector<PrmRow> rows = read_rows(file);
    check_control_points(file, rows, 2, "lines \"t value\", two finite numbers with blanks between them");
    std::vector<std::string> points;
    for (const PrmRow &row : rows)
      {
        if (const double value = *parse_number(row.words[1]); !range.contains(value))
          refuse_row(file, row, "the " + quantity + " is " + row.words[1], "a number " + range.text(),
                     std::abs(value) <= 100 && std::abs(value) > 1 ? "parts of 1 are meant, not per cent" : "");
        points.push_back(join(row.words, " "));
      }
    return {join(points, "; "), file.string()};
  }

  FlexodealProfile strain_ramp(FlexodealParameters &theirs, const double length)
  {
    const std::string section = "Prescribed displacement";
    const double      start = theirs.number(section, "Pull time start"), end = theirs.number(section, "Pull time end"),
                 strain   = theirs.number(section, "Pull strain");
    const PrmEntry &given = theirs.needed(section, "Pull strain");
    if (!(strain > -1))
      theirs.refuse(given, "a number > -1");
    if (theirs.number(section, "Pull strain rate") == 0 && strain == 0)
      return {"0 0", theirs.where(given)};
    const double rate = theirs.positive(section, "Pull strain rate");
    const double half = std::abs(strain) * length / (2 * rate), middle = (start + end) / 2;
    if (!(2 * half <= (end - start) * (1 + 1e-9)))
      theirs.refuse(theirs.needed(section, "Pull strain rate"), "at least " + format_number(std::abs(strain) * length / (end - start)) +
                                                                    " m/s between Pull time start and Pull time end");
    return {control_point(middle - half, 0) + "; " + control_point(middle + half, strain), theirs.where(given)};
  }

  FlexodealProfile activation_ramp(FlexodealParameters &theirs)
  {
    const double level = theirs.number("Activation", "Activation level"), start = theirs.number("Activation", "Activation start"),
                 end      = theirs.number("Activation", "Activation end");
    const PrmEntry &given = theirs.needed("Activation", "Activation level");
    if (!(end > start))
      theirs.refuse(theirs.needed("Activation", "Activation end"), "a time after Activation start",
                    "a jump of the activation must be written as a short ramp");
    return {control_point(start, 0) + "; " + control_point(end, level / 100), theirs.where(given)};
  }

  namespace
  {
    const std::string expected_pressures =
        "a line of names, \"time\" or \"#time\" and the numbers of faces, above lines of as many finite numbers";

    /// Newer versions have the names in a comment: "#time 1", "# 1".
    bool names_faces(const PrmRow &comment)
    {
      const auto is_number = [](const std::string &word) { return scene::parse_integer(word).has_value(); };
      return comment.words.size() > 1 && comment.words[0][0] == '#' &&
             std::all_of(comment.words.begin() + 1, comment.words.end(), is_number);
    }

    /// The line of names, which goes from @p rows if it is no comment.
    PrmRow take_names(const std::filesystem::path &file, std::vector<PrmRow> &rows)
    {
      const std::vector<PrmRow> comments = read_comments(file);
      const auto                found    = std::find_if(comments.begin(), comments.end(), names_faces);
      if (found != comments.end() && (rows.empty() || found->line < rows.front().line))
        return *found;
      if (rows.empty())
        throw InputError(InputProblem{file.string(), "there is no face", expected_pressures, ""});
      const PrmRow names = rows.front();
      if (const std::string text = join(names.words, " "); text.find_first_of(",;") != std::string::npos)
        refuse_row(file, names, "\"" + text + "\" is not understood", expected_pressures, "names are separated by blanks or tabs");
      if (scene::parse_number(names.words[0]))
        refuse_row(file, names, "there is no line of names", expected_pressures);
      if (names.words.size() < 2)
        refuse_row(file, names, "there is no face", expected_pressures);
      rows.erase(rows.begin());
      return names;
    }
  } // namespace

  std::vector<FlexodealPressure> read_pressures(const std::filesystem::path &file)
  {
    std::vector<PrmRow> rows  = read_rows(file);
    const PrmRow        names = take_names(file, rows);
    check_control_points(file, rows, names.words.size(), expected_pressures);
    std::vector<FlexodealPressure> pressures;
    for (std::size_t column = 1; column < names.words.size(); ++column)
      {
        const auto face = scene::parse_integer(names.words[column]);
        if (!face || *face < 0)
          refuse_row(file, names, "\"" + names.words[column] + "\" is not the number of a face", expected_pressures);
        for (const FlexodealPressure &before : pressures)
          if (before.face == *face)
            refuse_row(file, names, "face " + names.words[column] + " has two columns", expected_pressures);
        std::vector<std::string> points;
        for (const PrmRow &row : rows)
          points.push_back(row.words[0] + " " + row.words[column]);
        pressures.push_back({*face, join(points, "; "), file.string() + ", line " + std::to_string(names.line)});
      }
    return pressures;
  }

  std::vector<FlexodealMarker> read_flexodeal_markers(const std::filesystem::path &file, FlexodealParameters &theirs)
  {
    std::vector<FlexodealMarker> markers;
    std::error_code              ignored;
    if (!file.empty() && !(std::filesystem::is_regular_file(file, ignored) && std::filesystem::file_size(file, ignored) == 0))
      for (const PrmRow &row : read_rows(file))
        {
          refuse_odd_row(file, row, 1, 4, "\"name x y z\" with coordinates in metres");
          if (row.words[0].find(';') != std::string::npos)
            refuse_row(file, row, "the name \"" + row.words[0] + "\" has a semicolon", "a name without one");
          markers.push_back(
              {row.words[0], row.words[1] + " " + row.words[2] + " " + row.words[3], file.string() + ", line " + std::to_string(row.line)});
        }
    const std::string section = "Measuring locations";
    for (const auto &[place, name] : {std::pair{"Left", "left"}, {"Mid", "mid"}, {"Right", "right"}})
      {
        const std::string x = std::string(place) + " X", y = std::string(place) + " Y", z = std::string(place) + " Z";
        if (theirs.has(section, x) || theirs.has(section, y) || theirs.has(section, z))
          markers.push_back({name,
                             format_number(theirs.number(section, x)) + " " + format_number(theirs.number(section, y)) + " " +
                                 format_number(theirs.number(section, z)),
                             theirs.where(theirs.needed(section, x))});
      }
    return markers;
  }
} // namespace myolines
