// SPDX-License-Identifier: LGPL-2.1-or-later
#include "study_options.h"
#include "option_checks.h"

namespace myolines
{
  void add_study_options(CLI::App &command, study::Options &options)
  {
    command.add_option("study", options.file, "The study")->required()->type_name("STUDY.xml");
    command.add_option("--out", options.folder, "Where to write; default: results/ and the name of the study")->type_name("DIR");
    command.add_option("--jobs", options.jobs, "Runs at a time; default: as many as there are cores for")->check(at_least_one());
    command.add_flag("--retry", options.retry, "Runs cases again that failed");
    CLI::Option *list = command.add_flag("--list", options.list, "Validates and prints the cases, and runs nothing");
    CLI::Option *part =
        command.add_option("--part", options.part, "Runs every OF-th case from the one of that number on")->type_name("NUMBER/OF");
    CLI::Option *emit =
        command
            .add_option("--emit", options.emit, "Writes a batch script instead: slurm (array job) or mpi (one job, its ranks in groups)")
            ->check(CLI::IsMember({"slurm", "mpi"}))
            ->excludes(part)
            ->excludes(list);
    part->excludes(list);
    command.add_option("--tasks", options.tasks, "Tasks of that array, or groups of ranks of that job")
        ->check(at_least_one())
        ->needs(emit)
        ->capture_default_str();
    command.add_option("--set", options.overrides, "Overrides a value of the study: \"budget/total=60\"; may be repeated")
        ->allow_extra_args(false)
        ->type_name("PATH=VALUE");
  }

  void add_quantity_options(CLI::App &command, study::QuantityOptions &options)
  {
    command
        .add_option("--quantity", options.quantities,
                    "A value: a column of a table that runs write, its last value or, with :largest, :smallest or \":at TIME\" after "
                    "it, that one; may be repeated")
        ->required()
        ->allow_extra_args(false)
        ->type_name("FILE:COLUMN");
    command.add_option("--out", options.folder, "Where to write; default: results/, the name of the scene and that of the command")
        ->type_name("DIR");
    command.add_option("--at-most", options.at_most, "CPU time of a run over that of the scene; longer ones are left out")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command.add_option("--ranks", options.ranks, "MPI ranks of each run")->check(at_least_one())->capture_default_str();
    command.add_option("--jobs", options.jobs, "Runs at a time; default: as many as there are cores for")->check(at_least_one());
    command.add_flag("--retry", options.retry, "Runs again what failed");
  }

  void add_advise_options(CLI::App &command, study::AdviseOptions &options)
  {
    command.add_option("--accuracy", options.accuracy, "That is wanted: a part of each value, \"1 %\", or a number in its unit, \"0.05\"")
        ->required()
        ->type_name("NUMBER[%]");
    command.add_flag("--keep-mesh", options.keep_mesh, "The mesh of the scene stays, and the accuracy is that of the steps alone");
    command.add_flag("!--no-trial", options.trial, "What runs on the coarsest mesh predict is not tried on the mesh that is advised");
    command.add_option("--budget", options.budget, "Seconds after which the search is left; called again it goes on")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command.add_option("--write", options.write, "Writes the scene that is advised to this file")->type_name("FILE.xml");
  }
} // namespace myolines
