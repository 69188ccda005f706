// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sqlite_files.h"

#include <myolines/base/checksum.h>
#include <myolines/base/error.h>
#include <myolines/scene/numbers.h>
#include <myolines/study/database.h>

#include <sqlite3.h>

#include <cerrno>
#include <stdexcept>

namespace myolines::study
{
  namespace
  {
    constexpr int version = 2; ///< of the tables; 1 had no checksums

    constexpr const char *tables = R"(
      CREATE TABLE cases (name TEXT PRIMARY KEY, status TEXT NOT NULL, reason TEXT NOT NULL, cpu_seconds REAL, wall_seconds REAL NOT NULL,
                          command TEXT NOT NULL, manifest TEXT NOT NULL, ledger TEXT NOT NULL, scene TEXT NOT NULL,
                          checksum TEXT NOT NULL);
      CREATE TABLE results (name TEXT NOT NULL, "column" TEXT NOT NULL, value REAL, note TEXT NOT NULL, PRIMARY KEY (name, "column"));
    )";

    constexpr const char *columns = "cases: name, status, reason, cpu_seconds, wall_seconds, command, manifest, ledger, scene, checksum; "
                                    "results: name, column, value, note";

    [[noreturn]] void refuse_database(const std::filesystem::path &file, const std::string &what)
    {
      throw InputError(InputProblem{file.string(), what, "the database of a study by this version of the program",
                                    "choose another folder with --out, or remove the file to begin anew"});
    }

    /// Of all that a row says.
    std::string checksum_of(const Outcome &outcome)
    {
      Checksum checksum;
      for (const std::string *text :
           {&outcome.name, &outcome.status, &outcome.reason, &outcome.command, &outcome.manifest, &outcome.ledger, &outcome.scene})
        checksum.add(*text + '\0');
      checksum.add((outcome.cpu_seconds ? scene::format_number(*outcome.cpu_seconds) : "") + '\0' +
                   scene::format_number(outcome.wall_seconds));
      return checksum.text();
    }
  } // namespace

  std::string sqlite_version() { return sqlite3_libversion(); }

  void Database::fail() const
  {
    const std::string what = sqlite3_errmsg(handle_);
    switch (sqlite3_errcode(handle_) & 0xff)
      {
      case SQLITE_FULL:
      case SQLITE_PERM:
      case SQLITE_READONLY:
        files_->tell();
        throw SystemError("cannot use " + file_.string() + ": " + what, EIO);
      case SQLITE_IOERR: // a damaged file that ends too early, unless the system has refused something
        files_->tell();
        refuse_database(file_, "it is damaged (" + what + ")");
      case SQLITE_CANTOPEN:
        files_->tell();
        refuse_database(file_, what);
      case SQLITE_NOMEM:
        throw SystemError("use", file_, ENOMEM);
      case SQLITE_BUSY:
      case SQLITE_LOCKED:
        throw SystemError("cannot use " + file_.string() + ": another process has kept it for longer than a minute", EBUSY);
      case SQLITE_CONSTRAINT: // ours alone
      case SQLITE_MISUSE:
        throw std::runtime_error(file_.string() + ": " + what);
      default:
        refuse_database(file_, what);
      }
  }

  class Database::Statement
  {
  public:
    Statement(const Database &database, const char *sql)
      : database_(database)
    {
      database_.files_->forget();
      check(sqlite3_prepare_v2(database.handle_, sql, -1, &handle_, nullptr));
    }
    ~Statement() { sqlite3_finalize(handle_); }
    Statement(const Statement &)            = delete;
    Statement &operator=(const Statement &) = delete;

    void bind(const int i, const std::string &text)
    {
      check(sqlite3_bind_text(handle_, i, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT));
    }
    void bind(const int i, const std::optional<double> &number)
    {
      check(number ? sqlite3_bind_double(handle_, i, *number) : sqlite3_bind_null(handle_, i));
    }

    /// True if there is a row.
    bool step()
    {
      database_.files_->forget();
      const int code = sqlite3_step(handle_);
      if (code != SQLITE_ROW && code != SQLITE_DONE)
        database_.fail();
      return code == SQLITE_ROW;
    }
    void reset() { check(sqlite3_reset(handle_)); }

    std::string text(const int i) const
    {
      return {reinterpret_cast<const char *>(sqlite3_column_text(handle_, i)), static_cast<std::size_t>(sqlite3_column_bytes(handle_, i))};
    }
    std::optional<double> number(const int i) const
    {
      return sqlite3_column_type(handle_, i) == SQLITE_NULL ? std::nullopt : std::optional<double>(sqlite3_column_double(handle_, i));
    }

  private:
    void check(const int code)
    {
      if (code != SQLITE_OK)
        database_.fail();
    }

    const Database &database_;
    sqlite3_stmt   *handle_ = nullptr;
  };

  /// Rolled back unless it is committed.
  class Database::Transaction
  {
  public:
    explicit Transaction(const Database &database)
      : database_(database)
    {
      database_.execute("BEGIN IMMEDIATE");
    }
    ~Transaction()
    {
      if (!committed_)
        sqlite3_exec(database_.handle_, "ROLLBACK", nullptr, nullptr, nullptr);
    }
    Transaction(const Transaction &)            = delete;
    Transaction &operator=(const Transaction &) = delete;

    void commit()
    {
      database_.execute("COMMIT");
      committed_ = true;
    }

  private:
    const Database &database_;
    bool            committed_ = false;
  };

  Database::Database(const std::filesystem::path &file)
    : file_(file)
    , files_(std::make_unique<SqliteFiles>())
  {
    try
      {
        if (sqlite3_open_v2(file.c_str(), &handle_, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, files_->name().c_str()) != SQLITE_OK)
          fail();
        sqlite3_busy_timeout(handle_, 60000);
        Transaction transaction(*this);
        int         found = 0, n_tables = 0;
        {
          Statement user_version(*this, "PRAGMA user_version"), count(*this, "SELECT count(*) FROM sqlite_master");
          user_version.step();
          count.step();
          found    = static_cast<int>(user_version.number(0).value());
          n_tables = static_cast<int>(count.number(0).value());
        }
        if (found == 0 && n_tables == 0)
          execute(std::string(tables) + "PRAGMA user_version = " + std::to_string(version));
        else if (found == 1)
          refuse_database(file_, "it is a database of an earlier version of the program, without checksums");
        else if (found != version)
          refuse_database(file_, "it is a database of something else");
        require_whole();
        transaction.commit();
      }
    catch (...)
      {
        sqlite3_close(handle_);
        throw;
      }
  }

  void Database::require_whole() const
  {
    Statement check(*this, "PRAGMA quick_check(1)");
    check.step();
    if (check.text(0) != "ok")
      refuse_database(file_, "it is damaged: " + check.text(0));
    std::string found;
    for (const char *table : {"cases", "results"})
      {
        found += (found.empty() ? "" : "; ") + std::string(table) + ": ";
        Statement   row(*this, (std::string("PRAGMA table_info(") + table + ")").c_str());
        std::string names;
        while (row.step())
          names += (names.empty() ? "" : ", ") + row.text(1);
        found += names;
      }
    if (found != columns)
      refuse_database(file_, "it has other tables: " + found);
  }

  Database::~Database() { sqlite3_close(handle_); }

  void Database::execute(const std::string &sql) const
  {
    files_->forget();
    if (sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
      fail();
  }

  std::map<std::string, Outcome> Database::outcomes() const
  {
    std::map<std::string, Outcome> all;
    Statement row(*this, "SELECT name, status, reason, cpu_seconds, wall_seconds, command, manifest, ledger, scene, checksum FROM cases");
    while (row.step())
      {
        Outcome outcome;
        outcome.name         = row.text(0);
        outcome.status       = row.text(1);
        outcome.reason       = row.text(2);
        outcome.cpu_seconds  = row.number(3);
        outcome.wall_seconds = row.number(4).value_or(0); // damaged, see below
        outcome.command      = row.text(5);
        outcome.manifest     = row.text(6);
        outcome.ledger       = row.text(7);
        outcome.scene        = row.text(8);
        if (row.text(9) != checksum_of(outcome))
          refuse_database(file_, "what it has of the case \"" + outcome.name + "\" is damaged, or was changed by hand");
        all.emplace(outcome.name, outcome);
      }
    return all;
  }

  void Database::store(const std::vector<Outcome> &outcomes)
  {
    Transaction transaction(*this);
    Statement row(*this, "INSERT OR REPLACE INTO cases (name, status, reason, cpu_seconds, wall_seconds, command, manifest, ledger, scene, "
                         "checksum) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
    for (const Outcome &outcome : outcomes)
      {
        row.bind(1, outcome.name);
        row.bind(2, outcome.status);
        row.bind(3, outcome.reason);
        row.bind(4, outcome.cpu_seconds);
        row.bind(5, std::optional<double>(outcome.wall_seconds));
        row.bind(6, outcome.command);
        row.bind(7, outcome.manifest);
        row.bind(8, outcome.ledger);
        row.bind(9, outcome.scene);
        row.bind(10, checksum_of(outcome));
        row.step();
        row.reset();
      }
    transaction.commit();
  }

  void Database::replace_results(const std::vector<Result> &results)
  {
    Transaction transaction(*this);
    execute("DELETE FROM results");
    Statement row(*this, "INSERT INTO results (name, \"column\", value, note) VALUES (?, ?, ?, ?)");
    for (const Result &result : results)
      {
        row.bind(1, result.name);
        row.bind(2, result.column);
        row.bind(3, result.value);
        row.bind(4, result.note);
        row.step();
        row.reset();
      }
    transaction.commit();
  }
} // namespace myolines::study
