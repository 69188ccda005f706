// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: a report tells what is in a folder and nothing in it is markup, whatever its texts are.

#include "../../source/report/charts.h"
#include "../../source/report/page.h"
#include "../output/folder.h"

#include <myolines/base/error.h>
#include <myolines/report/command.h>

#include <cmath>
#include <sstream>

using namespace myolines;
using namespace myolines::report;

namespace
{
  void write(const std::filesystem::path &file, const std::string &text) { std::ofstream(file, std::ios::binary) << text; }

  const std::string evil = "</title></script><script>alert(1)</script><img src=x onerror=alert(2)>\"'";

  std::string in_xml(const std::string &text) { return escaped(text); }

  /// A run whose title, column, file name, exit reason and log are markup.
  void write_evil_run(const std::filesystem::path &folder)
  {
    write(folder / "scene.resolved.xml",
          "<ParameterList name=\"scene\"><Parameter name=\"title\" type=\"string\" value=\"" + in_xml(evil) + "\"/></ParameterList>\n");
    std::string quoted = evil;
    for (std::size_t at = quoted.find('"'); at != std::string::npos; at = quoted.find('"', at + 2))
      quoted.insert(at, "\"");
    write(folder / "reaction.csv", "Time [s],\"" + quoted + " [N]\"\n0,1\n0.1,2\n0.2,4\n");
    write(folder / "<img onerror=alert(3)>.csv", "Time [s],a [N]\n0,1\n0.1,2\n");
    write(folder / "manifest.json", Json({{"program", "myolines"},
                                          {"exit reason", evil},
                                          {"command line", evil},
                                          {"plan", {evil}},
                                          {"warnings", {evil}},
                                          {"inputs", {{evil, "0"}}}})
                                        .dump());
    write(folder / "run.log", evil);
  }

  std::size_t count_of(const std::string &text, const std::string &what)
  {
    std::size_t n = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
      ++n;
    return n;
  }
} // namespace

TEST(Page, Base64IsThatOfTheStandard) // RFC 4648, section 10
{
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(Page, ThinCurvesKeepTheirExtremes)
{
  study::Curve curve{"c", {}};
  for (int i = 0; i < 100000; ++i)
    curve.points.emplace_back(i, i == 54321 ? 7 : i == 777 ? -9 : std::sin(0.001 * i));
  curve.points.emplace_back(100000, NAN);
  const study::Curve few = thinned(curve, 800);
  EXPECT_LE(few.points.size(), 800u);
  EXPECT_EQ(few.points.front().first, 0);
  EXPECT_EQ(few.points.back().first, 99999);
  bool high = false, low = false;
  for (std::size_t i = 0; i < few.points.size(); ++i)
    {
      high = high || few.points[i] == std::pair<double, double>(54321, 7);
      low  = low || few.points[i] == std::pair<double, double>(777, -9);
      if (i > 0)
        {
          EXPECT_GE(few.points[i].first, few.points[i - 1].first);
        }
    }
  EXPECT_TRUE(high && low);
}

TEST(Report, TextsOfARunAreNoMarkup)
{
  const test::Folder folder;
  write_evil_run(folder.path);
  std::ostringstream out;
  report_command({folder.path, {}, [](const std::filesystem::path &) { return std::vector<ChangedValue>{{evil, evil, evil, evil}}; }}, out);
  const std::string html = folder.text("report.html");
  EXPECT_EQ(html.find("<script>alert"), std::string::npos);
  EXPECT_EQ(html.find("<img src=x"), std::string::npos);
  EXPECT_EQ(html.find("<img onerror"), std::string::npos);
  EXPECT_EQ(count_of(html, "</title>"), 1u);
  EXPECT_NE(html.find("&lt;/title&gt;&lt;/script&gt;"), std::string::npos) << "but they are shown";
  EXPECT_EQ(count_of(html, "<script"), count_of(html, "</script>"));
}

TEST(Report, NeedsNoOtherFileAndNoNetwork)
{
  const test::Folder folder;
  write_evil_run(folder.path);
  std::ostringstream out;
  report_command({folder.path, folder.path / "r.html", [](const std::filesystem::path &) { return std::vector<ChangedValue>(); }}, out);
  const std::string html = folder.text("r.html");
  EXPECT_NE(html.find("Content-Security-Policy\" content=\"default-src 'none'"), std::string::npos);
  for (const char *attribute : {" src=\"", " href=\""})
    for (std::size_t at = html.find(attribute); at != std::string::npos; at = html.find(attribute, at + 1))
      {
        const std::string address = html.substr(at + std::string(attribute).size(), 5);
        EXPECT_TRUE(address == "data:" || address[0] == '#' || html.rfind("<script>", at) > html.rfind("</script>", at)) << address;
      }
  EXPECT_NE(html.find("did not reach its end"), std::string::npos) << "the exit reason is none of a run that is done";
}

TEST(Report, TellsWhereThereIsNothing)
{
  const test::Folder folder;
  std::ostringstream out;
  EXPECT_THROW(report_command({folder.path, {}, {}}, out), InputError);
}
