// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "advise_reference.h"

namespace myolines::study
{
  /// The mesh to take, and what its cells do to the quantities and to the CPU time.
  struct MeshChoice
  {
    const Rung *pilot = nullptr;   ///< mesh of the pilot; nullptr: that of the scene, beside which there is none
    const Rung *rung  = nullptr;   ///< that is taken, likewise
    Values      errors;            ///< likely, of the quantities; 0 where the mesh is kept
    std::size_t rung_of_reference; ///< with which the reference has run on the meshes
    double      start_up = 0;      ///< CPU time before the steps [s]
    double      growth   = 1;      ///< of the CPU time of the steps, from the mesh of the pilot

    /// CPU time of @p run of the pilot on this mesh [s].
    double seconds_of(const PilotRun &run) const { return start_up + growth * run.seconds_of_steps(); }
  };

  /// The mesh of the pilot: the coarsest.
  const Rung *mesh_of_the_pilot(const Ladder &mesh);

  /// See advise_command(). @throws SolveError if no mesh is fine enough.
  MeshChoice choose_mesh(Pilot &pilot, const Choices &choices, const TimeReference &reference, const AdviseOptions &options);
} // namespace myolines::study
