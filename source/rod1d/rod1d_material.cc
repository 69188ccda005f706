// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/rod1d/rod1d_material.h>

namespace myolines
{
  namespace
  {
    double young_modulus(const double kappa, const double nu) { return 3 * kappa * (1 - 2 * nu); }

    RodMaterial neo_hookean(const double lambda, const double mu)
    {
      RodMaterial material;
      material.linear = false;
      material.lambda = lambda;
      material.mu     = mu;
      return material;
    }

    scene::Schema with_moduli(const std::string &doc)
    {
      using scene::Range;
      scene::Schema schema(doc);
      schema.number("bulk modulus", 1e6, "Pa", Range::positive(), "kappa.")
          .number("poisson ratio", 0.4, "-", Range{0, 0.5, false, true}, "nu.");
      return schema;
    }
  } // namespace

  RodMaterial RodMaterial::linear_elastic(const double kappa, const double nu)
  {
    RodMaterial material;
    material.young = young_modulus(kappa, nu);
    return material;
  }

  RodMaterial RodMaterial::neo_hookean_thesis(const double kappa, const double nu)
  {
    return neo_hookean(kappa * nu / ((1 - nu) * (1 - 2 * nu)), kappa / (2 * (1 + nu)));
  }

  RodMaterial RodMaterial::neo_hookean_corrected(const double kappa, const double nu)
  {
    const double young = young_modulus(kappa, nu);
    return neo_hookean(young * nu / ((1 + nu) * (1 - 2 * nu)), young / (2 * (1 + nu)));
  }

  scene::Schema rod_material_schema()
  {
    scene::Schema neo_hookean = with_moduli("P = mu l + (lambda log l - mu)/l, thesis (4.7.1).");
    neo_hookean.choice(
        "lame parameters", "corrected", {"corrected", "thesis"},
        "lambda and mu from Young's modulus 3 kappa (1 - 2 nu), or as thesis (4.7.2) prints them, with kappa in its place and "
        "1 - nu for 1 + nu.");
    scene::Schema schema("Stress P as a function of the stretch l.");
    schema.variant("type", "linear", {{"linear", with_moduli("P = E (l - 1), E = 3 kappa (1 - 2 nu).")}, {"neo-hookean", neo_hookean}},
                   "Kind of material.");
    return schema;
  }

  RodMaterial read_rod_material(const scene::Node &material)
  {
    const double kappa = material.number("bulk modulus"), nu = material.number("poisson ratio");
    if (material.text("type") == "linear")
      return RodMaterial::linear_elastic(kappa, nu);
    return material.text("lame parameters") == "thesis" ? RodMaterial::neo_hookean_thesis(kappa, nu)
                                                        : RodMaterial::neo_hookean_corrected(kappa, nu);
  }
} // namespace myolines
