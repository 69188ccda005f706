// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/output/checkpoint.h>
#include <myolines/time/loop.h>

#include <chrono>
#include <functional>
#include <optional>

namespace myolines
{
  /// Parameters of the list `checkpoint`.
  scene::Schema checkpoint_schema();

  /// What a run is made of; borrowed.
  struct RunParts
  {
    const SemiDiscreteSystem          &system;          ///< what is advanced
    const TimeMethod                  &integrator;      ///< by what
    const StepControl                 *control;         ///< or none: the integrator chooses its steps
    const std::vector<Observer *>     &observers;       ///< outputs
    WorkLedger                        &ledger;          ///< of the run
    std::string                        scene;           ///< every value in force
    std::map<std::string, std::string> inputs;          ///< see Checkpoint
    std::string                        instruction_set; ///< of the cell kernels
    std::function<void()>              forget;          ///< drops what solvers keep from step to step
    std::function<int()>               stop_signal;     ///< the signal that asks the run to stop, the same on all ranks; 0: none has come
  };

  /// Saves a run where its list `checkpoint` says so, where a signal stops it, and where it ends.
  ///
  /// After every so many steps solvers forget what they kept, whether or not the state is written then, so that a run that
  /// goes on and one that resumes are bit-equal and do not depend on the speed of the machine. Saved elsewhere, a run that resumes
  /// agrees with one that was not stopped to the tolerance of the solvers.
  ///
  /// The start is saved as well, so that a run whose first step fails can be resumed.
  ///
  /// Where the list has a list `keep`, states on the way are kept as well, in the folder `states`; those of steps to come, which a run
  /// that was stopped may have left, go first.
  ///
  /// Ledger: "checkpoints"; seconds of "checkpoint".
  class CheckpointKeeper : public Keeper
  {
  public:
    /// @p checkpoint is the list of that name; files go to @p folder.
    CheckpointKeeper(const scene::Node &checkpoint, RunParts run, const std::filesystem::path &folder);

    void                       begun(const State &state) override;
    void                       accepted(const State &state, std::size_t step) override;
    std::optional<std::string> reason_to_stop(const State &state, std::size_t step) override;
    void                       ended(const State &state, std::size_t step) override;

  private:
    bool time_to_write() const; ///< the same on all ranks
    void write(const State &state, std::size_t step, const std::filesystem::path &file);
    void keep(const State &state, std::size_t step); ///< if the list `keep` says so
    void sweep(std::size_t step);                    ///< removes kept states from that step on

    RunParts                              run_;
    std::filesystem::path                 folder_;
    std::size_t                           every_;
    std::optional<std::size_t>            keep_every_;
    bool                                  swept_ = false;
    double                                seconds_;
    std::chrono::steady_clock::time_point written_at_;
    Archive                               control_; ///< after the last accepted step, without the rejections since
  };
} // namespace myolines
