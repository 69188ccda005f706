// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/base/files.h>
#include <myolines/scene/input_text.h>

#include <algorithm>
#include <cstdio>

namespace myolines::scene
{
  namespace
  {
    namespace fs = std::filesystem;

    /// What @p file is instead of a regular file; "" if it is one.
    std::string other_kind(const fs::path &file)
    {
      std::error_code reason;
      fs::file_status status = fs::status(file, reason);
      switch (status.type())
        {
        case fs::file_type::regular:
          return "";
        case fs::file_type::directory:
          return "it is a folder, not a file";
        case fs::file_type::fifo:
          return "it is a pipe, not a file";
        case fs::file_type::socket:
          return "it is a socket, not a file";
        case fs::file_type::block:
        case fs::file_type::character:
          return "it is a device, not a file";
        case fs::file_type::not_found:
          return "there is no such file";
        default:
          return "it cannot be read: " + reason.message();
        }
    }

    [[noreturn]] void refuse_input(const fs::path &file, const std::string &what, const std::string &expected, const std::string &hint = "")
    {
      throw InputError(InputProblem{file.empty() ? "\"\"" : file.string(), what, expected, hint});
    }

    std::string line_number(const std::string &text, const std::size_t at)
    {
      return std::to_string(1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
    }

    std::string hexadecimal(const char c)
    {
      char digits[8];
      std::snprintf(digits, sizeof digits, "0x%02X", static_cast<unsigned int>(static_cast<unsigned char>(c)));
      return digits;
    }
  } // namespace

  std::string read_input_bytes(const std::filesystem::path &file)
  {
    const std::string expected = "a readable, non-empty file";
    if (const std::string other = other_kind(file); !other.empty())
      refuse_input(file, other, expected);
    std::string text;
    try
      {
        text = read_file(file);
      }
    catch (const SystemError &error)
      {
        refuse_input(file, error.what(), expected);
      }
    if (text.rfind("\xEF\xBB\xBF", 0) == 0)
      text.erase(0, 3);
    if (text.empty())
      refuse_input(file, "the file is empty", expected);
    return text;
  }

  std::string read_input_text(const std::filesystem::path &file)
  {
    std::string text = read_input_bytes(file);
    if (text.rfind("\xFF\xFE", 0) == 0 || text.rfind("\xFE\xFF", 0) == 0)
      refuse_input(file, "the file is in UTF-16", "text in UTF-8", "save it as UTF-8");
    if (const std::size_t at = text.find('\0'); at != std::string::npos)
      refuse_input(file, "there is a zero byte in line " + line_number(text, at), "text in UTF-8",
                   "the file is binary, or was cut off by a crash");
    if (const std::size_t at = first_not_utf8(text); at != std::string::npos)
      refuse_input(file, "the byte " + hexadecimal(text[at]) + " in line " + line_number(text, at) + " is not UTF-8", "text in UTF-8",
                   "save the file as UTF-8; from Latin-1: iconv -f latin1 -t utf-8");
    if (text.find('\n') == std::string::npos)
      std::replace(text.begin(), text.end(), '\r', '\n');
    return text;
  }
} // namespace myolines::scene
