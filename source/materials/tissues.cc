// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/materials/tissue.h>

#include <algorithm>
#include <cmath>

namespace myolines
{
  namespace
  {
    using scene::Range;
    using scene::Schema;

    // table 5.1, unscaled [Pa]
    const YeohParameters ecm{1, {1988.76435209844, 4917.02551347748, -591.533166457473}};
    const YeohParameters cells{1, {3703.32723408173, -707.76064007684, 123.247643527575}};

    TissueParameters tendinous(const double bulk_modulus)
    {
      TissueParameters t;
      t.bulk_modulus       = bulk_modulus;
      t.fibre.law          = FibreLaw::tendon;
      t.fibre.follows_body = false;
      t.base               = {2e5, {4.6896264975, -3.4551410975, 484.92055395}}; // table 5.3
      return t;
    }
  } // namespace

  const std::vector<TissueKind> &tissue_kinds()
  {
    static const std::vector<TissueKind> kinds{
        {"muscle", muscle_id, "Muscle tissue: fibres in a nearly incompressible base material.", {}},
        {"aponeurosis", aponeurosis_id, "Aponeurosis: the tendinous sheet on or in a muscle, thesis 5.3.", tendinous(1e7)},
        {"tendon", tendon_id, "Tendon, thesis 5.3.", tendinous(1e8)}};
    return kinds;
  }

  TissueNames printed_tissues()
  {
    TissueNames names;
    for (const TissueKind &kind : tissue_kinds())
      names.push_back(kind.name);
    return names;
  }

  unsigned int tissue_id(const TissueNames &names, const std::string &name)
  {
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? 0 : static_cast<unsigned int>(found - names.begin()) + 1;
  }

  namespace
  {
    void add_yeoh(Schema &schema, const YeohParameters &usual, const std::string &prefix)
    {
      const char *which[] = {"First", "Second", "Third"};
      for (int k = 0; k < 3; ++k)
        schema.number(prefix + "c" + std::to_string(k + 1), usual.c[k], usual.scale == 1 ? "Pa" : "-", Range::any(),
                      std::string(which[k]) + " Yeoh constant.");
    }

    Schema base_schema(const TissueKind &kind)
    {
      const YeohParameters &usual = kind.defaults.base;
      Schema                yeoh("Psi = factor * stress scale * sum c_k (I1 - 3)^k.");
      yeoh.number("stress scale", usual.scale, "Pa", Range::not_negative(), "sigma0 of the base material.")
          .number("factor", 1, "-", Range::not_negative(), "Multiplies the stress scale.");
      add_yeoh(yeoh, usual, "");
      if (kind.id != muscle_id)
        return Schema("Isotropic base material.").variant("type", "yeoh", {{"yeoh", yeoh}}, "Law of the base material.");

      Schema mixed("Extracellular matrix and cells by their fractions, two Yeoh laws, thesis (5.2.12): bulk modulus likewise.");
      mixed.number("matrix fraction", 0.05, "-", Range::closed(0, 1), "chi_ecm, volume of the extracellular matrix.")
          .number("matrix factor", 200, "-", Range::not_negative(), "s_ecm, multiplies the constants of the matrix.")
          .number("matrix bulk modulus", 1e7, "Pa", Range::positive(), "kappa of the matrix.")
          .number("cell factor", 1, "-", Range::not_negative(), "s_cell, multiplies the constants of the cells.");
      add_yeoh(mixed, ecm, "matrix ");
      add_yeoh(mixed, cells, "cell ");
      return Schema("Isotropic base material.")
          .variant("type", "yeoh", {{"yeoh", yeoh}, {"matrix and cells", mixed}}, "Law of the base material.");
    }

    Schema fibre_schema(const TissueKind &kind)
    {
      const FibreParameters &usual = kind.defaults.fibre;
      if (usual.law == FibreLaw::muscle)
        return Schema("Hill-type fibres, sigma = sigma0 (a sA(lam) sV(e) + sP(lam)), thesis (5.2.5) and appendix A.2.")
            .number("maximum isometric stress", usual.sigma0, "Pa", Range::not_negative(), "sigma0 of the fibres.")
            .number("maximum strain rate", usual.maximum_strain_rate, "1/s", Range::positive(), "Maximum unloaded strain rate e0.")
            .boolean("force-velocity", usual.force_velocity, "Whether the active stress depends on the strain rate (quasi-static: never).");
      return Schema("Tendinous fibres, sigma = sigma0 sT(lam), thesis (5.3.5) and (A.2.4).")
          .number("stress scale", usual.sigma0, "Pa", Range::not_negative(), "sigma0 of the fibres.")
          .optional_text("direction",
                         "Fibre direction \"x y z\" at rest, normalised; default: that of the geometry, else that of the muscle.");
    }

    Schema fat_schema()
    {
      const FatParameters usual;
      Schema              yeoh("Yeoh law of the thesis, table 5.2.");
      add_yeoh(yeoh, usual.base, "");
      Schema neo_hookean("Neo-Hookean law c1 (I1 - 3), as Flexodeal has it.");
      neo_hookean.number("c1", 1.3e5, "Pa", Range::not_negative(), "Constant.");
      return Schema("Intramuscular fat: all else weighs 1 - fraction, thesis 5.2.3.")
          .number("fraction", std::nullopt, "-", Range::closed(0, 1), "Volume of fat in the muscle.")
          .number("bulk modulus", usual.bulk_modulus, "Pa", Range::positive(), "kappa of fat.")
          .number("factor", 1, "-", Range::not_negative(), "Multiplies the constants.")
          .variant("type", "yeoh", {{"yeoh", yeoh}, {"neo-hookean", neo_hookean}}, "Law of fat.");
    }

    /// Constants times factors, as energies in Pa.
    void add_to(YeohParameters &sum, const double factor, const scene::Node &node, const std::string &prefix)
    {
      for (int k = 0; k < 3; ++k)
        sum.c[k] += factor * node.number(prefix + "c" + std::to_string(k + 1));
    }

    void read_base(const scene::Node &node, const scene::Node &tissue, TissueParameters &t)
    {
      t.base         = {1, {0, 0, 0}};
      t.bulk_modulus = tissue.number("bulk modulus");
      if (node.text("type") == "yeoh")
        {
          t.base.scale = node.number("factor") * node.number("stress scale");
          add_to(t.base, 1, node, "");
          return;
        }
      add_to(t.base, node.number("cell factor"), node, "cell ");
      t.matrix.emplace();
      t.matrix->fraction     = node.number("matrix fraction");
      t.matrix->bulk_modulus = node.number("matrix bulk modulus");
      add_to(t.matrix->base, node.number("matrix factor"), node, "matrix ");
    }
  } // namespace

  Schema tissue_schema(const TissueKind &kind)
  {
    Schema schema(kind.doc);
    schema.number("density", kind.defaults.density, "kg/m^3", Range::positive(), "Mass per reference volume.")
        .number("bulk modulus", kind.defaults.bulk_modulus, "Pa", Range::positive(),
                "kappa of the volumetric energy; of the cells where the base material is mixed.")
        .section("fibre", fibre_schema(kind))
        .section("base", base_schema(kind));
    if (kind.id == muscle_id)
      schema.optional_section("fat", fat_schema());
    schema.optional_section("laws", laws_schema());
    return schema;
  }

  Schema own_tissue_schema()
  {
    const TissueParameters usual;
    return Schema("The sum of its laws and of the volumetric energy.")
        .number("density", usual.density, "kg/m^3", Range::positive(), "Mass per reference volume.")
        .number("bulk modulus", usual.bulk_modulus, "Pa", Range::positive(), "kappa of the volumetric energy.")
        .optional_text("direction", "Fibre direction \"x y z\" at rest, normalised; default: that of system/fibres and of fields.")
        .section("laws", laws_schema());
  }

  TissueParameters read_tissue(const TissueKind &kind, const scene::Node &node)
  {
    TissueParameters   t     = kind.defaults;
    const scene::Node &fibre = node.section("fibre");
    t.density                = node.number("density");
    read_base(node.section("base"), node, t);
    if (t.fibre.law == FibreLaw::muscle)
      {
        t.fibre.sigma0              = fibre.number("maximum isometric stress");
        t.fibre.maximum_strain_rate = fibre.number("maximum strain rate");
        t.fibre.force_velocity      = fibre.boolean("force-velocity");
      }
    else
      t.fibre.sigma0 = fibre.number("stress scale");
    if (kind.id == muscle_id && node.has("fat"))
      {
        const scene::Node &fat = node.section("fat");
        t.fat.fraction         = fat.number("fraction");
        t.fat.bulk_modulus     = fat.number("bulk modulus");
        t.fat.base             = {1, {0, 0, 0}};
        if (fat.text("type") == "neo-hookean")
          t.fat.base.c[0] = fat.number("factor") * fat.number("c1");
        else
          add_to(t.fat.base, fat.number("factor"), fat, "");
      }
    if (node.has("laws"))
      t.laws = read_laws(node.section("laws"));
    return t;
  }

  TissueParameters read_own_tissue(const scene::Node &node)
  {
    TissueParameters t;
    t.density      = node.number("density");
    t.bulk_modulus = node.number("bulk modulus");
    t.base         = {0, {0, 0, 0}};
    t.fibre.sigma0 = 0;
    t.laws         = read_laws(node.section("laws"));
    if (t.laws.empty())
      node.refuse("laws", "the tissue has no law, and so no stiffness", "at least one list with a \"type\" of `myolines list laws`");
    return t;
  }

  double TissueParameters::shear_modulus_of_laws() const
  {
    double sum = 0;
    for (const TissuePart &part : laws)
      sum += part.weight * part.law->shear_modulus(fibre.direction);
    return sum;
  }

  bool TissueParameters::viscous() const
  {
    return std::any_of(laws.begin(), laws.end(), [](const TissuePart &part) { return part.law->kind.rates != Rates::none; });
  }

  std::optional<std::array<double, 3>> unit_vector(const std::array<double, 3> &v)
  {
    const double length = std::hypot(v[0], v[1], v[2]);
    if (!(length > 0) || !std::isfinite(length))
      return std::nullopt;
    return std::array<double, 3>{{v[0] / length, v[1] / length, v[2] / length}};
  }

  Material material(const TissueParameters &t)
  {
    auto         base = t.base.coefficients();
    double       bulk = t.bulk_modulus;
    const auto   fat  = t.fat.base.coefficients();
    const double f = t.fat.fraction, rest = 1 - f;
    if (t.matrix)
      {
        const double chi    = t.matrix->fraction;
        const auto   matrix = t.matrix->base.coefficients();
        for (int i = 0; i < 3; ++i)
          base[i] = chi * matrix[i] + (1 - chi) * base[i];
        bulk = chi * t.matrix->bulk_modulus + (1 - chi) * bulk;
      }
    const bool muscle = t.fibre.law == FibreLaw::muscle;
    Material   m{};
    for (int i = 0; i < 3; ++i)
      {
        m[material_direction + i] = t.fibre.direction[i];
        m[material_yeoh + i]      = rest * base[i] + f * fat[i];
      }
    m[material_bulk]     = rest * bulk + f * t.fat.bulk_modulus;
    m[material_density]  = t.density;
    m[material_active]   = muscle ? rest * t.fibre.sigma0 : 0;
    m[material_passive]  = m[material_active];
    m[material_tendon]   = muscle ? 0 : rest * t.fibre.sigma0;
    m[material_slowness] = 1 / t.fibre.maximum_strain_rate;
    m[material_fat]      = f;
    return m;
  }
} // namespace myolines
