// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "flexodeal_parameters.h"

#include <myolines/cli/flexodeal.h>
#include <myolines/scene/scene.h>

#include <ostream>
#include <string>
#include <vector>

namespace myolines
{
  /// A scene that grows out of Flexodeal's files, and where its parameters are from.
  class FlexodealTranslation
  {
  public:
    FlexodealTranslation(const FlexodealOptions &options, std::ostream &out);

    void set(const std::string &path, const std::string &text, const std::string &origin = "");

    /// Problems of the parameter or list at @p path that name @p word in quotes, or of all of it, are those of @p origin.
    void set_origin(const std::string &path, const std::string &word, const std::string &origin);

    /// The text of an entry that must be there becomes that of the parameter at @p path.
    void take(const std::string &section, const std::string &name, const std::string &path);

    /// @p file as the scene has to name it.
    std::string from_scene(const std::filesystem::path &file) const;

    const std::vector<scene::Setting> &settings() const { return settings_; }

    /// Problems of the scene @p name as problems of the files that it is made of.
    InputError at_origins(const InputError &error, const std::string &name) const;

    const FlexodealOptions &options;
    std::ostream           &out; ///< for what a person should know
    FlexodealParameters     theirs;

  private:
    std::string origin_of(std::string path, const std::string &what) const;

    struct Origin
    {
      std::string path, word, where;
    };

    std::vector<scene::Setting> settings_;
    std::vector<Origin>         origins_; ///< of parameters; those of words in them come first
  };
} // namespace myolines
