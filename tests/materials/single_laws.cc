// SPDX-License-Identifier: LGPL-2.1-or-later
// What is known of single laws in closed form.
#include "law_states.h"

#include <gtest/gtest.h>

namespace myolines
{
  namespace
  {
    using namespace test;

    /// Of the fibre direction and of transverse shear at rest: C bf along, C bfs and C bt in shear.
    TEST(Guccione, HasTheModuliOfItsWeights)
    {
      Deformation<double> at;
      at.F      = identity();
      at.F_rate = Matrix::zero();
      at.a0     = {{1, 0, 0}};
      const Guccione law;
      double         A[9][9];
      moduli(law, at, 1., 0., A);
      EXPECT_NEAR(A[1][1], law.C * law.bfs / 2, 1e-9); // F_xy: E_xy = 1/2
      EXPECT_NEAR(A[5][5], law.C * law.bt / 2, 1e-9);
      // of the deviatoric part of E = e_x (x) e_x, by hand
      EXPECT_NEAR(A[0][0], law.C * (law.bf * 4 / 9. + law.bt * 2 / 9.), 1e-9);
    }

    TEST(Guccione, HasTheEnergyOfItsFormula)
    {
      Deformation<double> at = states()[3];
      at.a0                  = {{1, 0, 0}};
      const double J = strain(at).J, power = std::pow(J, -2. / 3);
      const Matrix E = 0.5 * (power * (transpose(at.F) * at.F) - identity());
      const double Q = 8 * E(0, 0) * E(0, 0) + 2 * (E(1, 1) * E(1, 1) + E(2, 2) * E(2, 2) + 2 * E(1, 2) * E(1, 2)) +
                       4 * 2 * (E(0, 1) * E(0, 1) + E(0, 2) * E(0, 2));
      EXPECT_NEAR(Guccione{}.energy(strain(at)), 1000 * (std::exp(Q) - 1), 1e-9);
    }

    /// A bar stretched at constant volume: 3 eta of the fluid, 2/3 * 3/2 eta of the fibres.
    TEST(Viscosity, OfABar)
    {
      Deformation<double> at;
      at.F = at.F_rate = Matrix::zero();
      const double s = 1.3, rate = 0.4, across = 1 / std::sqrt(s);
      for (int i = 0; i < 3; ++i)
        {
          at.F(i, i)      = i == 0 ? s : across;
          at.F_rate(i, i) = i == 0 ? s * rate : -across * rate / 2;
        }
      at.a0             = {{1, 0, 0}};
      const auto stress = [&](const auto &law) {
        const Matrix sigma = law.stress(strain(at)) * transpose(at.F);
        return sigma(0, 0) - sigma(1, 1);
      };
      EXPECT_NEAR(stress(Viscosity{7, 0}), 3 * 7 * rate, 1e-13);
      EXPECT_NEAR(stress(FibreViscosity{7}), 7 * rate, 1e-13);
      at.F_rate          = 0.2 * at.F; // swelling at 0.2 in all directions
      const Matrix sigma = Viscosity{7, 5}.stress(strain(at)) * transpose(at.F);
      for (int i = 0; i < 9; ++i)
        EXPECT_NEAR(sigma.entry[i], i % 4 == 0 ? 5 * 0.6 : 0, 1e-13);
    }
  } // namespace
} // namespace myolines
