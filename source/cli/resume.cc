// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/checksum.h>
#include <myolines/base/error.h>
#include <myolines/cli/resume.h>
#include <myolines/scene/document.h>

#include <deal.II/base/mpi.h>

#include <map>

namespace myolines
{
  namespace
  {
    using Values = std::map<std::string, std::string>;

    void collect(const scene::RawList &list, const std::string &path, Values &values)
    {
      for (const scene::RawParameter &parameter : list.parameters)
        values[path + parameter.name] = parameter.text;
      for (const scene::RawList &inner : list.lists)
        collect(inner, path + inner.name + "/", values);
    }

    Values values_of(const std::string &xml)
    {
      std::vector<InputProblem> problems;
      const scene::RawList      root = scene::parse_document(xml, "scene.resolved.xml", problems);
      if (!problems.empty())
        throw InputError(problems);
      Values values;
      collect(root, "", values);
      return values;
    }

    bool may_differ(const std::string &path)
    {
      for (const char *free : {"output/", "solver/", "time/control/"})
        if (path.rfind(free, 0) == 0)
          return true;
      return path == "title" || path == "plug-ins" || path == "time/end" || path == "time/step" || path == "time/steps";
    }

    std::string shown(const Values &values, const std::string &path)
    {
      const auto found = values.find(path);
      return found == values.end() ? "not given" : "\"" + found->second + "\"";
    }
  } // namespace

  void refuse_other_run(const std::string &saved, const std::string &now, const std::string &scene_file)
  {
    const Values before = values_of(saved), after = values_of(now);
    Values       all = before;
    all.insert(after.begin(), after.end());
    std::vector<InputProblem> problems;
    for (const auto &[path, ignored] : all)
      if (const std::string was = shown(before, path), is = shown(after, path); was != is && !may_differ(path))
        problems.push_back({scene_file + ": " + path, "is " + is + ", in the run to resume it was " + was,
                            "the same; title, output, solver and time/end, step, steps and control may differ",
                            "run it without --resume, in another folder (--out)"});
    if (!problems.empty())
      throw InputError(problems);
  }

  void refuse_other_mesh(const scene::Node &scene, const std::map<std::string, std::string> &inputs)
  {
    const scene::Node &system = scene.section("system");
    if (system.text("type") != "muscle 3d") // whose geometry alone is of files
      return;
    for (const std::filesystem::path &file : system.section("geometry").files())
      if (const auto then = inputs.find(file.string()); then != inputs.end() && then->second != checksum_of_file(file))
        throw InputError(InputProblem{system.section("geometry").where("file"), file.string() + " has changed since the state was saved",
                                      "the mesh of that run, as the state is of its nodes", "begin a new run with the new mesh"});
  }

  std::vector<std::string> changes_of_machine(const Checkpoint &checkpoint, const InstructionSet instruction_set)
  {
    std::vector<std::string> lines;
    const unsigned int       ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    const std::string        set   = name(instruction_set);
    if (checkpoint.ranks != ranks)
      lines.push_back("ranks: " + std::to_string(ranks) + " instead of " + std::to_string(checkpoint.ranks));
    if (checkpoint.instruction_set != set)
      lines.push_back("instruction set: " + set + " instead of " + checkpoint.instruction_set);
    return lines;
  }
} // namespace myolines
