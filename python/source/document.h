// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/document.h>
#include <myolines/scene/scene.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace myolines
{
  namespace [[gnu::visibility("hidden")]] python
  {
    /// A scene as it is written, with changes; validated when somebody asks for what it means.
    class Document
    {
    public:
      /// @p name stands for the file in messages, relative paths start from @p folder. @throws InputError for what is no scene.
      Document(const std::string &xml, std::string name, std::filesystem::path folder);

      const std::string    &name() const { return name_; }
      const scene::RawList &root() const { return root_; }

      /// @throws InputError with everything that is wrong.
      const scene::Node &node() const;

      /// A copy, for what runs without the lock of Python: another thread may change the scene meanwhile.
      scene::Node copied_node() const { return node(); }

      /// Sets texts by their paths. @throws InputError, and changes nothing, for what is wrong with one of them; what is missing elsewhere
      /// is told by node().
      void set(const std::vector<std::pair<std::string, std::string>> &settings);

      void add_list(const std::string &path)
      {
        scene::add_list(root_, path);
        node_.reset();
      }

      /// @throws InputError if the scene does not write it.
      void remove(const std::string &path);

    private:
      scene::RawList                     root_;
      std::string                        name_;
      std::filesystem::path              folder_;
      mutable std::optional<scene::Node> node_; ///< of the present values, made when asked for
    };
  } // namespace python
} // namespace myolines
