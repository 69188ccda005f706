// SPDX-License-Identifier: LGPL-2.1-or-later
// Fuzzing led by coverage, with libFuzzer of clang, see guided.py; MYOLINES_READER names the reader of files. An input is read or refused
// (InputError); anything else is a fault: another exception, a bad access to memory, undefined behaviour, a hang, too much memory.

#include <myolines/base/checksum.h>
#include <myolines/base/error.h>
#include <myolines/cli/prm_file.h>
#include <myolines/meshes/field_grid.h>
#include <myolines/meshes/tidy.h>
#include <myolines/meshes/write.h>
#include <myolines/output/checkpoint.h>
#include <myolines/output/manifest.h>
#include <myolines/scene/columns.h>
#include <myolines/scene/csv.h>
#include <myolines/scene/document.h>
#include <myolines/scene/formula.h>
#include <myolines/scene/scene.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <string>

#include <unistd.h>

using namespace myolines;

namespace
{
  /// With every kind of parameter and list that scenes have.
  scene::Schema schema()
  {
    using scene::Range;
    using scene::Schema;
    const Schema each = Schema("One.").number("x", 1., "m", Range::positive(), "A number.").text("formula", "x + y", "A text.");
    return Schema("All.")
        .number("number", std::nullopt, "s", Range::closed(0, 1), "A number.")
        .integer("integer", 3, Range::closed(0, 10), "An integer.")
        .boolean("boolean", true, "A choice of two.")
        .optional_text("text", "A text.")
        .section("list", Schema("A list.").choice("word", "a", {"a", "b"}, "A word."))
        .optional_section("optional", each)
        .section("named", Schema("Lists.").named_sections(each))
        .variant("type", "first", {{"first", each}, {"second", Schema("Another.").optional_number("y", "Pa", Range::any(), "A number.")}},
                 "Which one.");
  }

  /// A scene that has been read gives its resolved text again, or a run would not resume.
  void read_scene_text(const std::string &bytes)
  {
    static const scene::Schema all  = schema();
    const std::string          text = scene::resolved_xml(scene::parse_scene(bytes, all));
    if (scene::resolved_xml(scene::parse_scene(text, all)) != text)
      std::abort();
  }

  void read_formula(const std::string &bytes)
  {
    try
      {
        const VectorFormula formula(std::array<std::string, 3>{{bytes, "0", "0"}});
        formula(0, dealii::Point<3>(0.1, 0.2, 0.3), 0.4);
      }
    catch (const std::invalid_argument &)
      {} // as promised
  }

  /// A mesh that has been read can be written in all formats, and read again.
  void read_mesh_bytes(const std::string &bytes)
  {
    PlainMesh mesh = parse_mesh(bytes, "mesh");
    tidy(mesh);
    for (const std::string &ending : mesh_endings())
      if (const PlainMesh written = parse_mesh(mesh_text(mesh, ending), "written" + ending);
          written.points != mesh.points || written.cells.size() != mesh.cells.size())
        std::abort();
    if (mesh.cells.size() < 100)
      split_into_hexahedra(mesh);
  }

  /// For readers that want a file.
  std::filesystem::path file_of(const std::string &bytes, const std::string &name = "input")
  {
    static const std::filesystem::path folder = "/dev/shm/myolines_guided_" + std::to_string(getpid());
    std::filesystem::create_directory(folder);
    std::ofstream(folder / name, std::ios::binary) << bytes;
    return folder / name;
  }

  void read_table(const std::string &bytes)
  {
    const scene::CsvTable table = scene::read_csv_input(file_of(bytes));
    for (std::size_t c = 0; c < table.header.size(); ++c)
      try
        {
          table.required_column(table.header[c]);
          scene::unit_factor(scene::split_column_name(table.header[c]).unit, "s");
          table.numbers(c);
        }
      catch (const InputError &)
        {} // another column may be right
  }

  /// The head gets the length and the checksum that fit it: all changed ones would be refused for these.
  void read_checkpoint(const std::string &bytes)
  {
    const std::size_t second = bytes.find('\n', bytes.find('\n') + 1), last = bytes.rfind("}\n");
    const std::size_t begin = second == std::string::npos ? 0 : second + 1, end = last == std::string::npos ? bytes.size() : last + 2;
    const std::string json = begin < end ? bytes.substr(begin, end - begin) : "", head = std::to_string(json.size()) + "\n" + json;
    Checksum          checksum;
    checksum.add(head);
    const CheckpointReader reader(
        file_of("myolines checkpoint 2 " + checksum.text() + "\n" + head + bytes.substr(std::min(end, bytes.size()))));
    for (const char *name : {"u", "v", "a"})
      reader.whole(name);
  }

  void read_prm_file(const std::string &bytes)
  {
    const auto file = file_of(bytes);
    try
      {
        for (const PrmRow &row : read_rows(file))
          refuse_odd_row(file, row, 0, 2, "two numbers");
      }
    catch (const InputError &)
      {} // no table, but perhaps a file of parameters
    read_prm(file);
  }

  void read_manifest_text(const std::string &bytes) { read_manifest(file_of(bytes, "manifest.json").parent_path()); }
  void read_fields(const std::string &bytes) { read_field_grid(file_of(bytes)); }

  using Reader = void (*)(const std::string &);

  const std::map<std::string, Reader> readers = {
      {"scene", read_scene_text},       {"formula", read_formula}, {"table", read_table},
      {"mesh", read_mesh_bytes},        {"fields", read_fields},   {"checkpoint", read_checkpoint},
      {"manifest", read_manifest_text}, {"prm", read_prm_file}};
  Reader chosen = nullptr;
} // namespace

extern "C" int LLVMFuzzerInitialize(int *argc, char ***argv)
{
  static const dealii::Utilities::MPI::MPI_InitFinalize mpi(*argc, *argv, 1);
  const char                                           *name = std::getenv("MYOLINES_READER");
  if (name == nullptr || readers.count(name) == 0)
    {
      std::cerr << "MYOLINES_READER: name of a reader expected\n";
      return 1;
    }
  chosen = readers.at(name);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const unsigned char *data, std::size_t size)
{
  try
    {
      chosen(std::string(reinterpret_cast<const char *>(data), size));
    }
  catch (const InputError &)
    {}
  return 0;
}
