// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/integrators/sundials_arkode_system.h>
#include <myolines/time/stable_step.h>

#include <arkode/arkode_arkstep.h>

#include <algorithm>
#include <functional>
#include <limits>

namespace myolines
{
  ArkodeSystem::ArkodeSystem(const ArkodeTables &tables, const ErrorTolerances &tolerances, const scene::Node &integrator,
                             const IntegratorContext &context, FirstOrderForm &whole, const SundialsContext &sundials, const State &layout)
    : tables_(tables)
    , tolerances_(tolerances)
    , context_(context)
    , whole_(whole)
    , sundials_(sundials)
    , implicit_system_(tables.additive() ? context.system.implicit_part(integrator.text("split")) : nullptr)
    , implicit_form_(implicit_system_
                         ? std::make_unique<FirstOrderForm>(
                               IntegratorContext{*implicit_system_, context.solver, context.boundary_rates, context.ledger}, layout)
                         : nullptr)
    , implicit_(implicit_form_ ? *implicit_form_ : whole)
    , newton_(sundials, [this](const double *b, double *x) { return solve(b, x); })
    , mass_(
          sundials, [this](const double *b, double *x) { return solve_mass(b, x); },
          [this](const double *x, double *y) { return multiply_mass(x, y); })
    , force_(whole.n_free())
    , other_(whole.n_free())
  {}

  ArkodeSystem::~ArkodeSystem() { ARKStepFree(&memory_); }

  void *ArkodeSystem::begin(const double t, N_Vector y)
  {
    whole_.linearise_mass(t, entries(y));
    if (whole_.begins_piece(t))
      implicit_.begin_piece(t);
    ARKStepFree(&memory_);
    create(t, y);
    return memory_;
  }

  double ArkodeSystem::stable_step(const double t, N_Vector y)
  {
    if (tables_.implicit)
      return std::numeric_limits<double>::infinity();
    const State             &at = whole_.state(t, entries(y), nullptr);
    StepReport               report;
    const LargestEigenvalues largest = largest_eigenvalues({t, Side::right, at.u, at.v, at.a}, context_, whole_.stage_solver(), report);
    context_.solver.forget();
    return report.accepted() ? tables_.stable_step(largest.stiffness, largest.rates) : 0;
  }

  void ArkodeSystem::create(const double t, N_Vector y)
  {
    const ARKRhsFn whole = [](double t, N_Vector y, N_Vector f, void *data) {
      ArkodeSystem &system = *static_cast<ArkodeSystem *>(data);
      return system.right_hand_side(system.whole_, t, entries(y), entries(f)) ? 0 : 1;
    };
    const ARKRhsFn implicit_part = [](double t, N_Vector y, N_Vector f, void *data) {
      ArkodeSystem &system = *static_cast<ArkodeSystem *>(data);
      return system.right_hand_side(system.implicit_, t, entries(y), entries(f)) ? 0 : 1;
    };
    const ARKRhsFn explicit_part = [](double t, N_Vector y, N_Vector f, void *data) {
      return static_cast<ArkodeSystem *>(data)->explicit_forces(t, entries(y), entries(f)) ? 0 : 1;
    };
    memory_ = ARKStepCreate(tables_.additive()  ? explicit_part
                            : tables_.explicit_ ? whole
                                                : nullptr,
                            tables_.additive() ? implicit_part
                            : tables_.implicit ? whole
                                               : nullptr,
                            t, y, sundials_);
    tables_.set(memory_);
    ARKStepSetUserData(memory_, this);
    require_success(ARKStepWFtolerances(memory_,
                                        [](N_Vector y, N_Vector weights, void *data) {
                                          const ArkodeSystem &system = *static_cast<ArkodeSystem *>(data);
                                          set_error_weights(system.tolerances_, system.whole_, entries(y), entries(weights));
                                          return 0;
                                        }),
                    "ARKStepWFtolerances");
    if (tables_.implicit)
      {
        require_success(ARKStepSetLinearSolver(memory_, newton_.solver(), newton_.matrix()), "ARKStepSetLinearSolver");
        require_success(ARKStepSetLinSysFn(memory_, linearise), "ARKStepSetLinSysFn");
        // f of a stage from what the iteration found: f(z) would magnify what it left by the stiffness
        ARKStepSetDeduceImplicitRhs(memory_, SUNTRUE);
        newton_method_ = std::make_unique<SundialsNewton>(sundials_, y, whole_);
        require_success(ARKStepSetNonlinearSolver(memory_, newton_method_->solver()), "ARKStepSetNonlinearSolver");
        // fresh at every step: rates of convergence that earlier steps have shown pass a first iteration with a worse matrix
        ARKStepSetLSetupFrequency(memory_, 1);
        ARKStepSetLinearSolutionScaling(memory_, SUNFALSE); // solve() takes the present g
      }
    require_success(ARKStepSetMassLinearSolver(memory_, mass_.solver(), mass_.matrix(), SUNFALSE), "ARKStepSetMassLinearSolver");
    require_success(ARKStepSetMassFn(memory_, [](double, SUNMatrix, void *, N_Vector, N_Vector, N_Vector) { return 0; }),
                    "ARKStepSetMassFn");
    ARKStepSetInterpolantDegree(memory_, 3); // its derivative at the end of a step is that of the equations, for nothing
  }

  bool ArkodeSystem::right_hand_side(FirstOrderForm &form, const double t, const double *y, double *f)
  {
    if (!form.residual(t, y, nullptr, force_.data()))
      return false;
    const std::size_t n = form.n_free();
    std::copy(y + n, y + 2 * n, f);
    std::transform(force_.begin(), force_.end(), f + n, std::negate<>());
    return true;
  }

  bool ArkodeSystem::explicit_forces(const double t, const double *y, double *f)
  {
    if (!implicit_.residual(t, y, nullptr, force_.data()) || !whole_.residual(t, y, nullptr, other_.data()))
      return false;
    const std::size_t n = whole_.n_free();
    std::fill(f, f + n, 0);
    std::transform(force_.begin(), force_.end(), other_.begin(), f + n, std::minus<>());
    return true;
  }

  int ArkodeSystem::linearise(const double t, N_Vector y, N_Vector, SUNMatrix, SUNMatrix, const int up_to_date, int *renewed, const double,
                              void *self, N_Vector, N_Vector, N_Vector)
  {
    if (!up_to_date)
      static_cast<ArkodeSystem *>(self)->implicit_.linearise(t, entries(y), nullptr);
    *renewed = !up_to_date;
    return 0;
  }

  bool ArkodeSystem::solve(const double *b, double *x)
  {
    const std::size_t n = whole_.n_free();
    double            g = 0;
    ARKStepGetCurrentGamma(memory_, &g);
    implicit_.apply({0, g, 1}, b, force_.data());
    for (std::size_t i = 0; i < n; ++i)
      force_[i] += g * b[n + i];
    if (!implicit_.solve({g * g, g, 1}, force_.data(), x))
      return false;
    for (std::size_t i = 0; i < n; ++i)
      x[n + i] = (x[i] - b[i]) / g;
    return true;
  }

  bool ArkodeSystem::solve_mass(const double *b, double *x)
  {
    const std::size_t n = whole_.n_free();
    std::copy(b, b + n, x);
    return whole_.solve_mass(b + n, x + n);
  }

  bool ArkodeSystem::multiply_mass(const double *x, double *y)
  {
    const std::size_t n = whole_.n_free();
    std::copy(x, x + n, y);
    whole_.apply_mass(x + n, y + n);
    return true;
  }
} // namespace myolines
