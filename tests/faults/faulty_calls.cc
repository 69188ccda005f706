// SPDX-License-Identifier: LGPL-2.1-or-later
// The calls of the system by which programs change files, in place of those of the C library: symbols of the program come first, also for
// the libraries that it loads.

#include "faulty_calls.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

namespace
{
  struct Descriptor
  {
    bool watched = false, written = false; ///< written: since it was opened or synced
  };

  // Of calls that anything may make, which can be handed nothing: what is watched is global.
  std::array<Descriptor, 4096> descriptors;
  char                         watched_folder[PATH_MAX] = "";
  myolines::test::Fault        planned;
  myolines::test::CallList    *calls = nullptr; ///< none: nothing is watched

  Descriptor *descriptor(const int file)
  {
    return file >= 0 && static_cast<std::size_t>(file) < descriptors.size() ? &descriptors[static_cast<std::size_t>(file)] : nullptr;
  }

  bool is_watched(const int folder, const char *path)
  {
    if (calls == nullptr || path == nullptr)
      return false;
    char whole[2 * PATH_MAX] = "";
    if (path[0] != '/')
      {
        char link[64];
        std::snprintf(link, sizeof link, folder == AT_FDCWD ? "/proc/self/cwd" : "/proc/self/fd/%d", folder);
        const ssize_t length = readlink(link, whole, PATH_MAX);
        if (length < 0)
          return false;
        whole[length] = '/';
      }
    std::strncat(whole, path, PATH_MAX - 1);
    const std::size_t length = std::strlen(watched_folder);
    if (std::strncmp(whole, watched_folder, length) != 0 || whole[length] != '/')
      return false;
    const char *name = std::strrchr(whole, '/') + 1;
    for (const char *other : {"run.lock", "study.lock", "out.txt", "err.txt", "console.txt"})
      if (std::strcmp(name, other) == 0)
        return false;
    return true;
  }

  enum class Fate
  {
    usual,
    failed, ///< errno is set
    killed
  };

  Fate fate_of(const char *call, const char *path, const bool needs_room)
  {
    const long number = calls->add(call, path);
    if (planned.at == 0 || number < planned.at || (number > planned.at && !(planned.lasting && needs_room)))
      return Fate::usual;
    errno = planned.error;
    return planned.error == 0 ? Fate::killed : Fate::failed;
  }

  [[noreturn]] void end()
  {
    raise(SIGKILL);
    _exit(127);
  }

  /// True if the call is to fail.
  bool fails(const char *call, const char *path, const bool needs_room)
  {
    const Fate fate = fate_of(call, path, needs_room);
    if (fate == Fate::killed)
      end();
    return fate == Fate::failed;
  }

  bool fails(const char *call, const int file, const bool needs_room)
  {
    const Descriptor *known = descriptor(file);
    if (calls == nullptr || known == nullptr || !known->watched)
      return false;
    char path[PATH_MAX] = "", link[64];
    std::snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    (void) !readlink(link, path, sizeof path - 1);
    return fails(call, path, needs_room);
  }

  /// @p write does the call for a number of bytes.
  template <typename Write>
  ssize_t written(const char *call, const int file, const std::size_t bytes, const Write &write)
  {
    Descriptor *known = descriptor(file);
    if (calls == nullptr || known == nullptr || !known->watched)
      return write(bytes);
    known->written      = true;
    char path[PATH_MAX] = "", link[64];
    std::snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    (void) !readlink(link, path, sizeof path - 1);
    const Fate fate = fate_of(call, path, true);
    if (fate == Fate::usual)
      return write(bytes);
    const int reason = errno;
    write(bytes / 2);
    if (fate == Fate::killed)
      end();
    errno = reason;
    return -1;
  }

  int opened(const int folder, const char *path, const int flags, const mode_t mode)
  {
    const bool watched = is_watched(folder, path), reads = (flags & O_ACCMODE) == O_RDONLY;
    if (watched && fails(reads ? "read" : "open", path, (flags & O_CREAT) != 0))
      return -1;
    const int file = static_cast<int>(syscall(SYS_openat, folder, path, flags, mode));
    if (Descriptor *known = descriptor(file))
      *known = {watched && !reads, false};
    return file;
  }

  mode_t mode_of(const int flags, va_list &more) { return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0; }

  int moved(const int from_folder, const char *from, const int to_folder, const char *to)
  {
    if (is_watched(to_folder, to) && fails("rename", to, true))
      return -1;
    return static_cast<int>(syscall(SYS_renameat2, from_folder, from, to_folder, to, 0));
  }

  int removed(const int folder, const char *path, const int flags)
  {
    if (is_watched(folder, path) && fails("remove", path, false))
      return -1;
    return static_cast<int>(syscall(SYS_unlinkat, folder, path, flags));
  }

  FILE *stream(const char *symbol, const char *path, const char *mode)
  {
    if (is_watched(AT_FDCWD, path) && fails(mode[0] == 'r' ? "read" : "open", path, mode[0] != 'r'))
      return nullptr;
    return reinterpret_cast<FILE *(*) (const char *, const char *)>(dlsym(RTLD_NEXT, symbol))(path, mode);
  }
} // namespace

extern "C" {
int open(const char *path, int flags, ...)
{
  va_list more;
  va_start(more, flags);
  const mode_t mode = mode_of(flags, more);
  va_end(more);
  return opened(AT_FDCWD, path, flags, mode);
}
int open64(const char *path, int flags, ...)
{
  va_list more;
  va_start(more, flags);
  const mode_t mode = mode_of(flags, more);
  va_end(more);
  return opened(AT_FDCWD, path, flags, mode);
}
FILE *fopen(const char *path, const char *mode) { return stream("fopen", path, mode); }
FILE *fopen64(const char *path, const char *mode) { return stream("fopen64", path, mode); }

ssize_t write(int file, const void *data, size_t bytes)
{
  return written("write", file, bytes, [&](const std::size_t n) { return syscall(SYS_write, file, data, n); });
}
ssize_t pwrite(int file, const void *data, size_t bytes, off_t begin)
{
  return written("write", file, bytes, [&](const std::size_t n) { return syscall(SYS_pwrite64, file, data, n, begin); });
}
ssize_t pwrite64(int file, const void *data, size_t bytes, off64_t begin)
{
  return written("write", file, bytes, [&](const std::size_t n) { return syscall(SYS_pwrite64, file, data, n, begin); });
}
int ftruncate(int file, off_t bytes) noexcept
{
  if (fails("cut", file, false))
    return -1;
  if (Descriptor *known = descriptor(file))
    known->written = true;
  return static_cast<int>(syscall(SYS_ftruncate, file, bytes));
}
int ftruncate64(int file, off64_t bytes) noexcept { return ftruncate(file, bytes); }
int fsync(int file)
{
  if (fails("sync", file, true))
    return -1;
  if (Descriptor *known = descriptor(file))
    known->written = false;
  return static_cast<int>(syscall(SYS_fsync, file));
}
int fdatasync(int file) { return fsync(file); }
int close(int file)
{
  const Descriptor *known  = descriptor(file);
  const bool        failed = known != nullptr && known->written && fails("close", file, true);
  const int         reason = errno;
  if (Descriptor *gone = descriptor(file))
    *gone = {};
  const int result = static_cast<int>(syscall(SYS_close, file));
  if (!failed)
    return result;
  errno = reason;
  return -1;
}

int rename(const char *from, const char *to) noexcept { return moved(AT_FDCWD, from, AT_FDCWD, to); }
int renameat(int from_folder, const char *from, int to_folder, const char *to) noexcept { return moved(from_folder, from, to_folder, to); }
int unlink(const char *path) noexcept { return removed(AT_FDCWD, path, 0); }
int unlinkat(int folder, const char *path, int flags) noexcept { return removed(folder, path, flags); }
int rmdir(const char *path) noexcept { return removed(AT_FDCWD, path, AT_REMOVEDIR); }
int remove(const char *path) noexcept
{
  const int result = removed(AT_FDCWD, path, 0);
  return result != 0 && errno == EISDIR ? static_cast<int>(syscall(SYS_unlinkat, AT_FDCWD, path, AT_REMOVEDIR)) : result;
}
int mkdir(const char *path, mode_t mode) noexcept
{
  if (is_watched(AT_FDCWD, path) && fails("mkdir", path, true))
    return -1;
  return static_cast<int>(syscall(SYS_mkdirat, AT_FDCWD, path, mode));
}
}

namespace myolines::test
{
  struct CallList::Shared
  {
    std::atomic<long>        n;
    std::atomic<std::size_t> length;
    char                     text[1 << 22];
  };

  CallList::CallList()
    : shared_(static_cast<Shared *>(mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)))
  {
    if (shared_ == MAP_FAILED)
      _exit(127);
  }

  CallList::~CallList() { munmap(shared_, sizeof(Shared)); }

  void CallList::clear() { shared_->n = 0, shared_->length = 0; }

  std::string CallList::text() const { return {shared_->text, std::min<std::size_t>(shared_->length, sizeof shared_->text)}; }

  long CallList::add(const char *call, const char *path)
  {
    char              line[PATH_MAX + 64];
    const int         length = std::snprintf(line, sizeof line, "%s %s\n", call, path);
    const std::size_t begin  = shared_->length.fetch_add(static_cast<std::size_t>(length));
    if (begin + static_cast<std::size_t>(length) < sizeof shared_->text)
      std::memcpy(shared_->text + begin, line, static_cast<std::size_t>(length));
    return ++shared_->n;
  }

  void watch_calls(const std::string &folder, CallList &list, const Fault &fault)
  {
    if (folder.size() >= sizeof watched_folder)
      _exit(127);
    std::strcpy(watched_folder, folder.c_str());
    planned = fault;
    calls   = &list;
  }
} // namespace myolines::test
