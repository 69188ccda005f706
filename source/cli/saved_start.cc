// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/cli/resume.h>
#include <myolines/cli/saved_start.h>
#include <myolines/output/checkpoint.h>
#include <myolines/scene/document.h>
#include <myolines/time/step_control.h>

#include <algorithm>

namespace myolines
{
  namespace
  {
    const std::string file_name = "saved state";

    scene::RawList tree_of(const std::string &xml, const std::string &name)
    {
      std::vector<InputProblem> problems;
      scene::RawList            root = scene::parse_document(xml, name, problems);
      if (!problems.empty())
        throw InputError(problems);
      return root;
    }

    const scene::RawList *list_in(const scene::RawList &root, const std::string &name)
    {
      const auto found = std::find_if(root.lists.begin(), root.lists.end(), [&](const scene::RawList &list) { return list.name == name; });
      return found == root.lists.end() ? nullptr : &*found;
    }

    /// The first parameter in which they differ; "" if there is none.
    std::string difference(const scene::RawList &one, const scene::RawList &other)
    {
      if (one.parameters.size() != other.parameters.size() || one.lists.size() != other.lists.size())
        return one.name;
      for (std::size_t i = 0; i < one.parameters.size(); ++i)
        if (one.parameters[i].name != other.parameters[i].name || one.parameters[i].text != other.parameters[i].text)
          return one.name + "/" + one.parameters[i].name;
      for (std::size_t i = 0; i < one.lists.size(); ++i)
        if (const std::string inner = difference(one.lists[i], other.lists[i]); !inner.empty())
          return one.name + "/" + inner;
      return "";
    }

    /// Unknowns have another meaning where the kind of system, its sizes, its mesh or its elements are others; all else may differ.
    std::string difference_of_systems(const scene::RawList &one, const scene::RawList &other)
    {
      for (const char *list : {"geometry", "discretisation", "data"})
        if (const auto *left = list_in(one, list), *right = list_in(other, list); left != nullptr || right != nullptr)
          {
            const std::string found = left == nullptr || right == nullptr ? list : difference(*left, *right);
            if (!found.empty())
              return "system/" + found;
          }
      for (const char *name : {"type", "length", "scale", "muscle", "task", "elements", "degree", "masses", "activation"})
        {
          const auto *left = scene::find_parameter(one, name), *right = scene::find_parameter(other, name);
          if ((left == nullptr) != (right == nullptr) || (left != nullptr && left->text != right->text))
            return std::string("system/") + name;
        }
      return "";
    }
  } // namespace

  bool starts_from_saved(const scene::Node &scene)
  {
    const scene::Node &time  = scene.section("time");
    const bool         saved = time.text("start state") == "saved";
    if (saved && !time.has(file_name))
      time.refuse("start state", "there is no \"" + file_name + "\"",
                  "a file that a run has saved: checkpoint, or one of its folder states");
    if (!saved && time.has(file_name))
      time.refuse(file_name, "it is not looked at, as \"start state\" is \"" + time.text("start state") + "\"",
                  "\"start state\" = \"saved\", or no \"" + file_name + "\"");
    if (saved && start_velocity(time) == StartVelocity::impulse)
      time.refuse("start velocity", "a saved state has its velocities", "\"consistent\"");
    return saved;
  }

  State saved_start(const scene::Node &scene, const SemiDiscreteSystem &system, const double t0)
  {
    const scene::Node          &time = scene.section("time");
    const std::filesystem::path file = time.file(file_name);
    const CheckpointReader      reader(file);
    const scene::RawList saved = tree_of(reader.contents().scene, file.string()), here = tree_of(scene::resolved_xml(scene), "scene");
    const scene::RawList *const its = list_in(saved, "system"), *const ours = list_in(here, "system");
    if (const std::string other = its == nullptr ? "system" : difference_of_systems(*its, *ours); !other.empty())
      time.refuse(file_name, "the state is of a run with another \"" + other + "\"", "a run of the same body on the same mesh",
                  "conditions, drives and materials may be others");
    refuse_other_mesh(scene, reader.contents().inputs);
    State state = system.initial_state(t0), read = reader.read(system).state;
    state.u.swap(read.u);
    state.v.swap(read.v);
    system.prescribed(t0, Side::right, state);
    for (Vector *x : {&state.u, &state.v, &state.a})
      x->update_ghost_values();
    return state;
  }
} // namespace myolines
