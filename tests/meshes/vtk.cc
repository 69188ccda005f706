// SPDX-License-Identifier: LGPL-2.1-or-later
// Files of VTK, legacy and XML, in all their encodings; and meshes that are written and read back.
#include "example.h"

#include <myolines/meshes/write.h>

#include <gtest/gtest.h>

#include <zlib.h>

#include <cmath>

namespace myolines
{
  namespace
  {
    const std::vector<std::vector<int>> &elements()
    {
      static const std::vector<std::vector<int>> all = [] {
        std::vector<std::vector<int>> list{{0, 1}}; // a line, which is passed over
        for (const auto &cell : test::TwoCubes::cell)
          list.emplace_back(cell, cell + 8);
        for (const auto &face : test::TwoCubes::face)
          list.emplace_back(face, face + 4);
        return list;
      }();
      return all;
    }
    const std::vector<int> types{3, 12, 12, 9, 9}, groups{9, 1, 2, 11, 12};

    enum class Coding
    {
      ascii,
      base64,
      compressed,
      appended_raw,
      appended_base64,
      appended_compressed
    };

    std::string base64(const std::string &bytes)
    {
      static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
      std::string       text;
      for (std::size_t i = 0; i < bytes.size(); i += 3)
        {
          unsigned int bits = 0;
          for (std::size_t b = i; b < i + 3; ++b)
            bits = bits << 8 | (b < bytes.size() ? static_cast<unsigned char>(bytes[b]) : 0u);
          for (unsigned int c = 0; c < 4; ++c)
            text += i + c > bytes.size() ? '=' : letters[bits >> (18 - 6 * c) & 63];
        }
      return text;
    }

    /// Writes arrays one after the other.
    class Vtu
    {
    public:
      Vtu(const Coding coding, const bool swapped, const bool long_heads)
        : coding_(coding)
        , swapped_(swapped)
        , long_heads_(long_heads)
      {}

      std::string array(const std::string &type, const std::string &name, const std::vector<double> &values, const int components = 1)
      {
        std::ostringstream out;
        out << "<DataArray type='" << type << "' Name=\"" << name << "\" NumberOfComponents=\"" << components << "\" format=\""
            << (coding_ == Coding::ascii        ? "ascii"
                : coding_ <= Coding::compressed ? "binary"
                                                : "appended")
            << "\"";
        if (coding_ > Coding::compressed)
          {
            out << " offset=\"" << appended_.size() << "\"/>\n";
            appended_ += coded(type, values);
            return out.str();
          }
        out << ">\n";
        if (coding_ == Coding::ascii)
          for (const double x : values)
            out << x << " ";
        else
          out << coded(type, values);
        out << "\n</DataArray>\n";
        return out.str();
      }

      std::string file(const std::string &first_half)
      {
        const bool  compressed = coding_ == Coding::compressed || coding_ == Coding::appended_compressed;
        std::string text =
            std::string("<?xml version=\"1.0\"?>\n<!-- by a test -->\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"") +
            (swapped_ ? "BigEndian" : "LittleEndian") + "\" header_type=\"" + (long_heads_ ? "UInt64" : "UInt32") + "\"" +
            (compressed ? " compressor=\"vtkZLibDataCompressor\"" : "") + ">\n<UnstructuredGrid>\n" + first_half + "</UnstructuredGrid>\n";
        if (coding_ > Coding::compressed)
          text += std::string("<AppendedData encoding=\"") + (coding_ == Coding::appended_base64 ? "base64" : "raw") + "\">\n_" +
                  appended_ + "\n</AppendedData>\n";
        return text + "</VTKFile>\n";
      }

    private:
      std::string head(const std::vector<std::size_t> &numbers) const
      {
        test::Bytes bytes(swapped_);
        for (const std::size_t n : numbers)
          long_heads_ ? bytes.add<std::uint64_t>(n) : bytes.add<std::uint32_t>(static_cast<std::uint32_t>(n));
        return bytes.text;
      }

      std::string coded(const std::string &type, const std::vector<double> &values) const
      {
        test::Bytes bytes(swapped_);
        for (const double x : values)
          if (type == "Float64")
            bytes.add<double>(x);
          else if (type == "Float32")
            bytes.add<float>(static_cast<float>(x));
          else if (type == "Int32")
            bytes.add<std::int32_t>(static_cast<std::int32_t>(x));
          else if (type == "Int64")
            bytes.add<std::int64_t>(static_cast<std::int64_t>(x));
          else if (type == "Int16")
            bytes.add<std::int16_t>(static_cast<std::int16_t>(x));
          else if (type == "Int8")
            bytes.add<std::int8_t>(static_cast<std::int8_t>(x));
          else if (type == "UInt64")
            bytes.add<std::uint64_t>(static_cast<std::uint64_t>(x));
          else if (type == "UInt32")
            bytes.add<std::uint32_t>(static_cast<std::uint32_t>(x));
          else if (type == "UInt16")
            bytes.add<std::uint16_t>(static_cast<std::uint16_t>(x));
          else
            bytes.add<std::uint8_t>(static_cast<std::uint8_t>(x));
        const bool letters = coding_ != Coding::appended_raw && coding_ != Coding::appended_compressed;
        if (coding_ != Coding::compressed && coding_ != Coding::appended_compressed)
          return letters ? base64(head({bytes.text.size()}) + bytes.text) : head({bytes.text.size()}) + bytes.text;
        // Blocks of 64 bytes, the last one shorter.
        const std::size_t        block = 64, n = (bytes.text.size() + block - 1) / block;
        std::vector<std::size_t> numbers{n, block, bytes.text.size() % block};
        std::string              data;
        for (std::size_t i = 0; i < n; ++i)
          {
            const std::string part   = bytes.text.substr(i * block, block);
            uLongf            length = compressBound(part.size());
            std::string       small(length, '\0');
            compress(reinterpret_cast<Bytef *>(small.data()), &length, reinterpret_cast<const Bytef *>(part.data()), part.size());
            numbers.push_back(length);
            data += small.substr(0, length);
          }
        return letters ? base64(head(numbers)) + base64(data) : head(numbers) + data;
      }

      Coding      coding_;
      bool        swapped_, long_heads_;
      std::string appended_;
    };

    std::vector<double> coordinates()
    {
      std::vector<double> all;
      for (int i = 0; i < 12; ++i)
        for (const double x : test::TwoCubes::point(i))
          all.push_back(x);
      return all;
    }

    /// Groups and ends of cells being numbers of the type @p integers.
    std::string two_cubes(const Coding coding, const bool swapped = false, const bool long_heads = false,
                          const std::string &integers = "Int32")
    {
      Vtu                 vtu(coding, swapped, long_heads);
      std::vector<double> connectivity, offsets, fibre;
      for (const auto &element : elements())
        {
          connectivity.insert(connectivity.end(), element.begin(), element.end());
          offsets.push_back(static_cast<double>(connectivity.size()));
          fibre.insert(fibre.end(), {1, 0.5, static_cast<double>(offsets.size())});
        }
      return vtu.file("<Piece NumberOfPoints=\"12\" NumberOfCells=\"5\">\n<PointData>\n" +
                      vtu.array("Float32", "height", std::vector<double>(12, 0.25)) + "</PointData>\n<CellData>\n" +
                      vtu.array(integers, "gmsh:physical", {groups.begin(), groups.end()}) + vtu.array("Float64", "fibre", fibre, 3) +
                      "</CellData>\n<Points>\n" + vtu.array("Float64", "Points", coordinates(), 3) + "</Points>\n<Cells>\n" +
                      vtu.array("Int64", "connectivity", connectivity) + vtu.array(integers, "offsets", offsets) +
                      vtu.array("UInt8", "types", {types.begin(), types.end()}) + "</Cells>\n</Piece>\n");
    }

    const Coding all_codings[] = {Coding::ascii,        Coding::base64,          Coding::compressed,
                                  Coding::appended_raw, Coding::appended_base64, Coding::appended_compressed};

    TEST(VtkFiles, EveryEncodingIsTheSameMesh)
    {
      for (const Coding coding : all_codings)
        for (const bool swapped : {false, true})
          for (const bool long_heads : {false, true})
            {
              const PlainMesh mesh = test::mesh_of(two_cubes(coding, swapped, long_heads));
              EXPECT_EQ(test::difference_from_two_cubes(mesh), "") << static_cast<int>(coding) << swapped << long_heads;
              ASSERT_EQ(mesh.cell_fields.size(), 2u);
              EXPECT_EQ(mesh.cell_fields[1].values, (std::vector<double>{1, 0.5, 2, 1, 0.5, 3})) << "rows of cells alone";
              ASSERT_EQ(mesh.point_fields.size(), 1u);
              EXPECT_EQ(mesh.point_fields[0].values, std::vector<double>(12, 0.25));
            }
    }

    TEST(VtkFiles, IntegersMayHaveAnyWidth)
    {
      for (const char *type : {"Int8", "Int16", "Int32", "Int64", "UInt8", "UInt16", "UInt32", "UInt64"})
        for (const bool swapped : {false, true})
          EXPECT_EQ(test::difference_from_two_cubes(test::mesh_of(two_cubes(Coding::base64, swapped, false, type))), "") << type << swapped;
      EXPECT_NE(test::refusal_of(two_cubes(Coding::base64, false, false, "Int128")).find("\"Int128\" are not known"), std::string::npos);
    }

    std::string legacy(const bool binary, const bool newer)
    {
      test::Bytes b(true);
      const auto  number = [&](const auto value) { binary ? b.add(value) : b.t(std::to_string(value) + " "); };
      b.t(std::string("# vtk DataFile Version ") + (newer ? "5.1" : "3.0") + "\nby a test\n" + (binary ? "BINARY" : "ASCII") +
          "\nDATASET UNSTRUCTURED_GRID\nPOINTS 12 double\n");
      for (const double x : coordinates())
        number(x);
      if (newer)
        {
          b.t("\nMETADATA\nINFORMATION 0\n\nCELLS 6 26\nOFFSETS vtktypeint64\n");
          std::int64_t end = 0;
          number(end);
          for (const auto &element : elements())
            number(end += static_cast<std::int64_t>(element.size()));
          b.t("\nCONNECTIVITY vtktypeint64\n");
          for (const auto &element : elements())
            for (const int v : element)
              number(static_cast<std::int64_t>(v));
        }
      else
        {
          b.t("\nCELLS 5 31\n");
          for (const auto &element : elements())
            {
              number(static_cast<int>(element.size()));
              for (const int v : element)
                number(v);
            }
        }
      b.t("\nCELL_TYPES 5\n");
      for (const int type : types)
        number(type);
      b.t("\nCELL_DATA 5\nVECTORS fibre float\n");
      for (int i = 0; i < 15; ++i)
        number(static_cast<float>(i));
      b.t("\nFIELD FieldData 1\nmaterial 1 5 int\n");
      for (const int group : groups)
        number(group);
      b.t("\nPOINT_DATA 12\nSCALARS height double 1\nLOOKUP_TABLE default\n");
      for (int i = 0; i < 12; ++i)
        number(0.5 * i);
      return b.t("\n").text;
    }

    TEST(VtkFiles, LegacyFilesAreTheSameMesh)
    {
      for (const bool binary : {false, true})
        for (const bool newer : {false, true})
          {
            const PlainMesh mesh = test::mesh_of(legacy(binary, newer));
            EXPECT_EQ(test::difference_from_two_cubes(mesh), "") << binary << newer;
            ASSERT_EQ(mesh.cell_fields.size(), 2u);
            EXPECT_EQ(mesh.cell_fields[0].values, (std::vector<double>{3, 4, 5, 6, 7, 8}));
            EXPECT_EQ(mesh.point_fields.at(0).values.at(11), 5.5);
          }
    }

    TEST(VtkFiles, ArraysThatMayBeGroupsAreNoted)
    {
      const auto noted = [](const std::string &array, const std::string &values) {
        return test::mesh_of(
                   "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 float\n0 0 0 1 0 0 0 1 0 0 0 1 1 1 1 2 1 1\n"
                   "CELLS 3 15\n4 0 1 2 3\n4 1 2 3 4\n4 1 2 4 5\nCELL_TYPES 3\n10 10 10\nCELL_DATA 3\nSCALARS " +
                   array + " float 1\nLOOKUP_TABLE default\n" + values + "\n")
            .possible_groups;
      };
      EXPECT_EQ(noted("region", "1 2 2"), std::vector<std::string>{"region"});
      EXPECT_TRUE(noted("Tissue", "1 2 2").empty()) << "it is one";
      for (const char *values : {"1 1 1", "1 2 3", "0.5 1 1", "-1 1 1", "nan 1 1"})
        EXPECT_TRUE(noted("region", values).empty()) << values;
    }

    TEST(VtkFiles, WhatOnlyPicturesNeedIsPassedOver)
    {
      const auto repeated = [](const std::string &text, const int n) {
        std::string all;
        for (int i = 0; i < n; ++i)
          all += text;
        return all;
      };
      const std::string behind = "SCALARS last float\nLOOKUP_TABLE mine\n";
      const std::string text   = legacy(false, false) + "COLOR_SCALARS c 3\n" + repeated("0.5 0 1\n", 12) +
                               "LOOKUP_TABLE mine 2\n0 0 0 1 1 1 1 1\n" + "TEXTURE_COORDINATES t 2 float\n" + repeated("0 1 ", 12) + "\n" +
                               behind + repeated("nan 2 ", 6) + "\n";
      const std::string bytes = legacy(true, false) + "COLOR_SCALARS c 3\n" + repeated("\n  ", 12) + "\nLOOKUP_TABLE mine 2\n" +
                                repeated("$ \n1", 2) + "\nTEXTURE_COORDINATES t 2 float\n" + repeated(std::string(8, '\0'), 12) + "\n" +
                                behind + repeated(std::string("\x7f\xc0\0\0@\0\0\0", 8), 6) + "\n";
      for (const std::string &file : {text, bytes})
        {
          const PlainMesh mesh = test::mesh_of(file);
          EXPECT_EQ(test::difference_from_two_cubes(mesh), "");
          ASSERT_EQ(mesh.point_fields.size(), 2u);
          EXPECT_TRUE(std::isnan(mesh.point_fields[1].values[0]));
          EXPECT_EQ(mesh.point_fields[1].values[11], 2);
        }
    }

    TEST(VtkFiles, NoDamageDoesAnyHarm)
    {
      std::vector<std::string> files{legacy(false, false), legacy(true, false), legacy(true, true)};
      for (const Coding coding : all_codings)
        files.push_back(two_cubes(coding));
      std::size_t refused = 0;
      for (const std::string &text : files)
        for (std::size_t n = 0; n < text.size(); n += 7)
          {
            refused += test::refusal_of(text.substr(0, n)).empty() ? 0 : 1;
            std::string changed = text;
            changed[n]          = static_cast<char>(changed[n] ^ (n % 2 == 0 ? 0x80 : 0x15));
            refused += test::refusal_of(changed).empty() ? 0 : 1;
          }
      EXPECT_GT(refused, 1000u);
    }

    TEST(VtkFiles, RefusalsNameWhatIsWrong)
    {
      const auto told = [](std::string text, const std::string &what, const std::string &by, const std::string &words) {
        text.replace(text.find(what), what.size(), by);
        const std::string refusal = test::refusal_of(text);
        EXPECT_NE(refusal.find(words), std::string::npos) << refusal;
      };
      const std::string text = two_cubes(Coding::ascii);
      told(text, "\"UnstructuredGrid\"", "\"ImageData\"", "the data set is \"ImageData\"");
      told(text, "header_type", "compressor=\"vtkLZ4DataCompressor\" header_type", "compressed by vtkLZ4DataCompressor");
      told(text, "3 12 12", "3 42 12", "cells of type 42");
      told(text, "0.25 ", "0.25 0.25 ", "\"height\" has 13 numbers");
      told(text, "9 1 2 11", "9 1.5 2 11", "\"gmsh:physical\" of cell 1 is 1.5");
      told(text, "</VTKFile>", "", "the file is cut off");
      told(text, "NumberOfCells=\"5\"", "NumberOfCells=\"6\"", "has 5 cells, but NumberOfCells is \"6\"");
      told(text, "NumberOfPoints=\"12\"", "NumberOfPoints=\"13\"", "has 12 points, but NumberOfPoints is \"13\"");
      told(legacy(false, false), "UNSTRUCTURED_GRID", "POLYDATA", "the data set is POLYDATA");
      told(legacy(false, false), "POINTS 12", "POINTS 1200000000", "which the");
      // A block that is said to hold much more than zlib can compress.
      Vtu vtu(Coding::appended_compressed, false, false);
      told(vtu.file(vtu.array("Float64", "Points", coordinates(), 3).insert(0, "<Piece><Points>") + "</Points></Piece>"),
           std::string("@\0\0\0", 4), std::string("@\0\0\x7f", 4), "what zlib may compress");
    }

    TEST(WrittenMeshes, ReadBackAsTheyWere)
    {
      PlainMesh mesh    = test::mesh_of(two_cubes(Coding::ascii));
      mesh.points[3][1] = 1. / 3;
      mesh.cells.push_back({PlainMesh::Shape::tetrahedron, 2, {{0, 1, 3, 6}}});
      mesh.cell_fields = {{"fibre", 3, {1, 0.1, 0, 1, 0.2, 0, 1, 0.3, 1e-300}}};
      mesh.cell_groups = {{1, "muscle"}, {2, "tendon of \"Achilles\" & sons"}};
      mesh.face_groups = {{11, "x-"}, {12, "the end"}};
      for (const std::string &ending : mesh_endings())
        {
          const PlainMesh again = test::mesh_of(mesh_text(mesh, ending));
          EXPECT_EQ(again.points, mesh.points) << ending;
          EXPECT_EQ(again.cell_groups, mesh.cell_groups) << ending;
          EXPECT_EQ(again.face_groups, mesh.face_groups) << ending;
          ASSERT_EQ(again.cells.size(), mesh.cells.size());
          for (std::size_t i = 0; i < mesh.cells.size(); ++i)
            {
              EXPECT_EQ(again.cells[i].shape, mesh.cells[i].shape);
              EXPECT_EQ(again.cells[i].corner, mesh.cells[i].corner);
              EXPECT_EQ(again.cells[i].group, mesh.cells[i].group);
            }
          EXPECT_EQ(again.faces.size(), mesh.faces.size());
          if (ending == ".vtu")
            {
              EXPECT_EQ(again.cell_fields.back().values, mesh.cell_fields.back().values);
            }
        }
    }
  } // namespace
} // namespace myolines
