// SPDX-License-Identifier: LGPL-2.1-or-later
#include "vtk_cells.h"

#include <limits>

namespace myolines
{
  namespace
  {
    /// Bytes of a number of a type of VTK; 0 if the type is not known.
    std::size_t size_of_type(const std::string_view type)
    {
      static const std::map<std::string_view, std::size_t> sizes{
          {"char", 1},          {"unsigned_char", 1}, {"short", 2},        {"unsigned_short", 2}, {"int", 4},
          {"unsigned_int", 4},  {"float", 4},         {"vtktypeint64", 8}, {"long", 8},           {"unsigned_long", 8},
          {"vtktypeuint64", 8}, {"vtkIdType", 4},     {"double", 8}};
      const auto found = sizes.find(type);
      return found == sizes.end() ? 0 : found->second;
    }

    class LegacyReader
    {
    public:
      explicit LegacyReader(Cursor &cursor)
        : cursor_(cursor)
        , grid_(cursor, mesh_)
      {}

      PlainMesh read()
      {
        const std::string first(cursor_.line());
        cursor_.line(); // the title
        const std::string_view encoding = cursor_.line();
        binary_                         = encoding.substr(0, 6) == "BINARY";
        if (!binary_ && encoding.substr(0, 5) != "ASCII")
          cursor_.refuse("the third line is neither ASCII nor BINARY", "ASCII or BINARY");
        mesh_.format    = "VTK" + (first.size() > 22 ? first.substr(22) : "") + (binary_ ? ", binary" : ", ASCII");
        cursor_.swapped = true; // most significant byte first
        for (std::string_view word = cursor_.word(); !word.empty(); word = cursor_.word())
          section(word);
        if (!has_cells_)
          cursor_.refuse("there are no cells", "POINTS, CELLS and CELL_TYPES");
        grid_.finish();
        return std::move(mesh_);
      }

    private:
      void section(const std::string_view word)
      {
        if (word == "DATASET")
          {
            if (const std::string kind(cursor_.word()); kind != "UNSTRUCTURED_GRID")
              cursor_.refuse("the data set is " + kind, "UNSTRUCTURED_GRID");
          }
        else if (word == "POINTS")
          {
            const auto n = cursor_.integer("the number of points");
            grid_.add_points(numbers(n, 3, std::string(cursor_.word()), "coordinates"));
          }
        else if (word == "CELLS")
          read_cells();
        else if (word == "CELL_TYPES")
          {
            const auto n = cursor_.integer("the number of types");
            grid_.add_cells(connectivity_, ends_, numbers(n, 1, "int", "types of cells"));
            has_cells_ = true;
          }
        else if (word == "CELL_DATA" || word == "POINT_DATA")
          {
            of_cells_ = word == "CELL_DATA";
            of_any_   = true;
            rows_     = cursor_.integer("the number of rows");
          }
        else if (word == "FIELD")
          read_arrays();
        else if (word == "METADATA")
          {
            cursor_.line();                                       // the rest of its own
            while (cursor_.left() > 0 && !cursor_.line().empty()) // up to the next empty one
              continue;
          }
        else
          read_attribute(word);
      }

      /// Since version 5.1 ends of the cells and their points are arrays of their own.
      void read_cells()
      {
        const auto n = cursor_.integer("the number of cells"), size = cursor_.integer("the size of the list of cells");
        if (cursor_.peek_word() == "OFFSETS")
          {
            cursor_.word();
            ends_ = numbers(n, 1, std::string(cursor_.word()), "ends of cells");
            if (cursor_.word() != "CONNECTIVITY")
              cursor_.refuse("the points of the cells are missing", "CONNECTIVITY");
            connectivity_ = numbers(size, 1, std::string(cursor_.word()), "points of cells");
            if (!ends_.empty())
              ends_.erase(ends_.begin()); // where the first one begins
            return;
          }
        const std::vector<double> list = numbers(size, 1, "int", "points of cells");
        for (std::size_t at = 0; at < list.size();)
          {
            const double points = list[at++];
            if (!(points >= 0 && points <= static_cast<double>(list.size() - at)))
              cursor_.refuse("a cell has " + std::to_string(points) + " points", "no more than the list of cells has");
            for (const std::size_t end = at + static_cast<std::size_t>(points); at < end; ++at)
              connectivity_.push_back(list[at]);
            ends_.push_back(static_cast<double>(connectivity_.size()));
          }
      }

      /// FIELD name n, and n times: name, components, rows, type.
      void read_arrays()
      {
        cursor_.word();
        const std::size_t n = cursor_.count(cursor_.integer("the number of arrays"), 8, "arrays");
        for (std::size_t i = 0; i < n; ++i)
          {
            const std::string         name(cursor_.word());
            const auto                components = cursor_.integer("a number of components"), rows = cursor_.integer("a number of rows");
            const std::vector<double> values = numbers(rows, components, std::string(cursor_.word()), "numbers of \"" + name + "\"");
            if (of_any_)
              grid_.add_field(of_cells_, name, static_cast<std::size_t>(components), values);
          }
      }

      void read_attribute(const std::string_view word)
      {
        if (word == "LOOKUP_TABLE" || word == "COLOR_SCALARS" || word == "TEXTURE_COORDINATES")
          return pass_over(word);
        std::int64_t components = word == "SCALARS" ? 1 : word == "VECTORS" || word == "NORMALS" ? 3 : word == "TENSORS" ? 9 : 0;
        if (components == 0 || !of_any_)
          cursor_.refuse("\"" + std::string(word.substr(0, 40)) + "\" is not known", "a section of VTK's unstructured grids");
        const std::string name(cursor_.word()), type(cursor_.word());
        if (word == "SCALARS")
          {
            if (cursor_.peek_word() != "LOOKUP_TABLE")
              components = cursor_.integer("a number of components");
            cursor_.word();
            cursor_.word();
          }
        grid_.add_field(of_cells_, name, static_cast<std::size_t>(components),
                        numbers(rows_, components, type, "numbers of \"" + name + "\""));
      }

      /// What only pictures need. Colours are bytes in binary files.
      void pass_over(const std::string_view word)
      {
        cursor_.word(); // its name
        const auto second = cursor_.integer("a number of rows or components");
        if (word == "LOOKUP_TABLE")
          numbers(second, 4, "unsigned_char", "colours");
        else
          numbers(rows_, second, word == "COLOR_SCALARS" ? "unsigned_char" : std::string(cursor_.word()), "numbers of a picture");
      }

      std::vector<double> numbers(const std::int64_t rows, const std::int64_t components, const std::string &type,
                                  const std::string &things)
      {
        const std::size_t bytes = size_of_type(type);
        if (bytes == 0)
          cursor_.refuse("numbers of type \"" + type.substr(0, 40) + "\" are not known", "int, float, double, vtktypeint64 and the like");
        if (binary_)
          cursor_.line(); // numbers begin in the next one
        if (components < 0 || components > 1000)
          cursor_.refuse("there are " + std::to_string(components) + " components", "at most 1000");
        const std::size_t   each = std::max<std::size_t>(1, static_cast<std::size_t>(components));
        const std::size_t   n    = cursor_.count(rows, each * (binary_ ? bytes : 1), things) * static_cast<std::size_t>(components);
        std::vector<double> values(n);
        cursor_.binary = binary_;
        for (double &x : values)
          x = binary_ ? raw_number(type, bytes) : text_number(things);
        cursor_.binary = false;
        return values;
      }

      /// Fields may have no value at a point.
      double text_number(const std::string &things)
      {
        for (const std::string_view none : {"nan", "NaN", "-nan"})
          if (cursor_.peek_word() == none)
            return number_of(cursor_.word());
        return cursor_.number("one of the " + things);
      }

      double raw_number(const std::string &type, const std::size_t bytes)
      {
        const std::string what = "numbers";
        if (type == "float")
          return cursor_.raw<float>(what);
        if (type == "double")
          return cursor_.raw<double>(what);
        const bool natural = type.rfind("unsigned", 0) == 0 || type == "vtktypeuint64";
        switch (bytes)
          {
          case 1:
            return natural ? static_cast<double>(cursor_.raw<std::uint8_t>(what)) : cursor_.raw<std::int8_t>(what);
          case 2:
            return natural ? static_cast<double>(cursor_.raw<std::uint16_t>(what)) : cursor_.raw<std::int16_t>(what);
          case 4:
            return natural ? static_cast<double>(cursor_.raw<std::uint32_t>(what)) : cursor_.raw<std::int32_t>(what);
          default:
            return natural ? static_cast<double>(cursor_.raw<std::uint64_t>(what)) : static_cast<double>(cursor_.raw<std::int64_t>(what));
          }
      }

      Cursor             &cursor_;
      PlainMesh           mesh_;
      VtkGrid             grid_;
      std::vector<double> connectivity_, ends_;
      std::int64_t        rows_   = 0;
      bool                binary_ = false, has_cells_ = false, of_cells_ = false, of_any_ = false;
    };
  } // namespace

  PlainMesh read_legacy_vtk(Cursor &cursor) { return LegacyReader(cursor).read(); }
} // namespace myolines
