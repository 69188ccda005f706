// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/solve/free_unknowns.h>
#include <myolines/system/band_linearisation.h>
#include <myolines/time/first_order_form.h>
#include <myolines/time/start.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace myolines
{
  /// A solver of its own: mass and tangent are wanted in turn, and each is kept.
  class FirstOrderForm::Mass
  {
  public:
    explicit Mass(const IntegratorContext &context)
      : linear_(scene::list_of_defaults(LinearSolver::linear_schema(), "solver of the mass"),
                scene::list_of_defaults(LinearSolver::preconditioner_schema(), "solver of the mass", preconditioner(context.system)),
                context.ledger)
      , nonlinear_(scene::list_of_defaults(NonlinearSolver::schema(), "solver of the mass",
                                           {"relative tolerance=1e-12", "absolute tolerance=0", "forcing maximum=1e-4"}),
                   linear_, context.ledger)
      , solver(IntegratorContext{context.system, nonlinear_, context.boundary_rates, context.ledger})
    {}

  private:
    /// A consistent mass is well conditioned once its diagonal is scaled; bands are factored.
    static std::vector<std::string> preconditioner(const SemiDiscreteSystem &system)
    {
      const bool band = dynamic_cast<BandLinearisation *>(system.make_linearisation().get()) != nullptr;
      return band ? std::vector<std::string>{} : std::vector<std::string>{"type=jacobi"};
    }

    LinearSolver    linear_;
    NonlinearSolver nonlinear_;

  public:
    StageSolver solver;
    bool        linearised = false;
  };

  FirstOrderForm::FirstOrderForm(const IntegratorContext &context, const State &layout)
    : context_(context)
    , solver_(context)
    , constraints_(std::make_unique<FreeUnknowns>(context.system.constraints(), layout.u))
    , full_{layout.t, layout.u, layout.u, layout.u}
    , in_(layout.u)
    , out_(layout.u)
  {
    for (unsigned int i = 0; i < layout.u.locally_owned_size(); ++i)
      if (!context.system.constraints().is_constrained(layout.u.get_partitioner()->local_to_global(i)))
        free_.push_back(i);
    n_free_of_all_ranks_ = dealii::Utilities::MPI::sum(free_.size(), communicator());
  }

  FirstOrderForm::~FirstOrderForm() = default;

  void FirstOrderForm::start_piece(State &state)
  {
    myolines::start_piece(context_, solver_, state);
    begin_piece(state.t);
    if (context_.system.capabilities().inertia)
      consistent_acceleration(context_, solver_, Side::right, state);
    else
      consistent_rates(state);
  }

  /// Newton's method with halved steps where they do not help.
  void FirstOrderForm::consistent_rates(State &state)
  {
    const std::size_t   n = n_free();
    std::vector<double> y(2 * n), trial(2 * n), r(n), d(n);
    gather(state, y.data());
    const auto size = [&](const std::vector<double> &at) {
      if (!residual(state.t, at.data(), nullptr, r.data()))
        throw SolveError("The initial rates cannot be computed: " + take_reason() + ".");
      return std::sqrt(dealii::Utilities::MPI::sum(std::inner_product(r.begin(), r.end(), r.begin(), 0.), communicator()));
    };
    const double begin = size(y);
    double       now   = begin;
    for (unsigned int iteration = 0; now > 1e-12 * begin && iteration < 100; ++iteration)
      {
        linearise(state.t, y.data(), nullptr);
        if (!solve({0, 1, 0}, r.data(), d.data()))
          break;
        double part = 1, next = now;
        for (; part > 1e-6; part /= 2)
          {
            trial = y;
            for (std::size_t i = 0; i < n; ++i)
              trial[n + i] -= part * d[i];
            next = size(trial);
            if (next < now)
              break;
          }
        if (!(next < now)) // rounding
          break;
        y   = trial;
        now = next;
      }
    if (!std::isfinite(now) || (now > 1e-6 * begin && now > 1e-6))
      throw SolveError("The initial rates cannot be computed: nothing balances the system at its start.");
    scatter(y.data() + n, state.v);
    context_.system.prescribed(state.t, Side::right, state);
  }

  void FirstOrderForm::gather(const State &state, double *y, double *a) const
  {
    gather(state.u, y);
    gather(state.v, y + n_free());
    if (a != nullptr)
      gather(state.a, a);
  }

  State &FirstOrderForm::state(const double t, const double *y, const double *a)
  {
    full_.t = t;
    scatter(y, full_.u);
    scatter(y + n_free(), full_.v);
    scatter(a, full_.a);
    context_.system.prescribed(t, side(t), full_);
    return full_;
  }

  bool FirstOrderForm::residual(const double t, const double *y, const double *a, double *r)
  {
    const State     &at         = state(t, y, a);
    const Evaluation evaluation = context_.system.residual({t, side(t), at.u, at.v, at.a}, out_);
    ++counts_.residual_evaluations;
    if (!evaluation.admissible)
      {
        reason_ = evaluation.reason;
        return false;
      }
    constraints_->condense(out_);
    gather(out_, r);
    return true;
  }

  void FirstOrderForm::linearise(const double t, const double *y, const double *a)
  {
    const State &at = state(t, y, a);
    solver_.linearise({t, side(t), at.u, at.v, at.a});
  }

  bool FirstOrderForm::solve(const Weights &w, const double *b, double *x) { return solve(solver_, w, b, x, true); }

  void FirstOrderForm::apply(const Weights &w, const double *x, double *y) { apply(solver_, w, x, y); }

  void FirstOrderForm::linearise_mass(const double t, const double *y)
  {
    if (!mass_)
      mass_ = std::make_unique<Mass>(context_);
    if (mass_->linearised)
      return;
    const State &at = state(t, y, nullptr);
    mass_->solver.linearise({t, side(t), at.u, at.v, at.a});
    mass_->linearised = true;
  }

  bool FirstOrderForm::solve_mass(const double *b, double *x) { return solve(mass_->solver, {0, 0, 1}, b, x, false); }

  void FirstOrderForm::apply_mass(const double *x, double *y) { apply(mass_->solver, {0, 0, 1}, x, y); }

  StepReport FirstOrderForm::take_counts() { return std::exchange(counts_, {}); }

  void FirstOrderForm::scatter(const double *values, Vector &x) const
  {
    for (std::size_t i = 0; i < free_.size(); ++i)
      x.local_element(free_[i]) = values != nullptr ? values[i] : 0;
  }

  void FirstOrderForm::gather(const Vector &x, double *values) const
  {
    for (std::size_t i = 0; i < free_.size(); ++i)
      values[i] = x.local_element(free_[i]);
  }

  bool FirstOrderForm::solve(StageSolver &solver, const Weights &w, const double *b, double *x, const bool roughly)
  {
    in_ = 0;
    scatter(b, in_);
    in_ *= -1;
    out_                         = 0;
    const NonlinearReport report = solver.solve_linear(w, in_, out_, roughly);
    counts_.newton_iterations += report.iterations;
    counts_.linear_iterations += report.linear_iterations;
    if (!report.converged)
      {
        reason_ = report.reason;
        return false;
      }
    gather(out_, x);
    return true;
  }

  void FirstOrderForm::apply(const StageSolver &solver, const Weights &w, const double *x, double *y)
  {
    in_ = 0;
    scatter(x, in_);
    constraints_->distribute(in_);
    solver.apply(w, in_, out_);
    constraints_->condense(out_);
    gather(out_, y);
  }
} // namespace myolines
