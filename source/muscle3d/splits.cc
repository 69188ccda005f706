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
    /// Bound of the eigenvalues of M^-1 C / mu [1/m^2] at rest, for rates n : grad v, n = a0 (x) a0 - I/3, along straight fibres a0.
    /// A wave of v with wave vector k has |n k|^2 = (a0.k)^2/3 + |k|^2/9, and k_i^2 is at most the eigenvalue of a single free
    /// element of size h_i (Fried, doi:10.1016/0022-460X(72)90484-1).
    double largest_rate_eigenvalue(const Muscle3dParameters &p)
    {
      const double of_element[] = {12, 60, 170.125}; // times 1/h^2, degree 1 to 3, consistent mass
      double       along = 0, sum = 0;
      for (unsigned int i = 0; i < 3; ++i)
        {
          const double h = p.geometry.size[i] / (p.geometry.cells[i] * std::exp2(p.geometry.refinement));
          along += std::abs(p.fibre_direction[i]) / h;
          sum += 1 / (h * h);
        }
      return of_element[p.degree - 1] * (along * along / 3 + sum / 9);
    }

    /// Why splits that leave the active stress explicit do not converge; empty without activation.
    std::string active_stress_is_explicit(const Muscle3dParameters &p)
    {
      if (!p.activation)
        return "";
      const FibreParameters &fibre      = p.tissue.fibre;
      const double           eigenvalue = largest_rate_eigenvalue(p) / p.tissue.density;
      const double           stress     = fibre.sigma0 * curves::active(1.).value;
      std::ostringstream     text;
      text.precision(2);
      if (!fibre.force_velocity)
        text << "it leaves the active stress explicit, whose stiffness in the order of sigma0 = " << stress
             << " Pa limits the step to about " << 2 / std::sqrt(stress * eigenvalue) << " s on this mesh";
      else
        {
          const double viscosity = stress * curves::force_velocity(0.).slope / fibre.maximum_strain_rate;
          text << "it leaves the force-velocity relation explicit, a viscosity of " << viscosity
               << " Pa s at full activation and rest, which limits the step to about " << 2 / (viscosity * eigenvalue)
               << " s on this mesh (four times less once it is refined, and 0.6 times where the curve is steepest)";
        }
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
    const std::string why = active_stress_is_explicit(parameters_);
    return {{"linear", "the inertia and the passive stiffness at rest, frozen", why},
            {"volumetric", "the inertia and the volumetric stress", why},
            {"passive", "the inertia and all passive stresses", why},
            {"all but active", "everything but the active stress", why}};
  }

  std::unique_ptr<SemiDiscreteSystem> Muscle3dSystem::implicit_part(const std::string &split) const
  {
    const std::vector<Split> known = splits();
    if (std::none_of(known.begin(), known.end(), [&](const Split &s) { return s.name == split; }))
      return nullptr;
    Muscle3dParameters part = parameters_;
    part.activation         = nullptr;
    if (split != "all but active")
      {
        part.body_force.reset();
        part.boundary.erase(std::remove_if(part.boundary.begin(), part.boundary.end(),
                                           [](const BoundaryCondition &c) { return c.type == BoundaryCondition::Type::traction; }),
                            part.boundary.end());
      }
    if (split == "volumetric")
      {
        part.tissue.base.scale   = 0;
        part.tissue.fibre.sigma0 = 0;
      }
    auto system = std::make_unique<Part>(*this, std::move(part));
    if (split == "linear")
      return std::make_unique<LinearisedSystem>(std::move(system));
    return system;
  }
} // namespace myolines
