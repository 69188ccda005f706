// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/algebra/shared_file.h>
#include <myolines/base/checksum.h>
#include <myolines/base/error.h>
#include <myolines/output/checkpoint.h>
#include <myolines/output/text_file.h>

#include <boost/serialization/utility.hpp> // pairs are sent between ranks
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <iomanip>
#include <sstream>

namespace myolines
{
  namespace
  {
    // The file: a line with name, version and the checksum of the two parts that follow; a line with the length of the JSON; the JSON,
    // with the checksum of each vector; the vectors as doubles of the machine, one after the other, each in canonical order; nothing else.

    using Json = nlohmann::ordered_json;

    const std::string first_words = "myolines checkpoint 2 ";

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

    /// The number that @p text is, whole. Infinities are written by controls that know no limit.
    double strict_number(const std::string &text)
    {
      double     value  = 0;
      const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
      if (result.ec != std::errc() || result.ptr != text.data() + text.size() || std::isnan(value))
        throw std::invalid_argument("\"" + text + "\" is no number");
      return value;
    }

    Archive numbers_archive(const Json &json)
    {
      Archive archive;
      for (const auto &[name, texts] : json.items())
        {
          std::vector<double> values;
          for (const Json &text : texts)
            values.push_back(strict_number(text));
          archive.put_numbers(name, values);
        }
      return archive;
    }

    struct NamedVector
    {
      std::string         part, name;
      std::vector<double> owned; ///< in canonical order
    };

    std::vector<NamedVector> vectors(const Checkpoint &checkpoint, const std::vector<unsigned int> &order)
    {
      std::vector<NamedVector> all;
      const auto               add = [&](const std::string &part, const std::string &name, const auto &values) {
        all.push_back({part, name, std::vector<double>(order.size())});
        for (std::size_t i = 0; i < order.size(); ++i)
          all.back().owned[i] = *(values.begin() + order[i]);
      };
      const State &state = checkpoint.state;
      for (const auto &[name, x] : {std::pair<std::string, const Vector *>{"u", &state.u}, {"v", &state.v}, {"a", &state.a}})
        add("state", name, *x);
      for (const auto &[name, values] : checkpoint.integrator.all_vectors())
        add("integrator", name, values);
      return all;
    }

    /// Of a vector that ranks own in pieces, one behind the other. Collective.
    std::string checksum(const std::vector<double> &owned, const MPI_Comm communicator)
    {
      Checksum mine, all;
      mine.add(owned.data(), owned.size() * sizeof(double));
      const auto parts = dealii::Utilities::MPI::all_gather(communicator, std::make_pair(mine.value(), owned.size() * sizeof(double)));
      for (const auto &[value, bytes] : parts)
        all.add_part(value, bytes);
      return all.text();
    }

    std::string head(const Checkpoint &checkpoint, const std::vector<NamedVector> &vectors, const MPI_Comm communicator)
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
      json["inputs"]          = checkpoint.inputs;
      json["scene"]           = checkpoint.scene;
      json["vectors"]         = Json::array();
      for (const NamedVector &vector : vectors)
        json["vectors"].push_back({vector.part, vector.name, checksum(vector.owned, communicator)});
      const std::string text = json.dump(1) + "\n", rest = std::to_string(text.size()) + "\n" + text;
      Checksum          checksum;
      checksum.add(rest);
      return first_words + checksum.text() + "\n" + rest;
    }

    /// What lies before the vectors, checked, on the rank that reads; "" and a reason if it is not what it should be.
    std::string read_head(const std::filesystem::path &file, std::string &json, std::size_t &begin, std::size_t &size)
    {
      if (!std::filesystem::is_regular_file(file))
        return "there is no checkpoint";
      const std::string damaged = "the checkpoint is damaged: ";
      const File        stream(file, File::Mode::read);
      std::string       lines(std::min<std::size_t>(size = stream.size(), 80), '\0');
      stream.read_at(0, lines.data(), lines.size());
      const std::size_t first = lines.find('\n'), second = lines.find('\n', first + 1);
      if (lines.rfind("myolines checkpoint 1\n", 0) == 0)
        return "this is a checkpoint of format 1, which has no checksums: resume it with the version of the program that wrote it (see "
               "manifest.json), or run the scene from its start";
      if (lines.rfind(first_words, 0) != 0 || second == std::string::npos)
        return "this is not a checkpoint of this version of the program: it begins with \"" +
               lines.substr(0, std::min<std::size_t>(first, 40)) + "\"";
      const std::string digits = lines.substr(first + 1, second - first - 1);
      std::size_t       length = 0;
      if (const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), length);
          read.ec != std::errc() || read.ptr != digits.data() + digits.size())
        return damaged + "\"" + digits + "\" is no length";
      if (length > size - second - 1)
        return damaged + "it is cut off";
      begin = second + 1 + length;
      json.resize(length);
      stream.read_at(second + 1, json.data(), length);
      Checksum found;
      found.add(digits + "\n" + json);
      if (lines.substr(first_words.size(), first - first_words.size()) != found.text())
        return damaged + "the checksum of its head differs";
      return "";
    }

    [[noreturn]] void refuse(const std::filesystem::path &file, const std::string &what)
    {
      throw InputError(InputProblem{file.string(), what, "the checkpoint that a run leaves in its output folder", ""});
    }
    /// What has been written is what can be read: @p begin of the own entries of the first vector, @p size of a whole one [bytes].
    void require_same(const SharedFile &file, const std::string &head, const std::vector<NamedVector> &vectors, const std::size_t begin,
                      const std::size_t size, const MPI_Comm communicator)
    {
      std::string         first(dealii::Utilities::MPI::this_mpi_process(communicator) == 0 ? head.size() : 0, '\0');
      std::vector<double> own;
      bool                same = file.read(0, first) && (first.empty() || first == head);
      for (std::size_t v = 0; v < vectors.size(); ++v)
        {
          own.resize(vectors[v].owned.size());
          same = file.read(begin + v * size, own) && same &&
                 (own.empty() || std::memcmp(own.data(), vectors[v].owned.data(), own.size() * sizeof(double)) == 0);
        }
      if (dealii::Utilities::MPI::min(same ? 1 : 0, communicator) == 0)
        throw SystemError("the new checkpoint reads back as something else than was written; the one before is kept", EIO);
    }
    void write_verified(const std::filesystem::path &file, const Checkpoint &checkpoint, const SemiDiscreteSystem &system)
    {
      const Vector                  &layout       = checkpoint.state.u;
      const MPI_Comm                 communicator = layout.get_mpi_communicator();
      const std::vector<NamedVector> all          = vectors(checkpoint, system.canonical_order());
      const std::string              text         = head(checkpoint, all, communicator);
      const std::size_t              begin        = dealii::Utilities::MPI::broadcast(communicator, text.size());
      const std::size_t              size         = layout.size() * sizeof(double);
      const std::size_t              own          = layout.get_partitioner()->local_range().first * sizeof(double);

      SharedFile shared(file, communicator, SharedFile::Mode::write_anew);
      shared.write_head(text);
      for (std::size_t v = 0; v < all.size(); ++v)
        shared.write(begin + v * size + own, all[v].owned);
      shared.sync(); // what the disk cannot take is refused here, and not after the former checkpoint has gone
      require_same(shared, text, all, begin + own, size, communicator);
      shared.close();
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
    const MPI_Comm communicator = checkpoint.state.u.get_mpi_communicator();
    // A system that every rank holds whole is written by one.
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) > 1 || writes_files())
      write_verified(file, checkpoint, system);
    if (writes_files())
      sync_to_disk(file.parent_path()); // the name, too: until then a power cut may bring back the former file
  }

  CheckpointReader::CheckpointReader(const std::filesystem::path &file)
    : file_(file)
  {
    std::string text, problem;
    std::size_t size = 0;
    if (writes_files())
      try
        {
          problem = read_head(file, text, begin_, size);
        }
      catch (const SystemError &error)
        {
          problem = error.what();
        }
    problem = dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, problem);
    if (!problem.empty())
      refuse(file, problem);
    text   = dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, text);
    begin_ = dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, begin_);
    size   = dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, size);
    try
      {
        parse(text);
      }
    catch (const std::exception &error) // of JSON and of numbers
      {
        refuse(file, std::string("the checkpoint is damaged: ") + error.what());
      }
    if (size != begin_ + blocks_.size() * n_unknowns_ * sizeof(double))
      refuse(file, "the checkpoint is damaged: it has " + std::to_string(size) + " bytes instead of " +
                       std::to_string(begin_ + blocks_.size() * n_unknowns_ * sizeof(double)));
  }

  void CheckpointReader::parse(const std::string &text)
  {
    const Json json           = Json::parse(text);
    contents_.step            = json.at("steps").get<std::size_t>();
    contents_.state.t         = strict_number(json.at("time [s]"));
    contents_.ranks           = json.at("ranks");
    contents_.instruction_set = json.at("instruction set");
    contents_.integrator      = numbers_archive(json.at("integrator"));
    contents_.control         = numbers_archive(json.at("step control"));
    contents_.outputs         = numbers_archive(json.at("outputs"));
    contents_.inputs          = json.at("inputs").get<std::map<std::string, std::string>>();
    contents_.scene           = json.at("scene");
    n_unknowns_               = json.at("unknowns");
    if (!std::isfinite(contents_.state.t))
      throw std::invalid_argument("its time is not finite");
    for (const auto &[name, count] : json.at("counts").items())
      contents_.ledger.count(name, count);
    for (const auto &[name, seconds] : json.at("seconds").items())
      contents_.ledger.add_seconds(name, seconds);
    for (const Json &vector : json.at("vectors"))
      blocks_.push_back({vector.at(0), vector.at(1), vector.at(2)});
  }

  Checkpoint CheckpointReader::read(const SemiDiscreteSystem &system) const
  {
    Checkpoint checkpoint = contents_;
    State      state      = system.initial_state(contents_.state.t);
    if (state.u.size() != n_unknowns_)
      refuse(file_, "the checkpoint holds " + std::to_string(n_unknowns_) + " unknowns, the system has " + std::to_string(state.u.size()));

    const MPI_Comm                  communicator = state.u.get_mpi_communicator();
    const std::vector<unsigned int> order        = system.canonical_order();
    const std::size_t               first        = state.u.get_partitioner()->local_range().first;
    std::vector<double>             sorted(order.size()), owned(order.size());
    Archive                         of_state;
    const SharedFile                shared(file_, communicator, SharedFile::Mode::read);
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      {
        const bool whole = shared.read(begin_ + (b * n_unknowns_ + first) * sizeof(double), sorted);
        require_whole(blocks_[b], whole, sorted, communicator);
        for (std::size_t i = 0; i < order.size(); ++i)
          owned[order[i]] = sorted[i];
        (blocks_[b].part == "state" ? of_state : checkpoint.integrator).put_owned_entries(blocks_[b].name, owned);
      }
    try
      {
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

  void CheckpointReader::require_whole(const Block &block, const bool whole, const std::vector<double> &owned,
                                       const MPI_Comm communicator) const
  {
    const std::string name   = "the checkpoint is damaged: the vector " + block.name;
    const bool        finite = std::all_of(owned.begin(), owned.end(), [](const double x) { return std::isfinite(x); });
    if (!whole)
      refuse(file_, name + " is cut off");
    if (checksum(owned, communicator) != block.checksum)
      refuse(file_, name + " has another checksum");
    if (dealii::Utilities::MPI::min(finite ? 1 : 0, communicator) == 0)
      refuse(file_, name + " is not finite");
  }

  std::vector<double> CheckpointReader::whole(const std::string &name) const
  {
    const auto is_wanted = [&name](const Block &block) { return block.part == "state" && block.name == name; };
    const auto found     = std::find_if(blocks_.begin(), blocks_.end(), is_wanted);
    if (found == blocks_.end())
      refuse(file_, "the checkpoint is damaged: it has no vector " + name);
    std::vector<double> values(n_unknowns_);
    const SharedFile    file(file_, MPI_COMM_SELF, SharedFile::Mode::read);
    const bool          whole = file.read(begin_ + (found - blocks_.begin()) * n_unknowns_ * sizeof(double), values);
    require_whole(*found, whole, values, MPI_COMM_SELF);
    return values;
  }
} // namespace myolines
