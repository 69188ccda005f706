#pragma once

#include <myolines/cli/catalogue.h>
#include <myolines/solve/nonlinear_solver.h>
#include <myolines/time/step_control.h>

#include <memory>

namespace myolines
{
  /// Everything a run needs, built from a validated scene; what ranges cannot express is refused here (InputError).
  class Experiment
  {
  public:
    explicit Experiment(scene::Node scene);

    const scene::Node     &scene() const { return scene_; }
    const AssembledSystem &assembled() const { return assembled_; }
    const MethodFacts     &method() const { return method_.facts; }
    const LoopSettings    &settings() const { return settings_; }
    WorkLedger            &ledger() { return ledger_; }

    /// Advances from the initial state to the end.
    void run(const std::vector<Observer *> &observers);

    /// Sizes of the steps as planned [s], with landings on events, if every step succeeds.
    std::vector<double> planned_steps() const;

  private:
    void refuse_ignored_inertia() const;

    scene::Node                  scene_;
    WorkLedger                   ledger_;
    AssembledSystem              assembled_;
    const IntegratorEntry       &method_;
    LoopSettings                 settings_;
    LinearSolver                 linear_;
    NonlinearSolver              nonlinear_;
    std::unique_ptr<Integrator>  integrator_;
    std::unique_ptr<StepControl> control_;
  };
} // namespace myolines
