// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/output/file_lock.h>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace myolines
{
  namespace
  {
    /// "node7, process 1234": who holds the lock, for the message that others get.
    std::string this_process()
    {
      char host[256] = "";
      gethostname(host, sizeof host - 1);
      return std::string(host) + ", process " + std::to_string(getpid());
    }

    std::string written_in(const int descriptor)
    {
      char          text[300];
      const ssize_t length = pread(descriptor, text, sizeof text, 0);
      return length > 0 ? std::string(text, static_cast<std::size_t>(length)) : "";
    }
  } // namespace

  FileLock::FileLock(const std::filesystem::path &file, const Kind kind, const std::string &holder)
    : file_(file)
  {
    lock(kind, holder);
    while (!is_in_place()) // who had it has removed the file between the opening and the lock
      {
        close(descriptor_);
        lock(kind, holder);
      }
  }

  FileLock::~FileLock()
  {
    if (flock(descriptor_, LOCK_EX | LOCK_NB) == 0 && is_in_place()) // nobody shares it
      unlink(file_.c_str());
    close(descriptor_);
  }

  void FileLock::lock(const Kind kind, const std::string &holder)
  {
    const auto refuse = [&](const std::string &what) {
      throw InputError(InputProblem{file_.string(), what, "a folder into which nothing else writes",
                                    "wait for its end, or choose another folder with --out"});
    };
    descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (descriptor_ < 0)
      refuse(std::string("cannot be written: ") + std::strerror(errno));
    if (flock(descriptor_, (kind == Kind::shared ? LOCK_SH : LOCK_EX) | LOCK_NB) == 0)
      {
        const std::string text = this_process();
        if (kind == Kind::exclusive && ftruncate(descriptor_, 0) == 0)
          (void) !pwrite(descriptor_, text.data(), text.size(), 0); // of use to a message alone
      }
    else if (errno != ENOLCK && errno != ENOTSUP && errno != ENOSYS)
      {
        const int         reason = errno;
        const std::string who    = kind == Kind::exclusive ? written_in(descriptor_) : "";
        close(descriptor_);
        refuse(reason == EWOULDBLOCK ? holder + " is running here" + (who.empty() ? "" : " (" + who + ")") : std::strerror(reason));
      }
  }

  /// Whether the name still leads to the file that is open here.
  bool FileLock::is_in_place() const
  {
    struct stat named
    {
    }, opened{};
    return stat(file_.c_str(), &named) == 0 && fstat(descriptor_, &opened) == 0 && named.st_dev == opened.st_dev &&
           named.st_ino == opened.st_ino;
  }
} // namespace myolines
