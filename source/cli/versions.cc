// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/lanes.h>
#include <myolines/cli/versions.h>
#include <myolines/integrators/sundials_tools.h>
#include <myolines/output/version.h>
#include <myolines/study/database.h>

namespace myolines
{
  namespace
  {
#ifdef __clang__
    constexpr const char *compiler = __VERSION__; // begins with its name
#else
    constexpr const char *compiler = "GCC " __VERSION__;
#endif
  } // namespace

  std::string versions_text()
  {
    std::string    text = std::string("myolines ") + version + "\n";
    Versions       all{{"sources", *git_hash == '\0' ? "no git hash" : git_hash},
                 {"build", build_type()},
                 {"compiler", compiler},
                 {"cell kernels", name(widest_instruction_set())}};
    const Versions libraries = library_versions();
    all.insert(all.end(), libraries.begin(), libraries.end());
    all.push_back({"SUNDIALS", sundials_version()});
    all.push_back({"SQLite", study::sqlite_version()});
    for (const auto &[name, version] : all)
      text += "  " + name + std::string(14 - name.size(), ' ') + version + "\n";
    text.pop_back();
    return text;
  }
} // namespace myolines
