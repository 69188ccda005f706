// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace myolines
{
  /// A file by the calls of the system, so that every refusal is known with its reason. All members but the destructor
  /// @throw SystemError with path and reason.
  class File
  {
  public:
    /// What the file is opened for.
    enum class Mode
    {
      read,       ///< one that is there
      write,      ///< one that is there, or is made
      write_anew, ///< emptied if it is there
      append      ///< after what is there
    };
    File(const std::filesystem::path &path, Mode mode); ///< Opens the file at @p path.
    ~File();                                            ///< Closes it and tells nothing.
    File(File &&) noexcept;                             ///< What is moved from is closed.
    File &operator=(File &&) noexcept;                  ///< Closes what it had open, then takes the other file over.

    /// At the end of what was written before, in the mode `append` of the file.
    void write(const std::string &text);

    void write_at(std::size_t begin, const void *data, std::size_t bytes); ///< @p bytes bytes from byte @p begin on.

    /// False if the file ends before.
    bool read_at(std::size_t begin, void *data, std::size_t bytes) const;

    /// Begin and end of the parts that are no holes [bytes]; between them the file reads as zeros.
    std::vector<std::pair<std::size_t, std::size_t>> written_parts() const;

    std::size_t size() const;              ///< [bytes]
    void        resize(std::size_t bytes); ///< cut, or longer by zeros
    void        sync();                    ///< returns once everything is on the disk itself
    void        close();                   ///< tells what the destructor would not: some systems refuse at the end only

    const std::filesystem::path &path() const { return path_; } ///< As it was opened.

  private:
    std::filesystem::path path_;
    int                   descriptor_ = -1;
  };

  /// The bytes of a file. @throws SystemError.
  std::string read_file(const std::filesystem::path &file);

  /// Where a file is written before it is moved to @p file: the same name and ".new".
  std::filesystem::path unfinished(const std::filesystem::path &file);

  /// Moves unfinished(file) to @p file, in place of what is there. @throws SystemError.
  void finish_file(const std::filesystem::path &file);

  /// Makes @p file anew with @p text in it, in one move: a reader or a kill never sees half of it. What could not be written whole is
  /// removed. What is there and is no file (a device, a pipe, a link) is written to as it is. @throws SystemError.
  void write_file(const std::filesystem::path &file, const std::string &text);

  /// The first byte of @p text that is not part of a character in UTF-8; npos if all are.
  std::size_t first_not_utf8(const std::string &text);
} // namespace myolines
