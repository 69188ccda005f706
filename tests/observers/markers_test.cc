// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/observers/markers.h>
#include <myolines/observers/muscle3d_fields.h>

#include "../output/folder.h"

using namespace myolines;

namespace
{
  scene::Node marker_scene(const std::string &parameters, const std::filesystem::path &folder = ".")
  {
    scene::Schema schema("markers");
    add_marker_parameters(schema);
    return scene::parse_scene("<ParameterList name=\"scene\">" + parameters + "</ParameterList>", schema, "scene.xml", folder);
  }

  std::string parameter(const std::string &name, const std::string &value)
  {
    return "<Parameter name=\"" + name + "\" type=\"string\" value=\"" + value + "\"/>";
  }

  /// The complaint about a list of markers; "" if it was accepted.
  std::string complaint(const std::string &markers)
  {
    try
      {
        read_markers(marker_scene(parameter("markers", markers)));
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  }

  scene::Node field_scene(const std::string &what)
  {
    scene::Schema schema("fields");
    schema.text("what", "displacement", "names");
    return scene::parse_scene("<ParameterList name=\"scene\">" + parameter("what", what) + "</ParameterList>", schema);
  }
} // namespace

TEST(Markers, NoneUnlessAskedFor) { EXPECT_TRUE(read_markers(marker_scene("")).empty()); }

TEST(Markers, FromText)
{
  const std::vector<Marker> markers = read_markers(marker_scene(parameter("markers", "p1 0.0075 0.005 0.005; mid_top 1.5e-2 0 -1;")));
  ASSERT_EQ(markers.size(), 2u);
  EXPECT_EQ(markers[0].name, "p1");
  EXPECT_EQ(markers[0].position, dealii::Point<3>(0.0075, 0.005, 0.005));
  EXPECT_EQ(markers[1].name, "mid_top");
  EXPECT_EQ(markers[1].position, dealii::Point<3>(0.015, 0, -1));
}

TEST(Markers, FromAFileInTheFormatOfFlexodeal)
{
  test::Folder folder;
  {
    std::ofstream file(folder.path / "markers.dat");
    file << "p1 0.0074999999999999997 0.005 0.005\n# a comment\n\nmid  0.135 0.0 0.0";
  }
  const std::vector<Marker> markers = read_markers(marker_scene(parameter("markers file", "markers.dat"), folder.path));
  ASSERT_EQ(markers.size(), 2u);
  EXPECT_EQ(markers[0].position[0], 0.0075);
  EXPECT_EQ(markers[1].name, "mid");
}

TEST(Markers, RefusesWhatIsNotAMarker)
{
  for (const char *bad : {"p1 0 0", "p1 0 0 zero", "p1 0 0 0 0", "p1 0,1 0 0", "p1 nan 0 0", "p1 0 inf 0", ";", "p1 0 0 0; p1 0 0 1"})
    {
      const std::string text = complaint(bad);
      EXPECT_NE(text.find("scene.xml"), std::string::npos) << bad << " -> " << text;
      EXPECT_NE(text.find("markers"), std::string::npos) << bad;
    }
  EXPECT_NE(complaint("p1 0 0 0; p1 0 0 1").find("\"p1\" is given twice"), std::string::npos);
}

TEST(Markers, RefusesTwoSources)
{
  test::Folder folder;
  {
    std::ofstream file(folder.path / "markers.dat");
    file << "p1 0 0 0\n";
  }
  EXPECT_THROW(read_markers(marker_scene(parameter("markers", "a 0 0 0") + parameter("markers file", "markers.dat"), folder.path)),
               InputError);
}

TEST(FieldNames, SeparatedByCommas)
{
  const std::vector<std::string> known{"displacement", "fibre stretch", "pressure"};
  EXPECT_EQ(read_names(field_scene("fibre stretch , displacement"), known, "field"),
            (std::vector<std::string>{"fibre stretch", "displacement"}));
  EXPECT_EQ(read_names(field_scene("pressure,pressure"), known, "field"), (std::vector<std::string>{"pressure"}));
}

TEST(FieldNames, UnknownNameGetsTheNearest)
{
  try
    {
      read_names(field_scene("displacement, presure"), {"displacement", "pressure"}, "field");
      FAIL() << "an unknown field was accepted";
    }
  catch (const InputError &error)
    {
      EXPECT_EQ(error.problems()[0].hint, "nearest: \"pressure\"");
    }
}

TEST(FieldNames, CollectionListsFilesWithTheirTimes)
{
  EXPECT_EQ(pvd_text({{0, "fields-0000.vtu"}, {0.025, "fields-0001.vtu"}}),
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n"
            "    <DataSet timestep=\"0\" group=\"\" part=\"0\" file=\"fields-0000.vtu\"/>\n"
            "    <DataSet timestep=\"0.025\" group=\"\" part=\"0\" file=\"fields-0001.vtu\"/>\n"
            "  </Collection>\n</VTKFile>\n");
}
