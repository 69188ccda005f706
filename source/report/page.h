// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/escape.h>
#include <myolines/study/picture.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace myolines::report
{
  using Json = nlohmann::ordered_json;

  /// A row of cells, all of them escaped when they are written.
  using Cells = std::vector<std::string>;

  /// A page that is written from top to bottom. Every text that it is given is escaped.
  class Page
  {
  public:
    /// A chapter with a place in the contents.
    void chapter(const std::string &title);
    void heading(const std::string &title);
    void paragraph(const std::string &text, const std::string &kind = "");
    void list(const std::vector<std::string> &items, const std::string &kind = "");
    /// With a button that copies it. @p numbers: columns of numbers, from the second on, stand to the right.
    void table(const Cells &head, const std::vector<Cells> &rows, bool numbers = false);
    /// Text as it stands in a file.
    void text(const std::string &text);
    /// What is between these is closed at first.
    void open_details(const std::string &title);
    void close_details();

    /// A diagram: @p svg without scripts, its curves with them.
    void chart(const study::Picture &picture, const std::string &svg);
    /// The body: @p png without scripts, @p body (body_data()) with them.
    void body(const std::string &png, const std::string &caption, Json body);

    /// The whole file. Libraries that are not there are left out, with what cannot be done without them.
    std::string html(const std::string &title) const;

  private:
    std::string                                      text_;
    std::vector<std::pair<std::string, std::string>> contents_; ///< mark and title
    Json                                             charts_ = Json::array();
    Json                                             body_;
  };

  /// Bytes for the address of an image.
  std::string base64(const std::string &bytes);

  /// The script libraries that are installed, and the names of packages that are not.
  struct Libraries
  {
    std::vector<std::string> texts, missing;
  };
  Libraries libraries(bool body, bool charts);
} // namespace myolines::report
