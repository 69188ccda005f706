// SPDX-License-Identifier: LGPL-2.1-or-later
#include "vtu_arrays.h"

#include <zlib.h>

#include <limits>

namespace myolines
{
  namespace
  {
    /// Bytes as they are, or in base 64, one after the other.
    class ByteSource
    {
    public:
      ByteSource(const std::string_view text, const bool base64, const Cursor &cursor)
        : text_(text)
        , base64_(base64)
        , cursor_(cursor)
      {}

      /// An upper bound of what is left.
      std::size_t left() const { return text_.size() - at_ + ready_.size(); }

      std::string take(const std::size_t n, const std::string &what)
      {
        if (n > left())
          refuse_end(what);
        if (!base64_)
          {
            at_ += n;
            return std::string(text_.substr(at_ - n, n));
          }
        while (ready_.size() < n)
          decode_group(what);
        const std::string taken = ready_.substr(0, n);
        ready_.erase(0, n);
        return taken;
      }

    private:
      [[noreturn]] void refuse_end(const std::string &what) const
      {
        cursor_.refuse("the data of an array end within " + what, "the whole array");
      }

      static int value_of(const char c)
      {
        if (c >= 'A' && c <= 'Z')
          return c - 'A';
        if (c >= 'a' && c <= 'z')
          return c - 'a' + 26;
        if (c >= '0' && c <= '9')
          return c - '0' + 52;
        return c == '+' ? 62 : c == '/' ? 63 : -1;
      }

      /// A run of groups, as many as are at hand up to some thousand, so that little is moved.
      void decode_group(const std::string &what)
      {
        std::string fresh;
        while (fresh.size() < 3000)
          {
            unsigned int bits = 0, letters = 0, padding = 0;
            while (letters + padding < 4 && at_ < text_.size())
              {
                const char c = text_[at_++];
                if (c == '=')
                  ++padding;
                else if (const int value = value_of(c); value >= 0)
                  {
                    bits = bits << 6 | static_cast<unsigned int>(value);
                    ++letters;
                  }
                else if (c != ' ' && c != '\n' && c != '\r' && c != '\t')
                  cursor_.refuse("the data of an array have a byte that is no letter of base 64", "letters of base 64");
              }
            if (letters < 2)
              break;
            bits <<= 6 * (4 - letters);
            for (unsigned int i = 0; i + 1 < letters; ++i)
              fresh += static_cast<char>(bits >> (16 - 8 * i) & 0xFF);
            if (padding > 0)
              break; // behind the heads of compressed blocks a new run of letters may begin
          }
        if (fresh.empty())
          refuse_end(what);
        ready_ += fresh;
      }

      std::string_view text_;
      bool             base64_;
      const Cursor    &cursor_;
      std::size_t      at_ = 0;
      std::string      ready_;
    };

    template <typename T>
    void append_numbers(const std::string &bytes, const bool swapped, std::vector<double> &values)
    {
      values.reserve(values.size() + bytes.size() / sizeof(T));
      for (std::size_t at = 0; at + sizeof(T) <= bytes.size(); at += sizeof(T))
        {
          char one[sizeof(T)];
          std::memcpy(one, bytes.data() + at, sizeof(T));
          if (swapped)
            std::reverse(one, one + sizeof(T));
          T value;
          std::memcpy(&value, one, sizeof(T));
          values.push_back(static_cast<double>(value));
        }
    }

    std::vector<double> numbers_of(const std::string &type, const std::string &bytes, const bool swapped, const Cursor &cursor)
    {
      std::vector<double> values;
      if (type == "Float64")
        append_numbers<double>(bytes, swapped, values);
      else if (type == "Float32")
        append_numbers<float>(bytes, swapped, values);
      else if (type == "Int64")
        append_numbers<std::int64_t>(bytes, swapped, values);
      else if (type == "Int32")
        append_numbers<std::int32_t>(bytes, swapped, values);
      else if (type == "Int16")
        append_numbers<std::int16_t>(bytes, swapped, values);
      else if (type == "Int8")
        append_numbers<std::int8_t>(bytes, swapped, values);
      else if (type == "UInt64")
        append_numbers<std::uint64_t>(bytes, swapped, values);
      else if (type == "UInt32")
        append_numbers<std::uint32_t>(bytes, swapped, values);
      else if (type == "UInt16")
        append_numbers<std::uint16_t>(bytes, swapped, values);
      else if (type == "UInt8" || type == "String")
        append_numbers<std::uint8_t>(bytes, swapped, values);
      else
        cursor.refuse("numbers of type \"" + type.substr(0, 40) + "\" are not known", "Float64, Float32, Int64 and the like");
      return values;
    }

    /// A number of bytes or blocks before the data.
    std::uint64_t head(ByteSource &source, const VtuEncoding &encoding)
    {
      const std::string bytes = source.take(encoding.long_heads ? 8 : 4, "its head");
      std::uint64_t     value = 0;
      for (std::size_t i = 0; i < bytes.size(); ++i)
        value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[encoding.swapped ? bytes.size() - 1 - i : i])) << 8 * i;
      return value;
    }

    std::string inflated(const std::string &compressed, const std::uint64_t size, const Cursor &cursor)
    {
      constexpr std::uint64_t best = 1100; // nothing is compressed better
      if (size > best * (compressed.size() + 1))
        cursor.refuse("a block of " + std::to_string(compressed.size()) + " bytes is said to hold " + std::to_string(size),
                      "what zlib may compress");
      std::string bytes(size, '\0');
      uLongf      length = size;
      if (uncompress(reinterpret_cast<Bytef *>(bytes.data()), &length, reinterpret_cast<const Bytef *>(compressed.data()),
                     compressed.size()) != Z_OK ||
          length != size)
        cursor.refuse("a compressed block cannot be decompressed", "data compressed by zlib", "the file is damaged");
      return bytes;
    }

    /// Compressed data: number of blocks, their size, that of the last one (0: it is full), and the size of each compressed.
    std::string decoded(ByteSource &source, const VtuEncoding &encoding, const Cursor &cursor)
    {
      if (!encoding.compressed)
        return source.take(head(source, encoding), "its numbers");
      const std::uint64_t blocks = head(source, encoding), size = head(source, encoding), last = head(source, encoding);
      if (blocks > source.left() / 4)
        cursor.refuse(std::to_string(blocks) + " compressed blocks are announced", "no more than the file can hold");
      std::vector<std::uint64_t> sizes(blocks);
      for (std::uint64_t &one : sizes)
        one = head(source, encoding);
      std::string bytes;
      for (std::uint64_t i = 0; i < blocks; ++i)
        bytes += inflated(source.take(sizes[i], "a compressed block"), i + 1 == blocks && last != 0 ? last : size, cursor);
      return bytes;
    }

    std::vector<double> ascii_numbers(const std::string_view text, const Cursor &cursor)
    {
      std::vector<double> values;
      for (std::size_t at = text.find_first_not_of(" \t\r\n"); at != std::string_view::npos;)
        {
          const std::size_t      end   = std::min(text.find_first_of(" \t\r\n", at), text.size());
          const std::string_view word  = text.substr(at, end - at);
          const double           value = number_of(word);
          if (value != value && word != "nan" && word != "-nan" && word != "NaN")
            cursor.refuse("\"" + std::string(word.substr(0, 40)) + "\" in an array is no number", "numbers");
          values.push_back(value);
          at = text.find_first_not_of(" \t\r\n", end);
        }
      return values;
    }
  } // namespace

  std::string XmlTag::attribute(const std::string &name) const
  {
    const auto found = attributes.find(name);
    return found == attributes.end() ? "" : found->second;
  }

  bool next_tag(Cursor &cursor, XmlTag &tag)
  {
    const std::string_view text = cursor.bytes();
    std::size_t            at   = text.find('<', cursor.at());
    while (at != std::string_view::npos && at + 1 < text.size() && (text[at + 1] == '?' || text[at + 1] == '!'))
      {
        const bool comment = text.substr(at, 4) == "<!--";
        at                 = text.find(comment ? "-->" : ">", at);
        at                 = at == std::string_view::npos ? at : text.find('<', at);
      }
    if (at == std::string_view::npos)
      return false;
    cursor.go_to(at);
    const std::size_t end = text.find('>', at);
    if (end == std::string_view::npos)
      cursor.refuse("a tag has no end: the file is cut off", "\">\"");
    const std::string_view inside = text.substr(at + 1, end - at - 1);
    tag                           = {};
    tag.closed                    = !inside.empty() && inside.back() == '/';
    std::size_t place             = std::min(inside.find_first_of(" \t\r\n/", 1), inside.size());
    tag.name                      = std::string(inside.substr(0, place));
    while (true)
      {
        place                    = inside.find_first_not_of(" \t\r\n/", place);
        const std::size_t equals = inside.find('=', std::min(place, inside.size()));
        if (place == std::string_view::npos || equals == std::string_view::npos)
          break;
        const std::size_t open = inside.find_first_of("\"'", equals);
        if (open == std::string_view::npos)
          cursor.refuse("an attribute of <" + tag.name.substr(0, 40) + "> has no quotation marks", "name=\"value\"");
        const std::size_t close = inside.find(inside[open], open + 1);
        if (close == std::string_view::npos)
          cursor.refuse("an attribute of <" + tag.name.substr(0, 40) + "> has no end", "name=\"value\"");
        std::string name(inside.substr(place, equals - place));
        name.erase(name.find_last_not_of(" \t\r\n") + 1);
        tag.attributes[name] = std::string(inside.substr(open + 1, close - open - 1));
        place                = close + 1;
      }
    cursor.go_to(end + 1);
    return true;
  }

  std::vector<double> read_vtu_array(const XmlTag &array, Cursor &cursor, const VtuEncoding &encoding)
  {
    const std::string format = array.attribute("format"), type = array.attribute("type");
    if (format == "appended")
      {
        const double offset = number_of(array.attribute("offset"));
        if (!(offset >= 0 && offset < static_cast<double>(encoding.appended.size())))
          cursor.refuse("the array \"" + array.attribute("Name") + "\" is not in the appended data", "an offset within them",
                        encoding.appended.empty() ? "the file has no appended data: it is cut off" : "");
        ByteSource source(encoding.appended.substr(static_cast<std::size_t>(offset)), encoding.base64, cursor);
        return numbers_of(type, decoded(source, encoding, cursor), encoding.swapped, cursor);
      }
    const std::size_t end = cursor.bytes().find('<', cursor.at());
    if (end == std::string_view::npos)
      cursor.refuse("the array \"" + array.attribute("Name") + "\" has no end: the file is cut off", "</DataArray>");
    const std::string_view text = cursor.bytes().substr(cursor.at(), end - cursor.at());
    if (format == "ascii")
      {
        const std::vector<double> values = ascii_numbers(text, cursor);
        cursor.go_to(end);
        return values;
      }
    if (format != "binary")
      cursor.refuse("the format \"" + format + "\" of an array is not known", "ascii, binary or appended");
    ByteSource          source(text, true, cursor);
    std::vector<double> values;
    if (text.find_first_not_of(" \t\r\n") != std::string_view::npos) // an empty array may have no head
      values = numbers_of(type, decoded(source, encoding, cursor), encoding.swapped, cursor);
    cursor.go_to(end);
    return values;
  }
} // namespace myolines
