#pragma once

#include "nox_vector.h"

#include <myolines/solve/lifted_function.h>
#include <myolines/solve/newton_steps.h>

#include <NOX.H>

namespace myolines
{
  /// What the parts of one solve with NOX share.
  struct NoxSolve
  {
    NonlinearProblem &problem;
    LiftedFunction    function;
    WorkLedger       &ledger;
    double            relative_tolerance;
    double            absolute_tolerance;
    unsigned int      maximum_iterations;
    unsigned int      maximum_cuts;
    unsigned int      patience;        ///< steps in a row that may raise |G|
    double            patience_growth; ///< by at most this factor

    bool         was_patient       = false;
    std::string  reason            = "";
    bool         inadmissible      = false;
    unsigned int iterations        = 0;
    unsigned int linear_iterations = 0;
    double       initial_norm      = 0;
    NewtonSteps  steps             = {};

    double tolerance() const { return std::max(relative_tolerance * initial_norm, absolute_tolerance); }
  };

  /// A point, G there and the Newton direction.
  class NoxGroup : public NOX::Abstract::Group
  {
  public:
    NoxGroup(NoxSolve &solve, const Vector &x)
      : solve_(solve)
      , x_(x)
      , g_(x)
      , direction_(x)
    {
      moved(1);
    }

    NOX::Abstract::Group &operator=(const NOX::Abstract::Group &other) override
    {
      const auto &from  = dynamic_cast<const NoxGroup &>(other);
      x_.values         = from.x_.values;
      g_.values         = from.g_.values;
      direction_.values = from.direction_.values;
      sample_           = from.sample_;
      first_            = from.first_;
      evaluated_        = from.evaluated_;
      has_direction_    = from.has_direction_;
      return *this;
    }

    void setX(const NOX::Abstract::Vector &x) override
    {
      x_ = x;
      moved(1);
    }

    void computeX(const NOX::Abstract::Group &from, const NOX::Abstract::Vector &direction, const double step) override
    {
      const auto  &origin    = dynamic_cast<const NoxGroup &>(from);
      const double remaining = (1 - step) * origin.sample_.remaining;
      x_.values              = origin.x_.values;
      x_.values.add(step, NoxVector::of(direction));
      if (remaining == 0)
        solve_.function.impose(x_.values);
      x_.values.update_ghost_values();
      moved(remaining);
      first_ = false;
    }

    ReturnType computeF() override
    {
      if (!evaluated_)
        sample_ = first_ ? solve_.function.first(x_.values, sample_.stamp, g_.values)
                         : solve_.function.evaluate(x_.values, sample_.stamp, sample_.remaining, g_.values);
      evaluated_ = true;
      return sample_.evaluation.admissible ? Ok : Failed;
    }

    ReturnType computeJacobian() override { return evaluated_ ? Ok : BadDependency; }

    /// An inexact direction that reduces the linear residual is still a good one: the line search judges it.
    ReturnType computeNewton(Teuchos::ParameterList &list) override
    {
      if (has_direction_)
        return Ok;
      const LinearReport report =
          solve_.function.direction(x_.values, sample_, g_.values, list.get<double>("Tolerance"), direction_.values);
      ++solve_.iterations;
      solve_.ledger.count("newton iterations");
      solve_.linear_iterations += report.iterations;
      has_direction_ = report.converged || report.relative_residual < 0.5;
      if (!has_direction_)
        solve_.reason = "linear solver: " + report.reason;
      return has_direction_ ? Ok : Failed;
    }

    bool isF() const override { return evaluated_; }
    bool isJacobian() const override { return evaluated_; }
    bool isNewton() const override { return has_direction_; }

    const NOX::Abstract::Vector &getX() const override { return x_; }
    const NOX::Abstract::Vector &getF() const override { return g_; }
    double                       getNormF() const override { return sample_.norm; }
    const NOX::Abstract::Vector &getNewton() const override { return direction_; }
    /// The gradient of |G|^2 / 2 needs J^T; nothing here asks for it.
    const NOX::Abstract::Vector &getGradient() const override { throw std::logic_error("the Newton group has no gradient"); }

    Teuchos::RCP<const NOX::Abstract::Vector> getXPtr() const override { return Teuchos::rcpFromRef(x_); }
    Teuchos::RCP<const NOX::Abstract::Vector> getFPtr() const override { return Teuchos::rcpFromRef(g_); }
    Teuchos::RCP<const NOX::Abstract::Vector> getNewtonPtr() const override { return Teuchos::rcpFromRef(direction_); }
    Teuchos::RCP<const NOX::Abstract::Vector> getGradientPtr() const override { return Teuchos::rcpFromRef(getGradient()); }

    Teuchos::RCP<NOX::Abstract::Group> clone(NOX::CopyType) const override { return Teuchos::rcp(new NoxGroup(*this)); }

    const LiftedFunction::Sample &sample() const { return sample_; }

  private:
    void moved(const double remaining)
    {
      sample_           = {};
      sample_.stamp     = solve_.function.new_stamp();
      sample_.remaining = remaining;
      first_            = true;
      evaluated_        = false;
      has_direction_    = false;
    }

    NoxSolve              &solve_;
    NoxVector              x_;
    NoxVector              g_;
    NoxVector              direction_;
    LiftedFunction::Sample sample_;
    bool                   first_         = true; ///< x was given, not reached by a step
    bool                   evaluated_     = false;
    bool                   has_direction_ = false;
  };
} // namespace myolines
