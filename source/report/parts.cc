// SPDX-License-Identifier: LGPL-2.1-or-later
#include "reports.h"

#include <myolines/scene/csv.h>
#include <myolines/scene/input_text.h>

#include <cmath>
#include <cstdio>

namespace myolines::report
{
  namespace
  {
    std::string cell_text(const Json &value) { return value.is_string() ? value.get<std::string>() : value.is_null() ? "" : value.dump(); }

    /// Numbers with six digits; other cells as they are.
    std::string short_cell(const std::string &cell)
    {
      char        *end = nullptr;
      const double x   = std::strtod(cell.c_str(), &end);
      if (cell.size() < 9 || end != cell.c_str() + cell.size())
        return cell;
      char text[32];
      std::snprintf(text, sizeof text, "%.6g", x);
      return text;
    }
  } // namespace

  Json json_in(const std::filesystem::path &file)
  {
    std::error_code none;
    if (!std::filesystem::exists(file, none))
      return nullptr;
    const Json json = Json::parse(scene::read_input_bytes(file), nullptr, /*allow_exceptions*/ false);
    return json.is_object() ? json : Json(nullptr);
  }

  std::string number_text(const double x)
  {
    if (!std::isfinite(x))
      return "";
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", x);
    return text;
  }

  void add_provenance(const Json &manifest, Page &page)
  {
    if (!manifest.is_object())
      {
        page.paragraph("There is no manifest: who made this, with what and when, is not known.", "note");
        return;
      }
    std::vector<Cells> rows;
    for (const char *name :
         {"version", "git hash", "build", "compiler", "ranks", "command line", "scene", "started", "finished", "resumed"})
      if (manifest.contains(name) && !manifest[name].is_null())
        rows.push_back({name, cell_text(manifest[name])});
    for (const char *group : {"host", "libraries"})
      if (manifest.contains(group) && manifest[group].is_object())
        for (const auto &[name, value] : manifest[group].items())
          rows.push_back({std::string(group) + ": " + name, cell_text(value)});
    page.table({"what", "value"}, rows);
    if (manifest.contains("inputs") && manifest["inputs"].is_object() && !manifest["inputs"].empty())
      {
        rows.clear();
        for (const auto &[file, checksum] : manifest["inputs"].items())
          rows.push_back({file, cell_text(checksum)});
        page.table({"input file", "CRC-32"}, rows);
      }
  }

  bool add_table(const std::filesystem::path &file, const std::size_t most_rows, Page &page)
  {
    const auto table = scene::read_csv(file);
    if (!table)
      return false;
    std::vector<Cells> rows;
    for (std::size_t r = 0; r < std::min(most_rows, table->rows.size()); ++r)
      {
        rows.emplace_back();
        for (const std::string &cell : table->rows[r])
          rows.back().push_back(short_cell(cell));
      }
    page.table(table->header, rows, true);
    if (rows.size() < table->rows.size())
      page.paragraph("The first " + std::to_string(rows.size()) + " of " + std::to_string(table->rows.size()) + " rows of " +
                         file.filename().string() + ".",
                     "hint");
    return true;
  }

  void add_file(const std::filesystem::path &file, const std::string &title, Page &page)
  {
    std::error_code none;
    if (!std::filesystem::exists(file, none))
      return;
    constexpr std::size_t most = 200000;
    std::string           text = scene::read_input_bytes(file);
    if (text.size() > most)
      text = text.substr(0, most / 2) + "\n... (" + std::to_string(text.size() - most) + " bytes left out)\n" +
             text.substr(text.size() - most / 2);
    page.open_details(title);
    page.text(text);
    page.close_details();
  }
} // namespace myolines::report
