#include <myolines/base/error.h>
#include <myolines/muscle1d/sampled.h>
#include <myolines/scene/csv.h>

namespace myolines
{
  Samples read_samples(const std::filesystem::path &file, const std::string &time_column, const std::vector<std::string> &columns)
  {
    const scene::CsvTable table = scene::read_csv_input(file);
    Samples               samples;
    samples.t = table.numbers(table.required_column(time_column));
    for (const std::string &name : columns)
      samples.x.push_back(table.numbers(table.required_column(name)));
    for (std::size_t row = 1; row < samples.t.size(); ++row)
      if (!(samples.t[row] > samples.t[row - 1]))
        throw InputError(InputProblem{table.where(row), "the time does not come after that of the line before", "times that ascend", ""});
    if (samples.t.size() < 2)
      throw InputError(InputProblem{file.string(), "holds fewer than two samples", "at least two", ""});
    return samples;
  }
} // namespace myolines
