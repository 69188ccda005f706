// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/cli/experiment.h>
#include <myolines/system/steered_drive.h>

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace myolines
{
  /// A scene that is advanced piece by piece, looked at and steered in between: for controllers in the loop and for programs of one's own.
  /// It steps as a run of the scene does: it lands on kinks and on the ends of the planned steps, and repeats steps that fail. Advanced
  /// from one end of a step to another, and not steered, it is bit-equal to that run: what solvers keep is dropped after the same steps.
  /// Nothing is written. All members are collective.
  class Simulation
  {
  public:
    /// Begins at `time/start`, with the state of the scene.
    explicit Simulation(scene::Node scene, InstructionSet instruction_set = widest_instruction_set());

    Experiment       &experiment() { return experiment_; }         ///< system, method and outputs
    const State      &state() const { return state_; }             ///< at the present time
    std::size_t       steps() const { return followed_.steps; }    ///< accepted so far
    const StepRecord &last_step() const { return followed_.last; } ///< the last accepted one

    /// Advances to @p t exactly. @p between is called after every accepted step but the last; what it throws ends the advance there.
    /// @throws InputError for a time before the present one or after `time/end`; SolveError where the control gives up. The state is then
    /// that of the last accepted step.
    void advance_to(double t, const std::function<void()> &between = {});

    /// The drives of type `steered`, to be set between steps: from the present time on, where the method restarts. Until the first step,
    /// what is set holds from the beginning, and the initial state is that which belongs to it.
    /// @throws InputError with the nearest name for a path that is not steered.
    Steering &steering(const std::string &path);
    void      steer(const std::string &path, double value, double duration = 0);   ///< Steering::go_to()
    void      steer(const std::string &path, std::shared_ptr<const Drive> course); ///< Steering::follow()

    /// all drives of type `steered`
    const std::vector<std::shared_ptr<Steering>> &steered() const { return experiment_.assembled().steered; }

    /// A number of a table that a run of the scene writes.
    struct Measured
    {
      std::string table;  ///< "forces.csv"
      std::string column; ///< "Force [N]"
      double      value;  ///< not a number where it is not defined
    };
    /// What the list `output` asks for, at the present state: loads are those with which the last step ended, at the start those with which
    /// the first begins.
    const std::vector<Measured> &measure();

    /// A moment to come back to.
    struct Moment
    {
      Checkpoint                     run;     ///< state, method and control
      std::vector<Steering::Courses> courses; ///< of the steered drives, in their order
      bool                           begun;   ///< whether the method has started
    };
    Moment save();                        ///< The present moment.
    void   restore(const Moment &moment); ///< Goes back to it, steered drives included. @throws InputError for one of another scene.

    /// The same as a file, which a later program reads with the same scene; of what steers it, it has nothing. @throws InputError for
    /// files that are damaged or of another scene.
    void save(const std::filesystem::path &file);
    void restore(const std::filesystem::path &file); ///< Goes on from such a file.

  private:
    struct Followed : Observer
    {
      void begin(const State &) override { begun = true; }
      void accepted(const State &, const StepRecord &record) override
      {
        last = record;
        ++steps;
      }

      StepRecord  last;
      std::size_t steps = 0;
      bool        begun = false; ///< the method has started
    };

    bool forgets(std::size_t step) const; ///< as a run does that keeps its state after it

    Experiment                             experiment_;
    State                                  state_;
    Followed                               followed_;
    std::vector<Observer *>                observers_;
    std::vector<Measured>                  measured_;
    std::vector<std::unique_ptr<Observer>> tables_; ///< made when they are asked for first; their rows go to measured_
  };
} // namespace myolines
