// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/checksum.h>
#include <myolines/base/error.h>
#include <myolines/cli/experiment.h>
#include <myolines/cli/memory.h>
#include <myolines/cli/plugins.h>
#include <myolines/cli/saved_start.h>
#include <myolines/output/checkpoint_keeper.h>
#include <myolines/output/text_file.h>
#include <myolines/scene/numbers.h>
#include <myolines/system/file_drive.h>
#include <myolines/system/instants.h>
#include <myolines/system/zajac.h>
#include <myolines/time/energy_guard.h>
#include <myolines/time/error_control.h>
#include <myolines/time/start.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

namespace myolines
{
  namespace
  {
    /// Accepts every step and computes nothing, so that the loop itself tells which steps it would take. Ends it (Interrupted) where there
    /// are more than the limit.
    class DryIntegrator : public Integrator
    {
    public:
      void       start(State &) override {}
      StepReport step(const double dt, State &state) override
      {
        if (plan.n_steps == Experiment::StepPlan::limit)
          {
            plan.complete = false;
            throw Interrupted("there are too many steps to plan them all");
          }
        state.t += dt;
        ++plan.n_steps;
        if (!plan.runs.empty() && std::abs(dt - plan.runs.back().size) <= 1e-9 * plan.runs.back().size)
          ++plan.runs.back().count;
        else
          plan.runs.push_back({1, dt});
        return {};
      }
      void save(Archive &) const override {}
      void load(const Archive &) override {}

      Experiment::StepPlan plan;
    };

    /// @p scene, if what it asks for can be made at all.
    scene::Node feasible(scene::Node scene)
    {
      if (!dealii::Utilities::MPI::job_supports_mpi())
        throw std::logic_error("MPI has not been started: MpiSession::start() comes before an Experiment");
      refuse_too_large(scene);
      return scene;
    }
  } // namespace

  Experiment::Experiment(scene::Node scene, const InstructionSet instruction_set)
    : scene_(feasible(std::move(scene)))
    , instruction_set_(instruction_set)
    , assembled_(make_system(scene_, ledger_, instruction_set))
    , method_(integrator_entry(scene_.section("integrator").text("type")))
    , settings_(loop_settings(scene_.section("time")))
    , linear_(scene_.section("solver").section("linear"), scene_.section("solver").section("preconditioner"), ledger_,
              [this] { return stop_signal() != 0; })
    , nonlinear_(scene_.section("solver").section("nonlinear"), linear_, ledger_)
  {
    for (const ZajacActivation *activation : assembled_.from_excitations)
      activation->begin(settings_.start);
    for (const FileDrive *file : assembled_.files)
      file->require(settings_.start, settings_.end);
    refuse_ignored_inertia();
    refuse_tiny_steps();
    if (starts_from_saved(scene_))
      saved_start(scene_, *assembled_.system, settings_.start);
    if (const scene::Node &time = scene_.section("time"); starts_from_equilibrium(time) && assembled_.require_equilibrium)
      assembled_.require_equilibrium(time, "start state");
    solver_plan_ = LinearSolver::plan(scene_.section("solver").section("linear"), scene_.section("solver").section("preconditioner"),
                                      *assembled_.system->make_linearisation(), assembled_.system->n_unknowns(),
                                      assembled_.system->capabilities().linear);
    error_norm_  = make_error_norm(scene_.section("time"), *assembled_.system);
    make_method();
    const OutputFolder nowhere = OutputFolder::nowhere();
    for (const auto &output : assembled_.make_outputs(scene_.section("output"), nowhere)) // which refuse what they cannot do
      for (const double t : output->landings())
        if (t > settings_.start && t <= settings_.end)
          settings_.landings.push_back(t);
        else if (t != settings_.start)
          scene_.section("time").refuse("end",
                                        "an output asks for the state at " + scene::format_number(t) + " s, which is no time of the run",
                                        "times between \"start\" and \"end\"", "change the list \"at\" of the output, or the run");
    settings_.landings = one_list(settings_.landings);
    output_files_      = nowhere.noted();
    for (const std::filesystem::path &file : scene_.files())
      if (writes_files())
        inputs_[file.string()] = checksum_of_file(file);
    for (const Plugin &plugin : plugins())
      inputs_[plugin.file.string()] = plugin.checksum;
  }

  IntegratorContext Experiment::context()
  {
    const scene::Node &time = scene_.section("time");
    return {*assembled_.system, nonlinear_, boundary_rates(time), ledger_, start_velocity(time), error_norm_.get()};
  }

  Integrator &Experiment::integrator()
  {
    if (!integrator_)
      throw std::logic_error("the method of this scene chooses its steps itself");
    return *integrator_;
  }

  State Experiment::start()
  {
    const scene::Node &time = scene_.section("time");
    if (starts_from_saved(scene_))
      return saved_start(scene_, *assembled_.system, settings_.start);
    State state = starting_state(*assembled_.system, settings_.start, boundary_rates(time), start_velocity(time));
    if (starts_from_equilibrium(time))
      find_equilibrium(state);
    return state;
  }

  std::vector<std::unique_ptr<Observer>> Experiment::make_outputs(const OutputFolder &folder) const
  {
    return assembled_.make_outputs(scene_.section("output"), folder);
  }

  void Experiment::make_method()
  {
    const scene::Node      &time = scene_.section("time"), &integrator = scene_.section("integrator");
    const IntegratorContext context = this->context();
    if (error_norm_ && method_.make_self_paced)
      {
        const scene::Node &control = time.section("control");
        if (control.has("largest gain"))
          control.refuse("largest gain", "\"" + method_.facts.name + "\" chooses its steps itself",
                         "no \"largest gain\", or another method");
        self_paced_ = make_self_paced(method_, integrator, context, error_control_limits(time));
        return;
      }
    control_    = make_step_control(time, error_exponent(method()));
    integrator_ = guard_energy(make_integrator(method_, integrator, context), time, *assembled_.system);
  }

  int Experiment::stop_signal() const
  {
    const int here = signal_ ? signal_() : 0;
    return dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1 ? here : dealii::Utilities::MPI::max(here, MPI_COMM_WORLD);
  }

  TimeMethod &Experiment::time_method() const { return self_paced_ ? static_cast<TimeMethod &>(*self_paced_) : *integrator_; }

  void Experiment::refuse_ignored_inertia() const
  {
    if (!method_.facts.dynamic && assembled_.system->capabilities().inertia)
      scene_.section("integrator")
          .refuse("type", "\"" + method_.facts.name + "\" ignores inertia, but the system has it", "an integrator for dynamics",
                  "`myolines list methods " + method_.facts.name + "` names systems without it, and what sets them");
  }

  /// A step below the rounding of the times does not advance them.
  void Experiment::refuse_tiny_steps() const
  {
    const scene::Node &time     = scene_.section("time");
    const double       rounding = time_tolerance(std::max(std::abs(settings_.start), std::abs(settings_.end)));
    const auto         require  = [&](const scene::Node &list, const std::string &parameter, const double size, const std::string &kind) {
      if (size > rounding)
        return;
      std::ostringstream what, expected;
      what << "a" << (kind == "interval" ? "n " : " ") << kind << " of " << size << " s is below the rounding of the times";
      expected << kind << "s longer than " << rounding << " s";
      list.refuse(parameter, what.str(), expected.str());
    };
    if (time.has("step"))
      require(time, "step", time.number("step"), "step");
    if (time.has("steps"))
      for (const SchedulePiece &piece : parse_schedule(time.text("steps"), time, "steps"))
        require(time, "steps", piece.size, "step");
    for (const scene::Node *output : intervals())
      require(*output, "interval", output->number("interval"), "interval");
  }

  /// The lists of the output that have rows at equal intervals.
  std::vector<const scene::Node *> Experiment::intervals() const
  {
    std::vector<const scene::Node *> lists;
    const scene::Node               &output = scene_.section("output");
    const scene::Schema              schema = system_entry(scene_.section("system").text("type"), "").output();
    for (const scene::Schema::Section &section : schema.sections())
      for (const scene::Entry &entry : section.schema->entries())
        if (entry.name == "interval" && output.has(section.name))
          lists.push_back(&output.section(section.name));
    return lists;
  }

  std::vector<std::string> Experiment::warnings() const
  {
    std::vector<std::string> warnings = scene_.notes();
    warnings.insert(warnings.end(), assembled_.warnings.begin(), assembled_.warnings.end());
    for (const FileDrive *file : assembled_.files)
      for (const std::string &note : {file->note(), file->note_of_times(settings_.start, settings_.end)})
        if (!note.empty())
          warnings.push_back(note);
    if (const scene::Node &time = scene_.section("time"); time.has("step") && !error_norm_)
      if (const double steps = (settings_.end - settings_.start) / time.number("step"); steps >= 1e7)
        {
          std::ostringstream text;
          text << "there will be " << steps << " steps: time/step is " << time.number("step") << " s";
          warnings.push_back(text.str());
        }
    for (const scene::Node *output : intervals())
      if (const double rows = (settings_.end - settings_.start) / output->number("interval"); rows >= 1e6)
        {
          std::ostringstream text;
          text << "output/" << output->name() << " will have " << rows << " rows: its interval is " << output->number("interval") << " s";
          warnings.push_back(text.str());
        }
    if (method_.facts.solves == MethodFacts::Solves::linear_systems && !assembled_.why_iterate.empty())
      warnings.push_back("\"" + method_.facts.name + "\" does not iterate. " + assembled_.why_iterate +
                         ". Most methods iterate (`myolines list integrators`)");
    if (self_paced_ && !error_norm_->looks_at_velocity())
      warnings.push_back("velocities are not looked at, and \"" + method_.facts.name +
                         "\" damps little of what it does not look at: forces may ring. A list \"time/control/velocity\" looks at them");
    return warnings;
  }

  void Experiment::keep(Checkpoint &checkpoint)
  {
    nonlinear_.forget();
    time_method().save(checkpoint.integrator);
    if (control_)
      control_->save(checkpoint.control);
  }

  void Experiment::recall(const Checkpoint &checkpoint)
  {
    nonlinear_.forget();
    time_method().load(checkpoint.integrator);
    if (control_)
      control_->load(checkpoint.control);
  }

  void Experiment::advance(const LoopSettings &settings, State &state, const std::vector<Observer *> &observers, Keeper *keeper)
  {
    if (self_paced_)
      run_loop(*assembled_.system, *self_paced_, settings, state, observers, ledger_, keeper);
    else
      run_loop(*assembled_.system, *integrator_, *control_, settings, state, observers, ledger_, keeper);
  }

  void Experiment::resume(const Checkpoint &checkpoint)
  {
    settings_.steps_done = checkpoint.step;
    settings_.resumed    = true;
    recall(checkpoint);
    for (const auto &[name, times] : checkpoint.ledger.counts())
      ledger_.count(name, times);
    for (const auto &[phase, seconds] : checkpoint.ledger.seconds())
      ledger_.add_seconds(phase, seconds);
    ledger_.count("resumed runs");
    resumed_ = checkpoint.state;
  }

  void Experiment::find_equilibrium(State &state)
  {
    try
      {
        start_from_equilibrium({*assembled_.system, nonlinear_, boundary_rates(scene_.section("time")), ledger_}, state);
      }
    catch (const SolveError &)
      {
        if (const int signal = stop_signal())
          throw Interrupted(std::string("asked to stop by the signal \"") + strsignal(signal) + "\" before its first step");
        throw;
      }
  }

  void Experiment::run(const std::vector<Observer *> &observers, const std::filesystem::path &folder, const std::function<int()> &stop)
  {
    signal_                = stop;
    State            state = resumed_ ? *resumed_ : start();
    CheckpointKeeper keeper(scene_.section("output").section("checkpoint"),
                            {*assembled_.system, time_method(), control_.get(), observers, ledger_, scene::resolved_xml(scene_), inputs_,
                             name(instruction_set_), [this] { nonlinear_.forget(); }, [this] { return stop_signal(); }},
                            folder);
    advance(settings_, state, observers, &keeper);
  }

  std::optional<Experiment::StepPlan> Experiment::planned_steps() const
  {
    if (error_norm_)
      return std::nullopt;
    DryIntegrator                      dry;
    WorkLedger                         unused;
    const std::unique_ptr<StepControl> control = make_step_control(scene_.section("time"));
    State                              state   = assembled_.system->initial_state(settings_.start);
    try
      {
        run_loop(*assembled_.system, dry, *control, settings_, state, {}, unused);
      }
    catch (const Interrupted &)
      {
        if (dry.plan.complete)
          throw;
      }
    return dry.plan;
  }
} // namespace myolines
