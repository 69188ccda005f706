// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/names.h>
#include <myolines/observers/muscle3d_fields.h>
#include <myolines/output/text_file.h>
#include <myolines/scene/numbers.h>

#include <algorithm>
#include <sstream>

namespace myolines
{
  std::vector<std::string> read_names(const scene::Node &list, const std::vector<std::string> &known, const std::string &kind)
  {
    std::vector<std::string> names;
    std::istringstream       text(list.text("what"));
    for (std::string piece; std::getline(text, piece, ',');)
      {
        const std::string name = scene::trimmed(piece);
        if (std::find(known.begin(), known.end(), name) == known.end())
          list.refuse("what", "there is no " + kind + " \"" + name + "\"", "names separated by commas, of: " + join(known),
                      nearest_hint(name, known));
        if (std::find(names.begin(), names.end(), name) == names.end())
          names.push_back(name);
      }
    if (names.empty())
      list.refuse("what", "names no " + kind, "names separated by commas, of: " + join(known),
                  "leave the list \"" + list.name() + "\" out if none is wanted");
    return names;
  }

  std::string pvd_text(const std::vector<std::pair<double, std::string>> &files)
  {
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
    for (const auto &[time, name] : files)
      text += "    <DataSet timestep=\"" + exact_text(time) + "\" group=\"\" part=\"0\" file=\"" + name + "\"/>\n";
    return text + "  </Collection>\n</VTKFile>\n";
  }
} // namespace myolines
