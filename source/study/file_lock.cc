#include "file_lock.h"

#include <myolines/base/error.h>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace myolines::study
{
  FileLock::FileLock(const std::filesystem::path &file, const Kind kind)
    : descriptor_(open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666))
  {
    const auto refuse = [&file](const std::string &what) {
      throw InputError(InputProblem{file.string(), what, "a folder in which no study is running",
                                    "wait for its end, or choose another folder with --out"});
    };
    if (descriptor_ < 0)
      refuse(std::string("cannot be written: ") + std::strerror(errno));
    if (flock(descriptor_, (kind == Kind::shared ? LOCK_SH : LOCK_EX) | LOCK_NB) != 0)
      {
        const int reason = errno;
        close(descriptor_);
        refuse(reason == EWOULDBLOCK ? "another study, or a part of one, is running here" : std::strerror(reason));
      }
  }

  FileLock::~FileLock() { close(descriptor_); }
} // namespace myolines::study
