// SPDX-License-Identifier: LGPL-2.1-or-later
#include "font.h"

#include <algorithm>
#include <cstdint>
#include <string_view>

namespace myolines::picture
{
  namespace
  {
    // Lines of the letters from U+0021 to U+007E, then of the others below: pairs of digits x, y, in which the base line has y = 2, small
    // letters reach 6 and capitals 8; a blank lifts the pen, a line ends a letter.
    constexpr std::string_view letters = "2824 2222\n"
                                         "1816 3836\n"
                                         "1218 3238 0444 0646\n"
                                         "473818070615354443321203 2921\n"
                                         "0248 0818170708 3343423233\n"
                                         "420607182837360403122244\n"
                                         "2826\n"
                                         "39272331\n"
                                         "19272311\n"
                                         "2723 0644 0446\n"
                                         "2723 0545\n"
                                         "222110\n"
                                         "1535\n"
                                         "2222\n"
                                         "0248\n"
                                         "120307183847433212\n"
                                         "172822 1232\n"
                                         "07183847460242\n"
                                         "07183847463525 354443321203\n"
                                         "32380444\n"
                                         "480805354443321203\n"
                                         "473818070312324344351504\n"
                                         "084812\n"
                                         "15060718384746351504031232434435\n"
                                         "031232434738180706153546\n"
                                         "2222 2525\n"
                                         "222110 2525\n"
                                         "470543\n"
                                         "0444 0646\n"
                                         "074503\n"
                                         "07183847462524 2222\n"
                                         "433212030718384744242646\n"
                                         "022842 1535\n"
                                         "02083847463505 3544433202\n"
                                         "4738180703123243\n"
                                         "02082846442202\n"
                                         "48080242 0535\n"
                                         "480802 0535\n"
                                         "47381807031232434525\n"
                                         "0208 4248 0545\n"
                                         "2228 1232 1838\n"
                                         "4843321203\n"
                                         "0208 480542\n"
                                         "080242\n"
                                         "0208254842\n"
                                         "02084248\n"
                                         "120307183847433212\n"
                                         "02083847463505\n"
                                         "120307183847433212 2442\n"
                                         "02083847463505 2542\n"
                                         "473818070615354443321203\n"
                                         "0848 2822\n"
                                         "080312324348\n"
                                         "082248\n"
                                         "0812263248\n"
                                         "0248 0842\n"
                                         "082548 2522\n"
                                         "08480242\n"
                                         "39292131\n"
                                         "0842\n"
                                         "19292111\n"
                                         "062846\n"
                                         "0141\n"
                                         "1827\n"
                                         "16364542 441403123243\n"
                                         "0208 0516364543321203\n"
                                         "4536160503123243\n"
                                         "4248 4536160503123243\n"
                                         "04444536160503123243\n"
                                         "38281712 0636\n"
                                         "4641301001 4536160503123243\n"
                                         "0208 0516364542\n"
                                         "2622 2828\n"
                                         "262110 2828\n"
                                         "0208 460442\n"
                                         "2822\n"
                                         "0206 05162522 25364542\n"
                                         "0206 0516364542\n"
                                         "160503123243453616\n"
                                         "0006 0516364543321203\n"
                                         "4046 4536160503123243\n"
                                         "0206 05163645\n"
                                         "45361605143443321203\n"
                                         "18132232 0636\n"
                                         "0603123243 4642\n"
                                         "062246\n"
                                         "0612253246\n"
                                         "0246 0642\n"
                                         "0622 4610\n"
                                         "06460242\n"
                                         "39292615242131\n"
                                         "2921\n"
                                         "19292635242111\n"
                                         "05163445\n"
                                         "1838361618\n"           // degree
                                         "0006 0603123243 4642\n" // micro
                                         "1838371535\n"           // superscript 2
                                         "18383515 2636\n"        // superscript 3
                                         "2525\n"                 // middle dot
                                         "0545\n"                 // minus
                                         "0347 0743\n"            // times
                                         "0242480802\n";          // any other
    constexpr std::uint32_t others[] = {0xB0, 0xB5, 0xB2, 0xB3, 0xB7, 0x2212, 0xD7};

    /// The next character from @p at on, which goes behind it.
    std::uint32_t next_character(const std::string &text, std::size_t &at)
    {
      const auto    first = static_cast<unsigned char>(text[at++]);
      const int     more  = first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : first >= 0xC0 ? 1 : 0;
      std::uint32_t code  = more == 0 ? first : first & (0x3F >> more);
      for (int i = 0; i < more && at < text.size(); ++i)
        code = code << 6 | (static_cast<unsigned char>(text[at++]) & 0x3F);
      return code;
    }

    /// Which line of `letters`.
    std::size_t line_of(const std::uint32_t character)
    {
      if (character > 0x20 && character < 0x7F)
        return character - 0x21;
      return 0x7F - 0x21 + static_cast<std::size_t>(std::find(std::begin(others), std::end(others), character) - std::begin(others));
    }

    std::string_view strokes_of(const std::uint32_t character)
    {
      std::size_t begin = 0;
      for (std::size_t line = line_of(character); line > 0; --line)
        begin = letters.find('\n', begin) + 1;
      return letters.substr(begin, letters.find('\n', begin) - begin);
    }
  } // namespace

  WrittenText written(const std::string &utf8)
  {
    constexpr double gap = 1.7, blank = 2.6;
    WrittenText      text;
    for (std::size_t at = 0; at < utf8.size();)
      {
        const std::uint32_t character = next_character(utf8, at);
        if (character <= 0x20)
          {
            text.width += blank;
            continue;
          }
        const std::string_view strokes = strokes_of(character);
        double                 left = 4, right = 0;
        for (std::size_t i = 0; i < strokes.size(); strokes[i] == ' ' ? ++i : i += 2)
          if (strokes[i] != ' ')
            {
              left  = std::min<double>(left, strokes[i] - '0');
              right = std::max<double>(right, strokes[i] - '0');
            }
        const auto x = [&](const std::size_t i) { return text.width + strokes[i] - '0' - left; };
        const auto y = [&](const std::size_t i) { return strokes[i + 1] - '0' - 2.; };
        for (std::size_t i = 0; i < strokes.size(); i += 2)
          {
            const bool last = i + 2 >= strokes.size() || strokes[i + 2] == ' ', first = i == 0 || strokes[i - 1] == ' ';
            if (!last)
              text.lines.push_back({{x(i), y(i), x(i + 2), y(i + 2)}});
            else if (first) // a point
              text.lines.push_back({{x(i), y(i), x(i), y(i)}});
            if (last)
              ++i;
          }
        text.width += right - left + gap;
      }
    text.width = std::max(0., text.width - gap);
    return text;
  }
} // namespace myolines::picture
