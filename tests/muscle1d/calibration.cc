// SPDX-License-Identifier: LGPL-2.1-or-later
#include "run.h"

#include <myolines/base/error.h>

using namespace myolines;
using namespace myolines::testing;

// Of an independent program: semitendinosus, errata 2.
TEST(Calibration, semitendinosus)
{
  const OptimalLengths optimal = calibrate(0.4122, 0.7);
  EXPECT_NEAR(optimal.muscle, 0.289348972329, 1e-12);
  EXPECT_NEAR(optimal.tendon, 0.122851027671, 1e-12);
  EXPECT_NEAR(optimal.muscle - 0.7 * 0.4122, 8.089723290543e-4, 1e-15);
  const OptimalLengths large = calibrate(4.122, 0.7);
  EXPECT_NEAR(large.muscle, 10 * optimal.muscle, 1e-13);

  const double L = 0.4122 * 0.98, a = 0.032901717673;
  EXPECT_NEAR(balanced_length(optimal, L, a, 0.7 * L), 0.279984808597, 2e-11);
  EXPECT_NEAR(balanced_length(optimal, L, 0, 0.7 * L), 0.280376953310, 2e-12);
}

TEST(Calibration, massesForcesAndVolumes)
{
  const Muscle1dParameters p = read_muscle_tendon_unit(node(muscle_tendon_unit_schema()));
  EXPECT_NEAR(p.maximum_force, 133.888749, 1e-6);
  EXPECT_NEAR(p.mass, 1060 * 1.7218032e-4, 1e-9);
  const Muscle1dParameters large = read_muscle_tendon_unit(node(muscle_tendon_unit_schema(), {"scale=10"}));
  EXPECT_NEAR(large.maximum_force, 100 * p.maximum_force, 1e-8);
  EXPECT_NEAR(large.mass, 1000 * p.mass, 1e-9);
  EXPECT_NEAR(large.initial_stretch, p.initial_stretch, 1e-13);
  EXPECT_NEAR(MuscleData::table21("MG", "walking").volume(), 2.39728e-4, 1e-9) << "errata 4";
}

TEST(Calibration, tableOfTheThesisAndWhatReplacesIt)
{
  const MuscleData cycling = MuscleData::table21("VM", "cycling");
  EXPECT_EQ(cycling.maximum_strain_rate, 10);
  EXPECT_EQ(cycling.zajac.time_constant, 0.025);
  EXPECT_EQ(cycling.unit_length, 0.2171);
  EXPECT_EQ(MuscleData::table21("MG", "running").zajac.time_constant, 0.045);
  EXPECT_EQ(MuscleData::table21("ST", "running").volume_fraction, 0.026);

  const Muscle1dParameters p =
      read_muscle_tendon_unit(node(muscle_tendon_unit_schema(), {"data/maximum strain rate=7", "data/volume=1e-4", "muscle=MG"}));
  EXPECT_EQ(p.force.maximum_strain_rate, 7);
  EXPECT_NEAR(p.mass, 0.106, 1e-15);
  for (const std::string muscle : {"MG", "VM", "ST"})
    for (const std::string task : {"walking", "running", "cycling"})
      {
        const Muscle1dParameters any = read_muscle_tendon_unit(node(muscle_tendon_unit_schema(), {"muscle=" + muscle, "task=" + task}));
        EXPECT_NEAR(hill::passive(any.optimal_length == 0 ? 0
                                                          : MuscleData::table21(muscle, task).unit_length *
                                                                MuscleData::table21(muscle, task).length_ratio / any.optimal_length)
                        .value,
                    hill::tendon(MuscleData::table21(muscle, task).unit_length * (1 - MuscleData::table21(muscle, task).length_ratio) /
                                 any.tendon->optimal_length)
                        .value,
                    1e-12)
            << muscle << " " << task;
      }
}

// Table 3.1, corrected by the factor 1000 (errata 14).
TEST(Reynolds, numbersOfTable31)
{
  for (const double s : {1., 10.})
    {
      EXPECT_NEAR(musculoskeletal_reynolds_number(1060, s * 0.3, 5, 200e3), s * s * 1.1925e-2, 1e-12);
      EXPECT_NEAR(musculoskeletal_reynolds_number(1060, s * 0.3, 10, 200e3), s * s * 4.77e-2, 1e-12);
    }
}

TEST(Calibration, refusesWhatDoesNotBalance)
{
  EXPECT_THROW(balanced_length({0.3, 0.1}, 3, 0.1, 0.3), SolveError) << "a tendon that is stretched tenfold";
}
