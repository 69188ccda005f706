#include "shared_file.h"

#include <myolines/base/error.h>
#include <myolines/output/checkpoint.h>
#include <myolines/output/text_file.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <sstream>

namespace myolines
{
  namespace
  {
    // The file: a line with name and version, a line with the length of what follows as JSON, the JSON, and then the vectors as
    // doubles of the machine, one after the other, each in canonical order.

    using Json = nlohmann::ordered_json;

    const std::string first_line = "myolines checkpoint 1";

    /// Numbers as text, so that every double comes back as it was, infinities included.
    Json numbers_json(const Archive &archive)
    {
      Json json = Json::object();
      for (const auto &[name, values] : archive.all_numbers())
        {
          Json texts = Json::array();
          for (const double value : values)
            texts.push_back(exact_text(value));
          json[name] = texts;
        }
      return json;
    }

    double number(const Json &json) { return std::strtod(json.get<std::string>().c_str(), nullptr); }

    Archive numbers_archive(const Json &json)
    {
      Archive archive;
      for (const auto &[name, texts] : json.items())
        {
          std::vector<double> values;
          for (const Json &text : texts)
            values.push_back(number(text));
          archive.put_numbers(name, values);
        }
      return archive;
    }

    struct NamedVector
    {
      std::string         part, name;
      std::vector<double> owned;
    };

    std::vector<NamedVector> vectors(const Checkpoint &checkpoint)
    {
      std::vector<NamedVector> all;
      const State             &state = checkpoint.state;
      for (const auto &[name, x] : {std::pair<std::string, const Vector *>{"u", &state.u}, {"v", &state.v}, {"a", &state.a}})
        all.push_back({"state", name, std::vector<double>(x->begin(), x->end())});
      for (const auto &[name, values] : checkpoint.integrator.all_vectors())
        all.push_back({"integrator", name, values});
      return all;
    }

    std::string head(const Checkpoint &checkpoint, const std::vector<NamedVector> &vectors)
    {
      Json json;
      json["steps"]           = checkpoint.step;
      json["time [s]"]        = exact_text(checkpoint.state.t);
      json["ranks"]           = checkpoint.ranks;
      json["instruction set"] = checkpoint.instruction_set;
      json["unknowns"]        = checkpoint.state.u.size();
      json["integrator"]      = numbers_json(checkpoint.integrator);
      json["step control"]    = numbers_json(checkpoint.control);
      json["outputs"]         = numbers_json(checkpoint.outputs);
      json["counts"]          = checkpoint.ledger.counts();
      json["seconds"]         = checkpoint.ledger.seconds();
      json["scene"]           = checkpoint.scene;
      json["vectors"]         = Json::array();
      for (const NamedVector &vector : vectors)
        json["vectors"].push_back({vector.part, vector.name});
      const std::string text = json.dump(1) + "\n";
      return first_line + "\n" + std::to_string(text.size()) + "\n" + text;
    }

    /// First line, length and JSON of the file, on the rank that reads; "" and a reason if it is not what it should be.
    std::string read_head(const std::filesystem::path &file, std::string &json)
    {
      std::ifstream stream(file, std::ios::binary);
      if (!stream)
        return "there is no checkpoint";
      std::string line, length;
      if (!std::getline(stream, line) || line != first_line || !std::getline(stream, length))
        return "this is not a checkpoint of this version of the program: it begins with \"" + line.substr(0, 40) + "\"";
      json.resize(std::strtoull(length.c_str(), nullptr, 10));
      if (!stream.read(json.data(), json.size()))
        return "the checkpoint is cut off";
      return "";
    }

    [[noreturn]] void refuse(const std::filesystem::path &file, const std::string &what)
    {
      throw InputError(InputProblem{file.string(), what, "the checkpoint that a run leaves in its output folder", ""});
    }
  } // namespace

  std::filesystem::path checkpoint_file(const std::filesystem::path &folder) { return folder / "checkpoint"; }

  std::filesystem::path kept_state_file(const std::filesystem::path &folder, const std::size_t step)
  {
    std::ostringstream name;
    name << "state-" << std::setw(9) << std::setfill('0') << step; // names ascend as steps do
    return folder / "states" / name.str();
  }

  std::vector<std::filesystem::path> kept_state_files(const std::filesystem::path &folder)
  {
    std::vector<std::filesystem::path> files;
    if (std::filesystem::is_directory(folder / "states"))
      for (const auto &entry : std::filesystem::directory_iterator(folder / "states"))
        if (entry.is_regular_file() && entry.path().filename().string().rfind("state-", 0) == 0 && entry.path().extension() != ".new")
          files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
  }

  void write_checkpoint(const std::filesystem::path &file, const Checkpoint &checkpoint, const SemiDiscreteSystem &system)
  {
    const Vector         &layout       = checkpoint.state.u;
    const MPI_Comm        communicator = layout.get_mpi_communicator();
    std::filesystem::path fresh        = file;
    fresh += ".new";
    // A system that every rank holds whole is written by one.
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) > 1 || writes_files())
      {
        const std::vector<unsigned int> order = system.canonical_order();
        const std::vector<NamedVector>  all   = vectors(checkpoint);
        const std::string               text  = head(checkpoint, all);
        const std::size_t               begin = dealii::Utilities::MPI::broadcast(communicator, text.size());
        const std::size_t               size  = layout.size() * sizeof(double);

        SharedFile shared(fresh, communicator, MPI_MODE_CREATE | MPI_MODE_WRONLY);
        shared.resize(begin + all.size() * size);
        shared.write_head(text);
        std::vector<double> sorted(order.size());
        for (std::size_t v = 0; v < all.size(); ++v)
          {
            for (std::size_t i = 0; i < order.size(); ++i)
              sorted[i] = all[v].owned.at(order[i]);
            shared.write(begin + v * size + layout.get_partitioner()->local_range().first * sizeof(double), sorted);
          }
        shared.close();
      }
    if (writes_files())
      {
        sync_to_disk(fresh);
        std::filesystem::rename(fresh, file);
        sync_to_disk(file.parent_path());
      }
  }

  CheckpointReader::CheckpointReader(const std::filesystem::path &file)
    : file_(file)
  {
    std::string text;
    std::string problem = writes_files() ? read_head(file, text) : "";
    problem             = dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, problem);
    if (!problem.empty())
      refuse(file, problem);
    text   = dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, text);
    begin_ = first_line.size() + 1 + std::to_string(text.size()).size() + 1 + text.size();
    try
      {
        const Json json           = Json::parse(text);
        contents_.step            = json.at("steps");
        contents_.state.t         = number(json.at("time [s]"));
        contents_.ranks           = json.at("ranks");
        contents_.instruction_set = json.at("instruction set");
        contents_.integrator      = numbers_archive(json.at("integrator"));
        contents_.control         = numbers_archive(json.at("step control"));
        contents_.outputs         = numbers_archive(json.at("outputs"));
        contents_.scene           = json.at("scene");
        n_unknowns_               = json.at("unknowns");
        for (const auto &[name, count] : json.at("counts").items())
          contents_.ledger.count(name, count);
        for (const auto &[name, seconds] : json.at("seconds").items())
          contents_.ledger.add_seconds(name, seconds);
        for (const Json &vector : json.at("vectors"))
          blocks_.push_back({vector.at(0), vector.at(1)});
      }
    catch (const Json::exception &error)
      {
        refuse(file, std::string("the checkpoint is damaged: ") + error.what());
      }
  }

  Checkpoint CheckpointReader::read(const SemiDiscreteSystem &system) const
  {
    Checkpoint checkpoint = contents_;
    State      state      = system.initial_state(contents_.state.t);
    if (state.u.size() != n_unknowns_)
      refuse(file_, "the checkpoint holds " + std::to_string(n_unknowns_) + " unknowns, the system has " + std::to_string(state.u.size()));

    const std::vector<unsigned int> order = system.canonical_order();
    const std::size_t               first = state.u.get_partitioner()->local_range().first;
    std::vector<double>             sorted(order.size()), owned(order.size());
    Archive                         of_state;
    try
      {
        const SharedFile shared(file_, state.u.get_mpi_communicator(), MPI_MODE_RDONLY);
        for (std::size_t b = 0; b < blocks_.size(); ++b)
          {
            shared.read(begin_ + (b * n_unknowns_ + first) * sizeof(double), sorted);
            for (std::size_t i = 0; i < order.size(); ++i)
              owned[order[i]] = sorted[i];
            (blocks_[b].part == "state" ? of_state : checkpoint.integrator).put_owned_entries(blocks_[b].name, owned);
          }
        of_state.read("u", state.u);
        of_state.read("v", state.v);
        of_state.read("a", state.a);
      }
    catch (const std::exception &error)
      {
        refuse(file_, std::string("the checkpoint is damaged: ") + error.what());
      }
    checkpoint.state = state;
    return checkpoint;
  }

  std::vector<double> CheckpointReader::whole(const std::string &name) const
  {
    const auto is_wanted = [&name](const Block &block) { return block.part == "state" && block.name == name; };
    const auto found     = std::find_if(blocks_.begin(), blocks_.end(), is_wanted);
    if (found == blocks_.end())
      throw std::logic_error("a checkpoint has no vector \"" + name + "\" of the state");
    std::vector<double> values(n_unknowns_);
    std::ifstream       stream(file_, std::ios::binary);
    stream.seekg(static_cast<std::streamoff>(begin_ + (found - blocks_.begin()) * n_unknowns_ * sizeof(double)));
    if (!stream.read(reinterpret_cast<char *>(values.data()), static_cast<std::streamsize>(n_unknowns_ * sizeof(double))))
      refuse(file_, "the checkpoint is cut off");
    return values;
  }
} // namespace myolines
