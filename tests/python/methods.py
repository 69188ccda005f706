# SPDX-License-Identifier: LGPL-2.1-or-later
"""Integrators that the tests write."""

import myolines


@myolines.integrator
class Trapezoidal(myolines.Integrator):
    name = "own trapezoidal rule"
    summary = "Newmark's method with beta = 1/4 and gamma = 1/2."
    order = 2
    second_order_only = True

    def step(self, dt, state):
        u = state.u + dt * state.v + dt**2 / 4 * state.a
        v = state.v + dt / 2 * state.a
        return self.solve_stage(state.t + dt, state, u, v, 0 * v, (dt**2 / 4, dt / 2, 1))


@myolines.integrator
class Theta(myolines.Integrator):
    name = "own theta method"
    summary = "Of first order but for theta = 1/2, where it is the trapezoidal rule."
    order = 1
    parameters = {"theta": (1.0, "-", 0.5, 1.0, "Weight of the end.")}

    def step(self, dt, state):
        theta = self.values["theta"]
        c = theta * dt
        v = state.v + (1 - theta) * dt * state.a
        u = state.u + (1 - theta) * dt * state.v + c * v
        return self.solve_stage(state.t + dt, state, u, v, 0 * v, (c * c, c, 1))


@myolines.integrator
class TwoStep(myolines.Integrator):
    """BDF2 for equal steps; remembers the last increments."""

    name = "own bdf2"
    summary = "Backward differences of second order; steps of one size."
    order = 2
    remembers = ("last_dt", "du", "dv")

    def start(self, state):
        super().start(state)
        self.last_dt, self.du, self.dv = 0.0, 0 * state.u, 0 * state.v

    def step(self, dt, state):
        begin = state.u.copy(), state.v.copy()
        if self.last_dt and abs(self.last_dt - dt) > 1e-9 * dt:
            return "the step has another size than the last one"
        c, memory = (1.5 / dt, 1 / 3) if self.last_dt else (1 / dt, 0)
        v = state.v + memory * self.dv
        u = state.u + memory * self.du + v / c
        report = self.solve_stage(state.t + dt, state, u, v, 0 * v, (1, c, c * c))
        if report.accepted:
            self.last_dt, self.du, self.dv = dt, state.u - begin[0], state.v - begin[1]
        return report


@myolines.integrator
class Explicit(myolines.Integrator):
    """Symplectic Euler on a diagonal mass, from residual and matrix alone."""

    name = "own symplectic euler"
    summary = "Explicit in u and v."
    order = 1
    second_order_only = True

    def step(self, dt, state):
        zero = 0 * state.a
        mass = self.system.linearise(state.t, state.u).M.diagonal()
        state.a = -self.system.residual(state.t, state.u, state.v, zero) / mass
        state.v[:] += dt * state.a
        state.u[:] += dt * state.v
        return None
