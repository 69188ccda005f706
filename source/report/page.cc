// SPDX-License-Identifier: LGPL-2.1-or-later
#include "page.h"
#include "charts.h"
#include "embedded.h"

#include <myolines/base/files.h>
#include <myolines/base/names.h>
#include <myolines/scene/numbers.h>

#include <algorithm>
#include <filesystem>

namespace myolines::report
{
  namespace
  {
    struct Library
    {
      const char *package, *file;
    };
    constexpr Library three{"libjs-three", "/usr/share/javascript/three/three.min.js"};
    constexpr Library chart{"libjs-chart.js", "/usr/share/javascript/chart.js/chart.min.js"};

    /// No script may end the element that it is in.
    std::string inside_script(std::string text)
    {
      for (std::size_t at = text.find("</script"); at != std::string::npos; at = text.find("</script", at))
        text.replace(at, 2, "<\\/");
      return text;
    }

    /// Data: the letter < is written by its number, so that no markup begins.
    std::string data_text(const Json &json)
    {
      std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace), safe;
      for (const char c : text)
        safe += c == '<' ? std::string("\\u003c") : std::string(1, c);
      return safe;
    }

    /// Whether all cells of the column are numbers, or empty.
    bool has_numbers(const std::vector<Cells> &rows, const std::size_t column)
    {
      return std::all_of(rows.begin(), rows.end(), [column](const Cells &row) {
        return column >= row.size() || row[column].empty() || scene::parse_number(row[column]);
      });
    }

    std::string attribute(const std::string &kind) { return kind.empty() ? "" : " class=\"" + escaped(kind) + "\""; }

    /// No other file and no network, whatever a text in the page may say.
    const char *const policy = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:";
  } // namespace

  void Page::chapter(const std::string &title)
  {
    const std::string mark = "c" + std::to_string(contents_.size());
    contents_.emplace_back(mark, title);
    text_ += "<h2 id=\"" + mark + "\">" + escaped(title) + "</h2>\n";
  }

  void Page::heading(const std::string &title) { text_ += "<h3>" + escaped(title) + "</h3>\n"; }

  void Page::paragraph(const std::string &text, const std::string &kind)
  {
    text_ += "<p" + attribute(kind) + ">" + escaped(text) + "</p>\n";
  }

  void Page::list(const std::vector<std::string> &items, const std::string &kind)
  {
    text_ += "<ul" + attribute(kind) + ">\n";
    for (const std::string &item : items)
      text_ += "<li>" + escaped(item) + "</li>\n";
    text_ += "</ul>\n";
  }

  void Page::table(const Cells &head, const std::vector<Cells> &rows, const bool numbers)
  {
    std::vector<std::string> kinds; // of the columns
    for (std::size_t c = 0; c < head.size(); ++c)
      kinds.push_back(numbers && c > 0 && has_numbers(rows, c) ? " class=\"number\"" : "");
    text_ += "<div class=\"table\"><table><thead><tr>";
    for (std::size_t c = 0; c < head.size(); ++c)
      text_ += "<th scope=\"col\"" + kinds[c] + ">" + escaped(head[c]) + "</th>";
    text_ += "</tr></thead><tbody>\n";
    for (const Cells &row : rows)
      {
        text_ += "<tr>";
        for (std::size_t c = 0; c < row.size(); ++c)
          text_ += "<td" + (c < kinds.size() ? kinds[c] : "") + ">" + escaped(row[c]) + "</td>";
        text_ += "</tr>\n";
      }
    text_ += "</tbody></table></div>\n";
  }

  void Page::text(const std::string &text) { text_ += "<pre tabindex=\"0\">" + escaped(text) + "</pre>\n"; }

  void Page::open_details(const std::string &title) { text_ += "<details><summary>" + escaped(title) + "</summary>\n"; }

  void Page::close_details() { text_ += "</details>\n"; }

  void Page::chart(const study::Picture &picture, const std::string &svg)
  {
    std::string numbers;
    for (Json &each : charts_of(picture))
      {
        numbers += (numbers.empty() ? "" : " ") + std::to_string(charts_.size());
        charts_.push_back(std::move(each));
      }
    text_ += "<figure class=\"chart\" data-charts=\"" + numbers + "\"><figcaption>" + escaped(picture.title) + "</figcaption><img alt=\"" +
             escaped(picture.title) + "\" src=\"data:image/svg+xml;base64," + base64(svg) + "\"></figure>\n";
  }

  void Page::body(const std::string &png, const std::string &caption, Json body)
  {
    body_ = std::move(body);
    text_ += "<figure id=\"body\"><div id=\"view\"></div><img alt=\"" + escaped(caption) + "\" src=\"data:image/png;base64," + base64(png) +
             "\"><figcaption>" + escaped(caption) + "</figcaption></figure>\n";
  }

  std::string Page::html(const std::string &title) const
  {
    const Libraries found = libraries(!body_.is_null(), !charts_.empty());
    std::string     html  = "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                            "<meta http-equiv=\"Content-Security-Policy\" content=\"" +
                       std::string(policy) +
                       "\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                       "<meta name=\"color-scheme\" content=\"light dark\">\n<title>" +
                       escaped(title) + "</title>\n<style>\n" + page_style + "</style>\n</head>\n<body>\n<header><h1>" + escaped(title) +
                       "</h1>\n<nav aria-label=\"Contents\">";
    for (const auto &[mark, name] : contents_)
      html += "<a href=\"#" + mark + "\">" + escaped(name) + "</a> ";
    html += "</nav></header>\n<main>\n";
    if (!found.missing.empty())
      html += "<p class=\"note\">" +
              escaped("Made without the packages " + join(found.missing) + ": what is drawn here cannot be turned or asked for values.") +
              "</p>\n";
    html += text_ + "</main>\n<script type=\"application/json\" id=\"data\">" + data_text({{"charts", charts_}, {"body", body_}}) +
            "</script>\n";
    for (const std::string &library : found.texts)
      html += "<script>" + inside_script(library) + "</script>\n";
    html += "<script>" + inside_script(page_script) + "</script>\n";
    if (!body_.is_null())
      html += "<script>" + inside_script(body_script) + "</script>\n";
    return html + "</body>\n</html>\n";
  }

  std::string base64(const std::string &bytes)
  {
    constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string    text;
    text.reserve(bytes.size() / 3 * 4 + 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3)
      {
        const auto byte = [&](const std::size_t j) {
          return j < bytes.size() ? static_cast<unsigned int>(static_cast<unsigned char>(bytes[j])) : 0u;
        };
        const unsigned int three_bytes = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
        for (int part = 0; part < 4; ++part)
          text += i + static_cast<std::size_t>(part) > bytes.size() ? '=' : letters[three_bytes >> (18 - 6 * part) & 63];
      }
    return text;
  }

  Libraries libraries(const bool body, const bool charts)
  {
    Libraries found;
    for (const auto &[library, wanted] : {std::pair<Library, bool>{three, body}, {chart, charts}})
      if (wanted && std::filesystem::exists(library.file))
        found.texts.push_back(read_file(library.file));
      else if (wanted)
        found.missing.emplace_back(library.package);
    return found;
  }
} // namespace myolines::report
