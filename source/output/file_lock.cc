// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/output/file_lock.h>

#include <fcntl.h>
#include <sys/file.h>
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
    : descriptor_(open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666))
  {
    const auto refuse = [&](const std::string &what) {
      throw InputError(InputProblem{file.string(), what, "a folder into which nothing else writes",
                                    "wait for its end, or choose another folder with --out"});
    };
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

  FileLock::~FileLock() { close(descriptor_); }
} // namespace myolines
