// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/base/files.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace myolines
{
  namespace
  {
    int flags(const File::Mode mode)
    {
      switch (mode)
        {
        case File::Mode::read:
          return O_RDONLY;
        case File::Mode::write:
          return O_RDWR | O_CREAT;
        case File::Mode::write_anew:
          return O_RDWR | O_CREAT | O_TRUNC;
        case File::Mode::append:
          return O_WRONLY | O_CREAT | O_APPEND;
        }
      return O_RDONLY;
    }

    /// Whole, however often the system stops in between: @p call takes what is left and returns how much it did, 0 at the end of a file.
    template <typename Call>
    std::size_t transfer(const char *verb, const std::filesystem::path &path, const std::size_t bytes, const Call &call)
    {
      std::size_t done = 0;
      while (done < bytes)
        {
          const ssize_t part = call(done, bytes - done);
          if (part == 0)
            break;
          if (part > 0)
            done += static_cast<std::size_t>(part);
          else if (errno != EINTR)
            throw SystemError(verb, path, errno);
        }
      return done;
    }
  } // namespace

  File::File(const std::filesystem::path &path, const Mode mode)
    : path_(path)
    , descriptor_(open(path.c_str(), flags(mode) | O_CLOEXEC, 0666))
  {
    if (descriptor_ < 0)
      throw SystemError(mode == Mode::read ? "read" : "write", path, errno);
  }

  File::~File()
  {
    if (descriptor_ >= 0)
      ::close(descriptor_);
  }

  File::File(File &&other) noexcept
    : path_(std::move(other.path_))
    , descriptor_(std::exchange(other.descriptor_, -1))
  {}

  File &File::operator=(File &&other) noexcept
  {
    std::swap(path_, other.path_);
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }

  void File::write(const std::string &text)
  {
    transfer("write", path_, text.size(),
             [&](const std::size_t from, const std::size_t n) { return ::write(descriptor_, text.data() + from, n); });
  }

  void File::write_at(const std::size_t begin, const void *data, const std::size_t bytes)
  {
    const char *all = static_cast<const char *>(data);
    transfer("write", path_, bytes, [&](const std::size_t from, const std::size_t n) {
      return pwrite(descriptor_, all + from, n, static_cast<off_t>(begin + from));
    });
  }

  bool File::read_at(const std::size_t begin, void *data, const std::size_t bytes) const
  {
    char *all = static_cast<char *>(data);
    return bytes == transfer("read", path_, bytes, [&](const std::size_t from, const std::size_t n) {
             return pread(descriptor_, all + from, n, static_cast<off_t>(begin + from));
           });
  }

  std::vector<std::pair<std::size_t, std::size_t>> File::written_parts() const
  {
    std::vector<std::pair<std::size_t, std::size_t>> parts;
    for (off_t end = 0;;)
      {
        const off_t begin = lseek(descriptor_, end, SEEK_DATA);
        if (begin < 0 && errno == ENXIO)
          return parts;
        if (begin < 0 || (end = lseek(descriptor_, begin, SEEK_HOLE)) < 0)
          throw SystemError("read", path_, errno);
        parts.emplace_back(static_cast<std::size_t>(begin), static_cast<std::size_t>(end));
      }
  }

  std::size_t File::size() const
  {
    struct stat status
    {
    };
    if (fstat(descriptor_, &status) != 0)
      throw SystemError("read", path_, errno);
    return static_cast<std::size_t>(status.st_size);
  }

  void File::resize(const std::size_t bytes)
  {
    if (ftruncate(descriptor_, static_cast<off_t>(bytes)) != 0)
      throw SystemError("write", path_, errno);
  }

  void File::sync()
  {
    if (fsync(descriptor_) != 0)
      throw SystemError("write", path_, errno);
  }

  void File::close()
  {
    if (descriptor_ >= 0 && ::close(std::exchange(descriptor_, -1)) != 0)
      throw SystemError("write", path_, errno);
  }

  std::string read_file(const std::filesystem::path &file)
  {
    const File  stream(file, File::Mode::read);
    std::string text(stream.size(), '\0');
    if (!stream.read_at(0, text.data(), text.size()))
      throw SystemError("cannot read " + file.string() + ": it became shorter meanwhile");
    return text;
  }

  std::filesystem::path unfinished(const std::filesystem::path &file)
  {
    std::filesystem::path fresh = file;
    return fresh += ".new";
  }

  void finish_file(const std::filesystem::path &file)
  {
    std::error_code refused;
    std::filesystem::rename(unfinished(file), file, refused);
    if (refused)
      throw SystemError("write", file, refused.value());
  }

  void write_file(const std::filesystem::path &file, const std::string &text)
  {
    std::error_code             ignored; // the first failure is the one to tell
    const auto                  found    = std::filesystem::symlink_status(file, ignored);
    const bool                  in_place = std::filesystem::exists(found) && !std::filesystem::is_regular_file(found);
    const std::filesystem::path place    = in_place ? file : unfinished(file);
    try
      {
        File stream(place, File::Mode::write_anew);
        stream.write_at(0, text.data(), text.size());
        stream.close();
        if (!in_place)
          finish_file(file);
      }
    catch (const SystemError &)
      {
        if (!in_place)
          std::filesystem::remove(place, ignored);
        throw;
      }
  }

  /// Unicode standard, table 3-7: well-formed byte sequences.
  std::size_t first_not_utf8(const std::string &text)
  {
    const auto byte = [&text](const std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
    for (std::size_t i = 0; i < text.size();)
      {
        const unsigned int lead   = byte(i);
        const std::size_t  length = lead < 0x80                   ? 1
                                    : lead >= 0xc2 && lead < 0xe0 ? 2
                                    : (lead & 0xf0) == 0xe0       ? 3
                                    : lead >= 0xf0 && lead < 0xf5 ? 4
                                                                  : 0;
        const unsigned int low    = lead == 0xe0 ? 0xa0 : lead == 0xf0 ? 0x90 : 0x80;
        const unsigned int high   = lead == 0xed ? 0x9f : lead == 0xf4 ? 0x8f : 0xbf;
        bool               good   = length > 0;
        if (length > 1)
          good = byte(i + 1) >= low && byte(i + 1) <= high;
        for (std::size_t k = 2; k < length; ++k)
          good = good && (byte(i + k) & 0xc0) == 0x80;
        if (!good)
          return i;
        i += length;
      }
    return std::string::npos;
  }
} // namespace myolines
