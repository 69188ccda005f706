// SPDX-License-Identifier: LGPL-2.1-or-later
#include "flexodeal_translation.h"

namespace myolines
{
  FlexodealTranslation::FlexodealTranslation(const FlexodealOptions &options, std::ostream &out)
    : options(options)
    , out(out)
    , theirs(options.parameters)
  {}

  void FlexodealTranslation::set(const std::string &path, const std::string &text, const std::string &origin)
  {
    settings_.push_back({path, text});
    if (!origin.empty())
      origins_.push_back({path, "", origin});
  }

  void FlexodealTranslation::set_origin(const std::string &path, const std::string &word, const std::string &origin)
  {
    origins_.insert(origins_.begin(), {path, word.empty() ? "" : "\"" + word + "\"", origin});
  }

  void FlexodealTranslation::take(const std::string &section, const std::string &name, const std::string &path)
  {
    const PrmEntry &entry = theirs.needed(section, name);
    set(path, entry.text, theirs.where(entry));
  }

  std::string FlexodealTranslation::from_scene(const std::filesystem::path &file) const
  {
    return std::filesystem::proximate(file, options.scene.parent_path()).string();
  }

  /// That of the parameter, or of the innermost list around it that has one.
  std::string FlexodealTranslation::origin_of(std::string path, const std::string &what) const
  {
    for (;;)
      {
        for (const Origin &origin : origins_)
          if (origin.path == path && what.find(origin.word) != std::string::npos)
            return origin.where;
        const std::size_t slash = path.rfind('/');
        if (slash == std::string::npos)
          return "";
        path.erase(slash);
      }
  }

  InputError FlexodealTranslation::at_origins(const InputError &error, const std::string &name) const
  {
    std::vector<InputProblem> problems = error.problems();
    for (InputProblem &problem : problems)
      {
        const bool        in_scene = problem.where.rfind(name + ": ", 0) == 0;
        const std::string path     = in_scene ? problem.where.substr(name.size() + 2) : problem.where;
        if (const std::string origin = origin_of(path, problem.what); !origin.empty())
          problem.where = origin;
        else if (in_scene)
          problem.where = options.parameters.string() + ": " + path + " of the scene";
      }
    return InputError(problems);
  }
} // namespace myolines
