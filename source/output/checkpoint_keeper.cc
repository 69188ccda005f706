// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/output/checkpoint_keeper.h>
#include <myolines/output/text_file.h>

#include <deal.II/base/mpi.h>

#include <cstring>

namespace myolines
{
  scene::Schema checkpoint_schema()
  {
    scene::Schema checkpoint(
        "States to resume from with --resume. The last state is always saved: at the end, on a signal, after a failure.");
    checkpoint
        .integer("every", 10, scene::Range::closed(1, 1e9),
                 "A state can be saved after every so many accepted steps; solvers keep nothing beyond them.")
        .number("seconds", 600, "s", scene::Range::not_negative(), "Least wall-clock time between two states that are saved.")
        .optional_section("keep",
                          scene::Schema("Further states that are kept, in the folder states: what `myolines compare` can look at before "
                                        "the end.")
                              .integer("every", 1, scene::Range::closed(1, 1e9), "Kept after every so many accepted steps."));
    return checkpoint;
  }

  CheckpointKeeper::CheckpointKeeper(const scene::Node &checkpoint, RunParts run, const std::filesystem::path &folder)
    : run_(std::move(run))
    , folder_(folder)
    , every_(checkpoint.integer("every"))
    , seconds_(checkpoint.number("seconds"))
    , written_at_(std::chrono::steady_clock::now())
  {
    if (checkpoint.has("keep"))
      keep_every_ = checkpoint.section("keep").integer("every");
    if (run_.control != nullptr)
      run_.control->save(control_);
  }

  void CheckpointKeeper::begun(const State &state) { write(state, 0, checkpoint_file(folder_)); }

  std::optional<std::string> CheckpointKeeper::reason_to_stop(const State &state, const std::size_t step)
  {
    if (const int signal = run_.stop_signal())
      return std::string("asked to stop by the signal \"") + strsignal(signal) + "\" after step " + std::to_string(step) +
             " at t = " + exact_text(state.t) + " s";
    return std::nullopt;
  }

  void CheckpointKeeper::accepted(const State &state, const std::size_t step)
  {
    if (run_.control != nullptr)
      run_.control->save(control_);
    keep(state, step);
    if (step % every_ == 0)
      {
        run_.forget();
        if (time_to_write())
          write(state, step, checkpoint_file(folder_));
      }
  }

  void CheckpointKeeper::ended(const State &state, const std::size_t step)
  {
    if (step > 0)
      keep(state, step);
    write(state, step, checkpoint_file(folder_));
  }

  void CheckpointKeeper::keep(const State &state, const std::size_t step)
  {
    if (!swept_)
      sweep(step);
    if (!keep_every_ || step % *keep_every_ != 0)
      return;
    if (writes_files())
      make_folder(kept_state_file(folder_, step).parent_path());
    write(state, step, kept_state_file(folder_, step));
  }

  void CheckpointKeeper::sweep(const std::size_t step)
  {
    if (writes_files())
      for (const std::filesystem::path &file : kept_state_files(folder_))
        if (file >= kept_state_file(folder_, step))
          remove_file(file);
    swept_ = true;
  }

  bool CheckpointKeeper::time_to_write() const
  {
    // The clock of one rank decides for all, as writing is collective.
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - written_at_).count();
    return dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, elapsed >= seconds_);
  }

  void CheckpointKeeper::write(const State &state, const std::size_t step, const std::filesystem::path &file)
  {
    {
      const WorkLedger::Timer timer(run_.ledger, "checkpoint");
      run_.ledger.count("checkpoints");
      Checkpoint checkpoint;
      checkpoint.step  = step;
      checkpoint.state = state;
      run_.integrator.save(checkpoint.integrator);
      checkpoint.control = control_;
      for (const Observer *observer : run_.observers)
        observer->save(checkpoint.outputs);
      checkpoint.ledger          = run_.ledger;
      checkpoint.scene           = run_.scene;
      checkpoint.inputs          = run_.inputs;
      checkpoint.ranks           = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
      checkpoint.instruction_set = run_.instruction_set;
      write_checkpoint(file, checkpoint, run_.system);
    }
    if (file == checkpoint_file(folder_))
      written_at_ = std::chrono::steady_clock::now();
  }
} // namespace myolines
