// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: every form of the volumetric energy is that of its formula, has the bulk modulus kappa at rest, and its derivatives and
// secants are its own.
#include <myolines/materials/volume_energy.h>

#include <gtest/gtest.h>

#include <cmath>

namespace myolines
{
  namespace
  {
    constexpr double kappa = 3e6;

    class VolumeForms : public ::testing::TestWithParam<VolumeForm>
    {
    protected:
      /// In more digits than the program has.
      static long double energy(const long double D)
      {
        const long double ln = std::log(D);
        switch (GetParam())
          {
          case VolumeForm::thesis:
            return kappa / 4 * (D * D - 2 * ln - 1);
          case VolumeForm::quadratic:
            return kappa / 2 * (D - 1) * (D - 1);
          case VolumeForm::logarithmic:
            return kappa / 2 * ln * ln;
          }
        return 0;
      }
      static long double slope(const long double D)
      {
        const long double h = 1e-6L;
        return (energy(D + h) - energy(D - h)) / (2 * h);
      }

      const VolumeEnergy<double> psi{GetParam(), kappa};
    };

    TEST_P(VolumeForms, RestAtOneWithTheBulkModulus)
    {
      EXPECT_EQ(psi.energy(1), 0);
      EXPECT_EQ(psi.stress(1), 0);
      EXPECT_DOUBLE_EQ(psi.stiffness(1), kappa);
    }

    TEST_P(VolumeForms, HaveTheEnergyOfTheirFormulaAndItsDerivatives)
    {
      for (const double D : {0.3, 0.8, 0.99, 1.02, 1.3, 2.5, 4.})
        {
          const double h = 1e-5;
          EXPECT_NEAR(psi.energy(D), energy(D), 1e-15 * kappa * (1 + D * D));
          EXPECT_NEAR(psi.stress(D), slope(D), 1e-10 * kappa) << D;
          EXPECT_NEAR(psi.stiffness(D), (psi.stress(D + h) - psi.stress(D - h)) / (2 * h), 1e-7 * kappa) << D;
        }
      EXPECT_EQ(psi.stiffness(2.8) < 0, GetParam() == VolumeForm::logarithmic); // e < 2.8
    }

    /// Far apart, where the series of the logarithm changes to its closed form, close together, and equal.
    TEST_P(VolumeForms, HaveSecantsWithoutCancellation)
    {
      for (const double D0 : {0.6, 1., 1.1, 1.9})
        for (const double ratio : {3., 1.3, 1.23, 1.22, 1.01, 1 + 1e-5, 1 + 1e-9, 1 - 1e-7, 0.8, 0.4})
          {
            const double D1 = D0 * ratio, h = 1e-6;
            const auto   secant = psi.secant(D0, D1);
            if (std::abs(D1 - D0) > 1e-6)
              {
                EXPECT_NEAR(secant.value, (energy(D1) - energy(D0)) / (static_cast<long double>(D1) - D0), 1e-12 * kappa)
                    << D0 << " " << D1;
              }
            EXPECT_NEAR(secant.slope, (psi.secant(D0, D1 + h).value - psi.secant(D0, D1 - h).value) / (2 * h), 1e-8 * kappa)
                << D0 << " " << D1;
          }
      for (const double D : {0.5, 1., 1.7})
        {
          EXPECT_NEAR(psi.secant(D, D).value, psi.stress(D), 1e-15 * kappa);
          EXPECT_NEAR(psi.secant(D, D).slope, psi.stiffness(D) / 2, 1e-15 * kappa);
        }
    }

    INSTANTIATE_TEST_SUITE_P(Named, VolumeForms, ::testing::Values(VolumeForm::thesis, VolumeForm::quadratic, VolumeForm::logarithmic),
                             [](const auto &info) { return volume_form_names[static_cast<int>(info.param)]; });

  } // namespace
} // namespace myolines
