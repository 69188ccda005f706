// SPDX-License-Identifier: LGPL-2.1-or-later
// Unknowns of second and first order in time and algebraic ones in one state, for methods that take them all.

#include "../support/matrices.h"
#include "experiment.h"

#include <gtest/gtest.h>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  /// Columns have the weights of the order of their unknown.
  class MixedLinearisation : public Linearisation
  {
  public:
    MixedLinearisation()
    {
      dealii::DynamicSparsityPattern pattern(3, 3);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          pattern.add(i, j);
      matrix_.reinit(dealii::complete_index_set(3), pattern, MPI_COMM_SELF);
    }

    void apply(const WeightsByOrder &w, const Vector &x, Vector &r) const override
    {
      for (unsigned int i = 0; i < 3; ++i)
        {
          double sum = 0;
          for (unsigned int j = 0; j < 3; ++j)
            sum += entry(w, i, j) * x.local_element(j);
          r.local_element(i) = sum;
        }
    }

    const SparseMatrix &sparse(const WeightsByOrder &w) override
    {
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          matrix_.set(i, j, entry(w, i, j));
      matrix_.compress(dealii::VectorOperation::insert);
      return matrix_;
    }

    double y = 0;

  private:
    double entry(const WeightsByOrder &w, const unsigned int i, const unsigned int j) const
    {
      const double entries[3][3] = {{w[2].u + w[2].a, 0, -w[0].u}, {0, w[1].u + w[1].v, 0}, {0, -2 * y * w[1].u, w[0].u}};
      return entries[i][j];
    }

    SparseMatrix matrix_;
  };

  /// x'' + x = z, y' + y = sin t, z = y^2 with x = x' = 0, y = 1 at t = 0.
  class Mixed : public SemiDiscreteSystem
  {
  public:
    Capabilities capabilities() const override
    {
      Capabilities c;
      c.orders = {0, 1, 2};
      return c;
    }
    std::size_t n_unknowns() const override { return 3; }
    State       initial_state(double t0) const override
    {
      State state{t0, serial_vector(3), serial_vector(3), serial_vector(3)};
      state.u(1) = state.u(2) = 1;
      state.v(1)              = -1;
      return state;
    }
    const Constraints &constraints() const override { return none_; }
    void               prescribed(double, Side, State &) const override {}
    Evaluation         residual(const Point &p, Vector &r) const override
    {
      r(0) = p.a(0) + p.u(0) - p.u(2);
      r(1) = p.v(1) + p.u(1) - std::sin(p.t);
      r(2) = p.u(2) - p.u(1) * p.u(1);
      return {};
    }
    std::unique_ptr<Linearisation> make_linearisation() const override { return std::make_unique<MixedLinearisation>(); }
    void                linearise(const Point &p, Linearisation &l) const override { dynamic_cast<MixedLinearisation &>(l).y = p.u(1); }
    std::vector<double> events(double, double) const override { return {}; }

  private:
    Constraints none_;
  };

  double y_exact(const double t) { return (std::sin(t) - std::cos(t)) / 2 + 1.5 * std::exp(-t); }

  /// x at t = 1 by the formula of variation of constants, with Simpson's rule.
  double x_exact()
  {
    const unsigned int n   = 2000;
    double             sum = 0;
    for (unsigned int i = 0; i <= n; ++i)
      {
        const double t = 1. * i / n, weight = i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2;
        sum += weight * std::sin(1 - t) * y_exact(t) * y_exact(t);
      }
    return sum / (3 * n);
  }

  class AllOrders : public ::testing::TestWithParam<IntegratorEntry>
  {
  };
} // namespace

TEST_P(AllOrders, areIntegratedWithTheOrderOfTheMethod)
{
  const auto errors = [&](const unsigned int n) {
    Solvers     solvers({"relative tolerance=1e-13", "absolute tolerance=0"});
    const Mixed system;
    const auto  integrator =
        GetParam().make(node(GetParam().schema), IntegratorContext{system, solvers.nonlinear, BoundaryRates::exact, solvers.ledger});
    State state = system.initial_state(0);
    integrator->start(state);
    for (unsigned int i = 0; i < n; ++i)
      {
        const StepReport report = integrator->step(1. / n, state);
        EXPECT_TRUE(report.accepted()) << report.reason;
      }
    EXPECT_NEAR(state.u(2), state.u(1) * state.u(1), 1e-12) << "the algebraic equation holds at every end of a step";
    return std::pair<double, double>(state.u(0) - x_exact(), state.u(1) - y_exact(1));
  };
  const unsigned int n      = GetParam().facts.order == 1 ? 800 : GetParam().facts.order == 2 ? 300 : 60;
  const auto         coarse = errors(n), fine = errors(2 * n);
  EXPECT_NEAR(std::log2(coarse.first / fine.first), GetParam().facts.order, 0.1);
  EXPECT_NEAR(std::log2(coarse.second / fine.second), GetParam().facts.order, 0.1);
}

namespace
{
  std::vector<IntegratorEntry> methods_for_all_orders()
  {
    std::vector<IntegratorEntry> methods;
    for (const IntegratorEntry &entry : integrator_registry())
      if (entry.make && entry.facts.dynamic && entry.facts.unknowns != MethodFacts::Unknowns::second_order && entry.facts.name != "newmark")
        methods.push_back(entry);
    return methods;
  }
} // namespace

INSTANTIATE_TEST_SUITE_P(registry, AllOrders, ::testing::ValuesIn(methods_for_all_orders()), [](const auto &info) {
  std::string name = info.param.facts.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});
