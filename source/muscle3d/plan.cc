#include <myolines/muscle3d/discretisation.h>
#include <myolines/muscle3d/loads.h>
#include <myolines/muscle3d/muscle3d_system.h>

namespace myolines
{
  std::vector<std::string> Muscle3dSystem::plan() const
  {
    const Muscle3dParameters &p    = parameters_;
    const auto                line = [](const std::string &term, const bool on, const std::string &why) {
      return std::string(on ? "on   " : "off  ") + term + ": " + why;
    };
    const bool               rates = capabilities().rates;
    std::vector<std::string> lines;
    lines.push_back(line("inertia", p.dynamic, p.dynamic ? "dynamic" : "quasi-static: no mass matrix is built"));
    lines.push_back(line("active stress", p.activation != nullptr,
                         p.activation ? "activation is given" : "no activation, or an activation that is always zero"));
    lines.push_back(line("force-velocity", rates,
                         rates                            ? "dynamic and active"
                         : !p.dynamic                     ? "quasi-static: sV = 1"
                         : !p.tissue.fibre.force_velocity ? "switched off for the tissue"
                                                          : "nothing is active"));
    lines.push_back(line("passive fibres and base material", true, "always"));
    lines.push_back(line("body force", p.body_force.has_value(), p.body_force ? "given" : "not given"));
    lines.push_back(
        line("tractions",
             std::any_of(p.boundary.begin(), p.boundary.end(), [](const auto &c) { return c.type == BoundaryCondition::Type::traction; }),
             "faces without a condition are free"));
    lines.push_back(std::string("tangent: ") + (capabilities().symmetric_tangent ? "symmetric" : "exact, not symmetric") +
                    "; kernels: " + name(discretisation_->instruction_set) + ", " + std::to_string(n_lanes) + " cells at once");
    return lines;
  }

  double Muscle3dSystem::memory_estimate() const
  {
    const Muscle3dDiscretisation &d        = *discretisation_;
    const double                  cells    = double(d.batches->n_batches()) * n_lanes;
    const double                  nodes    = d.element.n_nodes;
    const double                  unknowns = double(d.space->owned_unknowns().n_elements());
    const double                  row      = 3 * std::pow(2. * d.space->degree() + 1, 3); // most entries of a row of a regular mesh
    const double                  matrix   = unknowns * row * (sizeof(double) + sizeof(int));
    const double                  places   = cells * nodes * nodes * sizeof(int);
    const double                  vectors  = 20 * unknowns * sizeof(double);
    return d.batches->memory() + matrix + places + vectors;
  }
} // namespace myolines
