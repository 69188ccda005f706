// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cursor.h"

#include <myolines/base/error.h>

#include <charconv>
#include <cmath>
#include <limits>

namespace myolines
{
  namespace
  {
    bool is_white(const char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

    /// A word for a message: short, and without bytes that are no text.
    std::string shown(const std::string_view word)
    {
      std::string text;
      for (const char c : word.substr(0, 40))
        text += c >= ' ' && c <= '~' ? c : '?';
      return "\"" + text + (word.size() > 40 ? "...\"" : "\"");
    }
  } // namespace

  double number_of(std::string_view word)
  {
    if (!word.empty() && word.front() == '+')
      word.remove_prefix(1);
    double      value;
    const auto  result = std::from_chars(word.data(), word.data() + word.size(), value);
    const char *end    = word.data() + word.size();
    if (result.ec == std::errc() && result.ptr == end)
      return value;
    if (result.ec == std::errc() && (*result.ptr == 'D' || *result.ptr == 'd')) // programs in Fortran write 1.5D-03
      {
        std::string text(word);
        text[static_cast<std::size_t>(result.ptr - word.data())] = 'e';
        const auto again                                         = std::from_chars(text.data(), text.data() + text.size(), value);
        if (again.ec == std::errc() && again.ptr == text.data() + text.size())
          return value;
      }
    return std::numeric_limits<double>::quiet_NaN();
  }

  std::string_view Cursor::word()
  {
    while (at_ < bytes_.size() && is_white(bytes_[at_]))
      ++at_;
    const std::size_t begin = at_;
    while (at_ < bytes_.size() && !is_white(bytes_[at_]))
      ++at_;
    return bytes_.substr(begin, at_ - begin);
  }

  std::string_view Cursor::line()
  {
    const std::size_t begin = at_, end = std::min(bytes_.find('\n', at_), bytes_.size());
    at_                         = std::min(end + 1, bytes_.size());
    const std::string_view text = bytes_.substr(begin, end - begin);
    return !text.empty() && text.back() == '\r' ? text.substr(0, text.size() - 1) : text;
  }

  std::string_view Cursor::peek_word()
  {
    const std::size_t      before = at_;
    const std::string_view next   = word();
    at_                           = before;
    return next;
  }

  double Cursor::number(const std::string &what)
  {
    if (binary)
      {
        const double value = raw<double>(what);
        if (!std::isfinite(value))
          refuse(what + " is not finite", "a number");
        return value;
      }
    const std::string_view text  = word();
    const double           value = number_of(text);
    if (text.empty())
      refuse("the file ends where " + what + " should be", "the whole file");
    if (!std::isfinite(value))
      refuse(shown(text) + " stands where " + what + " should be", "a number");
    return value;
  }

  std::int64_t Cursor::text_integer(const std::string &what)
  {
    std::string_view text = word();
    if (text.empty())
      refuse("the file ends where " + what + " should be", "the whole file");
    std::int64_t value;
    const auto   result = std::from_chars(text.data(), text.data() + text.size(), value);
    if (result.ec != std::errc() || result.ptr != text.data() + text.size())
      refuse(shown(text) + " stands where " + what + " should be", "an integer");
    return value;
  }

  std::int64_t Cursor::integer(const std::string &what) { return binary ? raw<std::int32_t>(what) : text_integer(what); }

  std::int64_t Cursor::large_integer(const std::string &what) { return binary ? raw<std::int64_t>(what) : text_integer(what); }

  std::size_t Cursor::count(const std::int64_t announced, const std::size_t bytes, const std::string &things) const
  {
    if (announced < 0 || static_cast<std::uint64_t>(announced) > left() / bytes)
      refuse(std::to_string(announced) + " " + things + " are announced, which the " + std::to_string(left()) + " bytes behind cannot hold",
             "the whole file", "it was cut off, or is damaged");
    return static_cast<std::size_t>(announced);
  }

  void Cursor::refuse(const std::string &what, const std::string &expected, const std::string &hint) const
  {
    const std::string where =
        binary
            ? "byte " + std::to_string(at_)
            : "line " + std::to_string(
                            1 + std::count(bytes_.begin(),
                                           bytes_.begin() + static_cast<std::ptrdiff_t>(at_ > 0 && bytes_[at_ - 1] == '\n' ? at_ - 1 : at_),
                                           '\n'));
    throw InputError(InputProblem{file_.string() + ", " + where, what, expected, hint});
  }
} // namespace myolines
