# SPDX-License-Identifier: LGPL-2.1-or-later
"""Requirement: fits find the parameters that made the data, and say how well they know them."""

import unittest

import numpy as np
from common import FolderTest, oscillator

import myolines

MASS, DAMPING = "system/mass", "system/damping"
TRUTH = {MASS: 1.3, DAMPING: 0.4}
PARAMETERS = [myolines.Parameter(MASS, low=0.1, high=10, start=1), myolines.Parameter(DAMPING, low=0, high=5, start=0.1)]


def scene():
    return oscillator(**{"time/end": 3, "time/step": 0.05, "system/force/type": "constant"})


def measured(folder, n=40):
    table = myolines.run(scene().update(TRUTH), folder)["trajectory"]
    times = np.linspace(0.05, 2.95, n)
    return times, np.interp(times, table["Time"], table["Displacement"])


def column(times, values, sigma=None, of=None):
    return myolines.Column(of or scene(), "trajectory", "Displacement", times, values, sigma)


class Fits(FolderTest):
    def test_exact_data(self):
        fit = myolines.fit(PARAMETERS, [column(*measured(self.place("truth")))], jobs=1)
        np.testing.assert_allclose(fit.values, list(TRUTH.values()), rtol=1e-6)
        self.assertEqual(fit.weak, [])
        self.assertAlmostEqual(fit[MASS], 1.3, 6)
        self.assertEqual(fit.scenes[0][MASS], fit.values[0])
        self.assertIn("± ", repr(fit))
        self.assertIn("<table>", fit._repr_html_())
        with self.assertRaisesRegex(myolines.InputError, 'nearest: "system/mass"'):
            fit["system/mas"]  # pylint: disable=pointless-statement

    def test_intervals_hold_the_truth(self):
        """20 seeds of noise: each parameter is in its interval of 95 % for 17 or more."""
        times, values = measured(self.place("truth"))
        inside = np.zeros(2, dtype=int)
        for seed in range(20):
            noise = 0.02 * np.random.default_rng(seed).standard_normal(len(times))
            fit = myolines.fit(PARAMETERS, [column(times, values + noise)], jobs=1, tolerance=1e-6)
            ends = fit.intervals()
            inside += [low <= truth <= high for (low, high), truth in zip(ends, TRUTH.values())]
        print("\n  within 95 % intervals, of 20 seeds:", dict(zip(TRUTH, inside.tolist())))
        self.assertTrue((inside >= 17).all(), inside)

    def test_errors_against_known_sigma(self):
        """Of known sigma: J^T J of the closed form of the residuals, here by differences of exact solutions u(t; m, c)."""
        times, values = measured(self.place("truth"))
        fit = myolines.fit(PARAMETERS, [column(times, values, 0.02)], jobs=1)

        def exact(mass, damping):
            decay, omega = damping / (2 * mass), np.sqrt(1 / mass - (damping / (2 * mass)) ** 2)
            return np.exp(-decay * times) * (np.cos(omega * times) + decay / omega * np.sin(omega * times))

        h = 1e-6
        jacobian = np.stack([(exact(1.3 + h, 0.4) - exact(1.3 - h, 0.4)) / (2 * h), (exact(1.3, 0.4 + h) - exact(1.3, 0.4 - h)) / (2 * h)], 1)
        covariance = 0.02**2 * np.linalg.inv(jacobian.T @ jacobian)
        np.testing.assert_allclose(fit.covariance, covariance, rtol=2e-2)
        self.assertTrue(fit.sigma_known)
        self.assertLess(abs(fit.correlation[0, 1]), 1)

    def test_workers_give_the_same(self):
        times, values = measured(self.place("truth"))
        one = myolines.fit(PARAMETERS, [column(times, values)], jobs=1)
        two = myolines.fit(PARAMETERS, [column(times, values)], jobs=2)
        np.testing.assert_array_equal(one.values, two.values)
        self.assertEqual(one.runs, two.runs)

    def test_goes_on_where_it_was_stopped(self):
        times, values = measured(self.place("truth"))
        whole = myolines.fit(PARAMETERS, [column(times, values)], jobs=1)

        calls = []

        def stop(found, cost):
            calls.append(cost)
            if len(calls) == 3:
                raise KeyboardInterrupt

        with self.assertRaises(KeyboardInterrupt):
            myolines.fit(PARAMETERS, [column(times, values)], folder=self.place("fit"), jobs=1, progress=stop)
        resumed = myolines.fit(PARAMETERS, [column(times, values)], folder=self.place("fit"), jobs=1)
        np.testing.assert_array_equal(resumed.values, whole.values)
        self.assertLess(resumed.runs, whole.runs - 5)
        again = myolines.fit(PARAMETERS, [column(times, values)], folder=self.place("fit"), jobs=1)
        self.assertEqual(again.runs, 0)

    def test_several_scenes(self):
        """Each alone tells one parameter."""
        heavy = scene().update({"system/stiffness": 0.5})
        first = measured(self.place("truth"))
        table = myolines.run(heavy.with_values(TRUTH), self.place("heavy"))["trajectory"]
        second = first[0], np.interp(first[0], table["Time"], table["Displacement"])
        fit = myolines.fit(PARAMETERS, [column(*first), column(*second, of=heavy)], jobs=1)
        np.testing.assert_allclose(fit.values, list(TRUTH.values()), rtol=1e-6)
        self.assertEqual([len(part) for part in fit.residuals], [40, 40])

    def test_what_nothing_tells(self):
        """Free oscillations know mass and stiffness by their ratio alone."""
        parameters = [myolines.Parameter(MASS, 0.1, 10, 1), myolines.Parameter("system/stiffness", 0.1, 10, 1.1)]
        times, values = measured(self.place("truth"))
        fit = myolines.fit(parameters, [column(times, values, 0.01, scene().update({DAMPING: 0}))], jobs=1)
        [direction] = fit.weak
        self.assertGreater(direction[MASS] * direction["system/stiffness"], 0)
        self.assertTrue(np.isinf(fit.errors).all() or (fit.errors > 0.5).all(), fit.errors)

    def test_bounds(self):
        times, values = measured(self.place("truth"))
        parameters = [myolines.Parameter(MASS, 0.1, 1.2, 1), PARAMETERS[1]]
        fit = myolines.fit(parameters, [column(times, values)], jobs=1)
        self.assertAlmostEqual(fit[MASS], 1.2, 6)
        self.assertEqual(fit.at_bounds, [MASS])

    def test_refusals(self):
        times, values = measured(self.place("truth"))
        with self.assertRaisesRegex(myolines.InputError, "the start 100 is outside"):
            myolines.fit([myolines.Parameter(MASS, 0, 10, 100)], [column(times, values)], jobs=1)
        with self.assertRaisesRegex(myolines.InputError, "a run that covers"):
            myolines.fit(PARAMETERS, [column(times + 2, values)], jobs=1)
        with self.assertRaisesRegex(myolines.InputError, 'nearest valid name: "mass"'):
            myolines.fit([myolines.Parameter("system/mas", start=1)], [column(times, values)], jobs=2)
        with self.assertRaisesRegex(myolines.InputError, 'nearest: "Displacement"'):
            myolines.fit(PARAMETERS, [myolines.Column(scene(), "trajectory", "Displcement", times, values)], jobs=1)
        with self.assertRaisesRegex(myolines.InputError, "39 measured values"):
            myolines.fit(PARAMETERS, [column(times, values[1:])], jobs=1)


if __name__ == "__main__":
    unittest.main()
