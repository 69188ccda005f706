// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle1d/muscle1d_system.h>
#include <myolines/muscle3d/muscle3d_system.h>
#include <myolines/oscillator/oscillator_system.h>
#include <myolines/output/output_folder.h>
#include <myolines/particles/particle_system.h>
#include <myolines/rod1d/rod1d_system.h>
#include <myolines/scene/scene.h>
#include <myolines/system/ledger.h>
#include <myolines/time/loop.h>

#include <filesystem>
#include <memory>
#include <vector>

namespace myolines
{
  ///@{
  /// Parameters of the list `output` for each system.
  scene::Schema muscle3d_output_schema();
  scene::Schema oscillator_output_schema();
  scene::Schema particle_output_schema();
  scene::Schema rod1d_output_schema();
  scene::Schema muscle_tendon_output_schema();
  scene::Schema isometric_chain_output_schema();
  ///@}

  ///@{
  /// The observers a scene asks for; they write into @p folder, which exists and is writable. Made on all ranks alike.
  std::vector<std::unique_ptr<Observer>> make_outputs(const scene::Node &output, const Muscle3dSystem &system, const OutputFolder &folder,
                                                      WorkLedger &ledger);
  std::vector<std::unique_ptr<Observer>> make_outputs(const scene::Node &output, const OscillatorSystem &system, const OutputFolder &folder,
                                                      WorkLedger &ledger);
  std::vector<std::unique_ptr<Observer>> make_outputs(const scene::Node &output, const ParticleSystem &system, const OutputFolder &folder,
                                                      WorkLedger &ledger);
  std::vector<std::unique_ptr<Observer>> make_outputs(const scene::Node &output, const Rod1dSystem &system, const OutputFolder &folder,
                                                      WorkLedger &ledger);
  std::vector<std::unique_ptr<Observer>> make_outputs(const scene::Node &output, const Muscle1dSystem &system, const OutputFolder &folder,
                                                      WorkLedger &ledger);
  ///@}
} // namespace myolines
