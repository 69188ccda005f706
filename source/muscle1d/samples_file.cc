#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/muscle1d/sampled.h>
#include <myolines/scene/numbers.h>

#include <algorithm>
#include <fstream>

namespace myolines
{
  namespace
  {
    /// Fields of a line without quotes, less white space at their ends.
    std::vector<std::string> fields(std::string line)
    {
      if (!line.empty() && line.back() == '\r')
        line.pop_back();
      std::vector<std::string> all;
      for (std::size_t begin = 0;;)
        {
          const std::size_t comma = line.find(',', begin);
          all.push_back(scene::trimmed(line.substr(begin, comma - begin)));
          if (comma == std::string::npos)
            return all;
          begin = comma + 1;
        }
    }

    std::size_t column(const std::vector<std::string> &header, const std::string &name, const std::string &file)
    {
      const auto found = std::find(header.begin(), header.end(), name);
      if (found == header.end())
        {
          const std::string nearest = nearest_name(name, header);
          throw InputError(InputProblem{file, "there is no column \"" + name + "\"", "one of " + join(header),
                                        nearest.empty() ? "" : "nearest valid name: \"" + nearest + "\""});
        }
      return found - header.begin();
    }
  } // namespace

  Samples read_samples(const std::filesystem::path &file, const std::string &time_column, const std::vector<std::string> &columns)
  {
    std::ifstream stream(file);
    std::string   line;
    if (!stream || !std::getline(stream, line))
      throw InputError(
          InputProblem{file.string(), "cannot be read, or is empty", "comma-separated values with names in the first line", ""});
    const std::vector<std::string> header = fields(line);
    std::vector<std::size_t>       wanted{column(header, time_column, file.string())};
    for (const std::string &name : columns)
      wanted.push_back(column(header, name, file.string()));

    Samples samples;
    samples.x.resize(columns.size());
    for (std::size_t number = 2; std::getline(stream, line); ++number)
      {
        if (scene::trimmed(line).empty())
          continue;
        const std::string              where = file.string() + ", line " + std::to_string(number);
        const std::vector<std::string> cells = fields(line);
        if (cells.size() != header.size())
          throw InputError(InputProblem{where, "has " + std::to_string(cells.size()) + " fields",
                                        std::to_string(header.size()) + ", as many as the first line", ""});
        for (std::size_t i = 0; i < wanted.size(); ++i)
          {
            const auto value = scene::parse_number(cells[wanted[i]]);
            if (!value)
              throw InputError(InputProblem{where, "\"" + cells[wanted[i]] + "\" in column \"" + header[wanted[i]] + "\"",
                                            "a finite number", "samples that are missing are left out as whole lines"});
            (i == 0 ? samples.t : samples.x[i - 1]).push_back(*value);
          }
        const std::size_t n = samples.t.size();
        if (n > 1 && !(samples.t[n - 1] > samples.t[n - 2]))
          throw InputError(InputProblem{where, "the time does not come after that of the line before", "times that ascend", ""});
      }
    if (samples.t.size() < 2)
      throw InputError(InputProblem{file.string(), "holds fewer than two samples", "at least two", ""});
    return samples;
  }
} // namespace myolines
