// SPDX-License-Identifier: LGPL-2.1-or-later
#include "vtk_cells.h"

#include <cmath>
#include <limits>
#include <optional>
#include <set>

namespace myolines
{
  namespace
  {
    using Shape = PlainMesh::Shape;

    /// A type of cells of VTK; its corners come first in all but the two whose cells are parallel to the axes.
    struct VtkKind
    {
      std::optional<Shape> shape;
      bool                 straight = true, row_by_row = false;
    };

    VtkKind vtk_kind(const int type, const Cursor &cursor)
    {
      static const std::map<int, VtkKind> kinds{
          {1, {}},
          {2, {}},
          {3, {}},
          {4, {}},
          {21, {}},
          {35, {}},
          {68, {}},
          {75, {}},
          {5, {Shape::triangle}},
          {8, {Shape::quadrilateral, true, true}},
          {9, {Shape::quadrilateral}},
          {10, {Shape::tetrahedron}},
          {11, {Shape::hexahedron, true, true}},
          {12, {Shape::hexahedron}},
          {13, {Shape::wedge}},
          {14, {Shape::pyramid}},
          {22, {Shape::triangle, false}},
          {23, {Shape::quadrilateral, false}},
          {24, {Shape::tetrahedron, false}},
          {25, {Shape::hexahedron, false}},
          {26, {Shape::wedge, false}},
          {27, {Shape::pyramid, false}},
          {28, {Shape::quadrilateral, false}},
          {29, {Shape::hexahedron, false}},
          {31, {Shape::wedge, false}},
          {32, {Shape::wedge, false}},
          {33, {Shape::hexahedron, false}},
          {34, {Shape::triangle, false}},
          {37, {Shape::pyramid, false}},
          {69, {Shape::triangle, false}},
          {70, {Shape::quadrilateral, false}},
          {71, {Shape::tetrahedron, false}},
          {72, {Shape::hexahedron, false}},
          {73, {Shape::wedge, false}},
          {74, {Shape::pyramid, false}},
      };
      const auto found = kinds.find(type);
      if (found == kinds.end())
        cursor.refuse("cells of type " + std::to_string(type) + " of VTK are not known",
                      "hexahedra, tetrahedra, wedges, pyramids and their faces");
      return found->second;
    }

    /// Names that programs give to the numbers of the parts of a mesh, in small letters.
    const std::vector<std::string> group_names{"group",      "tissue",      "tissue_id", "gmsh:physical", "material",      "material_id",
                                               "materialid", "materialids", "medit:ref", "cell_tags",     "cellentityids", "boundary_id"};

    /// Whether the numbers of @p field at @p rows could be those of groups: a few natural numbers.
    bool may_be_groups(const PlainMesh::Field &field, const std::vector<std::size_t> &rows)
    {
      constexpr std::size_t most = 32;
      std::set<double>      numbers;
      for (const std::size_t row : rows)
        {
          const double x = field.values[row];
          if (!(x >= 0 && x < std::numeric_limits<int>::max()) || x != std::floor(x))
            return false;
          numbers.insert(x);
          if (numbers.size() > most)
            return false;
        }
      return numbers.size() > 1 && numbers.size() < rows.size();
    }

    /// An integer in [low, high]. @throws with @p what otherwise.
    std::size_t index(const double value, const std::size_t low, const std::size_t high, const std::string &what, const Cursor &cursor)
    {
      if (!(value >= static_cast<double>(low) && value <= static_cast<double>(high)) || value != std::floor(value))
        cursor.refuse(what + " is " + std::to_string(value), "an integer from " + std::to_string(low) + " to " + std::to_string(high));
      return static_cast<std::size_t>(value);
    }
  } // namespace

  void VtkGrid::add_points(const std::vector<double> &x)
  {
    if (x.size() % 3 != 0)
      cursor_.refuse("there are " + std::to_string(x.size()) + " coordinates", "three for each point");
    first_point_ = n_points_;
    for (std::size_t i = 0; i < x.size(); i += 3)
      {
        for (std::size_t c = i; c < i + 3; ++c)
          if (!std::isfinite(x[c]))
            cursor_.refuse("a coordinate of point " + std::to_string(i / 3) + " is not finite", "numbers");
        builder_.add_point(static_cast<std::int64_t>(n_points_++), {{x[i], x[i + 1], x[i + 2]}});
      }
  }

  void VtkGrid::add_cells(const std::vector<double> &connectivity, const std::vector<double> &ends, const std::vector<double> &types)
  {
    if (types.size() != ends.size())
      cursor_.refuse("there are " + std::to_string(types.size()) + " types of cells, but " + std::to_string(ends.size()) +
                         " ends of their points",
                     "as many");
    first_cell_       = n_cells_;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < types.size(); ++i)
      {
        const std::size_t end = index(ends[i], begin, connectivity.size(), "the end of the points of cell " + std::to_string(i), cursor_);
        const VtkKind     kind =
            vtk_kind(static_cast<int>(index(types[i], 0, 1000, "the type of cell " + std::to_string(i), cursor_)), cursor_);
        if (kind.shape)
          {
            const std::size_t n = n_corners(*kind.shape);
            if (end - begin < n || (kind.straight && end - begin != n))
              cursor_.refuse("cell " + std::to_string(i) + " has " + std::to_string(end - begin) + " points",
                             (kind.straight ? "" : "at least ") + std::to_string(n));
            std::vector<std::int64_t> corners(n);
            for (std::size_t v = 0; v < n; ++v)
              corners[v] = static_cast<std::int64_t>(first_point_ + index(connectivity[begin + v], 0,
                                                                          n_points_ - first_point_ - (n_points_ > first_point_ ? 1 : 0),
                                                                          "a point of cell " + std::to_string(i), cursor_));
            if (kind.row_by_row)
              for (std::size_t v = 2; v < n; v += 4)
                std::swap(corners[v], corners[v + 1]);
            const bool cell = !faces_of(*kind.shape).empty();
            if (cell && !kind.straight)
              ++mesh_.straightened;
            builder_.add(*kind.shape, {}, corners);
            (cell ? row_of_cell_ : row_of_face_).push_back(n_cells_ + i);
          }
        begin = end;
      }
    n_cells_ += types.size();
  }

  void VtkGrid::add_field(const bool of_cells, const std::string &name, const std::size_t n_components, const std::vector<double> &values)
  {
    const std::size_t first = of_cells ? first_cell_ : first_point_, all = of_cells ? n_cells_ : n_points_;
    if (n_components == 0 || n_components > 1000 || values.size() != n_components * (all - first))
      cursor_.refuse("the array \"" + name + "\" has " + std::to_string(values.size()) + " numbers",
                     std::to_string(all - first) + " times " + std::to_string(n_components));
    auto &fields = of_cells ? cell_fields_ : mesh_.point_fields;
    for (PlainMesh::Field &field : fields)
      if (field.name == name && field.n_components == n_components)
        {
          if (field.values.size() == n_components * first)
            field.values.insert(field.values.end(), values.begin(), values.end());
          return;
        }
    if (first == 0)
      fields.push_back({name, static_cast<unsigned int>(n_components), values});
  }

  void VtkGrid::add_group_name(const std::string &text)
  {
    const std::size_t first = text.find(' '), second = text.find(' ', first + 1);
    if (second == std::string::npos)
      return;
    const double dimension = number_of(text.substr(0, first)), number = number_of(text.substr(first + 1, second - first - 1));
    if ((dimension == 2 || dimension == 3) && number >= 0 && number < std::numeric_limits<int>::max())
      (dimension == 3 ? mesh_.cell_groups : mesh_.face_groups)[static_cast<int>(number)] = text.substr(second + 1);
  }

  bool VtkGrid::is_group(const std::string &name) const
  {
    std::string small = name;
    std::transform(small.begin(), small.end(), small.begin(), [](const unsigned char c) { return std::tolower(c); });
    return std::find(group_names.begin(), group_names.end(), small) != group_names.end();
  }

  void VtkGrid::set_groups(const PlainMesh::Field &field)
  {
    const auto set = [&](std::vector<PlainMesh::Element> &elements, const std::vector<std::size_t> &rows) {
      for (std::size_t i = 0; i < elements.size(); ++i)
        elements[i].group = static_cast<int>(index(field.values[rows[i]], 0, std::numeric_limits<int>::max(),
                                                   "\"" + field.name + "\" of cell " + std::to_string(rows[i]), cursor_));
    };
    set(mesh_.cells, row_of_cell_);
    set(mesh_.faces, row_of_face_);
  }

  void VtkGrid::finish()
  {
    const auto whole = [](const std::size_t rows) {
      return [rows](const PlainMesh::Field &field) { return field.values.size() != rows * field.n_components; };
    };
    auto &of_points = mesh_.point_fields;
    of_points.erase(std::remove_if(of_points.begin(), of_points.end(), whole(n_points_)), of_points.end());
    cell_fields_.erase(std::remove_if(cell_fields_.begin(), cell_fields_.end(), whole(n_cells_)), cell_fields_.end());
    bool grouped = false;
    for (const PlainMesh::Field &field : cell_fields_)
      if (field.n_components == 1 && is_group(field.name))
        {
          set_groups(field);
          grouped = true;
          break;
        }
    std::vector<std::size_t> rows = row_of_cell_;
    rows.insert(rows.end(), row_of_face_.begin(), row_of_face_.end());
    for (const PlainMesh::Field &field : cell_fields_)
      if (!grouped && field.n_components == 1 && may_be_groups(field, rows))
        mesh_.possible_groups.push_back(field.name);
    std::vector<PlainMesh::Element> named;
    for (const PlainMesh::Element &face : mesh_.faces)
      if (face.group != 0)
        named.push_back(face);
    mesh_.faces = named;
    for (const PlainMesh::Field &field : cell_fields_)
      {
        PlainMesh::Field of_cells{field.name, field.n_components, {}};
        for (const std::size_t row : row_of_cell_)
          of_cells.values.insert(of_cells.values.end(), field.values.begin() + static_cast<std::ptrdiff_t>(row * field.n_components),
                                 field.values.begin() + static_cast<std::ptrdiff_t>((row + 1) * field.n_components));
        mesh_.cell_fields.push_back(of_cells);
      }
  }
} // namespace myolines
