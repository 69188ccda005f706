// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/system/archive.h>
#include <myolines/system/ledger.h>
#include <myolines/system/semi_discrete_system.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace myolines
{
  /// Everything a run needs to go on where it was.
  struct Checkpoint
  {
    std::size_t  step = 0;        ///< accepted steps
    State        state;           ///< u, v, a and the time
    Archive      integrator;      ///< what the method remembers
    Archive      control;         ///< what the control of steps remembers
    Archive      outputs;         ///< what the observers remember
    WorkLedger   ledger;          ///< of rank 0
    std::string  scene;           ///< every value in force, as scene.resolved.xml
    unsigned int ranks = 1;       ///< that wrote it
    std::string  instruction_set; ///< of the cell kernels that computed it

    std::map<std::string, std::string> inputs; ///< files that the scene names, with their checksums
  };

  /// The file of @p folder that holds the state to resume from.
  std::filesystem::path checkpoint_file(const std::filesystem::path &folder);

  /// The file of @p folder that keeps the state after @p step, in the folder `states`.
  std::filesystem::path kept_state_file(const std::filesystem::path &folder, std::size_t step);

  /// All such files in @p folder, ascending in their steps.
  std::vector<std::filesystem::path> kept_state_files(const std::filesystem::path &folder);

  /// Writes @p checkpoint to @p file: first to a file beside it, then, when that is on the disk and has been read back, in one move;
  /// whenever the program is killed or the disk refuses, one whole checkpoint stands. Collective. Vectors are written in the canonical
  /// order of the system, bit by bit, and the integrator's with them; of outputs and control only numbers. Head and vectors have checksums.
  /// @throws SystemError if the disk refuses.
  void write_checkpoint(const std::filesystem::path &file, const Checkpoint &checkpoint, const SemiDiscreteSystem &system);

  /// Reads what write_checkpoint() wrote, on any number of ranks. Collective.
  class CheckpointReader
  {
  public:
    /// Reads all but the vectors. @throws InputError on all ranks if there is no file, or it is damaged, or not one of this version.
    explicit CheckpointReader(const std::filesystem::path &file);

    /// All but the vectors, which are empty.
    const Checkpoint &contents() const { return contents_; }

    /// Everything, vectors included, for the @p system that wrote it.
    /// @throws InputError if the file is damaged (a checksum differs, a number is not finite) or holds another number of unknowns.
    Checkpoint read(const SemiDiscreteSystem &system) const;

    /// All entries of u, v or a (@p name) in canonical order, without the system; on the rank that calls.
    /// @throws InputError if the file is damaged.
    std::vector<double> whole(const std::string &name) const;

  private:
    struct Block
    {
      std::string part; ///< "state" or "integrator"
      std::string name;
      std::string checksum; ///< of its bytes
    };

    void parse(const std::string &json);
    void require_whole(const Block &block, bool whole, const std::vector<double> &owned, MPI_Comm communicator) const;

    std::filesystem::path file_;
    Checkpoint            contents_;
    std::vector<Block>    blocks_;
    std::size_t           n_unknowns_ = 0;
    std::size_t           begin_      = 0; ///< of the vectors [bytes]
  };
} // namespace myolines
