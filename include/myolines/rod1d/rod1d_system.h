// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/rod1d/rod1d_material.h>
#include <myolines/system/drive.h>
#include <myolines/system/ledger.h>
#include <myolines/system/semi_discrete_system.h>

#include <memory>
#include <vector>

namespace myolines
{
  /// What Rod1dSystem is made of.
  struct Rod1dParameters
  {
    double                       length           = 0.1;  ///< L [m]
    double                       area             = 1e-4; ///< of the cross-section [m^2]
    double                       density          = 1060; ///< rho [kg/m^3]
    unsigned int                 n_elements       = 8;    ///< of equal length
    unsigned int                 degree           = 2;    ///< 1 to 3
    double                       stiffness_factor = 1;    ///< multiplies P
    RodMaterial                  material;                ///< P(l)
    std::shared_ptr<const Drive> strain;                  ///< of the whole rod
  };

  scene::Schema   rod1d_schema();                        ///< Declaration of the list `system` of a rod.
  Rod1dParameters read_rod1d(const scene::Node &system); ///< Reads that list.

  /// Rod, thesis chapter 4: rho u_tt = P(1 + u_x)_x on (0, L), u(0, t) = 0, u(L, t) = L strain(t), at rest at the start. The
  /// cross-section multiplies all forces and plays no part in the motion. Elements of equal length and degree 1 to 3 with equidistant
  /// nodes, numbered along the rod; consistent mass, degree + 1 Gauss points. The rows of the residual at the ends are the forces that the
  /// supports exert [N]. Inadmissible: a stretch 1 + u_x <= 0 at a Gauss point of a material that has no stress there. One rank computes
  /// it.
  ///
  /// Split `linear`, thesis (4.7.7): the part mu (l - 1) of the Neo-Hookean stress is implicit; of a linear rod everything.
  class Rod1dSystem : public SemiDiscreteSystem
  {
  public:
    Rod1dSystem(Rod1dParameters parameters, WorkLedger &ledger); ///< All elements are alike and made once.
    ~Rod1dSystem() override;

    Capabilities                        capabilities() const override;
    std::size_t                         n_unknowns() const override { return layout_.size(); }
    State                               initial_state(double t0) const override;
    const Constraints                  &constraints() const override { return constraints_; }
    void                                prescribed(double t, Side side, State &state) const override;
    Evaluation                          residual(const Point &point, Vector &r) const override;
    std::unique_ptr<Linearisation>      make_linearisation() const override;
    void                                linearise(const Point &point, Linearisation &linearisation) const override;
    std::unique_ptr<SemiDiscreteSystem> implicit_part(const std::string &split) const override;
    Energetics                          energetics(const State &state, Side side) const override;
    std::vector<double>                 events(double t0, double t1) const override;

    const Rod1dParameters &parameters() const { return parameters_; } ///< those of the constructor

    /// Of the whole rod at one state [J].
    struct Energy
    {
      double kinetic = 0; ///< of the consistent mass
      double stored  = 0; ///< of the strain
    };
    Energy energy(const State &state) const; ///< Kinetic and stored energy of the whole rod.

    /// Of the moving end alone, the only one that brings energy: a look at the last element.
    EnergyRates energy_rates(const State &state) const;

    /// Position of node @p i [m].
    double position(unsigned int i) const;

    /// u_h at @p x in [0, L], from the nodal values @p u.
    double value(const Vector &u, double x) const;

  private:
    struct Element;

    Rod1dParameters                parameters_;
    WorkLedger                    &ledger_;
    std::unique_ptr<const Element> element_; ///< all elements are alike
    Constraints                    constraints_;
    Vector                         layout_;
  };
} // namespace myolines
