// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle1d/muscle1d_system.h>
#include <myolines/scene/scene.h>

#include <string>

namespace myolines
{
  /// What is known of a muscle and a task, thesis Table 2.1, for a subject of given mass and height.
  struct MuscleData
  {
    double maximum_stress      = 225e3; ///< sigma_0 [Pa]
    double maximum_strain_rate = 5;     ///< e_0 [1/s]
    Zajac  zajac;                       ///< time constants of the activation
    double volume_fraction;             ///< chi_M, of one lower leg
    double length_ratio;                ///< r_M, of muscle to muscle and tendon
    double unit_length;                 ///< optimal length of muscle and tendon [m]
    double density     = 1060;          ///< [kg/m^3]
    double body_mass   = 68;            ///< W [kg]
    double body_height = 1.67;          ///< H [m]

    /// @p muscle MG, VM or ST (medial gastrocnemius, vastus medialis, semitendinosus); @p task walking, running (subject 1) or
    /// cycling (subject 2). @throws std::out_of_range for others.
    static MuscleData table21(const std::string &muscle, const std::string &task);

    /// V = chi_M (47 W H + 1285) 1e-6 m^3, thesis (2.2.9), W in kg and H in m.
    double volume() const;
  };

  /// Optimal lengths of muscle and tendon whose passive forces balance, thesis (2.2.13)-(2.2.15): with the estimates l~_M = r_M l, l~_T =
  /// (1 - r_M) l and one correction d (errata 2), l_M = l~_M + d, l_T = l~_T - d and F_P(l~_M/l_M) = F_T(l~_T/l_T).
  struct OptimalLengths
  {
    double muscle; ///< [m]
    double tendon; ///< [m]
  };
  /// @throws SolveError if there is no such correction.
  OptimalLengths calibrate(double unit_length, double length_ratio);

  /// Length L_M of the muscle at which it and the tendon balance at rest in a unit of length @p unit_length [m], thesis (2.2.16)-(2.2.18)
  /// with the signs of errata 3: a F_A(L_M/l_M) + F_P(L_M/l_M) = F_T((L - L_M)/l_T), the solution next to @p estimate. @p activation zero
  /// is the passive balance of the thesis, which is not at rest where the muscle is active. @throws SolveError if there is none.
  double balanced_length(const OptimalLengths &optimal, double unit_length, double activation, double estimate);

  /// rho_0 l^2 e_0^2/sigma_0 with the muscle's length l, thesis (3.4.5): inertia over what force-velocity takes (errata 14 corrects
  /// Table 3.1).
  double musculoskeletal_reynolds_number(double density, double length, double maximum_strain_rate, double maximum_stress);

  /// A muscle of N masses with a tendon, N = 0: without mass; thesis chapter 2.
  scene::Schema muscle_tendon_unit_schema();
  /// Reads that list. @throws InputError for what ranges cannot express.
  Muscle1dParameters read_muscle_tendon_unit(const scene::Node &system);

  /// The same muscle as a continuum, thesis (3.3.6) with the tendon's force at its end, and base material (3.3.11).
  scene::Schema continuum_muscle_schema();
  Muscle1dParameters
  read_continuum_muscle(const scene::Node &system); ///< Reads that list. @throws InputError for what ranges cannot express.
} // namespace myolines
