#pragma once

#include <myolines/time/stage.h>

#include <string>
#include <vector>

namespace myolines
{
  /// Diagonally implicit Runge-Kutta method, stiffly accurate: the last stage is the end of the step.
  ///
  ///     v_i = v_0 + dt sum_j a_ij A_j,   u_i = u_0 + dt sum_j a_ij v_j,   R(t_0 + c_i dt, u_i, v_i, A_i) = 0,   c_i = sum_j a_ij.
  ///
  /// A first stage with a_11 = 0 is the beginning of the step. Unknowns of first order take v_i from u_i alone, algebraic ones
  /// only u_i: both are served by the same formulas.
  struct DirkTable
  {
    std::vector<std::vector<double>> a; ///< row i has i + 1 entries, the diagonal ones > 0 but for the first

    bool   explicit_first_stage() const { return a[0][0] == 0; }
    double c(std::size_t stage) const;
  };

  /// Steps of a DirkTable with a solver that others may use too. Nothing is remembered from step to step.
  class DirkStepper
  {
  public:
    /// @p linear: the system is.
    DirkStepper(DirkTable table, StageSolver &solver, const bool linear)
      : table_(std::move(table))
      , solver_(solver)
      , linear_(linear)
    {}

    /// As Integrator::step.
    StepReport step(double dt, State &state);

  private:
    void   allocate(const State &state);
    void   predict(std::size_t stage, double dt, const State &state, State &point);
    double diagonal(std::size_t stage, double dt) const { return table_.a[stage][stage] * dt; }

    DirkTable          table_;
    StageSolver       &solver_;
    const bool         linear_;
    std::vector<State> stages_;
    Vector             d_;
    Vector             increment_; ///< u of the last stage - u_0
  };

  /// The method as an integrator. @throws InputError if the system does not fit the facts.
  std::unique_ptr<Integrator> make_dirk(const DirkTable &table, const MethodFacts &facts, const scene::Node &integrator,
                                        const IntegratorContext &context);

  /// gamma = 1 - 1/sqrt(2): two stages, order 2, L-stable (Alexander, doi:10.1137/0714068).
  DirkTable sdirk2_table();
} // namespace myolines
