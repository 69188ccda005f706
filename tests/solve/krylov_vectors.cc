// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../../source/solve/krylov_vectors.h"

#include <BelosMVOPTester.hpp>
#include <BelosOutputManager.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace myolines
{
  namespace
  {
    using Many = Belos::MultiVec<double>;

    /// As many entries on each rank as its number says, so that no two are alike.
    struct KrylovVectorsOfRanks : public ::testing::Test
    {
      KrylovVectorsOfRanks()
      {
        MPI_Comm_rank(MPI_COMM_WORLD, &rank);
        MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
        entries.resize(21 + rank);
        for (std::size_t i = 0; i < entries.size(); ++i)
          entries[i] = std::sin(1. + i + 100 * rank);
        model = std::make_unique<KrylovVectors>(entries.data(), entries.size(), MPI_COMM_WORLD);
      }
      std::unique_ptr<KrylovVectors> clone(const int n) const
      {
        return std::unique_ptr<KrylovVectors>(dynamic_cast<KrylovVectors *>(model->Clone(n)));
      }

      int                            rank = 0, n_ranks = 1;
      std::vector<double>            entries;
      std::unique_ptr<KrylovVectors> model;
    };

    TEST_F(KrylovVectorsOfRanks, PassTheTestOfBelos)
    {
      const auto manager = Teuchos::rcp(new Belos::OutputManager<double>(Belos::Warnings));
      EXPECT_TRUE((Belos::TestMultiVecTraits<double, Many>(manager, Teuchos::rcp<const Many>(model.get(), false))));
    }

    TEST_F(KrylovVectorsOfRanks, TakeMemoryWhenTheyAreWritten)
    {
      const auto vectors = clone(100);
      EXPECT_EQ(vectors->GetNumberVecs(), 100);
      EXPECT_EQ(vectors->memory(), 0u);
      std::vector<double> norms;
      vectors->MvNorm(norms, Belos::TwoNorm);
      EXPECT_EQ(norms, std::vector<double>(100, 0.));
      const KrylovOperator twice(
          [&](const double *x, double *y) { std::transform(x, x + entries.size(), y, [](const double e) { return 2 * e; }); });
      const std::unique_ptr<Many> some(vectors->CloneViewNonConst({7}));
      twice.Apply(*model, *some);
      EXPECT_EQ(vectors->memory(), entries.size() * sizeof(double));
      vectors->MvNorm(norms, Belos::TwoNorm);
      std::vector<double> expected;
      model->MvNorm(expected, Belos::TwoNorm);
      EXPECT_DOUBLE_EQ(norms[7], 2 * expected[0]);
    }

    TEST_F(KrylovVectorsOfRanks, KeepWhatTheyAreToldToInSinglePrecision)
    {
      const auto           vectors = clone(2);
      const KrylovOperator third(
          [&](const double *x, double *y) { std::transform(x, x + entries.size(), y, [](const double e) { return e / 3; }); },
          KrylovOperator::Rounds{false, true});
      const std::unique_ptr<Many> first(vectors->CloneViewNonConst({0}));
      third.Apply(*model, *first);
      EXPECT_EQ(vectors->memory(), entries.size() * sizeof(float));
      // What is read of it, by sums and by operators, is the same.
      std::vector<double>                     sum(entries.size(), 0.), seen(entries.size(), 0.);
      KrylovVectors                           to(sum.data(), sum.size(), MPI_COMM_WORLD), image(seen.data(), seen.size(), MPI_COMM_WORLD);
      Teuchos::SerialDenseMatrix<int, double> one(2, 1);
      one(0, 0) = 1;
      one(1, 0) = 5; // of a vector that is zero
      to.MvTimesMatAddMv(1, *vectors, one, 0);
      const KrylovOperator identity([&](const double *x, double *y) { std::copy_n(x, entries.size(), y); });
      identity.Apply(*first, image);
      for (std::size_t i = 0; i < entries.size(); ++i)
        {
          EXPECT_EQ(sum[i], static_cast<double>(static_cast<float>(entries[i] / 3)));
          EXPECT_EQ(seen[i], sum[i]);
        }
    }

    TEST_F(KrylovVectorsOfRanks, RoundWhatAnOperatorHasSeen)
    {
      const auto vectors = clone(2), images = clone(2);
      vectors->MvInit(1. / 3);
      const KrylovOperator identity([&](const double *x, double *y) { std::copy_n(x, entries.size(), y); },
                                    KrylovOperator::Rounds{true, false});
      identity.Apply(*vectors, *images);
      EXPECT_EQ(vectors->memory(), 2 * entries.size() * sizeof(float));
      EXPECT_EQ(images->memory(), 2 * entries.size() * sizeof(double));
      const double        third = static_cast<double>(1.f / 3);
      const double        n     = static_cast<double>(model->GetGlobalLength());
      std::vector<double> products;
      images->MvDot(*vectors, products);
      EXPECT_NEAR(products[1], n * third * third, 1e-14 * n);
      const std::unique_ptr<Many> one(images->CloneViewNonConst({0}));
      identity.Apply(*model, *one); // what belongs to somebody else is not touched
      EXPECT_EQ(entries[0], std::sin(1. + 100 * rank));
    }

    TEST_F(KrylovVectorsOfRanks, SumOverTheRanks)
    {
      EXPECT_EQ(model->GetGlobalLength(), 21 * n_ranks + n_ranks * (n_ranks - 1) / 2);
      const auto ones = clone(2);
      ones->MvInit(1);
      std::vector<double> sums;
      ones->MvDot(*ones, sums);
      EXPECT_EQ(sums, std::vector<double>(2, static_cast<double>(model->GetGlobalLength())));
      Teuchos::SerialDenseMatrix<int, double> products(2, 1);
      model->MvTransMv(3, *ones, products);
      double all = std::accumulate(entries.begin(), entries.end(), 0.);
      MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
      EXPECT_NEAR(products(1, 0), 3 * all, 1e-13 * model->GetGlobalLength());
    }
  } // namespace
} // namespace myolines
