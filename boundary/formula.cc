// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/boundary/boundary_entries.h>
#include <myolines/scene/formula.h>

#include <algorithm>
#include <cmath>

namespace myolines
{
  namespace
  {
    /// u_c = f_c(x, y, z, t), with both time derivatives given as formulas too.
    class FormulaFace : public BoundaryCondition
    {
    public:
      FormulaFace(const scene::Node &node, const BoundaryReading &reading)
        : BoundaryCondition(reading.facts)
        , u_(read_formulas(node, "displacement "))
        , v_(read_formulas(node, "velocity "))
        , a_(read_formulas(node, "acceleration "))
      {
        facts_.prescribed = read_components(node);
        for (unsigned int c = 0; c < 3; ++c)
          facts_.moving[c] = !u_.zero(c);
        if (reading.dynamic)
          refuse_inconsistent_rates(node);
      }

      Motion motion(const double t, Side) const override
      {
        return [this, t](const dealii::Point<3> &x) {
          std::array<Vector3, 3> all;
          for (unsigned int c = 0; c < 3; ++c)
            if (facts_.prescribed[c])
              {
                all[0][c] = u_(c, x, t);
                all[1][c] = v_(c, x, t);
                all[2][c] = a_(c, x, t);
              }
          return all;
        };
      }

    private:
      /// In a dynamic scene the three formulas of a motion must be derivatives of each other: compared with differences.
      void refuse_inconsistent_rates(const scene::Node &node) const
      {
        const dealii::Point<3> x(0.0123, 0.0047, 0.0031);
        const double           h = 1e-4;
        const auto check         = [&](const VectorFormula &f, const VectorFormula &rate, const std::string &name, const unsigned int c) {
          for (const double t : {0.0137, 0.0713, 0.139})
            {
              const double difference = (f(c, x, t + h) - f(c, x, t - h)) / (2 * h), given = rate(c, x, t);
              if (!(std::abs(difference - given) <= 0.02 * std::max(std::abs(difference), std::abs(given)) + 1e-9))
                node.refuse(name + axes[c],
                                    "is " + std::to_string(given) + " at t = " + std::to_string(t) + " s, where its formula should give about " +
                                        std::to_string(difference),
                                    "the time derivative of the formula before it");
            }
        };
        for (unsigned int c = 0; c < 3; ++c)
          if (facts_.prescribed[c])
            {
              check(u_, v_, "velocity ", c);
              check(v_, a_, "acceleration ", c);
            }
      }

      const VectorFormula u_, v_, a_;
    };
  } // namespace

  BoundaryEntry formula_condition()
  {
    scene::Schema schema("The face moves by a displacement u(X, t) given by formulas, together with its time derivatives.");
    add_components(schema);
    add_formulas(schema, "displacement ", "Displacement [m]");
    add_formulas(schema, "velocity ", "Its first time derivative [m/s]");
    add_formulas(schema, "acceleration ", "Its second time derivative [m/s^2]");
    return {"formula",
            MuscleEnd::moved,
            schema,
            {"displacement x=0.1*x*t^2", "velocity x=0.2*x*t", "acceleration x=0.2*x", "displacement z=y*sin(t)", "velocity z=y*cos(t)",
             "acceleration z=-y*sin(t)"},
            [](const scene::Node &node, const BoundaryReading &reading) { return std::make_shared<FormulaFace>(node, reading); }};
  }
} // namespace myolines
