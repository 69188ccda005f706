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

    std::string line_of(const std::vector<std::string> &texts)
    {
      std::string line;
      for (const std::string &text : texts)
        line += (line.empty() ? "" : ",") + quoted_if_needed(text);
      return line;
    }

    std::string entry(const std::string &name) { return "bytes of " + name; }
  } // namespace

  CsvFile::CsvFile(const OutputFolder &folder, const std::string &name, const std::vector<std::string> &columns)
    : name_(name)
    , path_(folder.path / name)
    , n_columns_(columns.size())
  {
    if (folder.saved != nullptr && folder.saved->has_numbers(entry(name)))
      on_writing_rank(path_.string(), "the file of the run to resume, as it was when its state was saved",
                      "put it back, or run the scene from its start",
                      [&] { go_on(static_cast<std::uintmax_t>(folder.saved->number(entry(name))), columns); });
    else
      {
        if (writes_files())
          stream_.open(path_, std::ios::binary);
        write(columns);
      }
  }

  void CsvFile::go_on(const std::uintmax_t bytes, const std::vector<std::string> &columns)
  {
    std::string   header;
    std::ifstream before(path_, std::ios::binary);
    if (!std::getline(before, header))
      throw std::runtime_error("cannot read the file");
    if (header != line_of(columns))
      throw std::runtime_error("has the columns " + header + ", the scene now asks for " + line_of(columns));
    if (std::filesystem::file_size(path_) < bytes)
      throw std::runtime_error("is shorter than it was");
    std::filesystem::resize_file(path_, bytes);
    stream_.open(path_, std::ios::binary | std::ios::app);
  }

  void CsvFile::save(Archive &archive) const
  {
    if (!writes_files())
      return;
    sync_to_disk(path_);
    archive.put(entry(name_), static_cast<double>(std::filesystem::file_size(path_)));
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
    stream_ << line_of(texts) << '\n' << std::flush;
    if (!stream_)
      throw std::runtime_error("cannot write " + path_.string());
  }
} // namespace myolines
