#include <myolines/output/csv_file.h>
#include <myolines/output/text_file.h>

#include <stdexcept>

namespace myolines
{
  namespace
  {
    std::string quoted_if_needed(const std::string &text)
    {
      if (text.find_first_of(",\"\n\r") == std::string::npos)
        return text;
      std::string quoted = "\"";
      for (const char c : text)
        quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
      return quoted + '"';
    }
  } // namespace

  CsvFile::CsvFile(const std::filesystem::path &file, const std::vector<std::string> &columns)
    : path_(file)
    , n_columns_(columns.size())
  {
    if (writes_files())
      stream_.open(path_, std::ios::binary);
    write(columns);
  }

  void CsvFile::row(const std::vector<double> &values)
  {
    std::vector<std::string> texts;
    texts.reserve(values.size());
    for (const double value : values)
      texts.push_back(exact_text(value));
    row(texts);
  }

  void CsvFile::row(const std::vector<std::string> &texts)
  {
    if (texts.size() != n_columns_)
      throw std::logic_error(path_.string() + " has " + std::to_string(n_columns_) + " columns, a row of " + std::to_string(texts.size()) +
                             " does not fit");
    write(texts);
  }

  void CsvFile::write(const std::vector<std::string> &texts)
  {
    if (!writes_files())
      return;
    std::string line;
    for (const std::string &text : texts)
      line += (line.empty() ? "" : ",") + quoted_if_needed(text);
    stream_ << line << '\n' << std::flush;
    if (!stream_)
      throw std::runtime_error("cannot write " + path_.string());
  }
} // namespace myolines
