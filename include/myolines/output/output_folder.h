// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/files.h>
#include <myolines/system/archive.h>

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace myolines
{
  /// Where the outputs of a run go and, in a resumed run, what they saved when it was kept: every output made with it goes on
  /// where it was then, or begins anew if it saved nothing. Copies note files in the same list.
  class OutputFolder
  {
  public:
    /// @p folder exists; @p saved_outputs of a resumed run are borrowed.
    OutputFolder(std::filesystem::path folder, const Archive *saved_outputs = nullptr);

    /// The same folder, in which files that the run has not noted are left alone.
    static OutputFolder with_foreign_files(std::filesystem::path folder);

    /// No folder: outputs that are made with it refuse what they cannot do, and open no file.
    static OutputFolder nowhere();

    /// Takes the rows of a table: its name, its columns, the numbers.
    using RowReader = std::function<void(const std::string &, const std::vector<std::string> &, const std::vector<double> &)>;

    /// No folder: rows of tables go to @p reader, on all ranks, and nothing else is written; outputs that write other files are not made.
    static OutputFolder read_by(RowReader reader);

    bool             rows_are_read() const { return static_cast<bool>(list_->reader); } ///< whether rows go to a reader
    const RowReader &reader() const { return list_->reader; }                           ///< that of read_by()

    std::filesystem::path path;  ///< of the folder
    const Archive        *saved; ///< nullptr in a run from its start; borrowed

    /// The place of the file @p name, which the run will write; noted. Collective.
    /// @throws InputError if a foreign file of that name is there.
    std::filesystem::path file(const std::string &name) const;

    /// Opens file() of that name on the rank that writes; nullptr on others and nowhere. @throws SystemError.
    std::shared_ptr<File> open(const std::string &name, File::Mode mode) const;

    /// Closes what open() gave; some systems refuse at the end only. Nothing is written there afterwards. @throws SystemError.
    void close() const;

    /// Notes files with numbers in their names, "fields-*.vtu"; see matches(). As file().
    void note(const std::string &pattern) const;

    /// What has been noted: names relative to the folder and patterns.
    const std::set<std::string> &noted() const { return list_->names; }

    /// Notes what the table @p file is about, in words.
    void entitle(const std::string &file, const std::string &title) const { list_->titles[file] = title; }

    /// Those words, by table.
    const std::map<std::string, std::string> &titles() const { return list_->titles; }

    /// Notes that cells of @p column in the table @p file are empty where there is no number for them.
    void leave_empty(const std::string &file, const std::string &column) const { list_->empty[file].insert(column); }

    /// Columns with such cells, by table; on the rank that writes.
    const std::map<std::string, std::set<std::string>> &left_empty() const { return list_->empty; }

  private:
    struct List
    {
      std::set<std::string>                        names;
      std::map<std::string, std::string>           titles;
      std::map<std::string, std::set<std::string>> empty;
      std::vector<std::shared_ptr<File>>           open;
      RowReader                                    reader;
      bool                                         spares_others = false;
      bool                                         nowhere       = false;
    };
    std::shared_ptr<List> list_;
  };

  /// Whether @p name is @p pattern, in which a star stands for a number ("0003", or "0003.1" for the piece of a rank).
  bool matches(const std::string &name, const std::string &pattern);
} // namespace myolines
