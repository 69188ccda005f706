# SPDX-License-Identifier: LGPL-2.1-or-later
"""Requirement: the examples run, draw, and show what they say."""

import contextlib
import importlib.util
import io
import os
import unittest

from common import INPUT, ROOT, FolderTest

os.environ["MYOLINES_INPUT"] = INPUT


def example(name):
    spec = importlib.util.spec_from_file_location(name, os.path.join(ROOT, "examples", "python", name + ".py"))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class Examples(FolderTest):
    def shown(self, name):
        with contextlib.redirect_stdout(io.StringIO()) as out:
            result = example(name).main(self.folder)
        self.assertTrue(out.getvalue())
        with open(self.place(name + ".png"), "rb") as stream:
            self.assertEqual(stream.read(4), b"\x89PNG")
        return result

    def test_reflex(self):
        sunk = self.shown("reflex")
        self.assertLess(sunk["reflex"], 0.5 * sunk["no reflex"])

    def test_force_length(self):
        fit, truth = self.shown("force_length")
        for (low, high), true in zip(fit.intervals(0.999), truth):
            self.assertTrue(low < true < high, (low, true, high))

    def test_own_integrator(self):
        orders = self.shown("own_integrator")
        for method, order in orders.items():
            self.assertAlmostEqual(order, 2, delta=0.3, msg=method)

    def test_emg_to_force(self):
        run = self.shown("emg_to_force")
        self.assertTrue(run.done)


if __name__ == "__main__":
    unittest.main()
