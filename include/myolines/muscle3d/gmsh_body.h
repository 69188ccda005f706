#pragma once

#include <deal.II/base/point.h>
#include <deal.II/grid/tria.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace myolines
{
  /// A hexahedral mesh from a Gmsh file, checked.
  struct GmshBody
  {
    std::vector<dealii::Point<3>>    vertices; ///< [m]
    std::vector<dealii::CellData<3>> cells;    ///< material ids are those of CellId
    dealii::SubCellData              faces;    ///< boundary ids are places in face_names
    std::vector<std::string>         face_names;
    std::vector<dealii::Point<3>>    face_centres; ///< the vertex of each face nearest to its centre
    std::vector<std::string>         tissues;      ///< by name
    dealii::Point<3>                 low, high;    ///< corners of the box around it
    double                           volume = 0;   ///< [m^3]
    std::vector<std::string>         report;       ///< lines for `check`

    /// Boundary id of faces without a physical group.
    static constexpr unsigned int unnamed = 1000;

    /// Reads any version and encoding that Gmsh reads. Physical volumes are tissues, by name ("muscle", "aponeurosis", "tendon",
    /// or such a name, a space and more: "muscle soleus") or, without one, by number (1, 2, 3); without any, all is muscle. Physical
    /// surfaces name faces; without a name their number is it.
    /// @throws InputError at @p where for a file that Gmsh does not read, cells that are no hexahedra of eight nodes, inverted or
    /// degenerate cells, hanging or coincident nodes, and unknown tissues.
    GmshBody(const std::filesystem::path &file, double scale, const std::string &where);
  };
} // namespace myolines
