// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/materials/curves.h>
#include <myolines/muscle3d/loads.h>
#include <myolines/muscle3d/muscle3d_system.h>
#include <myolines/system/linearised_system.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace myolines
{
  namespace
  {
    /// Estimates the largest eigenvalue of M^-1 C [1/m^2] at rest for viscosity and density one, stress n (n : grad v), n = a0 (x) a0 -
    /// I/3. A wave of v with wave vector k has |n k|^2 = (a0.k)^2/3 + |k|^2/9, and k_i^2 is at most the eigenvalue of a single free
    /// element.
    double largest_rate_eigenvalue(const Muscle3dParameters &p)
    {
      const double of_element[] = {12, 60, 170.125}; // times 1/h^2, degree 1 to 3, consistent mass
      double       along = 0, sum = 0;
      for (unsigned int i = 0; i < 3; ++i)
        {
          const double h = p.geometry.size[i] / (p.geometry.cells[i] * std::exp2(p.geometry.refinement));
          along += std::abs(p.muscle().fibre.direction[i]) / h;
          sum += 1 / (h * h);
        }
      return of_element[p.degree - 1] * (along * along / 3 + sum / 9);
    }

    /// Why splits that leave the active stress explicit are refused where it depends on the strain rate; else empty.
    std::string why_refused(const Muscle3dParameters &p)
    {
      if (!p.active() || !p.muscle().fibre.force_velocity)
        return "";
      const FibreParameters    &fibre  = p.muscle().fibre;
      const curves::FibreCurves curves = p.fibre_curves();
      const double              viscosity =
          fibre.sigma0 * curves::active(1., &curves).value * curves::force_velocity(0., &curves).slope / fibre.maximum_strain_rate;
      std::ostringstream text;
      text.precision(2);
      text << "it leaves the force-velocity relation explicit, a viscosity of " << viscosity
           << " Pa s at full activation and rest, which limits the step to about "
           << 2 * p.muscle().density / (viscosity * largest_rate_eigenvalue(p))
           << " s on this mesh and a quarter of that on the next finer one; beyond, velocities jump to and fro";
      return text.str();
    }
  } // namespace

  /// Other parameters on the same discretisation, with the kinks of the whole.
  class Muscle3dSystem::Part : public Muscle3dSystem
  {
  public:
    Part(const Muscle3dSystem &whole, Muscle3dParameters parameters)
      : Muscle3dSystem(std::move(parameters), whole.discretisation_, whole.ledger_)
      , whole_(whole)
    {}

    Capabilities capabilities() const override
    {
      Capabilities c = Muscle3dSystem::capabilities();
      c.splits.clear();
      return c;
    }

    std::vector<double> events(const double t0, const double t1) const override { return whole_.events(t0, t1); }

  private:
    const Muscle3dSystem &whole_;
  };

  std::vector<Split> Muscle3dSystem::splits() const
  {
    if (!parameters_.dynamic)
      return {};
    const std::string refused = why_refused(parameters_);
    return {{"linear", "the inertia and the passive stiffness at rest, frozen", refused},
            {"volumetric", "the inertia and the volumetric stress",
             refused.empty() && parameters_.viscous()
                 ? "it leaves the viscosity of tissues explicit, which limits the step as diffusion does"
             : refused.empty() && parameters_.fields.any() ? "stresses vary in space (system/fields) and would be left out point by point"
                                                           : refused},
            {"passive", "the inertia and all passive stresses", refused},
            {"all but active", "everything but the active stress", refused}};
  }

  std::unique_ptr<SemiDiscreteSystem> Muscle3dSystem::implicit_part(const std::string &split) const
  {
    const std::vector<Split> known = splits();
    if (std::none_of(known.begin(), known.end(), [&](const Split &s) { return s.name == split; }))
      return nullptr;
    Muscle3dParameters part = parameters_;
    part.activation         = nullptr;
    for (ActivationRegion &region : part.regions)
      region.activation = nullptr;
    if (split != "all but active")
      {
        part.body_force.reset();
        part.boundary.erase(
            std::remove_if(part.boundary.begin(), part.boundary.end(), [](const auto &c) { return !c->facts().constrains(); }),
            part.boundary.end());
      }
    if (split == "volumetric")
      {
        for (auto &[id, tissue] : part.tissues)
          {
            tissue.base.scale = 0;
            if (tissue.matrix)
              tissue.matrix->base.scale = 0;
            tissue.fat.base.scale = 0;
            tissue.fibre.sigma0   = 0;
            tissue.laws.clear();
          }
      }
    auto system = std::make_unique<Part>(*this, std::move(part));
    if (split == "linear")
      return std::make_unique<LinearisedSystem>(std::move(system));
    return system;
  }
} // namespace myolines
