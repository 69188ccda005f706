// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

struct sqlite3;

namespace myolines::study
{
  class SqliteFiles;

  std::string sqlite_version(); ///< as loaded

  /// How the run of a case ended, and with what.
  struct Outcome
  {
    std::string           name;             ///< of the case
    std::string           scene;            ///< every value in force, as scene.resolved.xml
    std::string           status;           ///< "done", "failed", "refused", "crashed", "timed out"
    std::string           reason;           ///< of all but "done"
    std::optional<double> cpu_seconds;      ///< of the process; none if it went on from a checkpoint
    double                wall_seconds = 0; ///< from start to end of the process
    std::string           command;          ///< as a shell would read it
    std::string           manifest;         ///< of the run: versions, git hash, host, dates; "" if it left none
    std::string           ledger;           ///< of the run: counts and seconds; "" if it left none
  };

  /// A cell of the table.
  struct Result
  {
    std::string           name;   ///< of the case
    std::string           column; ///< of study.csv
    std::optional<double> value;  ///< nothing: see note
    std::string           note;   ///< the class, or why there is no value
  };

  /// The SQLite file that keeps what a study has found: table `cases`, a row for each ended run, and table `results`.
  /// Every call is one transaction, on the disk when it returns.
  /// @throws InputError if the file is no such database or damaged, SystemError if the disk refuses.
  class Database
  {
  public:
    explicit Database(const std::filesystem::path &file); ///< Opens @p file, or makes it.
    ~Database();                                          ///< Closes it.
    Database(const Database &)            = delete;
    Database &operator=(const Database &) = delete;

    std::map<std::string, Outcome> outcomes() const; ///< All of them, by case.

    /// Adds the outcomes, each replacing one of the same case.
    void store(const std::vector<Outcome> &outcomes);

    /// Replaces all results.
    void replace_results(const std::vector<Result> &results);

  private:
    class Statement;
    class Transaction;
    void              execute(const std::string &sql) const;
    void              require_whole() const; ///< @throws InputError
    [[noreturn]] void fail() const;          ///< Throws what the system refused, or what is wrong with the file.

    std::filesystem::path        file_;
    std::unique_ptr<SqliteFiles> files_;
    sqlite3                     *handle_ = nullptr;
  };
} // namespace myolines::study
