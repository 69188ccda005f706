// SPDX-License-Identifier: LGPL-2.1-or-later
#include "assemble.h"

#include <myolines/measures/body_facts.h>
#include <myolines/measures/rigid_motions.h>
#include <myolines/muscle3d/muscle3d_system.h>
#include <myolines/muscle3d/plausibility.h>

namespace myolines
{
  using scene::Node;

  namespace
  {
    std::vector<const Drive *> drives_of(const Muscle3dParameters &parameters)
    {
      std::vector<const Drive *> drives = parameters.activation_drives();
      for (const auto &condition : parameters.boundary)
        for (const Drive *drive : condition->drives())
          drives.push_back(drive);
      return drives;
    }

    /// @p what needs a body that is held.
    void refuse_free_motions(const Muscle3dSystem &body, const Node &node, const std::string &parameter, const std::string &what)
    {
      const FreeMotions free = free_motions(body.parameters(), body.discretisation());
      if (free.any())
        node.refuse(parameter, what + " needs a body that is held; nothing holds this one against " + free.words(),
                    "boundary conditions or springs against all rigid motions, or a dynamic body that starts as given");
    }

    void require_equilibrium(const Muscle3dSystem &body, const Node &node, const std::string &parameter)
    {
      if (body.parameters().initial.has_displacement())
        node.refuse(parameter, "the scene gives initial displacements, which an equilibrium would replace",
                    "\"as given\", or no displacements in \"system/initial motion\"");
      refuse_free_motions(body, node, parameter, "an equilibrium");
    }
  } // namespace

  AssembledSystem make_muscle3d(const Node &node, WorkLedger &ledger, const InstructionSet set)
  {
    auto                     system     = std::make_unique<Muscle3dSystem>(read_muscle3d(node), MPI_COMM_WORLD, ledger, set);
    const Muscle3dParameters parameters = system->parameters();
    std::vector<std::string> plan       = system->plan();
    plan.push_back("cells: " + std::to_string(system->n_cells()));

    const std::string why_no_line = system->line_of_action().why_none;
    AssembledSystem   assembled   = assemble(std::move(system), ledger);
    assembled.plan                = std::move(plan);
    assembled.warnings            = implausible_values(parameters);
    note_drives(drives_of(parameters), assembled);
    if (parameters.force_velocity())
      assembled.why_iterate = "Nothing mends the volume that a linear step has spoiled, nor what it does where the force-velocity relation "
                              "bends: steps have to be of 0.1 ms or less, and longer ones may be wrong without failing";
    const auto &body = dynamic_cast<const Muscle3dSystem &>(*assembled.system);
    if (!parameters.dynamic)
      refuse_free_motions(body, node, "inertia", "a quasi-static system");
    assembled.require_equilibrium = [&body](const Node &time, const std::string &parameter) { require_equilibrium(body, time, parameter); };
    assembled.measure             = [&body] { return body_facts(body); };
    if (!why_no_line.empty())
      assembled.warnings.push_back("there is no line of action: " + why_no_line +
                                   "; forces, lengths and means along it are left out. A list \"line of action\" in \"system\" gives one");
    if (parameters.dynamic && parameters.degree == 2 && parameters.n_points < 4)
      assembled.warnings.push_back("dynamic runs of degree 2 want at least 4 quadrature points per direction, this scene has " +
                                   std::to_string(parameters.n_points));
    return assembled;
  }

  SizeEstimate muscle3d_size(const Node &node, const unsigned int ranks)
  {
    const Muscle3dSizes sizes = estimate_sizes(read_muscle3d(node), ranks);
    return {sizes.n_unknowns, sizes.bytes, sizes.matrix_bytes, false, sizes.tangent_bytes, sizes.patch_bytes, sizes.coarse_bytes};
  }
} // namespace myolines
