#pragma once

#include <myolines/output/checkpoint.h>
#include <myolines/time/loop.h>

#include <chrono>
#include <functional>

namespace myolines
{
  /// Parameters of the list `checkpoint`.
  scene::Schema checkpoint_schema();

  /// What a run is made of; borrowed.
  struct RunParts
  {
    const SemiDiscreteSystem      &system;
    const TimeMethod              &integrator;
    const StepControl             *control; ///< or none: the integrator chooses its steps
    const std::vector<Observer *> &observers;
    WorkLedger                    &ledger;
    std::string                    scene;       ///< every value in force
    std::function<void()>          forget;      ///< drops what solvers keep from step to step
    std::function<int()>           stop_signal; ///< the signal that asks this rank to stop, 0 if none has come
  };

  /// Saves a run where its list `checkpoint` says so, where a signal stops it, and where it ends.
  ///
  /// After every so many steps solvers forget what they kept, whether or not the state is written then, so that a run that
  /// goes on and one that resumes are bit-equal and do not depend on the speed of the machine. Saved elsewhere, a run that resumes
  /// agrees with one that was not stopped to the tolerance of the solvers.
  ///
  /// Ledger: "checkpoints"; seconds of "checkpoint".
  class CheckpointKeeper : public Keeper
  {
  public:
    /// @p checkpoint is the list of that name; files go to @p folder.
    CheckpointKeeper(const scene::Node &checkpoint, RunParts run, const std::filesystem::path &folder);

    std::optional<std::string> accepted(const State &state, std::size_t step) override;
    void                       ended(const State &state, std::size_t step) override;

  private:
    bool time_to_write() const; ///< the same on all ranks
    void write(const State &state, std::size_t step);

    RunParts                              run_;
    std::filesystem::path                 file_;
    std::size_t                           every_;
    double                                seconds_;
    std::chrono::steady_clock::time_point written_at_;
    Archive                               control_; ///< after the last accepted step, without the rejections since
  };
} // namespace myolines
