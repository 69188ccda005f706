// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sqlite_files.h"

#include <myolines/base/error.h>

#include <sqlite3.h>

#include <cerrno>
#include <optional>
#include <sstream>

#include <fcntl.h>
#include <unistd.h>

namespace myolines::study
{
  /// What SQLite calls "VFS": that of the system but for the calls that may be refused.
  struct SqliteFiles::System : sqlite3_vfs
  {
    struct Refusal
    {
      const char *verb;
      std::string path;
      int         error;
    };

    System()
      : sqlite3_vfs(*sqlite3_vfs_find(nullptr))
      , usual(sqlite3_vfs_find(nullptr))
    {}

    static void note(std::optional<Refusal> &place, const char *verb, const char *path, const int error)
    {
      if (!place)
        place = Refusal{verb, path == nullptr ? "a temporary file" : path, error};
    }

    sqlite3_vfs           *usual;
    std::string            own_name;
    std::optional<Refusal> first, writing; ///< `writing`: SQLite reads what it cannot write, and tells of it later
  };

  namespace
  {
    using System = SqliteFiles::System;

    /// The file of the system lies behind it in memory.
    struct WatchedFile : sqlite3_file
    {
      sqlite3_file *usual() { return reinterpret_cast<sqlite3_file *>(this + 1); }

      System     *system;
      const char *path; ///< SQLite keeps it until the file is closed
    };

    WatchedFile *watched(sqlite3_file *file) { return static_cast<WatchedFile *>(file); }

    /// The system's number, as the file keeps it. A full disk SQLite takes for no error of the system.
    int error_of(const int code, sqlite3_file *file)
    {
      const int last = errno;
      if (code == SQLITE_FULL)
        return ENOSPC;
      int kept = 0;
      file->pMethods->xFileControl(file, SQLITE_FCNTL_LAST_ERRNO, &kept);
      return kept != 0 ? kept : last;
    }

    /// Hands @p code on. A file that ends before what was to be read, or that another process holds, is not refused.
    int told(const char *verb, sqlite3_file *file, const int code)
    {
      if (code != SQLITE_OK && code != SQLITE_IOERR_SHORT_READ && (code & 0xff) != SQLITE_BUSY && code != SQLITE_NOTFOUND)
        System::note(watched(file)->system->first, verb, watched(file)->path, error_of(code, watched(file)->usual()));
      return code;
    }

    sqlite3_io_methods watched_methods()
    {
      sqlite3_io_methods methods{};
      methods.iVersion = 1; // without memory shared by processes, which databases in this mode do not need
      methods.xClose   = [](sqlite3_file *file) {
        sqlite3_file *usual = watched(file)->usual();
        return usual->pMethods->xClose(usual);
      };
      methods.xRead = [](sqlite3_file *file, void *data, int bytes, sqlite3_int64 begin) {
        sqlite3_file *usual = watched(file)->usual();
        return told("read", file, usual->pMethods->xRead(usual, data, bytes, begin));
      };
      methods.xWrite = [](sqlite3_file *file, const void *data, int bytes, sqlite3_int64 begin) {
        sqlite3_file *usual = watched(file)->usual();
        return told("write", file, usual->pMethods->xWrite(usual, data, bytes, begin));
      };
      methods.xTruncate = [](sqlite3_file *file, sqlite3_int64 bytes) {
        sqlite3_file *usual = watched(file)->usual();
        return told("write", file, usual->pMethods->xTruncate(usual, bytes));
      };
      methods.xSync = [](sqlite3_file *file, int flags) {
        sqlite3_file *usual = watched(file)->usual();
        return told("write", file, usual->pMethods->xSync(usual, flags));
      };
      methods.xFileSize = [](sqlite3_file *file, sqlite3_int64 *bytes) {
        sqlite3_file *usual = watched(file)->usual();
        return told("read", file, usual->pMethods->xFileSize(usual, bytes));
      };
      methods.xLock = [](sqlite3_file *file, int kind) {
        sqlite3_file *usual = watched(file)->usual();
        return told("lock", file, usual->pMethods->xLock(usual, kind));
      };
      methods.xUnlock = [](sqlite3_file *file, int kind) {
        sqlite3_file *usual = watched(file)->usual();
        return told("unlock", file, usual->pMethods->xUnlock(usual, kind));
      };
      methods.xCheckReservedLock = [](sqlite3_file *file, int *found) {
        sqlite3_file *usual = watched(file)->usual();
        return told("lock", file, usual->pMethods->xCheckReservedLock(usual, found));
      };
      methods.xFileControl = [](sqlite3_file *file, int what, void *value) {
        sqlite3_file *usual = watched(file)->usual();
        return usual->pMethods->xFileControl(usual, what, value); // hints that a file may ignore
      };
      methods.xSectorSize = [](sqlite3_file *file) {
        sqlite3_file *usual = watched(file)->usual();
        return usual->pMethods->xSectorSize(usual);
      };
      methods.xDeviceCharacteristics = [](sqlite3_file *file) {
        sqlite3_file *usual = watched(file)->usual();
        return usual->pMethods->xDeviceCharacteristics(usual);
      };
      return methods;
    }

    /// SQLite tries to read what it cannot make, so that no such file would be the reason in the end. Locks, which any closing of a file
    /// ends, are on none that is made here.
    bool make_file(System &system, const char *path)
    {
      const int made = ::open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0644);
      if (made < 0)
        System::note(system.first, "open", path, errno);
      else
        ::close(made);
      return made >= 0;
    }

    int open_watched(sqlite3_vfs *vfs, const char *path, sqlite3_file *file, int flags, int *found)
    {
      static const sqlite3_io_methods methods = watched_methods();
      System                         &system  = *static_cast<System *>(vfs);
      WatchedFile                    &opened  = *watched(file);
      int                             as      = flags;
      opened.pMethods                         = nullptr;
      opened.system                           = &system;
      opened.path                             = path;
      if ((flags & SQLITE_OPEN_CREATE) != 0 && path != nullptr && access(path, F_OK) != 0 && !make_file(system, path))
        return SQLITE_CANTOPEN;
      errno             = 0;
      int       code    = system.usual->xOpen(system.usual, path, opened.usual(), flags, &as);
      const int refused = errno != 0 ? errno : EACCES;
      if (code == SQLITE_OK && (flags & SQLITE_OPEN_READWRITE) != 0 && (as & SQLITE_OPEN_READONLY) != 0)
        {
          const bool database = (flags & SQLITE_OPEN_MAIN_DB) != 0; // may be read; what SQLite writes beside it may not
          System::note(database ? system.writing : system.first, database ? "write" : "open", path, refused);
          if (!database)
            {
              opened.usual()->pMethods->xClose(opened.usual());
              opened.usual()->pMethods = nullptr;
              code                     = SQLITE_CANTOPEN;
            }
        }
      else if (code != SQLITE_OK)
        System::note(system.first, "open", path, refused);
      if (opened.usual()->pMethods != nullptr) // to be closed, even if it could not be opened
        opened.pMethods = &methods;
      if (found != nullptr)
        *found = as;
      return code;
    }

    int remove_watched(sqlite3_vfs *vfs, const char *path, int sync_folder)
    {
      System   &system = *static_cast<System *>(vfs);
      const int code   = system.usual->xDelete(system.usual, path, sync_folder);
      if (code != SQLITE_OK && code != SQLITE_IOERR_DELETE_NOENT)
        System::note(system.first, "remove", path, errno);
      return code;
    }
  } // namespace

  SqliteFiles::SqliteFiles()
    : system_(std::make_unique<System>())
  {
    std::ostringstream name;
    name << "myolines " << system_.get();
    system_->own_name = name.str();
    system_->zName    = system_->own_name.c_str();
    system_->pNext    = nullptr;
    system_->szOsFile += static_cast<int>(sizeof(WatchedFile));
    system_->xOpen   = open_watched;
    system_->xDelete = remove_watched;
    if (sqlite3_vfs_register(system_.get(), /*as default*/ 0) != SQLITE_OK)
      throw SystemError("SQLite does not take files", ENOMEM);
  }

  SqliteFiles::~SqliteFiles() { sqlite3_vfs_unregister(system_.get()); }

  const std::string &SqliteFiles::name() const { return system_->own_name; }

  void SqliteFiles::forget() { system_->first.reset(); }

  void SqliteFiles::tell() const
  {
    for (const auto &refusal : {system_->first, system_->writing})
      if (refusal)
        throw SystemError(refusal->verb, refusal->path, refusal->error);
  }
} // namespace myolines::study
