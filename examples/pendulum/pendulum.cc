// SPDX-License-Identifier: LGPL-2.1-or-later
// A system of one's own, advanced by the integrators of the library.
//
//     pendulum [INTEGRATOR [STEPS]]      as `myolines list integrators` names them; default: newmark 200
//
// Prints the angle after one period of a pendulum that is let go at 60 degrees. It should be 60 degrees again.

#include <myolines/system/band_linearisation.h>
#include <myolines/time/loop.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <cstdio>
#include <string>

namespace
{
  using namespace myolines;

  /// The angle u of a mass at the end of a massless rod: u'' + (g / l) sin u = 0, per m l^2.
  class Pendulum : public SemiDiscreteSystem
  {
  public:
    explicit Pendulum(const double angle, WorkLedger &ledger)
      : angle_(angle)
      , ledger_(ledger)
      , layout_(dealii::complete_index_set(1), MPI_COMM_SELF)
    {
      constraints_.close();
      layout_.update_ghost_values();
    }

    /// By the arithmetic-geometric mean of 1 and cos(angle / 2).
    double period() const
    {
      double a = 1, b = std::cos(angle_ / 2);
      while (a - b > 1e-15)
        {
          const double mean = (a + b) / 2;
          b                 = std::sqrt(a * b);
          a                 = mean;
        }
      return 2 * dealii::numbers::PI / (std::sqrt(gravity / length) * a);
    }

    Capabilities capabilities() const override
    {
      Capabilities capabilities;
      capabilities.rates             = false;
      capabilities.symmetric_tangent = true;
      return capabilities;
    }

    std::size_t        n_unknowns() const override { return 1; }
    const Constraints &constraints() const override { return constraints_; }
    void               prescribed(double, Side, State &) const override {}

    State initial_state(const double t0) const override
    {
      State state{t0, layout_, layout_, layout_};
      state.u.local_element(0) = angle_;
      return state;
    }

    Evaluation residual(const Point &point, Vector &r) const override
    {
      r.local_element(0) = point.a.local_element(0) + gravity / length * std::sin(point.u.local_element(0));
      if (std::isfinite(r.local_element(0)))
        return {};
      return {false, "the angle is not a finite number"};
    }

    std::unique_ptr<Linearisation> make_linearisation() const override
    {
      return std::make_unique<StoredBands>(std::vector<unsigned int>{2}, 0, std::vector<unsigned int>{}, ledger_);
    }

    void linearise(const Point &point, Linearisation &linearisation) const override
    {
      auto &bands = dynamic_cast<StoredBands &>(linearisation);
      bands.begin();
      bands.mass(0, 0)      = 1;
      bands.stiffness(0, 0) = gravity / length * std::cos(point.u.local_element(0));
    }

    std::vector<double> events(double, double) const override { return {}; }

  private:
    static constexpr double gravity = 9.81, length = 1; ///< [m/s^2], [m]

    const double angle_; ///< [rad]
    WorkLedger  &ledger_;
    Constraints  constraints_;
    Vector       layout_;
  };

  /// All digits, as parameters take them.
  std::string text(const double number)
  {
    char digits[32];
    std::snprintf(digits, sizeof(digits), "%.17g", number);
    return digits;
  }
} // namespace

int main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string                              method = argc > 1 ? argv[1] : "newmark";
  const int                                      steps  = argc > 2 ? std::stoi(argv[2]) : 200;
  const double                                   degree = dealii::numbers::PI / 180;
  try
    {
      using scene::list_of_defaults;
      WorkLedger      ledger;
      const Pendulum  pendulum(60 * degree, ledger);
      LinearSolver    linear(list_of_defaults(LinearSolver::linear_schema(), "linear"),
                             list_of_defaults(LinearSolver::preconditioner_schema(), "preconditioner"), ledger);
      NonlinearSolver nonlinear(list_of_defaults(NonlinearSolver::schema(), "nonlinear", {"relative tolerance=1e-12"}), linear, ledger);

      const IntegratorEntry &entry = integrator_entry(method);
      if (!entry.make)
        throw std::runtime_error(method + " chooses its steps itself: this example takes them as they are given");
      const auto integrator =
          entry.make(list_of_defaults(entry.schema, "integrator"), IntegratorContext{pendulum, nonlinear, BoundaryRates::exact, ledger});
      const double      end      = pendulum.period();
      const scene::Node time     = list_of_defaults(time_schema(), "time", {"end=" + text(end), "step=" + text(end / steps)});
      State             state    = pendulum.initial_state(0);
      const auto        control  = make_step_control(time);
      LoopSettings      settings = loop_settings(time);
      settings.end               = end;
      run_loop(pendulum, *integrator, *control, settings, state, {}, ledger);
      std::printf("%.6f degrees after %.6f s, %g steps of %s\n", state.u.local_element(0) / degree, state.t,
                  static_cast<double>(ledger.counted("accepted steps")), method.c_str());
    }
  catch (const std::exception &error)
    {
      std::fprintf(stderr, "%s\n", error.what());
      return 1;
    }
}
