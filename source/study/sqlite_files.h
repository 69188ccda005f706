// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <string>

namespace myolines::study
{
  /// The files of a database as the system gives them to SQLite, with a note of what the system refused first: SQLite itself tells no more
  /// than "disk I/O error", and forgets the reason when it rolls back.
  class SqliteFiles
  {
  public:
    SqliteFiles();  ///< Registers them under name().
    ~SqliteFiles(); ///< No connection uses them any more.
    SqliteFiles(const SqliteFiles &)            = delete;
    SqliteFiles &operator=(const SqliteFiles &) = delete;

    const std::string &name() const; ///< for sqlite3_open_v2()

    void forget();     ///< What was refused before: an operation begins. That a database cannot be written is kept.
    void tell() const; ///< @throws SystemError with operation, path and reason if anything was refused since.

    struct System;

  private:
    std::unique_ptr<System> system_;
  };
} // namespace myolines::study
