// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle3d/muscle3d_system.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace myolines
{
  /// Where stress comes from.
  enum StressPart
  {
    volumetric_part,   ///< p J H, of all tissues
    muscle_active,     ///< active fibres of muscle
    muscle_passive,    ///< passive fibres of muscle
    muscle_base,       ///< isotropic part of muscle
    aponeurosis_fibre, ///< fibres of aponeurosis
    aponeurosis_base,  ///< isotropic part of aponeurosis
    tendon_fibre,      ///< fibres of tendon
    tendon_base,       ///< isotropic part of tendon
    fat_part,          ///< fat within any of them
    n_stress_parts     ///< of the printed tissues; laws have theirs behind
  };

  /// A quantity split by the part of the stress it comes from. The parts add up to the total: each has its weight in the mix.
  template <typename T>
  struct Parts
  {
    std::array<T, n_stress_parts> part{}; ///< by StressPart
    std::vector<T>                laws;   ///< as Muscle3dParameters::law_parts()

    ///@{
    /// The quantity of one part.
    T       &operator[](const StressPart p) { return part[p]; }
    const T &operator[](const StressPart p) const { return part[p]; }
    ///@}

    /// The sum of all parts but the volumetric one.
    T isochoric() const
    {
      T sum{};
      for (unsigned int p = volumetric_part + 1; p < n_stress_parts; ++p)
        sum += part[p];
      for (const T &law : laws)
        sum += law;
      return sum;
    }
    T total() const { return part[volumetric_part] + isochoric(); } ///< The sum of all parts.

    /// f(part of this, same part of @p other) for all; this may have no laws yet.
    template <typename Other, typename Function>
    void for_each(const Parts<Other> &other, const Function &f)
    {
      laws.resize(other.laws.size());
      for (unsigned int p = 0; p < n_stress_parts; ++p)
        f(part[p], other.part[p]);
      for (std::size_t l = 0; l < laws.size(); ++l)
        f(laws[l], other.laws[l]);
    }
    /// f(part) for all.
    template <typename Function>
    void for_each(const Function &f)
    {
      for (T &one : part)
        f(one);
      for (T &one : laws)
        f(one);
    }
  };

  /// Which points of the muscle the slab averages use: those from 3/8 to 5/8 of the line of action, X_1 in [3/8 L, 5/8 L] of the thesis, or
  /// those nearest to its middle if none is in there.
  enum class SlabRule
  {
    quadrature_points, ///< by quadrature point, (6.2.20)
    whole_cells        ///< by cell centre, as Flexodeal
  };

  /// Rates of work at one state [W].
  struct Powers
  {
    double active_power =
        0; ///< what the active stress would do isometrically, - int sigma0 a sA lam-dot/lam, positive while fibres shorten
    double dissipation      = 0; ///< int sigma0 a sA (sV - 1) lam-dot/lam >= 0, and what laws dissipate
    double body_force_power = 0; ///< of the force per volume
    double traction_power   = 0; ///< of pressures, isotonic loads and far ends of tendons too
  };
  /// Walks over the body only if it is active. @p side here and below: the limit of given functions at a kink.
  Powers measure_powers(const Muscle3dSystem &system, const State &state, Side side = Side::left);

  /// Integrals over the body at one state. Energies of the true balance are in joules; work-like densities (6.2.3)-(6.2.11) are in J/m^3 of
  /// current volume.
  struct BodyMeasures : Powers
  {
    double        volume            = 0; ///< current [m^3]
    double        kinetic           = 0; ///< [J]
    double        stored_volumetric = 0; ///< int Psi_vol(D_h) [J]
    double        stored_base       = 0; ///< int Yeoh energies, fat included [J]
    double        stored_passive    = 0; ///< int sigma0 int sP/lam dlam, of the muscle [J]
    double        stored_springs    = 0; ///< in elastic foundations, tendons and stops at faces [J]
    double        stored_tendinous  = 0; ///< int sigma0 int sT/lam dlam from rest, of aponeurosis and tendon [J]
    double        stored_laws       = 0; ///< of the laws that are added to tissues [J]
    Parts<double> work_density;          ///< (6.2.3)-(6.2.11) [J/m^3]

    std::vector<double> stored_by_law; ///< of each of them, as Muscle3dParameters::law_parts() [J]; zero where a law has no energy

    double               slab_volume      = 0; ///< current [m^3]
    double               mean_stretch     = 0; ///< (6.2.22), |F a0|; means of a body without muscle, or line of action, are not numbers
    double               mean_pennation   = 0; ///< (6.2.25), between fibre and line of action, neither with a sense [degree]
    double               mean_strain_rate = 0; ///< (6.2.21), non-dimensional, d|F a0|/dt / e0
    dealii::Tensor<1, 3> mean_velocity;        ///< (6.2.19) [m/s]

    double l2_displacement = 0; ///< [m^2.5]
    double l2_pressure     = 0; ///< [Pa m^1.5]
    double min_jacobian    = 0; ///< smallest det F at a quadrature point
    double max_jacobian    = 0; ///< largest
  };
  /// All of these in one walk over the body. Collective.
  BodyMeasures measure_body(const Muscle3dSystem &system, const State &state, SlabRule rule, Side side = Side::left);

  /// Size of the middle of the body: how far the nodes of the slab reach across the line of action [m].
  struct MiddleSize
  {
    double width     = 0; ///< across line and thickness
    double thickness = 0; ///< along the thickness
  };
  /// @p thickness: unit vector across the line of action, which the system must have.
  MiddleSize measure_middle(const Muscle3dSystem &system, const State &state, const dealii::Tensor<1, 3> &thickness);

  /// The direction of the thickness: that of the line of action or, where it has none, that in which the fibres of the slab lean from the
  /// line at rest; nothing where they do not lean, or lean to all sides. Collective.
  std::optional<dealii::Tensor<1, 3>> thickness_direction(const Muscle3dSystem &system);

  /// Force with which each boundary condition that reacts pulls on the muscle, in the order of the scene: the residual summed over the
  /// components that it prescribes or ties, and its loads and the forces of its springs and dashpots. An unknown on a shared edge belongs
  /// to the later condition.
  struct Reaction
  {
    std::string         condition; ///< its name in the scene
    Vector3             force;     ///< [N]
    double              power = 0; ///< of the residual at the prescribed velocity [W]
    std::vector<double> own;       ///< columns that the condition adds
  };
  /// One entry for each condition that reacts. Collective.
  std::vector<Reaction> measure_reactions(const Muscle3dSystem &system, const State &state, Side side = Side::left);

  /// Kinetic and stored energy [J].
  double energy(const BodyMeasures &body);
  /// Rates for the balance of energy: active, dissipated, and those of loads and moving faces [W].
  EnergyRates energy_rates(const Powers &powers, const std::vector<Reaction> &reactions);

} // namespace myolines
