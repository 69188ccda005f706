#include <myolines/output/outputs.h>
#include <myolines/output/text_file.h>
#include <myolines/output/version.h>

#include <deal.II/base/config.h>
#include <deal.II/base/mpi.h>

#include <nlohmann/json.hpp>

#include <fstream>
#include <thread>

namespace myolines
{
  namespace
  {
    using Json = nlohmann::ordered_json;

    std::string trilinos_version()
    {
      return std::to_string(DEAL_II_TRILINOS_VERSION_MAJOR) + "." + std::to_string(DEAL_II_TRILINOS_VERSION_MINOR) + "." +
             std::to_string(DEAL_II_TRILINOS_VERSION_SUBMINOR);
    }

    std::string mpi_version()
    {
      char text[MPI_MAX_LIBRARY_VERSION_STRING];
      int  length = 0;
      MPI_Get_library_version(text, &length);
      const std::string all(text, length);
      return all.substr(0, all.find_first_of(",\n"));
    }

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
  } // namespace

  void write_manifest(const std::filesystem::path &folder, const std::string &command_line, const std::string &started,
                      const std::string &resumed, const std::string &exit_reason)
  {
    Json manifest;
    manifest["program"]  = "myolines";
    manifest["version"]  = version;
    manifest["git hash"] = *git_hash == '\0' ? Json(nullptr) : Json(git_hash);
#ifdef DEBUG
    manifest["build"] = "Debug";
#else
    manifest["build"] = "Release";
#endif
    manifest["compiler"]     = __VERSION__;
    manifest["libraries"]    = {{"deal.II", DEAL_II_PACKAGE_VERSION}, {"Trilinos", trilinos_version()}, {"MPI", mpi_version()}};
    manifest["ranks"]        = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    manifest["host"]         = {{"name", host_name()}, {"CPU", cpu_model()}, {"hardware threads", std::thread::hardware_concurrency()}};
    manifest["command line"] = command_line;
    manifest["started"]      = started;
    manifest["finished"]     = iso8601_now();
    manifest["resumed"]      = resumed.empty() ? Json(nullptr) : Json(resumed);
    manifest["exit reason"]  = exit_reason;
    replace_file(folder / "manifest.json", manifest.dump(2) + "\n");
  }

  bool run_is_done(const std::filesystem::path &folder)
  {
    bool done = false;
    if (writes_files())
      {
        std::ifstream file(folder / "manifest.json");
        const Json    manifest = Json::parse(file, nullptr, /*allow_exceptions*/ false);
        done                   = manifest.is_object() && manifest.value("exit reason", "") == "done";
      }
    return dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, done);
  }

  void write_ledger(const std::filesystem::path &folder, const WorkLedger &ledger)
  {
    Json json;
    json["counts"]  = Json(ledger.counts());
    json["seconds"] = Json(ledger.seconds());
    replace_file(folder / "ledger.json", json.dump(2) + "\n");
  }
} // namespace myolines
