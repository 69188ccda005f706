// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/lanes.h>
#include <myolines/base/registry.h>
#include <myolines/output/output_folder.h>
#include <myolines/scene/document.h>
#include <myolines/scene/scene.h>
#include <myolines/system/ledger.h>
#include <myolines/system/semi_discrete_system.h>
#include <myolines/time/loop.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace myolines
{
  class FileDrive;
  class ZajacActivation;
  class Steering;

  /// A system as a scene describes it.
  struct AssembledSystem
  {
    std::unique_ptr<SemiDiscreteSystem> system; ///< with the parameters of the scene

    /// Observers for the list `output`; they refer to the system.
    std::function<std::vector<std::unique_ptr<Observer>>(const scene::Node &output, const OutputFolder &folder)> make_outputs;

    std::vector<std::string> plan;     ///< what is computed, what is skipped and why, sizes
    std::vector<std::string> warnings; ///< valid, but probably not what is wanted

    std::string why_iterate; ///< why methods that solve linear systems and do not iterate serve badly, a sentence; "" where they serve

    std::vector<const FileDrive *>         files;            ///< that drive the system
    std::vector<const ZajacActivation *>   from_excitations; ///< activations that follow excitations, which must know where the run begins
    std::vector<std::shared_ptr<Steering>> steered;          ///< what else drives it and is set while it runs

    /// Throws an InputError at the place it gets where the system has no equilibrium to start from; empty: it always has.
    std::function<void(const scene::Node &time, const std::string &parameter)> require_equilibrium;

    std::function<std::vector<std::string>()> measure; ///< more lines, which take work; none where there are none
  };

  /// How large a system will be, known before it is made.
  struct SizeEstimate
  {
    double n_unknowns    = 0;     ///< on all ranks
    double bytes         = 0;     ///< on each rank: system and vectors of a run
    double matrix_bytes  = 0;     ///< on each rank: the assembled tangent
    bool   banded        = false; ///< solved directly in bytes, unless the scene names a preconditioner
    double tangent_bytes = 0;     ///< on each rank: what actions of the tangent keep
    double patch_bytes   = 0;     ///< on each rank: inverses of patches; 0: the system has no two levels
    double coarse_bytes  = 0;     ///< on each rank: what else two levels keep
  };

  /// A kind of unknowns that a system may have: with inertia, without, ...
  struct SystemVariant
  {
    std::string                 name;     ///< "quasi-static"; may be empty where there is one only
    std::vector<scene::Setting> settings; ///< what makes it of the example
  };

  /// Parameters of the mesh, by their paths in the list `system`; "" for none.
  struct MeshParameters
  {
    std::string cells{};        ///< "elements"
    bool        halves = false; ///< one more halves all cells; otherwise it is their number
    std::string degree{};       ///< of the elements
    std::string quadrature{};   ///< points per direction, which follow the degree
  };

  /// What a kind of system brings to scenes, help and templates.
  struct SystemEntry
  {
    std::string                    name;     ///< value of system/type
    std::function<scene::Schema()> schema;   ///< of the list `system`; plug-ins may have added to it since the last call
    std::function<scene::Schema()> output;   ///< of the list `output`, likewise
    std::vector<scene::Setting>    example;  ///< a small scene, without the integrator
    std::vector<SystemVariant>     variants; ///< what methods may take or not, the example itself first
    std::function<AssembledSystem(const scene::Node &, WorkLedger &, InstructionSet)> make; ///< kernels of that set, where it has some
    std::function<SizeEstimate(const scene::Node &, unsigned int ranks)>              size; ///< estimated from the list `system`
    MeshParameters                                                                    mesh; ///< for refinements
    std::function<bool(const scene::Node &)> inertia{}; ///< whether the list `system` describes one with inertia; empty: always
  };

  inline const std::string &name_of(const SystemEntry &entry) { return entry.name; } ///< For Registry.

  /// All systems, in the order of `myolines list systems`, then those of plug-ins. A new system is one more entry here.
  Registry<SystemEntry> &system_catalogue();

  /// The system of that name. @throws InputError with the nearest valid name; @p where is the place of the name.
  const SystemEntry &system_entry(const std::string &name, const std::string &where);

  /// The system of a whole @p scene, which read_whole_scene() gives. @p ledger outlives it. @throws InputError for what ranges cannot
  /// express.
  AssembledSystem make_system(const scene::Node &scene, WorkLedger &ledger, InstructionSet instruction_set = widest_instruction_set());

  /// The whole scene with the outputs of @p system, and its checkpoints.
  scene::Schema root_schema(const SystemEntry &system);

  /// Reads and validates @p file. Its plug-ins are loaded first (plugins.h); the outputs that a scene may ask for depend on its
  /// system/type, which is looked at next.
  scene::Node read_whole_scene(const std::filesystem::path &file, const std::vector<std::string> &overrides = {});

  /// The schema of the scene @p root, which has been parsed but not validated; @p name stands for its file in messages. Its plug-ins are
  /// loaded first. @throws InputError if it does not say which system it is of.
  scene::Schema schema_of(const scene::RawList &root, const std::string &name);

  /// The scene @p root, validated, with the first values of what it lacks and problems of what is wrong; relative paths start from
  /// @p folder. @p problems gets everything that is wrong, and the node is of use only if that is nothing.
  scene::Node build_whole_scene(const scene::RawList &root, const std::string &name, const std::filesystem::path &folder,
                                std::vector<InputProblem> &problems);
} // namespace myolines
