// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/output/file_lock.h>
#include <myolines/output/refused_name.h>

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

    /// How to mend that the file @p lock cannot be opened.
    std::string mending(const std::filesystem::path &lock, const int error)
    {
      const std::string folder = lock.has_parent_path() ? lock.parent_path().string() : ".";
      const std::string other  = "choose another folder with --out";
      switch (error)
        {
        case EACCES:
        case EPERM:
          return "allow yourself to write there (chmod u+w \"" + folder + "\"), or " + other;
        case EROFS:
          return "its file system can only be read: " + other;
        case ELOOP:
          return "it is a symbolic link: remove it, or " + other;
        default:
          return other;
        }
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
    descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (descriptor_ < 0 && !is_of_the_name(errno))
      throw SystemError("write", file_, errno);
    if (descriptor_ < 0)
      throw InputError(InputProblem{file_.string(), std::string("cannot be written: ") + std::strerror(errno),
                                    "a folder in which files can be made", mending(file_, errno)});
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
        const bool taken = reason == EWOULDBLOCK;
        throw InputError(InputProblem{file_.string(),
                                      taken ? holder + " is running here" + (who.empty() ? "" : " (" + who + ")") : std::strerror(reason),
                                      "a folder into which nothing else writes",
                                      std::string(taken ? "wait for its end, or " : "") + "choose another folder with --out"});
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
