// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/boundary/face_mean.h>
#include <myolines/muscle3d/body_measures.h>

#include <map>
#include <optional>
#include <vector>

namespace myolines
{
  /// What moves at the ends of the line of action, and the face whose force is reported; nothing where the body has no such line, or face.
  struct EndPoints
  {
    EndPoints(const Muscle3dSystem &system, std::optional<unsigned int> force_face); ///< Collective.

    std::optional<FaceMean> from;       ///< face where the line of action begins
    std::optional<FaceMean> to;         ///< face where it ends
    std::optional<FaceMean> force_face; ///< face whose force is reported
  };

  /// What the files of a muscle run may want to know of one state, each measured on first use and then shared: a row of
  /// every file costs one pass over the body, and nothing that no file asks for is measured.
  /// All ranks must ask for the same things in the same order. Borrows everything.
  ///
  /// Ledger: "body measurements", "power measurements", "reaction measurements", "face force measurements".
  class Muscle3dSample
  {
  public:
    /// Measures nothing yet.
    Muscle3dSample(const Muscle3dSystem &system, const State &state, Side side, SlabRule slab, const EndPoints &ends, WorkLedger &ledger);

    const Muscle3dSystem &system() const { return system_; } ///< that of the run
    const State          &state() const { return state_; }   ///< the state that is measured
    double                t() const { return state_.t; }     ///< its time [s]
    Side                  side() const { return side_; }     ///< the limit of given functions at a kink

    const BodyMeasures                &body() const;                        ///< integrals over the body
    Powers                             powers() const;                      ///< less work than body(), and none if that was measured
    EnergyRates                        energy_rates() const;                ///< of powers() and reactions() [W]
    Energetics                         energetics() const;                  ///< energy of body(), with its rates
    const std::vector<Reaction>       &reactions() const;                   ///< of all conditions that react
    const Parts<dealii::Tensor<1, 3>> &face_force(unsigned int face) const; ///< interior_point_force() of the face [N]

    Activation activation() const; ///< [-], on the side of the state at a kink
    /// Length of the body along the line of action: at rest, and what the faces at its ends have moved apart in the mean [m].
    double muscle_length() const;
    /// Part along the line of action of the mean velocity of the force face [m/s].
    double force_face_speed() const;

  private:
    const Muscle3dSystem &system_;
    const State          &state_;
    Side                  side_;
    SlabRule              slab_;
    const EndPoints      &ends_;
    WorkLedger           &ledger_;

    mutable std::optional<BodyMeasures>                         body_;
    mutable std::optional<Powers>                               powers_;
    mutable std::optional<std::vector<Reaction>>                reactions_;
    mutable std::map<unsigned int, Parts<dealii::Tensor<1, 3>>> forces_; ///< by face
  };
} // namespace myolines
