# SPDX-License-Identifier: LGPL-2.1-or-later
"""Requirement: residuals, matrices and solves as NumPy and SciPy see them are those of the system."""

import inspect
import os
import unittest

import numpy as np
from common import INPUT, FolderTest, block, oscillator
from scipy.sparse.linalg import eigsh, gmres

import myolines

RELATIVE = "rtol" if "rtol" in inspect.signature(gmres).parameters else "tol"  # the name of the tolerance before SciPy 1.12


def dynamic_block():
    scene = myolines.Scene(os.path.join(INPUT, "isometric_block.xml"))
    return scene.update({"system/geometry/refinement": 0, "system/tissues/curves/type": "smooth"})


class Block(FolderTest):
    def setUp(self):
        super().setUp()
        self.system = myolines.System(dynamic_block())
        random = np.random.default_rng(1)
        u, v, a = self.system.initial_state(0.1)
        self.t = 0.1
        self.u = u + 1e-4 * random.standard_normal(len(u))
        self.v = v + 1e-3 * random.standard_normal(len(u))
        self.a = a + random.standard_normal(len(u))
        self.x = random.standard_normal(len(u))

    def residual(self, du=0.0, dv=0.0, da=0.0):
        return self.system.residual(self.t, self.u + du * self.x, self.v + dv * self.x, self.a + da * self.x)

    def test_jacobian_against_differences(self):
        at = self.system.linearise(self.t, self.u, self.v, self.a)
        for h, weights in ((1e-8, {"u": 1}), (1e-6, {"v": 1}), (1e-1, {"a": 1})):
            step = {"d" + name: h for name in weights}
            back = {"d" + name: -h for name in weights}
            differences = (self.residual(**step) - self.residual(**back)) / (2 * h)
            product = at.operator(**weights) @ self.x
            self.assertLess(np.linalg.norm(product - differences), 1e-5 * np.linalg.norm(product), weights)

    def test_matrices_are_the_operator_on_free_unknowns(self):
        at, free = self.system.linearise(self.t, self.u, self.v, self.a), self.system.free
        self.assertTrue(0 < free.sum() < len(free))
        x = np.where(free, self.x, 0)
        for matrix, weights in ((at.K, {"u": 1}), (at.C, {"v": 1}), (at.M, {"a": 1}), (at.matrix(2, 3, 4), {"u": 2, "v": 3, "a": 4})):
            product = (at.operator(**weights) @ x)[free]
            np.testing.assert_allclose((matrix @ x)[free], product, atol=1e-10 * np.abs(product).max())
            self.assertEqual(matrix[~free].nnz, 0)
        mass = at.M[free][:, free]
        self.assertEqual(abs(mass - mass.T).max(), 0)
        self.assertGreater(eigsh(mass.tocsc(), 1, sigma=0, return_eigenvectors=False)[0], 0)

    def test_solves(self):
        at, free = self.system.linearise(self.t, self.u, self.v, self.a), self.system.free
        weights = {"u": 1, "v": 1e3, "a": 1e6}
        b = np.where(free, self.x, 0)
        x = at.solve(b, **weights, tolerance=1e-9)
        self.assertEqual(np.abs(x[~free]).max(), 0)
        self.assertLess(np.linalg.norm((at.operator(**weights) @ x - b)[free]), 2e-9 * np.linalg.norm(b))
        matrix = at.matrix(**weights)
        counts = []
        rough = at.preconditioner(**weights)
        solution, code = gmres(matrix + _ones(~free), b, M=rough, atol=0, **{RELATIVE: 1e-8}, callback=counts.append, callback_type="pr_norm")
        self.assertEqual(code, 0)
        self.assertLess(len(counts), 20)
        np.testing.assert_allclose(solution[free], x[free], atol=1e-6 * np.abs(x).max())

    def test_inadmissible(self):
        inside_out = -2 * np.ones_like(self.u)
        inside_out[::3] = np.linspace(0, -1, len(inside_out[::3]))
        self.assertTrue(np.isnan(self.system.residual(self.t, inside_out)).all())
        self.assertIn("det F", self.system.why_inadmissible(self.t, inside_out) or "")
        self.assertIsNone(self.system.why_inadmissible(self.t, self.u, self.v, self.a))

    def test_wrong_sizes(self):
        with self.assertRaisesRegex(ValueError, "numbers is needed"):
            self.system.residual(self.t, np.zeros(5))
        with self.assertRaisesRegex(ValueError, "left"):
            self.system.residual(self.t, self.u, side="up")


def _ones(mask):
    from scipy.sparse import diags

    return diags(mask.astype(float))


class Small(unittest.TestCase):
    def test_oscillator(self):
        system = myolines.System(oscillator(**{"system/mass": 2, "system/damping": 3, "system/cubic stiffness": 5}))
        self.assertEqual(system.n_unknowns, 1)
        self.assertEqual(system.residual(0, np.array([2.0]), np.array([1.0]), np.array([0.5]))[0], 2 * 0.5 + 3 + 2 + 5 * 8)
        at = system.linearise(0, np.array([2.0]))
        self.assertEqual((at.K[0, 0], at.C[0, 0], at.M[0, 0]), (1 + 15 * 4, 3, 2))
        self.assertFalse(system.capabilities["linear"])
        np.testing.assert_allclose(at.solve(np.array([122.0]), u=1), [2])

    def test_of_a_simulation(self):
        simulation = myolines.Simulation(block()).advance(0.03)
        system = simulation.system
        residual = system.residual(simulation.t, simulation.u, simulation.v, simulation.a)
        self.assertLess(np.abs(residual[system.free]).max(), 1e-6)
        np.testing.assert_array_equal(np.sort(system.gathered(simulation.u)), np.sort(simulation.u))
        self.assertAlmostEqual(system.dot(residual, residual), float(residual @ residual))

    def test_frequency_of_a_rod(self):
        """Of the linear rod with fixed ends: c = sqrt(P/rho), f_1 = c/(2 L)."""
        scene = myolines.Scene(os.path.join(INPUT, "rod_linear.xml"))
        system = myolines.System(scene.update({"system/elements": 32}))
        u, _, _ = system.initial_state()
        at, free = system.linearise(0, u), system.free
        stiffness, mass = at.K[free][:, free].tocsc(), at.M[free][:, free].tocsc()
        lowest = np.sort(eigsh(stiffness, 3, mass, sigma=0, return_eigenvectors=False))
        np.testing.assert_allclose(np.sqrt(lowest / lowest[0]), [1, 2, 3], rtol=1e-4)


if __name__ == "__main__":
    unittest.main()
