// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/output/csv_file.h>
#include <myolines/output/text_file.h>

#include <cmath>
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

    const std::string bytes_of    = "bytes of ";
    const std::string checksum_of = "checksum of ";

    /// "" if @p file begins as the table @p name did when @p saved was written; otherwise what is wrong.
    std::string complaint(const std::filesystem::path &file, const std::string &name, const Archive &saved)
    {
      std::error_code none;
      const auto      bytes = static_cast<std::size_t>(saved.number(bytes_of + name));
      if (!std::filesystem::is_regular_file(file, none))
        return "there is no such file any more";
      if (std::filesystem::file_size(file, none) < bytes)
        return "it is shorter than it was";
      Checksum found;
      found.add(read_file(file).substr(0, bytes));
      if (static_cast<double>(found.value()) != saved.number(checksum_of + name))
        return "its rows are not those that were written";
      return "";
    }

    const std::string as_it_was = "the file of the run to resume, as it was when its state was saved";
    const std::string mend      = "put it back, or run the scene from its start";
  } // namespace

  CsvFile::CsvFile(const OutputFolder &folder, const TableName &name, const std::vector<std::string> &columns)
    : folder_(folder)
    , name_(name.file)
    , path_(folder.file(name.file))
    , columns_(columns)
  {
    if (!name.title.empty())
      folder.entitle(name.file, name.title);
    if (folder.saved != nullptr && folder.saved->has_numbers(bytes_of + name_))
      on_writing_rank(path_.string(), as_it_was, mend, [&] { go_on(*folder.saved, columns); });
    else
      {
        file_ = folder.open(name_, File::Mode::write_anew);
        write(columns);
      }
  }

  void CsvFile::go_on(const Archive &saved, const std::vector<std::string> &columns)
  {
    if (const std::string wrong = complaint(path_, name_, saved); !wrong.empty())
      throw std::runtime_error(wrong);
    std::string       text   = read_file(path_);
    const std::string header = text.substr(0, text.find('\n'));
    if (header != line_of(columns))
      throw std::runtime_error("it has the columns " + header + ", the scene now asks for " + line_of(columns));
    size_ = static_cast<std::size_t>(saved.number(bytes_of + name_));
    text.resize(size_);
    checksum_.add(text);
    file_ = folder_.open(name_, File::Mode::write);
    file_->resize(size_);
  }

  void CsvFile::save(Archive &archive) const
  {
    if (!file_)
      return;
    file_->sync();
    archive.put(bytes_of + name_, static_cast<double>(size_));
    archive.put(checksum_of + name_, static_cast<double>(checksum_.value()));
  }

  void CsvFile::row(const std::vector<double> &values)
  {
    if (folder_.rows_are_read())
      return folder_.reader()(name_, columns_, values);
    std::vector<std::string> texts;
    texts.reserve(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      {
        texts.push_back(std::isnan(values[i]) ? "" : exact_text(values[i])); // what is not defined has no number
        if (std::isnan(values[i]) && i < columns_.size())
          folder_.leave_empty(name_, columns_[i]);
      }
    row(texts);
  }

  void CsvFile::row(const std::vector<std::string> &texts)
  {
    if (texts.size() != columns_.size())
      throw std::logic_error(path_.string() + " has " + std::to_string(columns_.size()) + " columns, a row of " +
                             std::to_string(texts.size()) + " does not fit");
    write(texts);
  }

  void CsvFile::close()
  {
    if (file_)
      file_->close();
  }

  void CsvFile::write(const std::vector<std::string> &texts)
  {
    if (!file_)
      return;
    const std::string line = line_of(texts) + "\n";
    try
      {
        file_->write_at(size_, line.data(), line.size());
      }
    catch (const SystemError &)
      {
        try
          {
            file_->resize(size_); // half a row would be taken for a whole one
          }
        catch (const SystemError &)
          {} // the first failure is the one to tell
        throw;
      }
    size_ += line.size();
    checksum_.add(line);
  }

  void require_tables(const std::filesystem::path &folder, const Archive &saved)
  {
    std::vector<std::string> wrong;
    on_writing_rank(folder.string(), "the tables of the run to resume, as they were when its state was saved", mend, [&] {
      for (const auto &[entry, bytes] : saved.all_numbers())
        if (entry.rfind(bytes_of, 0) == 0)
          {
            const std::string name = entry.substr(bytes_of.size());
            if (const std::string what = complaint(folder / name, name, saved); !what.empty())
              wrong.push_back(name + ": " + what);
          }
      if (!wrong.empty())
        throw std::runtime_error(join(wrong, "; "));
    });
  }
} // namespace myolines
