// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/names.h>

#include <algorithm>
#include <numeric>

namespace myolines
{
  namespace
  {
    /// Levenshtein distance.
    std::size_t edit_distance(const std::string &a, const std::string &b)
    {
      std::vector<std::size_t> row(b.size() + 1);
      std::iota(row.begin(), row.end(), std::size_t(0));
      for (std::size_t i = 1; i <= a.size(); ++i)
        {
          std::size_t diagonal = row[0];
          row[0]               = i;
          for (std::size_t j = 1; j <= b.size(); ++j)
            {
              const std::size_t substitution = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
              diagonal                       = row[j];
              row[j]                         = std::min({row[j] + 1, row[j - 1] + 1, substitution});
            }
        }
      return row[b.size()];
    }
  } // namespace

  std::string nearest_name(const std::string &name, const std::vector<std::string> &candidates)
  {
    std::string best;
    std::size_t best_distance = name.size() / 2 + 1;
    for (const std::string &candidate : candidates)
      {
        const std::size_t distance = edit_distance(name, candidate);
        if (distance < best_distance)
          {
            best          = candidate;
            best_distance = distance;
          }
      }
    return best;
  }

  std::string nearest_hint(const std::string &name, const std::vector<std::string> &candidates, const std::string &label)
  {
    const std::string nearest = nearest_name(name, candidates);
    return nearest.empty() ? "" : label + ": \"" + nearest + "\"";
  }

  std::string join(const std::vector<std::string> &words, const std::string &separator)
  {
    std::string text;
    for (const std::string &word : words)
      text += (text.empty() ? "" : separator) + word;
    return text;
  }

  std::string shell_text(const std::vector<std::string> &words)
  {
    // What no shell gives a meaning; everything else is quoted.
    constexpr const char *harmless = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./=:@%+,-";
    std::string           text;
    for (const std::string &word : words)
      {
        const bool  plain = !word.empty() && word.find_first_not_of(harmless) == std::string::npos;
        std::string quoted;
        for (const char c : word)
          quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
        text += (text.empty() ? "" : " ") + (plain ? word : "'" + quoted + "'");
      }
    return text;
  }
} // namespace myolines
