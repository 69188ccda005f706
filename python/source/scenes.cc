// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bindings.h"

#include <myolines/base/error.h>
#include <myolines/cli/catalogue.h>
#include <myolines/cli/commands.h>
#include <myolines/cli/experiment.h>
#include <myolines/cli/plan.h>
#include <myolines/scene/columns.h>
#include <myolines/scene/contents.h>
#include <myolines/scene/input_text.h>

#include "document.h"

#include <algorithm>
#include <sstream>

namespace myolines
{
  namespace [[gnu::visibility("hidden")]] python
  {
    Document::Document(const std::string &xml, std::string name, std::filesystem::path folder)
      : name_(std::move(name))
      , folder_(std::move(folder))
    {
      std::vector<InputProblem> problems;
      root_ = scene::parse_document(xml, name_, problems);
      if (!problems.empty())
        throw InputError(problems);
    }

    const scene::Node &Document::node() const
    {
      if (!node_)
        {
          std::vector<InputProblem> problems;
          scene::Node               node = build_whole_scene(root_, name_, folder_, problems);
          if (!problems.empty())
            throw InputError(problems);
          node_ = std::move(node);
        }
      return *node_;
    }

    namespace
    {
      /// The path that @p problem is about, without the file in front and what stands behind; "" for none.
      std::string path_of(const InputProblem &problem, const std::string &file)
      {
        const std::string front = file + ": ", behind = " (override)";
        if (problem.where.rfind(front, 0) != 0)
          return "";
        std::string path = problem.where.substr(front.size());
        if (path.size() > behind.size() && path.compare(path.size() - behind.size(), behind.size(), behind) == 0)
          path.resize(path.size() - behind.size());
        return path;
      }
    } // namespace

    void Document::set(const std::vector<std::pair<std::string, std::string>> &settings)
    {
      scene::RawList            changed = root_;
      std::vector<InputProblem> problems, about;
      for (const auto &[path, text] : settings)
        {
          if (const std::size_t end = path.rfind('/'); end != std::string::npos)
            scene::add_list(changed, path.substr(0, end));
          scene::apply_overrides(changed, {path + "=" + text}, about);
        }
      build_whole_scene(changed, name_, folder_, problems);
      for (const InputProblem &problem : problems)
        {
          const std::string place   = path_of(problem, name_);
          const auto        is_here = [&place](const auto &setting) {
            return setting.first == place || (!place.empty() && setting.first.rfind(place + "/", 0) == 0);
          };
          if (std::any_of(settings.begin(), settings.end(), is_here))
            about.push_back(problem);
        }
      if (!about.empty())
        throw InputError(about);
      root_ = std::move(changed);
      node_.reset();
    }

    void Document::remove(const std::string &path)
    {
      std::vector<InputProblem> problems;
      scene::apply_overrides(root_, {"~" + path}, problems);
      if (!problems.empty())
        throw InputError(problems);
      node_.reset();
    }

    namespace
    {
      const char *kind_name(const scene::Kind kind)
      {
        switch (kind)
          {
          case scene::Kind::number:
            return "number";
          case scene::Kind::integer:
            return "integer";
          case scene::Kind::boolean:
            return "boolean";
          case scene::Kind::choice:
            return "choice";
          case scene::Kind::file:
            return "file";
          default:
            return "text";
          }
      }

      py::dict dict_of(const scene::Item &item)
      {
        py::dict dict;
        dict["name"]    = item.name;
        dict["list"]    = item.is_list;
        dict["named"]   = item.named;
        dict["present"] = item.present;
        dict["written"] = item.written;
        dict["text"]    = item.text;
        dict["doc"]     = item.is_list ? item.doc : item.entry.doc;
        if (item.is_list)
          return dict;
        dict["kind"]     = kind_name(item.entry.kind);
        dict["unit"]     = item.entry.unit;
        dict["default"]  = item.entry.fallback;
        dict["expected"] = item.entry.expected();
        dict["choices"]  = item.entry.choices;
        return dict;
      }

      py::dict contents(const Document &document, const std::string &path)
      {
        const scene::Contents contents = scene::contents_of(document.node(), schema_of(document.root(), document.name()), path);
        py::list              items;
        for (const scene::Item &item : contents.items)
          items.append(dict_of(item));
        py::dict dict;
        dict["doc"]        = contents.doc;
        dict["items"]      = items;
        dict["takes more"] = contents.takes_more;
        return dict;
      }

      Document from_file(const std::filesystem::path &file)
      {
        return Document(scene::read_input_text(file), file.string(), file.parent_path());
      }

      std::string template_text(const std::string &system, const std::string &integrator)
      {
        need_mpi(); // it makes what it prints
        std::ostringstream text;
        template_command(system, integrator, text);
        return text.str();
      }

      std::vector<std::string> check(const Document &document)
      {
        need_mpi();
        const scene::Node node = document.copied_node();
        return without_lock([&] { return Experiment(node).warnings(); });
      }

      std::vector<std::string> plan(const Document &document)
      {
        need_mpi();
        const scene::Node node = document.copied_node();
        return without_lock([&] { return plan_of(Experiment(node)); });
      }

      std::string list(const std::string &topic, const std::string &name)
      {
        need_mpi();
        std::ostringstream text;
        list_command(topic, name, text);
        return text.str();
      }
    } // namespace

    void bind_scenes(py::module_ &module)
    {
      py::class_<Document>(module, "Document", "A scene as it is written, with changes; behind myolines.Scene.")
          .def(py::init(
                   [](const std::string &xml, const std::string &name, const std::string &folder) { return Document(xml, name, folder); }),
               py::arg("xml"), py::arg("name"), py::arg("folder"), "Parses XML; relative paths in it start from the folder.")
          .def_static(
              "from_file", [](const std::string &file) { return from_file(file); }, py::arg("file"), "Reads and parses a file.")
          .def(
              "copy", [](const Document &document) { return Document(document); }, "Another one with the same values.")
          .def("set", &Document::set, py::arg("settings"), "Sets texts by their paths, all or, if one is wrong, none.")
          .def("add_list", &Document::add_list, py::arg("path"), "Makes a list.")
          .def("remove", &Document::remove, py::arg("path"), "Takes away what the scene writes at a path.")
          .def("contents", &contents, py::arg("path"), "What a list holds and may hold.")
          .def(
              "validate", [](const Document &document) { document.node(); }, "Raises InputError with everything that is wrong.")
          .def(
              "notes", [](const Document &document) { return document.node().notes(); }, "What changes have left out of the file.")
          .def("check", &check, "Makes everything that a run needs; its warnings.")
          .def("plan", &plan, "What a run computes, skips and why, in lines.")
          .def(
              "written_xml", [](const Document &document) { return scene::written_xml(document.node()); }, "XML of what is written.")
          .def(
              "resolved_xml", [](const Document &document) { return scene::resolved_xml(document.node()); }, "XML of all values in force.")
          .def_property_readonly("name", &Document::name, "Stands for its file in messages.");
      module.def("template_text", &template_text, py::arg("system"), py::arg("integrator"), "A complete commented scene as XML.");
      module.def("list_text", &list, py::arg("topic"), py::arg("name"), "What `myolines list` prints.");
      module.def("list_topics", &list_topics, "The words that it takes.");
      module.def(
          "unit_factor", [](const std::string &from, const std::string &to) { return scene::unit_factor(from, to); }, py::arg("from_unit"),
          py::arg("to_unit"), "What numbers in one unit are multiplied by to be in another; None if they do not fit.");
    }
  } // namespace python
} // namespace myolines
