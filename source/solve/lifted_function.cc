#include <myolines/solve/lifted_function.h>

#include <cmath>
#include <limits>

namespace myolines
{
  namespace
  {
    /// l2 norm over all ranks; unlike that of the vector class it may be NaN in builds with assertions.
    double norm_or_nan(const Vector &x)
    {
      double sum = 0;
      for (const double entry : x)
        sum += entry * entry;
      return std::sqrt(dealii::Utilities::MPI::sum(sum, x.get_mpi_communicator()));
    }
  } // namespace

  LiftedFunction::LiftedFunction(NonlinearProblem &problem, LinearSolver &linear, WorkLedger &ledger, const Vector &layout)
    : problem_(problem)
    , linear_(linear)
    , ledger_(ledger)
    , free_(problem.constraints(), layout)
    , lift_(layout)
  {}

  Vector LiftedFunction::gap(const Vector &x) const
  {
    Vector difference = x;
    problem_.impose(difference);
    difference -= x; // exactly zero on free unknowns, which impose() leaves alone
    return difference;
  }

  void LiftedFunction::linearise(const Vector &x, const std::uint64_t stamp)
  {
    if (linearised_at_ == stamp)
      return;
    const WorkLedger::Timer timer(ledger_, "assembly");
    problem_.linearise(x);
    linearised_at_ = stamp;
  }

  void LiftedFunction::add_lift(const Vector &x, const Vector &missing, Sample &sample, Vector &g)
  {
    linearise(x, sample.stamp);
    problem_.linearisation().apply(problem_.weights(), missing, lift_);
    if (has_rate_gap_)
      problem_.lift_rates(lift_);
    free_.condense(lift_);
    g += lift_;
    lifted_at_       = sample.stamp;
    sample.remaining = 1;
    sample.norm      = norm_or_nan(g);
  }

  LiftedFunction::Sample LiftedFunction::first(const Vector &x, const std::uint64_t stamp, Vector &g)
  {
    has_rate_gap_        = problem_.open_rates(x);
    Sample       sample  = sample_at(x, stamp, g);
    const Vector missing = gap(x);
    const double size    = norm_or_nan(missing);
    if (!std::isfinite(size))
      sample.evaluation = {false, "a prescribed value is not a finite number: a formula or drive is not defined at this time"};
    if (sample.evaluation.admissible && (has_rate_gap_ || size > 0))
      add_lift(x, missing, sample, g);
    return sample;
  }

  LiftedFunction::Sample LiftedFunction::evaluate(const Vector &x, const std::uint64_t stamp, const double remaining, Vector &g)
  {
    if (has_rate_gap_)
      problem_.keep_open(remaining);
    Sample sample    = sample_at(x, stamp, g);
    sample.remaining = remaining;
    if (remaining != 0 && sample.evaluation.admissible)
      {
        g.add(remaining, lift_);
        sample.norm = norm_or_nan(g);
      }
    return sample;
  }

  /// C^T F(x) with the rate gap as open as it is.
  LiftedFunction::Sample LiftedFunction::sample_at(const Vector &x, const std::uint64_t stamp, Vector &g)
  {
    ++evaluations_;
    Sample sample;
    sample.stamp      = stamp;
    sample.evaluation = problem_.residual(x, g);
    sample.norm       = std::numeric_limits<double>::quiet_NaN();
    if (!sample.evaluation.admissible)
      return sample;

    free_.condense(g);
    sample.norm = norm_or_nan(g);
    if (!std::isfinite(sample.norm))
      sample.evaluation = {false, "the residual is not a finite number: a load or motion by a formula, perhaps, that is not defined there"};
    return sample;
  }

  /// Relative residual of a Newton direction that is good where the linear solver stalls.
  constexpr double enough = 0.1;

  LinearReport LiftedFunction::direction(const Vector &x, Sample &sample, Vector &g, const double tolerance, Vector &dx)
  {
    linearise(x, sample.stamp);
    const bool   open    = sample.remaining != 0;
    const Vector missing = open ? gap(x) : Vector();
    if (open && lifted_at_ != sample.stamp)
      {
        g.add(-sample.remaining, lift_);
        add_lift(x, missing, sample, g);
      }
    Vector right(g);
    right *= -1;
    const LinearReport report = linear_.solve(problem_.linearisation(), problem_.weights(), problem_.constraints(), problem_.symmetric(),
                                              right, dx, tolerance, enough);
    free_.distribute(dx);
    if (open)
      dx += missing;
    return report;
  }
} // namespace myolines
