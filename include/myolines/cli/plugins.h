// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/boundary/boundary.h>
#include <myolines/cli/catalogue.h>
#include <myolines/materials/laws.h>
#include <myolines/observers/muscle3d_series.h>
#include <myolines/system/profiles.h>
#include <myolines/time/integrator.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace myolines
{
  /// What a plug-in brings: it is handed to the function `myolines_plugin_entries` of its shared object, which
  /// `myolines_add_plugin` of the CMake package writes. A kind of things with a Registry has a function add() here.
  class PluginEntries
  {
  public:
    ///@{
    /// Notes a thing that the plug-in brings.
    void add(IntegratorEntry entry) { put(integrator_registry(), std::move(entry)); }
    void add(SystemEntry entry) { put(system_catalogue(), std::move(entry)); }
    void add(LawKind kind) { put(law_kinds(), std::move(kind)); }
    void add(BoundaryEntry entry) { put(boundary_registry(), std::move(entry)); }
    void add(SeriesEntry entry) { put(series_registry(), std::move(entry)); }
    void add(ProfileEntry entry) { put(profile_registry(), std::move(entry)); }
    ///@}

    const std::vector<std::string> &words() const { return words_; } ///< "integrator houbolt"
    const std::vector<std::string> &taken() const { return taken_; } ///< those of them that are there already, or twice

    /// Adds all of them to their registries.
    void enter() const;

  private:
    template <typename Entry>
    void put(Registry<Entry> &registry, Entry entry)
    {
      note(registry.kind() + " " + name_of(entry), registry.find(name_of(entry)) != nullptr);
      enter_.push_back([&registry, entry] { registry.add(entry); });
    }

    void note(const std::string &words, bool taken);

    std::vector<std::string>           words_, taken_;
    std::vector<std::function<void()>> enter_;
  };

  /// A plug-in that has been loaded. It stays until the end of the process.
  struct Plugin
  {
    std::string              name;     ///< that of its file without ".so": small letters, digits, hyphens
    std::filesystem::path    file;     ///< from which it was loaded
    std::string              checksum; ///< of the file, CRC-32
    std::vector<std::string> brings;   ///< "integrator houbolt"
  };

  /// In the order in which they were loaded.
  const std::vector<Plugin> &plugins();

  /// The name of the plug-in that brings @p words ("integrator houbolt"); "" if it is built in.
  std::string plugin_of(const std::string &words);

  /// Loads a plug-in, once. Before any code of it runs, what it was built with is read from the file and compared with build_facts.
  /// @throws InputError at @p where and @p file if the file is none or not whole, if a fact differs, if another file of this name was
  /// loaded, if one of its things is there already. @throws SystemError if it cannot be read.
  void load_plugin(const std::filesystem::path &file, const std::string &where = "plug-in");

  /// Loads those of @p names, words between blanks, from the folders of plugin_folders(). @throws InputError at @p where, for a name that
  /// is a path or that no folder has as well.
  void load_plugins(const std::string &names, const std::string &where);

  /// Loads those that the scene of a run names, if the output folder @p run has its scene. @throws InputError likewise.
  void load_plugins_of_run(const std::filesystem::path &run);

  /// Loads everything that the folders have, for lists. What was refused: name, or file, and why.
  std::vector<std::pair<std::string, std::string>> load_all_plugins();

  /// Where plug-ins are looked for by name: the folders of the variable MYOLINES_PLUGIN_PATH, with colons between, then that of the
  /// installation, which is found from where the program is, or the library, or the Python package.
  std::vector<std::filesystem::path> plugin_folders();
} // namespace myolines
