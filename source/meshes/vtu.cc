// SPDX-License-Identifier: LGPL-2.1-or-later
#include "field_cells.h"
#include "vtk_cells.h"
#include "vtu_arrays.h"

#include <myolines/scene/input_text.h>

namespace myolines
{
  namespace
  {
    /// @p Grid takes what the pieces tell: VtkGrid or FieldCells.
    template <typename Grid>
    class VtuReader
    {
    public:
      VtuReader(Cursor &cursor, Grid &grid)
        : cursor_(cursor)
        , grid_(grid)
      {}

      void read()
      {
        XmlTag tag;
        while (!ended_ && next_tag(cursor_, tag))
          take(tag);
        if (!ended_)
          cursor_.refuse("the file is cut off", "</VTKFile>");
        if (n_pieces_ == 0)
          cursor_.refuse("there is no piece of a grid", "<Piece> of an <UnstructuredGrid>");
        grid_.finish();
      }

    private:
      void take(const XmlTag &tag)
      {
        if (tag.name == "VTKFile")
          read_head(tag);
        else if (tag.name == "FieldData" || tag.name == "PointData" || tag.name == "CellData" || tag.name == "Points" ||
                 tag.name == "Cells")
          place_ = tag.closed ? "" : tag.name;
        else if (tag.name == "DataArray" || tag.name == "Array")
          read_array(tag);
        else if (tag.name == "Piece")
          piece_ = tag;
        else if (tag.name == "/Piece")
          end_piece();
        else if (tag.name == "AppendedData" || tag.name == "/VTKFile")
          ended_ = true;
      }

      void read_head(const XmlTag &tag)
      {
        const std::string type = tag.attribute("type"), compressor = tag.attribute("compressor"), head = tag.attribute("header_type");
        if (type != "UnstructuredGrid")
          cursor_.refuse("the data set is \"" + type + "\"", "an UnstructuredGrid",
                         type == "PUnstructuredGrid" ? "this file only names the pieces of others: save the mesh as one file" : "");
        if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
          cursor_.refuse("the data are compressed by " + compressor, "vtkZLibDataCompressor, or none", "save the file with another one");
        encoding_.compressed = !compressor.empty();
        encoding_.long_heads = head == "UInt64";
        encoding_.swapped    = tag.attribute("byte_order") == "BigEndian";
        find_appended();
      }

      void find_appended()
      {
        const std::string_view all   = cursor_.bytes();
        const std::size_t      begin = all.find("<AppendedData", cursor_.at());
        if (begin == std::string_view::npos)
          return;
        Cursor there = cursor_;
        there.go_to(begin);
        XmlTag tag;
        next_tag(there, tag);
        const std::size_t first = all.find('_', there.at());
        encoding_.base64        = tag.attribute("encoding") == "base64";
        if (first != std::string_view::npos)
          encoding_.appended = all.substr(first + 1);
        if (const std::size_t end = encoding_.base64 ? encoding_.appended.find('<') : std::string_view::npos; end != std::string_view::npos)
          encoding_.appended = encoding_.appended.substr(0, end);
      }

      void read_array(const XmlTag &tag)
      {
        const std::string name = tag.attribute("Name");
        if (place_ == "Cells" && name != "connectivity" && name != "offsets" && name != "types")
          return;
        if (place_.empty() || (place_ == "FieldData" && tag.attribute("type") != "String"))
          return;
        const double components = tag.attributes.count("NumberOfComponents") > 0 ? number_of(tag.attribute("NumberOfComponents")) : 1;
        if (!(components >= 0 && components <= 1000))
          cursor_.refuse("the array \"" + name + "\" has no number of components", "NumberOfComponents from 1 to 1000");
        std::vector<double> values = read_vtu_array(tag, cursor_, encoding_);
        if (place_ == "Points")
          points_ = std::move(values);
        else if (place_ == "Cells")
          cells_[name] = std::move(values);
        else if (place_ == "FieldData")
          read_names(values);
        else
          fields_.push_back({place_ == "CellData", {name, static_cast<unsigned int>(components), std::move(values)}});
      }

      /// Letters of texts, each ended by 0.
      void read_names(const std::vector<double> &letters)
      {
        std::string text;
        for (const double letter : letters)
          if (letter != 0)
            text += static_cast<char>(static_cast<unsigned char>(letter > 0 && letter < 256 ? letter : '?'));
          else
            {
              grid_.add_group_name(text);
              text.clear();
            }
      }

      /// The head of a piece says how many points and cells its arrays hold.
      void require(const std::string &attribute, const std::size_t n, const std::string &things) const
      {
        if (const std::string said = piece_.attribute(attribute); !said.empty() && number_of(said) != static_cast<double>(n))
          cursor_.refuse("a piece of the grid has " + std::to_string(n) + " " + things + ", but " + attribute + " is \"" +
                             said.substr(0, 40) + "\"",
                         "as many", "the file is damaged");
      }

      /// Its arrays may come in any order.
      void end_piece()
      {
        ++n_pieces_;
        require("NumberOfPoints", points_.size() / 3, "points");
        require("NumberOfCells", cells_["types"].size(), "cells");
        grid_.add_points(points_);
        grid_.add_cells(cells_["connectivity"], cells_["offsets"], cells_["types"]);
        for (const auto &[of_cells, field] : fields_)
          grid_.add_field(of_cells, field.name, field.n_components, field.values);
        points_.clear();
        cells_.clear();
        fields_.clear();
      }

      Cursor                                        &cursor_;
      Grid                                          &grid_;
      VtuEncoding                                    encoding_;
      XmlTag                                         piece_;
      std::string                                    place_; ///< the list of arrays that the cursor is in
      std::vector<double>                            points_;
      std::map<std::string, std::vector<double>>     cells_;
      std::vector<std::pair<bool, PlainMesh::Field>> fields_; ///< whether of cells
      unsigned int                                   n_pieces_ = 0;
      bool                                           ended_    = false;
    };
  } // namespace

  PlainMesh read_vtu(Cursor &cursor)
  {
    PlainMesh mesh;
    VtkGrid   grid(cursor, mesh);
    VtuReader<VtkGrid>(cursor, grid).read();
    mesh.format = "VTK XML";
    return mesh;
  }

  FieldGrid read_field_grid(const std::filesystem::path &file)
  {
    const std::string bytes = scene::read_input_bytes(file);
    Cursor            cursor(file, bytes);
    FieldGrid         grid;
    FieldCells        cells(cursor, grid);
    VtuReader<FieldCells>(cursor, cells).read();
    return grid;
  }
} // namespace myolines
