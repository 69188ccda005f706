// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/fem/vertex_stars.h>

#include <deal.II/lac/full_matrix.h>

#include <gtest/gtest.h>

#include <random>

namespace myolines
{
  namespace
  {
    /// Symmetric positive definite random element matrices on a small block with a fixed end.
    class Stars : public ::testing::TestWithParam<unsigned int>
    {
    protected:
      Stars()
        : mesh_(MPI_COMM_SELF)
        , element_(GetParam(), GetParam() + 1)
      {
        make_block(mesh_, {{3., 2., 2.}}, {{3, 2, 2}}, 0);
        space_   = std::make_unique<NodeSpace>(mesh_, GetParam());
        batches_ = std::make_unique<CellBatches>(*space_, element_);
        constraints_.reinit(space_->relevant_unknowns());
        for (const auto node : space_->face_nodes(0))
          for (unsigned int c = 0; c < 3; ++c)
            constraints_.add_line(3 * node + c);
        for (const auto node : space_->face_nodes(3))
          constraints_.add_line(3 * node + 1);
        constraints_.close();
        stars_  = std::make_unique<VertexStars>(*space_, *batches_, element_, constraints_);
        matrix_ = std::make_unique<BlockMatrix>(*space_, *batches_, element_.n_nodes, constraints_);
        fill();
      }

      void fill()
      {
        stars_->clear();
        matrix_->clear();
        std::mt19937                           engine(3);
        std::uniform_real_distribution<double> random(-1, 1);
        const int                              n = element_.n_nodes;
        dealii::AlignedVector<double>          matrices(std::size_t(9) * n * n * n_lanes);
        const auto                             at = [&](const int a, const int c, const int i, const int j, const int lane) -> double                             &{
          return matrices[((std::size_t(3 * a + c) * n + i) * n + j) * n_lanes + lane];
        };
        for (unsigned int b = 0; b < batches_->n_batches(); ++b)
          {
            for (int lane = 0; lane < n_lanes; ++lane)
              for (int ia = 0; ia < 3 * n; ++ia)
                for (int jc = 0; jc <= ia; ++jc)
                  at(ia % 3, jc % 3, ia / 3, jc / 3, lane) = at(jc % 3, ia % 3, jc / 3, ia / 3, lane) =
                      random(engine) + (ia == jc ? 3. * n : 0.);
            stars_->add(b, matrices.data());
            matrix_->add(b, matrices.data());
          }
      }

      Vector random_vector() const
      {
        Vector x = space_->make_vector();
        for (unsigned int i = 0; i < x.size(); ++i)
          if (!constraints_.is_constrained(i))
            x(i) = std::sin(1. + i);
        return x;
      }

      NodeSpace::Mesh              mesh_;
      const Element                element_;
      std::unique_ptr<NodeSpace>   space_;
      std::unique_ptr<CellBatches> batches_;
      Constraints                  constraints_;
      std::unique_ptr<VertexStars> stars_;
      std::unique_ptr<BlockMatrix> matrix_;
    };

    /// The stars found by position: the free unknowns nearer than one cell to a vertex in every direction.
    TEST_P(Stars, PatchesArePrincipalSubmatrices)
    {
      const Vector                           r = random_vector();
      std::vector<std::vector<unsigned int>> sets;
      for (const auto vertex : stars_->coarse_space().nodes().locally_owned_dofs())
        {
          sets.emplace_back();
          for (unsigned int node = 0; node < r.size() / 3; ++node)
            {
              const auto away = space_->node_position(node) - stars_->coarse_space().node_position(vertex);
              if (std::abs(away[0]) < 1 - 1e-9 && std::abs(away[1]) < 1 - 1e-9 && std::abs(away[2]) < 1 - 1e-9)
                for (unsigned int c = 0; c < 3; ++c)
                  if (!constraints_.is_constrained(3 * node + c))
                    sets.back().push_back(3 * node + c);
            }
        }
      Vector expected = space_->make_vector(), z = expected;
      for (const auto &set : sets)
        if (!set.empty())
          {
            dealii::FullMatrix<double> A(set.size());
            for (unsigned int i = 0; i < set.size(); ++i)
              for (unsigned int j = 0; j < set.size(); ++j)
                A(i, j) = matrix_->matrix().el(set[i], set[j]);
            A.gauss_jordan();
            for (unsigned int i = 0; i < set.size(); ++i)
              for (unsigned int j = 0; j < set.size(); ++j)
                expected(set[i]) += A(i, j) * r(set[j]);
          }
      EXPECT_EQ(stars_->patches().invert(), 0u);
      EXPECT_EQ(stars_->patches().overlap(), GetParam() == 1 ? 1 : 8);
      stars_->patches().apply(r, z);
      z -= expected;
      EXPECT_LT(z.linfty_norm(), 1e-4 * expected.linfty_norm());
    }

    TEST_P(Stars, CoarseMatrixIsGalerkin)
    {
      Vector x = stars_->coarse_space().make_vector(), y = x, expected = x;
      for (unsigned int i = 0; i < x.size(); ++i)
        if (!stars_->coarse_constraints().is_constrained(i))
          x(i) = std::cos(2. + i);
      Vector fine = space_->make_vector(), image = fine;
      stars_->interpolation().add(x, fine);
      matrix_->matrix().vmult(image, fine);
      stars_->interpolation().restrict_to(image, expected);
      for (unsigned int i = 0; i < x.size(); ++i)
        if (stars_->coarse_constraints().is_constrained(i))
          expected(i) = 0;
      stars_->coarse_matrix().vmult(y, x);
      y -= expected;
      EXPECT_LT(y.linfty_norm(), 1e-12 * expected.linfty_norm());
    }

    TEST_P(Stars, EntriesOfTheCoarseMatrixComeBackWithTheNextState)
    {
      Vector x = stars_->coarse_space().make_vector(), before = x, after = x;
      for (unsigned int i = 0; i < x.size(); ++i)
        x(i) = std::cos(2. + i);
      stars_->coarse_matrix().vmult(before, x);
      release_entries(stars_->coarse_matrix());
      fill();
      stars_->coarse_matrix().vmult(after, x);
      after -= before;
      EXPECT_GT(before.linfty_norm(), 1);
      EXPECT_EQ(after.linfty_norm(), 0);
    }

    TEST_P(Stars, InterpolationReproducesLinearFunctionsAndItsTransposeIsRestriction)
    {
      const NodeSpace &coarse = stars_->coarse_space();
      Vector           x = coarse.make_vector(), fine = space_->make_vector(), back = x;
      const auto       f = [](const dealii::Point<3> &p, const unsigned int c) { return p[0] * (1 + p[1] + 2. * c + p[1] * p[2]); };
      for (unsigned int node = 0; node < x.size() / 3; ++node)
        for (unsigned int c = 0; c < 3; ++c)
          x(3 * node + c) = f(coarse.node_position(node), c);
      stars_->interpolation().add(x, fine);
      for (unsigned int node = 0; node < fine.size() / 3; ++node)
        for (unsigned int c = 0; c < 3; ++c)
          if (!constraints_.is_constrained(3 * node + c))
            {
              EXPECT_NEAR(fine(3 * node + c), f(space_->node_position(node), c), 1e-12);
            }
      const Vector r = random_vector();
      stars_->interpolation().restrict_to(r, back);
      EXPECT_NEAR(back * x, r * fine, 1e-11);
    }

    INSTANTIATE_TEST_SUITE_P(Degree, Stars, ::testing::Values(1u, 2u, 3u));
  } // namespace
} // namespace myolines
