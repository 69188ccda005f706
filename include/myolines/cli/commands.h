// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/cli/mpi_session.h>
#include <myolines/scene/scene.h>
#include <myolines/study/advise.h>
#include <myolines/study/command.h>
#include <myolines/time/loop.h>

#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace myolines
{
  // The commands of the program, one function each. They print to @p out (rank 0 only has a real one) and throw
  // InputError, SolveError and Interrupted.

  /// What `run` is asked for.
  struct RunOptions
  {
    std::filesystem::path    scene;                  ///< file of the scene
    std::filesystem::path    folder;                 ///< empty: results/ and the name of the scene without extension
    std::vector<std::string> overrides;              ///< "path=value", in their order
    bool                     quiet     = false;      ///< no line for each step on the terminal
    bool                     resume    = false;      ///< go on from the checkpoint in the folder
    bool                     overwrite = false;      ///< results of other scenes in the folder go
    std::string              program   = "myolines"; ///< as it was called, for hints
    std::string              command_line;           ///< for the manifest
    std::string              instruction_set;        ///< of the cell kernels; empty: the widest that the processor has

    std::optional<scene::Node> made;     ///< the scene itself, made by a program: `scene` only names it, and nothing overrides it
    std::vector<Observer *>    watchers; ///< who else watches the run
  };
  /// Runs a scene to its end, or goes on with it, and prints where the results are.
  void run_command(const RunOptions &options, std::ostream &out);

  /// Prints the resolved scene, what will be computed, what is skipped and why, sizes, method and steps. If @p brief, only unknowns, steps,
  /// memory, predicted_cost() and warnings.
  void check_command(const std::filesystem::path &scene, const std::vector<std::string> &overrides, bool brief, std::ostream &out);

  /// Writes the mesh of @p scene, refined as it is there, to @p file: VTK or Gmsh by its ending.
  void mesh_command(const std::filesystem::path &scene, const std::vector<std::string> &overrides, const std::filesystem::path &file,
                    std::ostream &out);

  /// Prints growth rates and frequencies of small motions about the initial state of @p scene, and the rows of modes.csv into @p file,
  /// unless that is empty.
  void modes_command(const std::filesystem::path &scene, const std::vector<std::string> &overrides, const std::filesystem::path &file,
                     std::ostream &out);

  /// What `modes --along` is asked for.
  struct ModesAlongOptions
  {
    std::filesystem::path    scene;      ///< file of the scene
    std::vector<std::string> overrides;  ///< "path=value", in their order
    std::filesystem::path    run;        ///< output folder of a run of the scene that kept states
    std::optional<double>    at;         ///< only that time [s]; none: all of them
    unsigned int             number = 4; ///< of eigenvalues
    std::filesystem::path    file;       ///< empty: modes.csv in the folder of the run
  };
  /// Prints and writes the smallest eigenvalues of the tangent at the states that a run has kept; see tangent_eigenvalues().
  void modes_along_command(const ModesAlongOptions &options, std::ostream &out);

  /// Runs the study that @p options describe as runs of this program; what they leave open is set here. Cases of one rank run in copies
  /// of this process unless @p mpi was started, so that the libraries are loaded once.
  void study_command(study::Options options, bool quiet, MpiSession &mpi, std::ostream &out);

  /// Estimates the errors of steps and mesh of a scene; what @p options leave open is set here. Runs are started as above.
  void verify_command(study::VerifyOptions options, bool quiet, MpiSession &mpi, std::ostream &out);

  /// Advises method, steps and mesh for an accuracy; likewise.
  void advise_command(study::AdviseOptions options, bool quiet, MpiSession &mpi, std::ostream &out);

  /// The words `list` accepts.
  std::vector<std::string> list_topics();
  /// All items of a topic with a sentence each, or, with a @p name, everything about that one.
  void list_command(const std::string &topic, const std::string &name, std::ostream &out);

  /// Prints a complete commented scene; without an @p integrator with the method to begin with and steps chosen by error.
  void template_command(const std::string &system, const std::string &integrator, std::ostream &out);
} // namespace myolines
