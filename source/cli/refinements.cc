// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/cli/catalogue.h>
#include <myolines/cli/fit.h>
#include <myolines/cli/memory.h>
#include <myolines/cli/memory_limit.h>
#include <myolines/cli/refinements.h>
#include <myolines/scene/numbers.h>
#include <myolines/time/error_norm.h>
#include <myolines/time/integrator.h>
#include <myolines/time/step_control.h>

#include <cmath>
#include <functional>
#include <optional>
#include <sstream>

namespace myolines
{
  namespace
  {
    using scene::Node;
    using study::Ladder;
    using study::Rung;

    /// The scene, and what it becomes with other settings.
    struct BaseScene
    {
      std::filesystem::path    file;
      std::vector<std::string> overrides;
      Node                     node;

      /// None if the scene does not allow them.
      std::optional<Node> with(const std::vector<std::string> &settings) const
      {
        std::vector<std::string> all = overrides;
        all.insert(all.end(), settings.begin(), settings.end());
        try
          {
            return read_whole_scene(file, all);
          }
        catch (const InputError &)
          {
            return std::nullopt;
          }
      }
    };

    const SystemEntry &entry_of(const Node &node)
    {
      const Node &system = node.section("system");
      return system_entry(system.text("type"), system.where("type"));
    }

    double unknowns_of(const Node &node) { return entry_of(node).size(node.section("system"), 1).n_unknowns; }

    std::string six_digits(const double value)
    {
      std::ostringstream text;
      text << value;
      return text.str();
    }

    /// Of a size that is a suggestion.
    std::string three_digits(const double value)
    {
      std::ostringstream text;
      text.precision(3);
      text << value;
      return text.str();
    }

    /// "1/8", "8".
    std::string factor_text(const double factor) { return factor < 1 ? "1/" + six_digits(1 / factor) : six_digits(factor); }

    /// Fills the rungs that are there from level @p lowest (coarse) to @p highest; the scene has level 0.
    void add_levels(Ladder &ladder, const int lowest, const int highest, const std::function<std::optional<Rung>(int level)> &at)
    {
      ladder.rungs.push_back(at(0).value());
      for (int level = 1; level <= highest; ++level)
        if (const auto rung = at(level))
          ladder.rungs.push_back(*rung);
        else
          break;
      for (int level = -1; level >= lowest; --level)
        if (const auto rung = at(level))
          {
            ladder.rungs.insert(ladder.rungs.begin(), *rung);
            ++ladder.scene;
          }
        else
          break;
    }

    std::optional<Rung> if_allowed(const BaseScene &scene, const int level, const Rung &rung)
    {
      return level == 0 || scene.with(rung.settings) ? std::optional<Rung>(rung) : std::nullopt;
    }

    void add_tolerances(const BaseScene &scene, const IntegratorEntry &method, Ladder &ladder)
    {
      constexpr double  ratio   = 8;
      const Node       &control = scene.node.section("time").section("control");
      const MethodFacts facts   = facts_with(method, scene.node.section("integrator"));
      const double      order = facts.order, exponent = error_exponent(facts);
      ladder.parameter = "tolerances of time/control, times";
      ladder.order     = method.make ? order / exponent : 1;
      ladder.finer     = [](const double factor) { return study::Finer{"tolerances times " + three_digits(1 / factor), factor}; };
      add_levels(ladder, -2, 2, [&](const int level) {
        const double factor = std::pow(ratio, -level);
        Rung         rung{factor_text(factor), {}, factor, std::pow(ratio, level / exponent)};
        rung.settings = scaled_tolerances(control, factor);
        return if_allowed(scene, level, rung);
      });
    }

    void add_schedules(const BaseScene &scene, Ladder &ladder)
    {
      const Node                      &time   = scene.node.section("time");
      const std::vector<SchedulePiece> pieces = parse_schedule(time.text("steps"), time, "steps");
      ladder.parameter                        = "time/steps, times";
      ladder.finer = [](const double factor) { return study::Finer{"time/steps " + three_digits(1 / factor) + " times as long", factor}; };
      add_levels(ladder, 0, 2, [&](const int level) {
        const unsigned int n = 1u << level;
        std::string        text;
        for (const SchedulePiece &piece : pieces)
          text += (text.empty() ? "" : "; ") + std::to_string(n * piece.count) + " x " + scene::format_number(piece.size / n);
        return if_allowed(scene, level, {factor_text(1. / n), {"time/steps=" + text}, 1. / n, 1. * n});
      });
    }

    void add_step_sizes(const BaseScene &scene, Ladder &ladder)
    {
      const Node  &time = scene.node.section("time");
      const double step = time.number("step"), whole = time.number("end") - time.number("start");
      ladder.parameter = "time/step";
      ladder.finer     = [step](const double factor) { return study::Finer{"time/step = " + three_digits(step / factor), factor}; };
      add_levels(ladder, -2, 2, [&](const int level) -> std::optional<Rung> {
        const double size = std::pow(2, -level);
        if (level < 0 && size * step > whole)
          return std::nullopt;
        return if_allowed(scene, level, {six_digits(size * step), {"time/step=" + scene::format_number(size * step)}, size, 1 / size});
      });
    }

    Ladder steps_of(const BaseScene &scene)
    {
      const Node            &time   = scene.node.section("time");
      const std::string      name   = scene.node.section("integrator").text("type");
      const IntegratorEntry &method = integrator_entry(name);
      Ladder                 ladder;
      require_steps(time);
      ladder.name  = "steps";
      ladder.order = std::max(1u, facts_with(method, scene.node.section("integrator")).order);
      if (time.section("control").text("type") == "error")
        add_tolerances(scene, method, ladder);
      else if (time.has("steps"))
        add_schedules(scene, ladder);
      else
        add_step_sizes(scene, ladder);
      return ladder;
    }

    /// The list in @p system that @p path, "discretisation/degree", is in.
    const Node &list_of(const Node &system, const std::string &path)
    {
      const auto slash = path.find('/');
      return slash == std::string::npos ? system : list_of(system.section(path.substr(0, slash)), path.substr(slash + 1));
    }

    int integer_at(const Node &system, const std::string &path) { return list_of(system, path).integer(path.substr(path.rfind('/') + 1)); }

    /// With the cost that the numbers of unknowns predict, times @p more. None if the scene does not allow it or the memory is too small,
    /// which @p note then says.
    std::optional<Rung> on_other_mesh(const BaseScene &scene, const Rung &rung, const double more, std::string &note)
    {
      const std::optional<Node> node = scene.with(rung.settings);
      if (!node)
        return std::nullopt;
      try
        {
          if (memory_of_a_rank(*node) > std::min(memory_limit().bytes, memory_limit_of_a_process()))
            {
              note = rung.label + " needs more memory than there is";
              return std::nullopt;
            }
          Rung priced = rung;
          priced.cost = more * unknowns_of(*node) / unknowns_of(scene.node);
          return priced;
        }
      catch (const InputError &)
        {
          return std::nullopt;
        }
    }

    bool is_explicit(const BaseScene &scene)
    {
      return integrator_entry(scene.node.section("integrator").text("type")).facts.solves == MethodFacts::Solves::mass;
    }

    Ladder mesh_of(const BaseScene &scene)
    {
      const Node           &system = scene.node.section("system");
      const MeshParameters &mesh   = entry_of(scene.node).mesh;
      Ladder                ladder;
      ladder.name  = "mesh";
      ladder.order = mesh.degree.empty() ? 1 : integer_at(system, mesh.degree) + 1;
      const int n  = mesh.cells.empty() ? 0 : integer_at(system, mesh.cells);
      if (mesh.cells.empty() || (!mesh.halves && n == 0))
        {
          ladder.note = "there is no mesh";
          return ladder;
        }
      ladder.parameter = "system/" + mesh.cells;
      ladder.finer     = [name = ladder.parameter, n, halves = mesh.halves](const double factor) {
        const int more = halves ? static_cast<int>(std::ceil(std::log2(factor) - 1e-9)) : static_cast<int>(std::ceil(n * factor)) - n;
        return study::Finer{name + " = " + std::to_string(n + more), halves ? std::pow(2, more) : 1 + static_cast<double>(more) / n};
      };
      const bool stable_steps = !is_explicit(scene);
      add_levels(ladder, -2, stable_steps ? 2 : 0, [&](const int level) -> std::optional<Rung> {
        const double size = std::pow(2, -level);
        if (!mesh.halves && std::fmod(n, size) != 0)
          return std::nullopt;
        const int value = mesh.halves ? n + level : static_cast<int>(n / size);
        return on_other_mesh(scene, {std::to_string(value), {ladder.parameter + "=" + std::to_string(value)}, size, 1}, 1, ladder.note);
      });
      if (!stable_steps)
        ladder.note = "explicit steps are too long for finer meshes";
      else if (ladder.rungs.size() == 1 && ladder.note.empty())
        ladder.note = "there is no other " + ladder.parameter;
      return ladder;
    }

    /// Another degree, with as many quadrature points more, or fewer.
    std::optional<Rung> degree_rung(const BaseScene &scene, const int change)
    {
      const Node           &system = scene.node.section("system");
      const MeshParameters &mesh   = entry_of(scene.node).mesh;
      const int             degree = integer_at(system, mesh.degree), other = degree + change;
      Rung                  rung{std::to_string(other), {"system/" + mesh.degree + "=" + std::to_string(other)}, 1, 1};
      double                row = (other + 1.) / (degree + 1); // of the matrix, in each direction
      if (!mesh.quadrature.empty())
        {
          rung.settings.push_back("system/" + mesh.quadrature + "=" + std::to_string(integer_at(system, mesh.quadrature) + change));
          row *= row * row; // three directions
        }
      std::string no_room;
      return on_other_mesh(scene, rung, row, no_room);
    }
    /// The method to begin with, with the steps of the scene, where its order is higher.
    std::optional<Rung> method_rung(const BaseScene &scene)
    {
      constexpr double       cost   = 3; // a solve for each order, at most
      const Node            &own    = scene.node.section("integrator");
      const std::string      name   = own.text("type");
      const IntegratorEntry &method = integrator_entry(name), &other = *methods_for_every_system().front();
      const MethodFacts      facts = facts_with(method, own);
      if (is_explicit(scene) || facts.order == 0 || facts.order >= other.facts.order)
        return std::nullopt;
      const Rung rung{other.facts.name, {"integrator/type=" + other.facts.name}, 1, cost};
      return scene.with(rung.settings) ? std::optional<Rung>(rung) : std::nullopt;
    }

    /// The method that keeps vibrations best, where the system may vibrate and the scene has another one. Where the errors of velocities
    /// choose the steps, these follow vibrations, and the method may have no estimate of such errors.
    std::optional<Rung> least_damping_rung(const BaseScene &scene)
    {
      const SystemEntry &entry    = entry_of(scene.node);
      const Node        &own      = scene.node.section("integrator");
      const MethodFacts &facts    = method_of_least_damping().facts;
      const bool         vibrates = !entry.inertia || entry.inertia(scene.node.section("system"));
      const Node        &control  = scene.node.section("time").section("control");
      const bool         followed = control.text("type") == "error" && control.has("velocity");
      if (!vibrates || followed || is_explicit(scene) || own.text("type") == facts.name ||
          facts_with(integrator_entry(own.text("type")), own).order == 0)
        return std::nullopt;
      const Rung rung{facts.name, {"integrator/type=" + facts.name}, 1, 1};
      return scene.with(rung.settings) ? std::optional<Rung>(rung) : std::nullopt;
    }
  } // namespace

  std::vector<std::string> scaled_tolerances(const scene::Node &control, const double factor)
  {
    std::vector<std::string> settings;
    for (const char *block : {"displacement", "velocity"})
      if (control.has(block))
        for (const char *name : {"relative tolerance", "absolute tolerance"})
          settings.push_back("time/control/" + std::string(block) + "/" + name + "=" +
                             scene::format_number(factor * control.section(block).number(name)));
    return settings;
  }

  study::Refinements refinements_of(const std::filesystem::path &file, const std::vector<std::string> &overrides)
  {
    const BaseScene    scene{file, overrides, read_whole_scene(file, overrides)};
    study::Refinements refinements;
    refinements.steps         = steps_of(scene);
    refinements.mesh          = mesh_of(scene);
    refinements.method_name   = "integrator/type";
    refinements.method        = method_rung(scene);
    refinements.least_damping = least_damping_rung(scene);
    if (const std::string degree = entry_of(scene.node).mesh.degree; !degree.empty())
      {
        refinements.degree_name = "system/" + degree;
        if (!is_explicit(scene))
          refinements.degree = degree_rung(scene, 1);
        refinements.higher = refinements.degree.has_value();
        if (!refinements.higher)
          refinements.degree = degree_rung(scene, -1);
      }
    return refinements;
  }
} // namespace myolines
