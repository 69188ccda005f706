// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/checksum.h>
#include <myolines/base/error.h>
#include <myolines/base/files.h>
#include <myolines/base/names.h>
#include <myolines/cli/plugins.h>
#include <myolines/output/version.h>
#include <myolines/scene/numbers.h>
#include <myolines/scene/scene.h>

#include <dlfcn.h>
#include <elf.h>
#include <link.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <sstream>

namespace myolines
{
  namespace
  {
    std::vector<Plugin> &loaded()
    {
      static std::vector<Plugin> all;
      return all;
    }

    const Plugin *find_loaded(const std::string &name)
    {
      const auto found = std::find_if(loaded().begin(), loaded().end(), [&](const Plugin &plugin) { return plugin.name == name; });
      return found != loaded().end() ? &*found : nullptr;
    }

    /// Nothing of a path.
    bool is_name(const std::string &text)
    {
      return !text.empty() && text.front() != '-' && text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == std::string::npos;
    }

    constexpr const char *what_a_name_is = "small letters, digits and hyphens";

    /// The facts that the shared object @p content was built with, as its line of CMake put them there; "" if it has none.
    std::string facts_in(const std::string &content)
    {
      const std::string begin = std::string("\1") + "myolines plug-in\n"; // in two parts, so that this program is none
      const std::size_t found = content.find(begin);
      if (found == std::string::npos)
        return "";
      const std::size_t from = found + begin.size();
      return content.substr(from, content.find('\0', from) - from);
    }

    /// '"instructions: avx2", this program with "..."' for the first fact that differs; "" if none does.
    std::string first_other_fact(const std::vector<std::string> &there, const std::vector<std::string> &here)
    {
      for (std::size_t i = 0; i < here.size(); ++i)
        if (i >= there.size() || there[i] != here[i])
          return "\"" + (i < there.size() ? there[i] : "") + "\", this program with \"" + here[i] + "\"";
      return "";
    }

    void require_same_build(const std::string &content, const std::string &name, const std::string &where)
    {
      const std::string facts = facts_in(content);
      if (facts.empty())
        throw InputError(InputProblem{where, "this is no plug-in of Myolines", "a shared object made by myolines_add_plugin",
                                      "doc/plugins.md tells how to make one"});
      if (const std::string other = first_other_fact(scene::lines_of(facts), scene::lines_of(build_facts)); !other.empty())
        throw InputError(InputProblem{where, "the plug-in \"" + name + "\" was built with " + other,
                                      "one that was built as this program was",
                                      "build it anew against this installation, without compiler options of its own"});
    }

    /// A file that was cut short: the loader would map pages that are not there, and the first look at them kills the process.
    void require_whole_file(const std::string &content, const std::string &name, const std::string &where)
    {
      ElfW(Ehdr) header{};
      std::memcpy(&header, content.data(), std::min(sizeof header, content.size()));
      const auto there = [&](const std::size_t from, const std::size_t size) {
        return from <= content.size() && size <= content.size() - from;
      };
      bool whole = std::memcmp(header.e_ident, ELFMAG, SELFMAG) == 0 && there(header.e_phoff, header.e_phnum * sizeof(ElfW(Phdr))) &&
                   there(header.e_shoff, header.e_shnum * sizeof(ElfW(Shdr))); // which is the end of the file
      for (std::size_t i = 0; whole && i < header.e_phnum; ++i)
        {
          ElfW(Phdr) segment;
          std::memcpy(&segment, content.data() + header.e_phoff + i * sizeof segment, sizeof segment);
          whole = segment.p_type != PT_LOAD || there(segment.p_offset, segment.p_filesz);
        }
      if (!whole)
        throw InputError(InputProblem{where, "the file of the plug-in \"" + name + "\" is not whole",
                                      "a shared object made by myolines_add_plugin", "copy or build it again"});
    }

    using EntriesOf = void (*)(PluginEntries &);

    EntriesOf open_plugin(const std::filesystem::path &file, const std::string &name, const std::string &where)
    {
      void *const handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
      void *const symbol = handle != nullptr ? dlsym(handle, "myolines_plugin_entries") : nullptr;
      if (symbol == nullptr)
        throw InputError(InputProblem{where, "the plug-in \"" + name + "\" cannot be loaded: " + dlerror(),
                                      "a shared object made by myolines_add_plugin",
                                      "libraries that it needs must be found by the loader"});
      return reinterpret_cast<EntriesOf>(symbol);
    }

    std::string content_of(const std::filesystem::path &file, const std::string &where)
    {
      if (!std::filesystem::is_regular_file(file))
        throw InputError(InputProblem{where, "there is no file " + file.string(), "a plug-in, NAME.so", ""});
      return read_file(file);
    }

    /// What the plug-in brings, as it says itself.
    PluginEntries entries_of(const std::filesystem::path &file, const std::string &name, const std::string &where)
    {
      const EntriesOf tell = open_plugin(file, name, where);
      PluginEntries   entries;
      try
        {
          tell(entries);
        }
      catch (const std::exception &error)
        {
          throw InputError(InputProblem{where, "the plug-in \"" + name + "\" fails when it is asked what it brings: " + error.what(),
                                        "entries that can be made without a scene", "mend the functions that make its entries"});
        }
      return entries;
    }

    /// Shared objects in @p folder, if there is one.
    std::vector<std::filesystem::path> plugins_in(const std::filesystem::path &folder)
    {
      std::vector<std::filesystem::path> files;
      std::error_code                    none;
      for (const auto &entry : std::filesystem::directory_iterator(folder, none))
        if (entry.path().extension() == ".so")
          files.push_back(entry.path());
      std::sort(files.begin(), files.end());
      return files;
    }

    /// Without those of a name that an earlier folder has.
    std::vector<std::filesystem::path> all_there_are()
    {
      std::vector<std::filesystem::path> all;
      for (const std::filesystem::path &folder : plugin_folders())
        for (const std::filesystem::path &file : plugins_in(folder))
          if (std::none_of(all.begin(), all.end(), [&](const std::filesystem::path &other) { return other.stem() == file.stem(); }))
            all.push_back(file);
      return all;
    }
    /// That of the installation: beside the program, or where this code is part of the library or of the Python package, in a folder above.
    std::filesystem::path installed_folder()
    {
      Dl_info         where{};
      const link_map *object = nullptr;
      std::error_code none;
      if (dladdr1(reinterpret_cast<const void *>(&plugin_folders), &where, reinterpret_cast<void **>(const_cast<link_map **>(&object)),
                  RTLD_DL_LINKMAP) == 0 ||
          object->l_name[0] == '\0') // the program itself
        return (std::filesystem::read_symlink("/proc/self/exe", none).parent_path() / MYOLINES_PLUGIN_FOLDER).lexically_normal();
      const std::filesystem::path folder = std::filesystem::absolute(object->l_name).parent_path(), plugins = "myolines/plugins";
      for (std::filesystem::path above = folder; above.has_relative_path(); above = above.parent_path())
        if (std::filesystem::is_directory(above / plugins, none))
          return above / plugins;
      return folder / plugins;
    }
  } // namespace

  void PluginEntries::note(const std::string &words, const bool taken)
  {
    if (taken || std::count(words_.begin(), words_.end(), words) > 0)
      taken_.push_back(words);
    words_.push_back(words);
  }

  void PluginEntries::enter() const
  {
    for (const auto &enter : enter_)
      enter();
  }

  const std::vector<Plugin> &plugins() { return loaded(); }

  std::string plugin_of(const std::string &words)
  {
    for (const Plugin &plugin : loaded())
      if (std::count(plugin.brings.begin(), plugin.brings.end(), words) > 0)
        return plugin.name;
    return "";
  }

  void load_plugin(const std::filesystem::path &file, const std::string &where)
  {
    const std::string name = file.stem().string();
    if (!is_name(name) || file.extension() != ".so")
      throw InputError(InputProblem{where, "\"" + file.filename().string() + "\" is no name of a plug-in",
                                    std::string("NAME.so, NAME of ") + what_a_name_is, ""});
    const std::filesystem::path whole = std::filesystem::absolute(file); // without a slash the loader would look elsewhere
    const Plugin *const         other = find_loaded(name);
    std::error_code             gone;
    if (other != nullptr && std::filesystem::equivalent(whole, other->file, gone))
      return;
    const std::string at = where + ": " + whole.string(), content = content_of(whole, at);
    if (other != nullptr)
      throw InputError(InputProblem{at, "there is a plug-in \"" + name + "\" already, of the file " + other->file.string(),
                                    "one file of each name", "leave one of them out, or give it another name in CMakeLists.txt"});
    require_same_build(content, name, at);
    require_whole_file(content, name, at);
    const PluginEntries entries = entries_of(whole, name, at);
    if (!entries.taken().empty())
      throw InputError(InputProblem{at, "the plug-in \"" + name + "\" brings what there is already: " + join(entries.taken()),
                                    "names of its own", "give it another name in the facts, or the schema, of its source"});
    entries.enter();
    Checksum checksum;
    checksum.add(content);
    loaded().push_back({name, whole, checksum.text(), entries.words()});
  }

  void load_plugins(const std::string &names, const std::string &where)
  {
    std::istringstream words(names);
    for (std::string name; words >> name;)
      {
        if (!is_name(name))
          throw InputError(InputProblem{where, "\"" + name + "\" is no name of a plug-in", what_a_name_is,
                                        "scenes load no files: name one on the command line, --plugin FILE"});
        if (find_loaded(name) != nullptr)
          continue;
        const auto all   = all_there_are();
        const auto found = std::find_if(all.begin(), all.end(), [&](const std::filesystem::path &file) { return file.stem() == name; });
        if (found == all.end())
          {
            std::vector<std::string> folders, known;
            for (const std::filesystem::path &folder : plugin_folders())
              folders.push_back(folder.string());
            for (const std::filesystem::path &file : all)
              known.push_back(file.stem().string());
            const std::string nearest = nearest_hint(name, known);
            throw InputError(InputProblem{where, "there is no plug-in \"" + name + "\"",
                                          "a file " + name + ".so in " + join(folders, " or "),
                                          nearest.empty() ? "set MYOLINES_PLUGIN_PATH, or name the file: --plugin FILE" : nearest});
          }
        load_plugin(*found, where);
      }
  }

  void load_plugins_of_run(const std::filesystem::path &run)
  {
    const std::filesystem::path scene = run / "scene.resolved.xml";
    if (!std::filesystem::exists(scene))
      return;
    if (const auto names = scene::peek_text(scene, "plug-ins"))
      load_plugins(*names, scene.string() + ": plug-ins");
  }

  std::vector<std::pair<std::string, std::string>> load_all_plugins()
  {
    std::vector<std::pair<std::string, std::string>> refused;
    for (const std::filesystem::path &file : all_there_are())
      try
        {
          if (find_loaded(file.stem().string()) == nullptr)
            load_plugin(file);
        }
      catch (const InputError &error)
        {
          refused.emplace_back(file.stem().string(), file.string() + ": " + error.problems().front().what);
        }
      catch (const SystemError &error)
        {
          refused.emplace_back(file.stem().string(), error.what());
        }
    return refused;
  }

  std::vector<std::filesystem::path> plugin_folders()
  {
    std::vector<std::filesystem::path> folders;
    if (const char *path = std::getenv("MYOLINES_PLUGIN_PATH"))
      {
        std::istringstream parts(path);
        for (std::string part; std::getline(parts, part, ':');)
          if (!part.empty())
            folders.emplace_back(part);
      }
    folders.push_back(installed_folder());
    return folders;
  }
} // namespace myolines
