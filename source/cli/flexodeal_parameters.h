// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/error.h>
#include <myolines/cli/prm_file.h>

#include <filesystem>
#include <ostream>
#include <set>
#include <string>
#include <vector>

namespace myolines
{
  /// An entry that a version of Flexodeal or of Flexodeal Lite has, and what becomes of it.
  struct FlexodealEntry
  {
    enum class Fate
    {
      taken,       ///< its text goes into the parameter of the scene whose path is `note`
      read,        ///< it is translated
      passed_over, ///< it changes no number here; `note` says why
      refused      ///< it changes what is computed, in a way that is not known here; `note` says what to do
    };

    const char *section;
    const char *name;
    Fate        fate;
    const char *note = "";
  };

  const std::vector<FlexodealEntry> &flexodeal_entries();

  /// A parameter file of any version. Which entries are needed depends on what the others say, so they are asked for; entries that nobody
  /// has asked for are told in the end.
  class FlexodealParameters
  {
  public:
    /// @throws InputError with every entry that no version has, or that is refused, with file and line.
    explicit FlexodealParameters(const std::filesystem::path &file);

    bool has(const std::string &section, const std::string &name) const { return find(section, name) != nullptr; }

    /// The entry, or nullptr; it counts as asked for. @throws InputError if it is needed and not there.
    const PrmEntry *optional(const std::string &section, const std::string &name);
    const PrmEntry &needed(const std::string &section, const std::string &name);

    double number(const std::string &section, const std::string &name);
    double positive(const std::string &section, const std::string &name);
    int    integer(const std::string &section, const std::string &name, int low, int high);

    /// "parameters.prm, line 9: Length"
    std::string where(const PrmEntry &entry) const;

    [[noreturn]] void refuse(const PrmEntry &entry, const std::string &expected, const std::string &hint = "") const;

    /// A line for every reason why entries have no counterpart.
    void tell_what_is_lost(std::ostream &out) const;

  private:
    const PrmEntry *find(const std::string &section, const std::string &name) const;
    InputProblem    unknown(const PrmEntry &entry) const;

    std::string                file_;
    std::vector<PrmEntry>      entries_;
    std::set<const PrmEntry *> asked_for_;
  };
} // namespace myolines
