// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/cli/catalogue.h>
#include <myolines/output/checkpoint.h>
#include <myolines/solve/nonlinear_solver.h>
#include <myolines/time/error_norm.h>
#include <myolines/time/step_control.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>

namespace myolines
{
  /// Everything a run needs, built from a validated scene; what ranges cannot express is refused here (InputError),
  /// also what outputs cannot do.
  class Experiment
  {
  public:
    /// Of a scene that read_whole_scene() gives. Collective.
    explicit Experiment(scene::Node scene, InstructionSet instruction_set = widest_instruction_set());

    const scene::Node     &scene() const { return scene_; }         ///< that of the constructor
    const AssembledSystem &assembled() const { return assembled_; } ///< the system, and what belongs to it
    /// with the parameters of the scene
    MethodFacts         method() const { return facts_with(method_, scene_.section("integrator")); }
    const LoopSettings &settings() const { return settings_; }               ///< of the list `time`
    InstructionSet      instruction_set() const { return instruction_set_; } ///< of the cell kernels

    /// How linear systems are solved, in words.
    const std::vector<std::string> &solver_plan() const { return solver_plan_; }

    /// What the user should know before trusting the results: of the system, and of the method in it.
    std::vector<std::string> warnings() const;

    /// Whether the method chooses its steps itself.
    bool paces_itself() const { return self_paced_ != nullptr; }

    WorkLedger &ledger() { return ledger_; } ///< counts and seconds of all that this experiment does

    // For loops and methods of one's own (doc/interface.md); none of these runs anything but start(), where the scene asks for equilibrium.

    const SemiDiscreteSystem &system() const { return *assembled_.system; } ///< the semi-discrete equations

    /// For a method, or a StageSolver, of one's own. It refers to this experiment.
    IntegratorContext context();

    /// That of the scene, not started. @throws std::logic_error if it chooses its steps itself.
    Integrator &integrator();

    /// The state that a run begins with.
    State start();

    /// The observers of the list `output`, which write into @p folder; they refer to this experiment.
    std::vector<std::unique_ptr<Observer>> make_outputs(const OutputFolder &folder) const;

    /// Files that the scene names, with their checksums; on the rank that writes.
    const std::map<std::string, std::string> &inputs() const { return inputs_; }

    /// That the outputs of the scene will write, see OutputFolder::noted().
    const std::set<std::string> &output_files() const { return output_files_; }

    /// Advances @p state to the end of @p settings by run_loop(), with the method and the control of the scene.
    void advance(const LoopSettings &settings, State &state, const std::vector<Observer *> &observers, Keeper *keeper = nullptr);

    /// Drops what solvers keep from step to step.
    void forget() { nonlinear_.forget(); }

    /// Puts what method and control remember into @p checkpoint, or gives it back to them. What solvers keep is dropped both times, so that
    /// one that goes on and one that comes back later are bit-equal.
    void keep(Checkpoint &checkpoint);
    void recall(const Checkpoint &checkpoint); ///< Gives back what keep() put there.

    /// Goes on from @p checkpoint, of this scene, instead of the initial state.
    void resume(const Checkpoint &checkpoint);

    /// Advances to the end; keeps the run in @p folder. A signal for which @p stop returns a number ends it (Interrupted).
    void run(const std::vector<Observer *> &observers, const std::filesystem::path &folder, const std::function<int()> &stop);

    /// Steps as planned, with landings on events, if every step succeeds.
    struct StepPlan
    {
      /// Steps of one size.
      struct Run
      {
        std::size_t count; ///< of steps of one size, up to rounding
        double      size;  ///< [s]
      };
      static constexpr std::size_t limit = 1000000; ///< steps that are looked at

      std::vector<Run> runs;            ///< in their order
      std::size_t      n_steps  = 0;    ///< in these runs
      bool             complete = true; ///< false: there are more steps than the limit, of which these are the first
    };
    /// None if steps are chosen by error.
    std::optional<StepPlan> planned_steps() const;

  private:
    void                             refuse_ignored_inertia() const;
    void                             refuse_tiny_steps() const;
    std::vector<const scene::Node *> intervals() const;

    void        make_method();
    int         stop_signal() const; ///< the same on all ranks
    TimeMethod &time_method() const;
    void        find_equilibrium(State &state);

    scene::Node                          scene_;
    const InstructionSet                 instruction_set_; ///< of the cell kernels
    std::map<std::string, std::string>   inputs_;
    std::set<std::string>                output_files_;
    WorkLedger                           ledger_;
    AssembledSystem                      assembled_;
    const IntegratorEntry               &method_;
    LoopSettings                         settings_;
    std::function<int()>                 signal_; ///< of this rank, while the run runs
    LinearSolver                         linear_;
    NonlinearSolver                      nonlinear_;
    std::unique_ptr<ErrorNorm>           error_norm_;
    std::unique_ptr<Integrator>          integrator_; ///< with its control_, or
    std::unique_ptr<StepControl>         control_;
    std::unique_ptr<SelfPacedIntegrator> self_paced_; ///< one that needs none
    std::optional<State>                 resumed_;
    std::vector<std::string>             solver_plan_;
  };
} // namespace myolines
