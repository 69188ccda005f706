// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/muscle1d/hill_force.h>

#include <cmath>

namespace myolines
{
  BaseMaterial BaseMaterial::as_printed(const double fraction, const double ratio, const double nu)
  {
    return {fraction, ratio, nu / ((1 - nu) * (1 - 2 * nu)), 1 / (2 * (1 + nu))};
  }

  BaseMaterial BaseMaterial::corrected(const double fraction, const double ratio, const double nu)
  {
    return {fraction, ratio, 3 * nu / (1 + nu), 3 * (1 - 2 * nu) / (2 * (1 + nu))};
  }

  hill::Curve BaseMaterial::force(const double stretch) const
  {
    if (stretch < 1)
      return {0, 0};
    const double log = std::log(stretch);
    return {ratio * (mu * stretch + (lambda * log - mu) / stretch), ratio * (mu + (lambda * (1 - log) + mu) / (stretch * stretch))};
  }

  HillForce::Value HillForce::operator()(const double stretch, const double rate, const double activation) const
  {
    const hill::Curve active = hill::active(stretch), passive = hill::passive(stretch);
    const double      e        = rate / maximum_strain_rate;
    const hill::Curve velocity = force_velocity ? hill::force_velocity(e) : hill::Curve{1, 0};

    Value value{activation * active.value * velocity.value + passive.value + damping * e,
                activation * active.slope * velocity.value + passive.slope,
                (activation * active.value * velocity.slope + damping) / maximum_strain_rate, active.value * velocity.value};
    if (base.fraction == 0)
      return value;
    const double      hill = 1 - base.fraction;
    const hill::Curve more = base.force(stretch);
    return {hill * value.force + base.fraction * more.value, hill * value.by_stretch + base.fraction * more.slope, hill * value.by_rate,
            hill * value.by_activation};
  }

  hill::Curve HillForce::isometric(const double stretch, const double activation) const
  {
    const Value value = operator()(stretch, 0, activation);
    return {value.force, value.by_stretch};
  }

  scene::Schema base_material_schema()
  {
    using scene::Range;
    scene::Schema schema("Neo-Hookean material beside the fibres, which resists lengthening only, thesis (3.3.9).");
    schema.number("bulk modulus ratio", 5, "-", Range::positive(), "Bulk modulus over the maximum isometric stress.")
        .number("poisson ratio", 0.499, "-", Range{0, 0.5, false, true}, "nu.")
        .choice("lame parameters", "thesis", {"thesis", "corrected"},
                "As thesis (3.3.10) prints them, with which its fraction 0.0015 is enough, or from Young's modulus 3 kappa (1 - 2 nu) "
                "(errata 12).");
    return schema;
  }

  BaseMaterial read_base_material(const scene::Node &system)
  {
    const scene::Node &base     = system.section("base material");
    const double       fraction = system.number("base material fraction"), ratio = base.number("bulk modulus ratio"),
                 nu = base.number("poisson ratio");
    return base.text("lame parameters") == "thesis" ? BaseMaterial::as_printed(fraction, ratio, nu)
                                                    : BaseMaterial::corrected(fraction, ratio, nu);
  }
} // namespace myolines
