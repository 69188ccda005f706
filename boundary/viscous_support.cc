// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/boundary/boundary_entries.h>

namespace myolines
{
  namespace
  {
    using scene::Range;

    /// Springs and dashpots per reference area, along the normal N at rest and across it:
    /// -(k_n u_n + d_n v_n) N - k_t u_t - d_t v_t with x_n = x.N, x_t = x - x_n N (Kelvin and Voigt).
    class ViscousSupport : public BoundaryCondition
    {
    public:
      ViscousSupport(const scene::Node &node, const BoundaryReading &reading)
        : BoundaryCondition(reading.facts)
        , spring_{node.number("normal stiffness"), node.number("tangential stiffness")}
        , dashpot_{node.number("normal damping"), node.number("tangential damping")}
      {
        if (!dashpot_.any())
          node.refuse("normal damping", "nothing damps", "a \"normal damping\" or a \"tangential damping\" above zero",
                      "springs alone are an \"elastic foundation\"");
        if (!reading.dynamic)
          node.refuse("type", "a quasi-static system has no velocities, which dashpots need", "an \"elastic foundation\"",
                      "or \"dynamic\" as system/inertia");
        facts_.part        = read_box(node);
        facts_.pushes      = true;
        facts_.supports    = true;
        facts_.rates       = true;
        facts_.says_spring = spring_.any() ? "stands on springs and dashpots" : "stands on dashpots";
      }

      Vector3 force(double, Side, const FacePoint &point, const FaceMotion &x) const override
      {
        return -point.area * (spring_.times(x.u, point.normal) + dashpot_.times(x.v, point.normal));
      }

      ForceTangent tangent(double, Side, const FacePoint &point, const FaceMotion &) const override
      {
        ForceTangent k;
        for (unsigned int c = 0; c < 3; ++c)
          {
            Vector3 unit;
            unit[c]         = point.area;
            const Vector3 u = spring_.times(unit, point.normal), v = dashpot_.times(unit, point.normal);
            for (unsigned int a = 0; a < 3; ++a)
              {
                k.by_u[a][c] = u[a];
                k.by_v[a][c] = v[a];
              }
          }
        return k;
      }

      double energy(double, Side, const FacePoint &point, const FaceMotion &x) const override
      {
        return point.area / 2 * (x.u * spring_.times(x.u, point.normal));
      }

      double dissipation(double, Side, const FacePoint &point, const FaceMotion &x) const override
      {
        return point.area * (x.v * dashpot_.times(x.v, point.normal));
      }

      std::vector<Vector3> held_directions(const Vector3 &normal) const override
      {
        std::vector<Vector3> held;
        if (spring_.normal > 0)
          held.push_back(normal);
        if (spring_.tangential > 0)
          for (unsigned int c = 0; c < 3; ++c)
            {
              Vector3 unit;
              unit[c] = 1;
              held.push_back(unit - normal[c] * normal);
            }
        return held;
      }

    private:
      struct Coefficients
      {
        double normal, tangential;

        bool    any() const { return normal != 0 || tangential != 0; }
        Vector3 times(const Vector3 &x, const Vector3 &N) const { return tangential * x + (normal - tangential) * (x * N) * N; }
      };
      const Coefficients spring_, dashpot_; ///< [Pa/m], [Pa s/m]
    };
  } // namespace

  BoundaryEntry viscous_support_condition()
  {
    scene::Schema schema(
        "Springs and dashpots between the face and the ground, per reference area, along the normal N at rest and across it: "
        "the force is -(k_n u.N + d_n v.N) N - k_t u_t - d_t v_t, x_t the part of x across N. Dynamic systems only.");
    const auto add = [&](const std::string &what, const std::string &unit, const std::string &symbol) {
      schema.number("normal " + what, 0, unit, Range::not_negative(), symbol + "_n, along the normal.")
          .number("tangential " + what, 0, unit, Range::not_negative(), symbol + "_t, across it.");
    };
    add("stiffness", "Pa/m", "k");
    add("damping", "Pa s/m", "d");
    add_box(schema);
    return {"viscous support",
            MuscleEnd::none,
            schema,
            {"normal stiffness=1e8", "tangential stiffness=3e7", "normal damping=5e4", "tangential damping=2e4"},
            [](const scene::Node &node, const BoundaryReading &reading) { return std::make_shared<ViscousSupport>(node, reading); }};
  }
} // namespace myolines
