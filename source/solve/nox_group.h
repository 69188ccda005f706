// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "newton.h"
#include "nox_vector.h"

#include <NOX.H>

#include <stdexcept>

namespace myolines
{
  /// A point of Newton's method and its direction, as NOX sees them. NOX drives: it asks for directions with its forcing terms and for
  /// norms; what they are is the affair of Newton.
  class NoxGroup : public NOX::Abstract::Group
  {
  public:
    NoxGroup(Newton &newton, Iterate at)
      : at(std::move(at))
      , newton_(newton)
      , direction_(this->at.x)
      , x_(this->at.x)
    {}

    // The type that NOX wants. NOLINTNEXTLINE(misc-unconventional-assign-operator)
    NOX::Abstract::Group &operator=(const NOX::Abstract::Group &other) override
    {
      const auto &from  = dynamic_cast<const NoxGroup &>(other);
      at                = from.at;
      direction_.values = from.direction_.values;
      has_direction_    = from.has_direction_;
      return *this;
    }

    ReturnType computeF() override { return at.evaluation.admissible ? Ok : Failed; }
    ReturnType computeJacobian() override { return Ok; }
    ReturnType computeNewton(Teuchos::ParameterList &list) override
    {
      has_direction_ = has_direction_ || newton_.direction(at, list.get<double>("Tolerance"), direction_.values);
      return has_direction_ ? Ok : Failed;
    }

    bool isF() const override { return true; }
    bool isJacobian() const override { return true; }
    bool isNewton() const override { return has_direction_; }

    double                       getNormF() const override { return at.norm; }
    const NOX::Abstract::Vector &getNewton() const override { return direction_; }

    void setX(const NOX::Abstract::Vector &) override { unused(); }
    void computeX(const NOX::Abstract::Group &, const NOX::Abstract::Vector &, double) override { unused(); }

    /// NOX makes its vectors of this one.
    const NOX::Abstract::Vector &getX() const override
    {
      x_.values = at.x;
      return x_;
    }
    const NOX::Abstract::Vector &getF() const override { return unused(); }
    const NOX::Abstract::Vector &getGradient() const override { return unused(); }

    Teuchos::RCP<const NOX::Abstract::Vector> getXPtr() const override { return Teuchos::rcpFromRef(getX()); }
    Teuchos::RCP<const NOX::Abstract::Vector> getFPtr() const override { return Teuchos::rcpFromRef(unused()); }
    Teuchos::RCP<const NOX::Abstract::Vector> getNewtonPtr() const override { return Teuchos::rcpFromRef(direction_); }
    Teuchos::RCP<const NOX::Abstract::Vector> getGradientPtr() const override { return Teuchos::rcpFromRef(unused()); }

    Teuchos::RCP<NOX::Abstract::Group> clone(NOX::CopyType) const override { return Teuchos::rcp(new NoxGroup(*this)); }

    Iterate at;

    /// A step of the line search has brought the point here.
    void moved() { has_direction_ = false; }

  private:
    [[noreturn]] static const NOX::Abstract::Vector &unused()
    {
      throw std::logic_error("a Newton group gives norms and directions; points move with their local unknowns");
    }

    Newton           &newton_;
    NoxVector         direction_;
    mutable NoxVector x_;
    bool              has_direction_ = false;
  };
} // namespace myolines
