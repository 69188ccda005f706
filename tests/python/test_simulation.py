# SPDX-License-Identifier: LGPL-2.1-or-later
"""Requirement: a simulation in hand steps as the run does, obeys what is set, and comes back to where it was."""

import os
import signal
import time
import unittest
import warnings

import numpy as np
from common import INPUT, FolderTest, block, oscillator, unit

import myolines

FORCE = "system/force"


def state(simulation):
    return np.concatenate([simulation.u, simulation.v, simulation.a])


class Steps(FolderTest):
    def test_in_pieces_it_is_the_run(self):
        for file, times in (("kinked_rod.xml", 7), ("oscillator.xml", 11)):
            scene = myolines.Scene(os.path.join(INPUT, file))
            whole = myolines.Simulation(scene)
            whole.advance_to(whole.end)
            pieces = myolines.Simulation(scene)
            step, end = scene["time/step"], pieces.end
            while pieces.t < end:
                planned = round(pieces.t / step) + times
                pieces.advance_to(min(end, planned * step))
            np.testing.assert_array_equal(state(pieces), state(whole), file)
            self.assertEqual(pieces.steps, whole.steps)

    def test_it_is_the_run_of_the_program(self):
        scene = oscillator(**{"time/end": 1})
        run = myolines.run(scene, self.place("run"))
        simulation = myolines.Simulation(scene).advance_to(1)
        self.assertEqual(simulation.u[0], run["trajectory"]["Displacement"][-1])
        self.assertEqual(simulation.measure("Velocity"), run["trajectory"]["Velocity"][-1])
        self.assertEqual(simulation.measures()["trajectory.csv"]["Time [s]"], 1)

    def test_times(self):
        simulation = myolines.Simulation(oscillator())
        simulation.advance(0.5).advance(0.25)
        self.assertEqual(simulation.t, 0.75)
        simulation.advance(0)
        for wrong in (0.5, 4.1, float("nan")):
            with self.assertRaisesRegex(myolines.InputError, "cannot advance"):
                simulation.advance_to(wrong)
        self.assertEqual(simulation.t, 0.75)

    def test_several_at_a_time(self):
        heavy, light = myolines.Simulation(oscillator(**{"system/mass": 4})), myolines.Simulation(oscillator())
        for i in range(1, 11):
            heavy.advance_to(0.2 * i)
            light.advance_to(0.2 * i)
        self.assertAlmostEqual(heavy.u[0], np.cos(1), 5)
        self.assertAlmostEqual(light.u[0], np.cos(2), 5)

    def test_a_step_that_fails(self):
        scene = block().update({"solver/nonlinear/maximum iterations": 6, "time/control/type": "fixed"})
        simulation = myolines.Simulation(scene).advance(0.01)
        before = state(simulation)
        simulation.ramp("system/boundary/moving end/strain", -0.97, 0.005)
        with self.assertRaises(myolines.SolveError):
            simulation.advance(0.01)
        self.assertEqual(simulation.t, 0.01)
        np.testing.assert_array_equal(simulation.u, before[: len(before) // 3])

    def test_interrupt(self):
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            simulation = myolines.Simulation(oscillator(**{"time/end": 1e6, "time/control/type": "fixed"}))
        self.assertIn("there will be 1e+08 steps", str(told[0].message))
        signal.setitimer(signal.ITIMER_REAL, 0.2)
        old = signal.signal(signal.SIGALRM, lambda *_: signal.raise_signal(signal.SIGINT))
        self.addCleanup(signal.signal, signal.SIGALRM, old)
        with self.assertRaises(KeyboardInterrupt):
            simulation.advance_to(1e6)
        self.assertGreater(simulation.steps, 0)
        simulation.advance(0.01)


class Steering(FolderTest):
    def test_a_force_that_jumps(self):
        """u'' + u = f: from rest at u = 1; f = 1 from t = 1 on."""
        simulation = myolines.Simulation(oscillator()).advance_to(1)
        simulation.set(FORCE, 1)
        self.assertEqual(simulation.value_of(FORCE), 1)
        simulation.advance_to(3)
        exact = np.cos(3) + 1 - np.cos(2)
        self.assertAlmostEqual(simulation.u[0], exact, 5)
        self.assertEqual(simulation.counts["restarts at events"], 1)

    def test_a_ramp_lands_on_its_kinks(self):
        simulation = myolines.Simulation(oscillator()).advance_to(0.5)
        simulation.ramp(FORCE, 2, 0.503)
        np.testing.assert_allclose(simulation.system.events(0, 4), [0.5, 1.003], rtol=1e-15)
        simulation.advance_to(2)
        slope = 2 / 0.503
        exact = np.cos(2) + slope * (1.5 - np.sin(1.5)) - slope * (0.997 - np.sin(0.997))
        self.assertAlmostEqual(simulation.u[0], exact, 5)

    def test_courses(self):
        """f = sin(2 t) from t = 0 on, as a function and as samples."""
        exact = np.cos(1.5) + (2 * np.sin(1.5) - np.sin(3)) / 3
        times = np.linspace(0, 4, 401)
        for course in (myolines.course(lambda t: np.sin(2 * t)), myolines.samples(times, np.sin(2 * times), "spline")):
            simulation = myolines.Simulation(oscillator())
            simulation.follow(FORCE, course)
            self.assertAlmostEqual(simulation.advance_to(1.5).u[0], exact, 5)

    def test_kinks_of_a_course(self):
        simulation = myolines.Simulation(oscillator())
        simulation.follow(FORCE, myolines.course(lambda t: float(t > 1.2345), kinks=[1.2345]))
        simulation.advance_to(3)
        self.assertAlmostEqual(simulation.u[0], np.cos(3) + 1 - np.cos(3 - 1.2345), 5)

    def test_a_motion(self):
        scene = oscillator(**{"system/support/type": "steered"})
        simulation = myolines.Simulation(scene)
        simulation.follow("system/support", myolines.course(lambda t: t**3, lambda t: 3 * t**2, lambda t: 6 * t))
        simulation.advance_to(1)  # u = cos t + t^3 - 6 t + 6 sin t
        self.assertAlmostEqual(simulation.u[0], np.cos(1) - 5 + 6 * np.sin(1), 5)
        np.testing.assert_allclose([simulation.u[1], simulation.v[1], simulation.a[1]], [1, 3, 6])
        self.assertAlmostEqual(simulation.measure("Support force"), 1 - simulation.u[0], 10)
        with self.assertRaisesRegex(myolines.InputError, "derivatives"):
            myolines.Simulation(scene).follow("system/support", myolines.course(lambda t: t**3))

    def test_before_the_first_step_it_holds_from_the_beginning(self):
        simulation = myolines.Simulation(unit())
        at_rest = simulation.u.copy()
        simulation.set("system/input/excitation", 0.8)
        self.assertFalse(np.array_equal(simulation.u, at_rest))  # another balance
        simulation.advance(0.2)
        self.assertAlmostEqual(simulation.measure("excitation"), 0.8)
        self.assertLess(abs(simulation.measure("muscle strain rate")), 1e-6)  # which it keeps

    def test_refusals(self):
        simulation = myolines.Simulation(unit())
        self.assertEqual(set(simulation.steered), {"system/input/excitation", "system/input/length"})
        with self.assertRaisesRegex(myolines.InputError, 'nearest: "system/input/excitation"'):
            simulation.set("system/input/excitaton", 0.5)
        with self.assertRaisesRegex(myolines.InputError, r"1.5 \[-\] is out of range"):
            simulation.set("system/input/excitation", 1.5)
        with self.assertRaisesRegex(myolines.InputError, "beforehand"):
            myolines.Simulation(unit().update({"system/activation": "beforehand"}))

    def test_muscle_in_three_dimensions(self):
        simulation = myolines.Simulation(block())
        strain = "system/boundary/moving end/strain"
        simulation.advance(0.02)
        force = "moving end along the line"
        self.assertLess(abs(simulation.measure(force, "reaction")), 1e-9)
        simulation.ramp("system/activation", 1, 0.02)
        simulation.advance(0.04)
        active = simulation.measure(force, "reaction")
        self.assertGreater(active, 1)
        simulation.ramp(strain, 0.05, 0.02)
        simulation.advance(0.04)
        self.assertAlmostEqual(simulation.value_of(strain), 0.05)
        self.assertNotEqual(simulation.measure(force, "reaction"), active)


class Moments(FolderTest):
    def go_on(self, simulation):
        simulation.set(FORCE, 0.3)
        simulation.advance(0.5)
        simulation.ramp(FORCE, -1, 0.2)
        return state(simulation.advance(0.7))

    def test_comes_back_bit_for_bit(self):
        for method in ("sdirk3", "bdf2", "generalized alpha"):
            simulation = myolines.Simulation(oscillator(**{"integrator/type": method})).advance(0.5)
            simulation.ramp(FORCE, 1, 1)
            simulation.advance(0.25)
            moment = simulation.save()
            self.assertEqual(moment.t, 0.75)
            first = self.go_on(simulation)
            simulation.restore(moment)
            self.assertEqual((simulation.t, simulation.value_of(FORCE)), (0.75, 0.25))
            np.testing.assert_array_equal(self.go_on(simulation), first, method)

    def test_from_the_beginning(self):
        simulation = myolines.Simulation(oscillator())
        moment = simulation.save()
        first = state(simulation.advance(1))
        np.testing.assert_array_equal(state(simulation.restore(moment).advance(1)), first)

    def test_a_muscle_comes_back(self):
        simulation = myolines.Simulation(block()).advance(0.02)
        simulation.set("system/activation", 0.7)
        simulation.advance(0.02)
        moment = simulation.save()
        first = state(simulation.advance(0.03))
        np.testing.assert_array_equal(state(simulation.restore(moment).advance(0.03)), first)

    def test_of_another_scene(self):
        moment = myolines.Simulation(block()).advance(0.02).save()
        with self.assertRaisesRegex(myolines.InputError, "the moment is of another scene"):
            myolines.Simulation(oscillator()).restore(moment)

    def test_files(self):
        scene = oscillator(**{"integrator/type": "bdf2"})
        simulation = myolines.Simulation(scene)
        with self.assertRaisesRegex(myolines.InputError, "has not begun"):
            simulation.save(self.place("moment"))
        simulation.advance(0.6)
        simulation.save(self.place("moment"))
        later = myolines.Simulation(scene).restore(self.place("moment"))
        self.assertEqual(later.t, simulation.t)
        np.testing.assert_array_equal(state(later.advance(0.5)), state(simulation.advance(0.5)))
        with self.assertRaisesRegex(myolines.InputError, "system/mass"):
            myolines.Simulation(oscillator(**{"system/mass": 7, "integrator/type": "bdf2"})).restore(self.place("moment"))


class Controllers(FolderTest):
    def test_called_at_its_interval(self):
        simulation = myolines.Simulation(oscillator())
        times = []
        simulation.advance_to(1, lambda s: times.append(s.t), every=0.25)
        self.assertEqual(times, [0, 0.25, 0.5, 0.75])
        times.clear()
        simulation.advance(0.05, lambda s: times.append(s.t))
        self.assertEqual(len(times), 5)
        self.assertEqual(simulation.t, 1.05)

    def test_a_controller_damps(self):
        """f = -2 v, sampled every 0.01 s, is a damper nearly: u = (1 + t) e^-t."""
        simulation = myolines.Simulation(oscillator())
        simulation.advance_to(2, lambda s: s.set(FORCE, -2 * s.v[0]))
        self.assertAlmostEqual(simulation.u[0], 3 * np.exp(-2), 2)

    def test_overhead(self):
        """Of 1000 steps of the massless unit under a callback: what it takes beyond the same steps and restarts of the library itself, which
        an own integrator loop in C++ would take too. The figure of doc/python.md; here only that it is not lost by an order."""
        seconds = []
        for _ in range(5):
            simulation = myolines.Simulation(unit())
            begin = time.process_time()
            simulation.advance_to(1, lambda s: s.set("system/input/excitation", 0.1 if s.t < 0.5 else 0.6))
            seconds.append(time.process_time() - begin)
            self.assertEqual(simulation.steps, 1000)
        self.assertLess(min(seconds) / 1000, 5e-4)


if __name__ == "__main__":
    unittest.main()
