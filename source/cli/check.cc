// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/names.h>
#include <myolines/cli/commands.h>
#include <myolines/cli/experiment.h>
#include <myolines/cli/memory.h>
#include <myolines/cli/plan.h>
#include <myolines/cli/plugins.h>
#include <myolines/output/text_file.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace myolines
{
  namespace
  {
    void print_method(const Experiment &experiment, std::ostream &out)
    {
      const MethodFacts &facts = experiment.method();
      out << "Integrator: " << facts.name << "\n  " << facts.summary << "\n";
      if (facts.order > 0)
        out << "  order " << facts.order << ", " << facts.stability << "\n";
      if (!facts.dynamic)
        out << "  ignores inertia and rates\n";
      out << "  reference: " << facts.reference << "\n";
      const auto &derived = integrator_entry(facts.name).derived;
      if (derived)
        for (const std::string &line : derived(experiment.scene().section("integrator")))
          out << "  " << line << "\n";
    }

    void print_plugins(std::ostream &out)
    {
      for (const Plugin &plugin : plugins())
        out << "Plug-in: " << plugin.name << ", " << join(plugin.brings) << "\n  " << plugin.file.string() << "\n";
    }

    /// Where Newton's method starts, and what is tried where it fails.
    void print_first_guesses(const Experiment &experiment, std::ostream &out)
    {
      const MethodFacts        &facts  = experiment.method();
      const SemiDiscreteSystem &system = *experiment.assembled().system;
      if (experiment.paces_itself() || facts.solves != MethodFacts::Solves::nonlinear_equations || system.capabilities().linear)
        return;
      const std::string last  = "at the last displacement";
      const bool        local = system.local(system.initial_state(experiment.settings().start).u).any();
      out << "Newton's method: starts " << (!local ? last : facts.dynamic ? "at the displacement of the last velocity" : last);
      const bool patient = local && !system.capabilities().rates;
      if (patient)
        out << ", with steps that may raise the residual for a while";
      if (local && (patient || facts.dynamic))
        out << "; where that fails, " << (facts.dynamic ? last : "again") << (patient ? ", with steps that lower it" : "");
      const std::string control = experiment.scene().section("time").section("control").text("type");
      if (!facts.dynamic)
        out << "; where that fails, loads are raised in parts";
      if (control != "fixed")
        out << "; where that fails, the step is shortened";
      out << "\n";
    }

    /// "8 x 0.025 s", equal neighbours together.
    void print_steps(const Experiment &experiment, std::ostream &out)
    {
      const auto planned = experiment.planned_steps();
      if (!planned)
        {
          out << "Steps: chosen by error from " << exact_text(experiment.settings().start) << " s to "
              << exact_text(experiment.settings().end) << " s, "
              << (experiment.paces_itself()                 ? "by the method itself"
                  : experiment.method().error_exponent != 0 ? "estimated by the method"
                                                            : "estimated by taking every step whole and in halves")
              << "\n";
          return;
        }
      out << "Steps: " << (planned->complete ? "" : "more than ") << planned->n_steps << " from " << exact_text(experiment.settings().start)
          << " s to " << exact_text(experiment.settings().end) << " s, if none is rejected\n";
      unsigned int lines = 0;
      std::size_t  told  = 0;
      for (const Experiment::StepPlan::Run &run : planned->runs)
        {
          if (++lines > 20)
            {
              out << "  ... and " << planned->n_steps - told << (planned->complete ? "" : " or") << " more\n";
              return;
            }
          out << "  " << run.count << " x " << run.size << " s\n";
          told += run.count;
        }
      if (!planned->complete)
        out << "  ... and more\n";
    }

    void print_brief(Experiment &experiment, std::ostream &out)
    {
      out << "The scene is valid: " << experiment.scene().section("system").text("type") << ", " << experiment.method().name << "\n"
          << "unknowns: " << experiment.assembled().system->n_unknowns() << "\n";
      const auto planned = experiment.planned_steps();
      out << "steps: " << (!planned ? "chosen by error" : (planned->complete ? "" : "more than ") + std::to_string(planned->n_steps))
          << ", from " << exact_text(experiment.settings().start) << " s to " << exact_text(experiment.settings().end) << " s\n"
          << memory_lines(experiment.scene()).front() << "\n"
          << predicted_cost(experiment) << "\n";
      for (const std::string &warning : experiment.warnings())
        out << "Warning: " << warning << "\n";
    }
  } // namespace

  void check_command(const std::filesystem::path &scene, const std::vector<std::string> &overrides, const bool brief, std::ostream &out)
  {
    Experiment experiment(read_whole_scene(scene, overrides));
    if (brief)
      {
        print_brief(experiment, out);
        return;
      }

    out << "The scene is valid. Resolved, with every value in force:\n\n" << scene::resolved_xml(experiment.scene()) << "\n";
    const std::string type = experiment.scene().section("system").text("type");
    out << "System: " << type << "\n  unknowns: " << experiment.assembled().system->n_unknowns() << "\n";
    for (const std::string &line : experiment.assembled().plan)
      out << "  " << line << "\n";
    if (experiment.assembled().measure)
      for (const std::string &line : experiment.assembled().measure())
        out << "  " << line << "\n";
    for (const std::string &line : skipped_outputs(experiment))
      out << "  " << line << "\n";
    for (const std::string &line : experiment.solver_plan())
      out << "  " << line << "\n";
    for (const std::string &line : memory_lines(experiment.scene()))
      out << "  " << line << "\n";
    print_plugins(out);
    print_method(experiment, out);
    print_first_guesses(experiment, out);
    print_steps(experiment, out);
    for (const std::string &warning : experiment.warnings())
      out << "Warning: " << warning << "\n";
  }
} // namespace myolines
