// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/scene.h>

#include <sstream>
#include <string>

namespace myolines::scene
{
  /// Writes nodes as XML.
  class SceneWriter
  {
  public:
    /// Which parameters are written.
    enum class Values
    {
      all,    ///< defaults included
      written ///< only what the scene wrote
    };

    /// @p values: which parameters.
    explicit SceneWriter(Values values)
      : values_(values)
    {}

    /// The document of a root node, named @p name. With a @p schema, every value is preceded by a comment from its declaration.
    std::string document(const Node &root, const Schema *schema = nullptr, const std::string &name = "scene");

  private:
    void list(const Node &node, const Schema *schema, int depth);
    void contents(const Node &node, const Schema *schema, int depth);
    void plain_contents(const Node &node, int depth);
    void commented_contents(const Node &node, const Schema &schema, int depth);
    void parameter(const std::string &name, const Node::Value &value, int depth);
    void comment(const std::string &text, int depth);
    bool wanted(const Node &node) const;
    void line(const std::string &text, int depth);

    Values             values_;
    std::ostringstream out_;
  };
} // namespace myolines::scene
