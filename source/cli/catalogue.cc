// SPDX-License-Identifier: LGPL-2.1-or-later
#include "assemble.h"

#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/cli/catalogue.h>
#include <myolines/cli/plugins.h>
#include <myolines/muscle1d/isometric_chain.h>
#include <myolines/muscle1d/muscle_tendon_unit.h>
#include <myolines/muscle3d/muscle3d_system.h>
#include <myolines/observers/outputs.h>
#include <myolines/oscillator/oscillator_system.h>
#include <myolines/output/checkpoint_keeper.h>
#include <myolines/particles/mass_chain.h>
#include <myolines/particles/spring_pendulum.h>
#include <myolines/rod1d/rod1d_system.h>
#include <myolines/scene/node_builder.h>
#include <myolines/scene/numbers.h>
#include <myolines/solve/nonlinear_solver.h>
#include <myolines/system/file_drive.h>
#include <myolines/system/steered_drive.h>
#include <myolines/system/zajac.h>
#include <myolines/time/step_control.h>

#include <algorithm>

namespace myolines
{
  using scene::Node;
  using scene::Schema;

  void note_drives(const std::vector<const Drive *> &drives, AssembledSystem &assembled)
  {
    for (const Drive *drive : drives)
      if (const ZajacActivation *activation = from_excitation(drive))
        assembled.from_excitations.push_back(activation);
    for (const Drive *drive : drives)
      if (const FileDrive *file = file_of(drive))
        assembled.files.push_back(file);
      else if (const auto steering = steering_of(drive))
        assembled.steered.push_back(steering);
  }

  namespace
  {
    AssembledSystem make_oscillator(const Node &node, WorkLedger &ledger, InstructionSet)
    {
      const OscillatorParameters parameters = read_oscillator(node);
      AssembledSystem            assembled  = assemble(std::make_unique<OscillatorSystem>(parameters, ledger), ledger);
      note_drives({parameters.force.get(), parameters.support.get()}, assembled);
      return assembled;
    }

    AssembledSystem make_mass_chain(const Node &node, WorkLedger &ledger, InstructionSet)
    {
      const MassChainParameters parameters = read_mass_chain(node);
      AssembledSystem           assembled  = assemble(std::make_unique<MassChain>(parameters, ledger), ledger);
      note_drives({parameters.support.get()}, assembled);
      return assembled;
    }

    AssembledSystem make_spring_pendulum(const Node &node, WorkLedger &ledger, InstructionSet)
    {
      return assemble(std::make_unique<SpringPendulum>(read_spring_pendulum(node), ledger), ledger);
    }

    SizeEstimate oscillator_size(const Node &, unsigned int) { return {2, 0, 0, true}; }

    SizeEstimate mass_chain_size(const Node &node, unsigned int)
    {
      return {1. + static_cast<double>(read_mass_chain(node).masses.size()), 0, 0, true};
    }

    AssembledSystem make_rod1d(const Node &node, WorkLedger &ledger, InstructionSet)
    {
      const Rod1dParameters parameters = read_rod1d(node);
      AssembledSystem       assembled  = assemble(std::make_unique<Rod1dSystem>(parameters, ledger), ledger);
      note_drives({parameters.strain.get()}, assembled);
      return assembled;
    }

    AssembledSystem make_muscle1d(Muscle1dParameters parameters, WorkLedger &ledger)
    {
      std::vector<const Drive *> drives{parameters.excitation.get(), parameters.tendon ? parameters.tendon->unit_length.get() : nullptr};

      const auto      activation = parameters.activation;
      auto            system     = std::make_unique<Muscle1dSystem>(std::move(parameters), ledger);
      auto            plan       = system->plan();
      AssembledSystem assembled  = assemble(std::move(system), ledger);
      assembled.plan             = std::move(plan);
      note_drives(drives, assembled);
      if (const ZajacActivation *from = from_excitation(activation.get())) // its file is that of the excitation
        assembled.from_excitations.push_back(from);
      return assembled;
    }

    AssembledSystem make_muscle_tendon_unit(const Node &node, WorkLedger &ledger, InstructionSet)
    {
      return make_muscle1d(read_muscle_tendon_unit(node), ledger);
    }

    AssembledSystem make_continuum_muscle(const Node &node, WorkLedger &ledger, InstructionSet)
    {
      return make_muscle1d(read_continuum_muscle(node), ledger);
    }

    AssembledSystem make_isometric_chain(const Node &node, WorkLedger &ledger, InstructionSet)
    {
      return make_muscle1d(read_isometric_chain(node), ledger);
    }

    /// Some twenty vectors of a run, four bands and the matrix that is solved with.
    SizeEstimate muscle1d_size(const double n_elements, const double degree, const double activations)
    {
      const double n = n_elements * (degree + activations), width = degree + activations;
      return {n, n * sizeof(double) * (20 + 3 * (2 * width + 1) + 3 * width + 1), 0, true};
    }

    double activations(const Node &node) { return node.text("activation") == "unknown" ? 1 : 0; }

    SizeEstimate muscle_tendon_unit_size(const Node &node, unsigned int)
    {
      return muscle1d_size(std::max(node.integer("masses"), 1), 1, activations(node));
    }

    SizeEstimate continuum_muscle_size(const Node &node, unsigned int)
    {
      return muscle1d_size(node.integer("elements"), node.integer("degree"), activations(node));
    }

    SizeEstimate isometric_chain_size(const Node &node, unsigned int) { return muscle1d_size(node.integer("elements"), 1, 0); }

    /// Some twenty vectors of a run and two band matrices.
    SizeEstimate rod1d_size(const Node &node, unsigned int)
    {
      const Rod1dParameters rod = read_rod1d(node);
      const double          n   = 1. + static_cast<double>(rod.n_elements) * rod.degree;
      return {n, n * sizeof(double) * (20 + 2 * (3 * rod.degree + 1)), 0, true};
    }

    std::deque<SystemEntry> make_catalogue()
    {
      const std::vector<scene::Setting> isometric{{"title", "Isometric contraction of a pennate block"},
                                                  {"system/geometry/refinement", "2"},
                                                  {"system/fibres/type", "pennation angle"},
                                                  {"system/fibres/angle", "30"},
                                                  {"system/boundary/moving end/face", "x+"},
                                                  {"system/boundary/moving end/type", "strain"},
                                                  {"system/boundary/moving end/strain/type", "constant"},
                                                  {"system/boundary/moving end/strain/value", "0"},
                                                  {"system/boundary/fixed end/face", "x-"},
                                                  {"system/boundary/fixed end/type", "fixed"},
                                                  {"system/activation/type", "ramp"},
                                                  {"system/activation/amplitude", "1"},
                                                  {"system/activation/duration", "0.2"},
                                                  {"time/end", "0.2"},
                                                  {"time/step", "0.025"}};
      const std::vector<scene::Setting> swinging{{"title", "Free oscillation"}, {"time/end", "10"}, {"time/step", "0.1"}};
      const std::vector<scene::Setting> led{{"title", "Two masses behind a stiff spring"},
                                            {"system/support/type", "sine"},
                                            {"system/support/amplitude", "1"},
                                            {"system/support/frequency", "0.1909859317102744"},
                                            {"time/end", "0.5"},
                                            {"time/step", "5e-4"}};
      const std::vector<scene::Setting> turning{{"title", "A mass on a stiff spring"}, {"time/end", "1"}, {"time/step", "1e-3"}};
      const std::vector<scene::Setting> stretched{{"title", "Stretching an elastic rod"},
                                                  {"system/profile/type", "smooth step"},
                                                  {"system/profile/amplitude", "0.1"},
                                                  {"system/profile/duration", "2"},
                                                  {"time/end", "2"},
                                                  {"time/step", "0.001"}};
      const std::vector<scene::Setting> walking{
          {"title", "A muscle with its tendon in a synthetic gait"}, {"time/end", "2"}, {"time/step", "1e-3"}};
      const std::vector<scene::Setting> relaxing{{"title", "An active muscle at fixed length"}, {"time/end", "10"}, {"time/step", "1e-3"}};
      const SystemVariant               unknown_activation{"activation unknown", {{"system/activation", "unknown"}}};
      return {{"muscle 3d",
               muscle3d_schema,
               muscle3d_output_schema,
               isometric,
               {{"dynamic", {}}, {"quasi-static", {{"system/inertia", "quasi-static"}}}},
               make_muscle3d,
               muscle3d_size,
               {"geometry/refinement", true, "discretisation/degree", "discretisation/quadrature points"},
               [](const Node &system) { return system.text("inertia") == "dynamic"; }},
              {"muscle-tendon unit",
               muscle_tendon_unit_schema,
               muscle_tendon_output_schema,
               walking,
               {{"masses", {}}, {"massless", {{"system/masses", "0"}}}, unknown_activation},
               make_muscle_tendon_unit,
               muscle_tendon_unit_size,
               {"masses"},
               [](const Node &system) { return system.integer("masses") > 0; }},
              {"continuum muscle",
               continuum_muscle_schema,
               muscle_tendon_output_schema,
               walking,
               {{"", {}}, unknown_activation},
               make_continuum_muscle,
               continuum_muscle_size,
               {"elements", false, "degree"}},
              {"isometric chain",
               isometric_chain_schema,
               isometric_chain_output_schema,
               relaxing,
               {{"", {}}},
               make_isometric_chain,
               isometric_chain_size,
               {"elements"}},
              {"rod 1d", rod1d_schema, rod1d_output_schema, stretched, {{"", {}}}, make_rod1d, rod1d_size, {"elements", false, "degree"}},
              {"oscillator", oscillator_schema, oscillator_output_schema, swinging, {{"", {}}}, make_oscillator, oscillator_size, {}},
              {"mass chain", mass_chain_schema, particle_output_schema, led, {{"", {}}}, make_mass_chain, mass_chain_size, {}},
              {"spring pendulum",
               spring_pendulum_schema,
               particle_output_schema,
               turning,
               {{"", {}}},
               make_spring_pendulum,
               oscillator_size,
               {}}};
    }

    Schema integrator_schema()
    {
      std::vector<std::pair<std::string, Schema>> alternatives;
      for (const IntegratorEntry &entry : integrator_registry())
        alternatives.emplace_back(entry.facts.name, entry.schema);
      return Schema("Method that advances the system in time.").variant("type", std::nullopt, alternatives, "Name of the method.");
    }
  } // namespace

  Registry<SystemEntry> &system_catalogue()
  {
    static Registry<SystemEntry> catalogue("system", make_catalogue());
    return catalogue;
  }

  const SystemEntry &system_entry(const std::string &name, const std::string &where)
  {
    if (const SystemEntry *entry = system_catalogue().find(name))
      return *entry;
    std::vector<std::string> names;
    for (const SystemEntry &entry : system_catalogue())
      names.push_back(entry.name);
    throw InputError(
        InputProblem{where, "unknown system \"" + name + "\"", "one of " + join(names), nearest_hint(name, names, "nearest valid name")});
  }

  AssembledSystem make_system(const Node &scene, WorkLedger &ledger, const InstructionSet instruction_set)
  {
    const Node &system = scene.section("system");
    return system_entry(system.text("type"), system.where("type")).make(system, ledger, instruction_set);
  }

  scene::Schema root_schema(const SystemEntry &system)
  {
    std::vector<std::pair<std::string, Schema>> systems;
    for (const SystemEntry &entry : system_catalogue())
      systems.emplace_back(entry.name, entry.schema());

    Schema solver("Solvers of the implicit stages.");
    solver.section("nonlinear", NonlinearSolver::schema())
        .section("linear", LinearSolver::linear_schema())
        .section("preconditioner", LinearSolver::preconditioner_schema());

    Schema output = system.output();
    output.section("checkpoint", checkpoint_schema());

    Schema root("One run: a system, an integrator, the steps, the solvers and what to write.");
    root.text("title", "", "What this scene is about, for example \"Isometric contraction\".")
        .optional_text("plug-ins", "Plug-ins that it needs, by name, with blanks between, for example \"my-methods\"; see: list plug-ins.")
        .section("system", Schema("What is computed.").variant("type", std::nullopt, systems, "Kind of system."))
        .section("integrator", integrator_schema())
        .section("time", time_schema())
        .section("solver", solver)
        .section("output", output);
    return root;
  }

  namespace
  {
    /// Whether the overrides say how large steps are, or who chooses them.
    bool choose_steps(const std::vector<std::string> &overrides)
    {
      const auto of_steps = [](const std::string &text) {
        const std::string path = scene::trimmed(text.substr(0, text.find('=')));
        return path == "time/step" || path == "time/steps" || path.rfind("time/control/", 0) == 0;
      };
      return std::any_of(overrides.begin(), overrides.end(), of_steps);
    }

    /// What a method needs that an override has chosen for a scene made for another one.
    std::vector<scene::Preset> presets(const std::filesystem::path &file, const std::vector<std::string> &overrides)
    {
      if (overrides.empty())
        return {};
      const auto chosen = scene::peek_text(file, "integrator/type", overrides);
      if (!chosen || chosen == scene::peek_text(file, "integrator/type"))
        return {};
      std::vector<scene::Preset> all;
      const IntegratorEntry     *entry = integrator_registry().find(*chosen);
      if (entry == nullptr)
        return all;
      if (!entry->make)
        all.push_back({"time/control/type", "error", *chosen + " chooses its steps itself"});
      else if ((entry->make_self_paced || entry->facts.solves == MethodFacts::Solves::linear_systems) && !choose_steps(overrides))
        all.push_back({"time/control/type", "error", "steps that were chosen for other methods may be too long for " + *chosen});
      if (!entry->facts.scheme_rates && scene::peek_text(file, "time/boundary rates", overrides) == "scheme")
        all.push_back({"time/boundary rates", "exact", *chosen + " has no formulas of its own for the rates of a moving boundary"});
      return all;
    }
  } // namespace

  namespace
  {
    /// Loads @p plugins, the text of that parameter, and gives the schema for the system @p type, both nothing where they are not written.
    scene::Schema schema_for(const std::optional<std::string> &plugins, const std::optional<std::string> &type, const std::string &name)
    {
      if (plugins)
        load_plugins(*plugins, name + ": plug-ins");
      const std::string where = name + ": system/type";
      if (!type)
        {
          std::vector<std::string> names;
          for (const SystemEntry &entry : system_catalogue())
            names.push_back(entry.name);
          throw InputError(InputProblem{where, "missing parameter \"type\"", "one of " + join(names), "Kind of system."});
        }
      return root_schema(system_entry(*type, where));
    }

    std::optional<std::string> text_at(const scene::RawList &root, const std::string &path)
    {
      const scene::RawParameter *found = scene::find_parameter(root, path);
      return found != nullptr ? std::optional<std::string>(found->text) : std::nullopt;
    }
  } // namespace

  scene::Node read_whole_scene(const std::filesystem::path &file, const std::vector<std::string> &overrides)
  {
    const auto          texts  = scene::peek_texts(file, {"plug-ins", "system/type"}, overrides);
    const scene::Schema schema = schema_for(texts[0], texts[1], file.string());
    return scene::read_scene(file, schema, overrides, "scene", presets(file, overrides));
  }

  scene::Schema schema_of(const scene::RawList &root, const std::string &name)
  {
    return schema_for(text_at(root, "plug-ins"), text_at(root, "system/type"), name);
  }

  scene::Node build_whole_scene(const scene::RawList &root, const std::string &name, const std::filesystem::path &folder,
                                std::vector<InputProblem> &problems)
  {
    return scene::NodeBuilder(name, folder, problems).build(&root, schema_of(root, name), "", "");
  }
} // namespace myolines
