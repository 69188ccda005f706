// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/output/output_folder.h>
#include <myolines/system/ledger.h>
#include <myolines/time/energy_balance.h>

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace myolines
{
  /// What manifest.json tells of a run beside program, versions and host.
  struct RunRecord
  {
    std::string                        command_line;      ///< as a shell would read it
    std::string                        scene;             ///< its file
    std::string                        started;           ///< as iso8601_now() gives it
    std::string                        resumed;           ///< from what; "" if the run began at its start
    std::map<std::string, std::string> inputs;            ///< files that it reads, with their checksums (CRC-32)
    std::optional<EnergyReport>        energy;            ///< none: nobody looked at it
    std::vector<std::string>           plan{};            ///< what it computes and skips
    std::vector<std::string>           warnings{};        ///< what was told before it began
    std::set<std::string>              outputs{};         ///< files that the outputs will write, see OutputFolder::noted()
    std::string                        instruction_set{}; ///< of the cell kernels

    /// What plug-ins bring ("integrator houbolt"), by their files, which are among the inputs.
    std::map<std::string, std::vector<std::string>> plugins = {};
  };

  /// manifest.json: version, git hash, library versions, ranks, host CPU, dates, input files, files noted in @p folder, exit reason;
  /// "finished" is the moment of writing. Rank 0 writes. Where the disk is full it is written over the one that is there.
  /// @throws SystemError if that is not possible either.
  void write_manifest(const OutputFolder &folder, const RunRecord &record, const std::string &exit_reason);

  /// The manifest of this program in @p folder: what it lists as files of the run, and as its exit reason. None if there is none.
  /// @throws InputError if manifest.json is there but not of this program, or damaged. On the rank that calls.
  struct Manifest
  {
    std::set<std::string> files;              ///< names relative to the folder, and patterns of OutputFolder::note()
    std::string           exit_reason;        ///< "done", "running", or why the run ended
    std::string           scene;              ///< its file; "" if the manifest does not say
    bool                  lists_files = true; ///< versions before 0.2 did not

    std::map<std::string, std::string> titles; ///< of tables, see OutputFolder::titles(); of runs that have them
  };
  std::optional<Manifest> read_manifest(const std::filesystem::path &folder); ///< That manifest.

  /// Adds @p names to the files that the manifest in @p folder lists, if there is one of this program. Rank 0 writes.
  void list_in_manifest(const std::filesystem::path &folder, const std::vector<std::string> &names);

  /// ledger.json: counts and seconds by phase, those of rank 0.
  void write_ledger(const OutputFolder &folder, const WorkLedger &ledger);
} // namespace myolines
