// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/muscle1d/isometric_chain.h>
#include <myolines/system/drive_types.h>

#include <cmath>

namespace myolines
{
  scene::Schema isometric_chain_schema()
  {
    using scene::Range;
    scene::Schema schema("Active muscle of N elements and N - 1 masses at fixed length, thesis chapter 3: where it is stable.");
    schema.integer("elements", 17, Range::closed(2, 10000000), "N.")
        .number("stretch", 1.15, "-", Range::positive(), "lambda_M, of the whole muscle.")
        .number("length", 0.3, "m", Range::positive(), "Optimal length L_M.")
        .number("maximum force", 525, "N", Range::positive(), "F_0.")
        .number("maximum strain rate", 5, "1/s", Range::positive(), "e_0.")
        .number("activation", 1, "-", Range::closed(0, 1), "Of all elements, at all times.")
        .number("maximum stress", 225e3, "Pa", Range::positive(), "sigma_0; with the density it gives the mass rho F_0/sigma_0 L_M.")
        .number("density", 1060, "kg/m^3", Range::positive(), "rho.")
        .number("perturbation", 1e-4, "m", Range::any(), "p: the masses start at rest from u_i = p sin(i^2).")
        .boolean("force velocity", true, "False: F_V = 1, nothing relaxes.")
        .number("base material fraction", 0, "-", Range{0, 1, false, true}, "chi_BM of (3.3.11).")
        .section("base material", base_material_schema());
    return schema;
  }

  Muscle1dParameters read_isometric_chain(const scene::Node &system)
  {
    Muscle1dParameters p;
    p.optimal_length            = system.number("length");
    p.maximum_force             = system.number("maximum force");
    p.mass                      = system.number("density") * p.maximum_force / system.number("maximum stress") * p.optimal_length;
    p.initial_stretch           = system.number("stretch");
    p.n_elements                = system.integer("elements");
    p.force.maximum_strain_rate = system.number("maximum strain rate");
    p.force.force_velocity      = system.boolean("force velocity");
    p.force.base                = read_base_material(system);
    p.activation                = std::make_shared<PiecewiseDrive>(PiecewiseDrive::constant(system.number("activation")));
    for (unsigned int i = 1; i < p.n_elements; ++i)
      p.initial_displacement.push_back(system.number("perturbation") * std::sin(static_cast<double>(i) * i));
    return p;
  }
} // namespace myolines
