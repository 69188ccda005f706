// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/base/files.h>
#include <myolines/output/manifest.h>
#include <myolines/output/text_file.h>
#include <myolines/output/version.h>
#include <myolines/scene/input_text.h>

#include <deal.II/base/mpi.h>

#include <nlohmann/json.hpp>

#include <fstream>
#include <thread>

namespace myolines
{
  namespace
  {
    using Json = nlohmann::ordered_json;

    /// The kernel's name of the first processor; null where it gives none (not all architectures do).
    Json cpu_model()
    {
      std::ifstream cpus("/proc/cpuinfo");
      for (std::string line; std::getline(cpus, line);)
        if (line.rfind("model name", 0) == 0 && line.find(':') != std::string::npos)
          return line.substr(std::min(line.size(), line.find(':') + 2));
      return nullptr;
    }

    Json host_name()
    {
      std::ifstream file("/proc/sys/kernel/hostname");
      std::string   name;
      if (std::getline(file, name))
        return name;
      return nullptr;
    }

    Json energy_json(const EnergyReport &energy)
    {
      const auto gain = [](const EnergyReport::Gain &g) { return Json{{"size [J]", g.size}, {"from [s]", g.from}, {"to [s]", g.to}}; };
      return {{"drift [J]", energy.drift},
              {"exchanged [J]", energy.exchanged},
              {"largest gain", gain(energy.rise)},
              {"largest gain in one step", gain(energy.jump)}};
    }

    Json json_object(const Versions &versions)
    {
      Json json;
      for (const auto &[name, version] : versions)
        json[name] = version;
      return json;
    }

    /// Command lines may hold bytes that are no text.
    std::string json_text(const Json &json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

    Json json_of(const std::filesystem::path &file)
    {
      return Json::parse(scene::read_input_bytes(file), nullptr, /*allow_exceptions*/ false);
    }

    /// The blocks of the file that is there are enough for a new text of much the same length.
    void write_over(const std::filesystem::path &file, const std::string &text)
    {
      if (!writes_files())
        return;
      const std::string before = read_file(file);
      File              there(file, File::Mode::write);
      try
        {
          there.write_at(0, text.data(), text.size());
          there.resize(text.size());
        }
      catch (const SystemError &)
        {
          there.write_at(0, before.data(), before.size()); // rather the old one than half a new one
          there.resize(before.size());
          throw;
        }
      there.close();
    }

    /// A name in the folder itself or in one of the folders that runs make there.
    bool is_inside(const std::string &name)
    {
      const std::filesystem::path path(name), folder = path.parent_path();
      return path.has_filename() && path.filename() != "." && path.filename() != ".." &&
             (folder.empty() || folder == "states" || folder == "pictures");
    }
  } // namespace

  void write_manifest(const OutputFolder &folder, const RunRecord &record, const std::string &exit_reason)
  {
    const std::filesystem::path file = folder.file("manifest.json");
    Json                        manifest;
    manifest["program"]         = "myolines";
    manifest["version"]         = version;
    manifest["git hash"]        = *git_hash == '\0' ? Json(nullptr) : Json(git_hash);
    manifest["build"]           = build_type();
    manifest["compiler"]        = __VERSION__;
    manifest["libraries"]       = json_object(library_versions());
    manifest["ranks"]           = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    manifest["host"]            = {{"name", host_name()}, {"CPU", cpu_model()}, {"hardware threads", std::thread::hardware_concurrency()}};
    manifest["instruction set"] = record.instruction_set;
    manifest["command line"]    = record.command_line;
    manifest["scene"]           = record.scene;
    manifest["started"]         = record.started;
    manifest["finished"]        = iso8601_now();
    manifest["resumed"]         = record.resumed.empty() ? Json(nullptr) : Json(record.resumed);
    manifest["exit reason"]     = exit_reason;
    manifest["energy"]          = record.energy ? energy_json(*record.energy) : Json(nullptr);
    manifest["plan"]            = record.plan;
    manifest["warnings"]        = record.warnings;
    manifest["plug-ins"]        = Json(record.plugins);
    manifest["inputs"]          = Json(record.inputs); // with their CRC-32
    manifest["files"]           = folder.noted();
    manifest["titles"]          = Json(folder.titles());
    const std::string text      = json_text(manifest);
    try
      {
        replace_file(file, text);
      }
    catch (const SystemError &)
      {
        if (std::error_code none; !std::filesystem::exists(file, none))
          throw; // an empty one would say that the folder is not ours
        write_over(file, text);
      }
  }

  std::optional<Manifest> read_manifest(const std::filesystem::path &folder)
  {
    const std::filesystem::path file = folder / "manifest.json";
    std::error_code             none;
    if (!std::filesystem::exists(file, none))
      return std::nullopt;
    const Json manifest = json_of(file);
    const auto refuse   = [&](const std::string &what) {
      throw InputError(InputProblem{file.string(), what, "the manifest of a run of this program", "choose another folder with --out"});
    };
    if (!manifest.is_object() || !manifest.contains("program") || manifest["program"] != "myolines")
      refuse("this is no manifest of this program, or it is damaged");
    Manifest read;
    if (!manifest.contains("exit reason") || !manifest["exit reason"].is_string())
      refuse("it is damaged: the exit reason is missing");
    read.exit_reason = manifest["exit reason"];
    if (manifest.contains("scene") && manifest["scene"].is_string())
      read.scene = manifest["scene"];
    if (manifest.contains("titles"))
      for (const auto &[table, title] : manifest["titles"].items())
        if (title.is_string())
          read.titles[table] = title;
    read.lists_files = manifest.contains("files");
    if (!read.lists_files)
      return read;
    if (!manifest["files"].is_array())
      refuse("it is damaged: the files are no list");
    for (const Json &name : manifest["files"])
      if (name.is_string() && is_inside(name))
        read.files.insert(name.get<std::string>());
      else
        refuse("it is damaged: " + name.dump() + " is no file of a run");
    return read;
  }

  void list_in_manifest(const std::filesystem::path &folder, const std::vector<std::string> &names)
  {
    if (!writes_files())
      return;
    const std::filesystem::path file     = folder / "manifest.json";
    Json                        manifest = json_of(file);
    if (!manifest.is_object() || !manifest.contains("program") || manifest["program"] != "myolines" || !manifest.contains("files"))
      return;
    std::set<std::string> all(names.begin(), names.end());
    for (const Json &name : manifest["files"])
      if (name.is_string())
        all.insert(name.get<std::string>());
    manifest["files"] = all;
    replace_file(file, json_text(manifest));
  }

  void write_ledger(const OutputFolder &folder, const WorkLedger &ledger)
  {
    Json json;
    json["counts"]  = Json(ledger.counts());
    json["seconds"] = Json(ledger.seconds());
    replace_file(folder.file("ledger.json"), json_text(json));
  }
} // namespace myolines
