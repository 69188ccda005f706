# SPDX-License-Identifier: LGPL-2.1-or-later
"""Requirement: integrators written in Python run through the loop of the library as its own do."""

import os
import unittest

import methods
import numpy as np
from common import INPUT, FolderTest, block, oscillator

import myolines


def error(method, step, **values):
    """At t = 2 of u'' + u = 0 from 1."""
    scene = oscillator(**{"integrator/type": method, "time/step": step, "time/control/type": "fixed"}).update(values)
    return abs(myolines.Simulation(scene).advance_to(2).u[0] - np.cos(2))


class Methods(FolderTest):
    def test_orders(self):
        for method, order in ((methods.Trapezoidal, 2), (methods.Theta, 1), (methods.TwoStep, 2), (methods.Explicit, 1)):
            errors = [error(method.name, step) for step in (0.02, 0.01)]
            self.assertAlmostEqual(np.log2(errors[0] / errors[1]), order, delta=0.1, msg=method.name)

    def test_parameters_are_those_of_scenes(self):
        self.assertLess(error("own theta method", 0.02, **{"integrator/theta": 0.5}), 0.02 * error("own theta method", 0.02))
        with self.assertRaisesRegex(myolines.InputError, "out of range"):
            oscillator(**{"integrator/type": "own theta method", "integrator/theta": 2})
        self.assertIn("own theta method", myolines.describe("integrators"))
        self.assertIn("theta", myolines.describe("integrators", "own theta method"))

    def test_it_is_the_method_of_the_library(self):
        values = {"integrator/type": "newmark", "time/step": 0.02, "time/control/type": "fixed"}
        scene = oscillator(**{**values, "integrator/first step": "own"})
        library = myolines.Simulation(scene).advance_to(2).u[0]
        own = myolines.Simulation(oscillator(**{**values, "integrator/type": "own trapezoidal rule"})).advance_to(2).u[0]
        self.assertAlmostEqual(own, library, 12)

    def test_in_the_muscle(self):
        scene = block().update({"system/activation": {"type": "ramp", "amplitude": 1, "duration": 0.05}})
        own = myolines.run(scene.with_values({"integrator/type": "own theta method"}), self.place("own"))
        library = myolines.run(scene, self.place("library"))
        self.assertTrue(own.done)
        name = "moving end along the line"
        np.testing.assert_allclose(own["reaction"][name], library["reaction"][name], atol=1e-6 * np.abs(library["reaction"][name]).max())

    def test_resumes_bit_for_bit(self):
        scene = oscillator(**{"integrator/type": "own bdf2", "output/checkpoint/every": 10, "output/checkpoint/seconds": 0})
        whole = myolines.run(scene, self.place("whole"))
        half = scene.with_values({"time/end": 2})
        myolines.run(half, self.place("half"))
        resumed = myolines.run(scene, self.place("half"), resume=True)
        self.assertEqual(resumed["trajectory"]["Displacement"][-1], whole["trajectory"]["Displacement"][-1])

    def test_a_step_that_fails(self):
        scene = oscillator(**{"integrator/type": "own bdf2", "time/control/type": "fixed"})
        simulation = myolines.Simulation(scene).advance(0.1)
        before = simulation.u[0]
        with self.assertRaisesRegex(myolines.SolveError, "another size"):
            simulation.advance(0.005)
        self.assertEqual(simulation.u[0], before)

    def test_an_error_in_a_step_is_raised(self):
        @myolines.integrator
        class Wrong(myolines.Integrator):
            name = "own mistake"

            def step(self, dt, state):
                state.u[:] = 7
                return 1 / 0

        simulation = myolines.Simulation(oscillator(**{"integrator/type": "own mistake"}))
        with self.assertRaises(ZeroDivisionError):
            simulation.advance(0.1)
        self.assertEqual(simulation.u[0], 1)

    def test_names(self):
        with self.assertRaisesRegex(ValueError, "there is an integrator"):
            myolines.integrator(type("Again", (myolines.Integrator,), {"name": "bdf2"}))
        with self.assertRaisesRegex(myolines.InputError, "no name"):
            myolines.integrator(type("Nameless", (myolines.Integrator,), {}))


class Rods(unittest.TestCase):
    def test_prescribed_motion(self):
        scene = myolines.Scene(os.path.join(INPUT, "rod_neo_hookean.xml"))
        scene.update({"time/boundary rates": "exact", "time/end": 0.05, "time/step": 5e-4, "integrator/type": "own trapezoidal rule"})
        own = myolines.Simulation(scene).advance_to(0.05)
        reference = myolines.Simulation(scene.update({"integrator/type": "sdirk3", "time/step": 1e-4})).advance_to(0.05)
        np.testing.assert_allclose(own.u, reference.u, atol=2e-3 * np.abs(reference.u).max())


if __name__ == "__main__":
    unittest.main()
