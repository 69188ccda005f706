# SPDX-License-Identifier: LGPL-2.1-or-later
"""Requirement: two ranks say what one says."""

import os
import subprocess
import sys
import unittest

import numpy as np
from common import FolderTest

SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "ranks.py")


def numbers(command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(done.stderr)
    return np.array([float(line) for line in done.stdout.split()])


class Ranks(FolderTest):
    def test_two_are_one(self):
        alone = numbers([sys.executable, "-B", SCRIPT, self.place("one")])
        together = numbers(["mpirun", "-np", "2", sys.executable, "-B", SCRIPT, self.place("two")])
        self.assertEqual(len(alone), len(together))
        np.testing.assert_allclose(together, alone, rtol=1e-4, atol=1e-6 * np.abs(alone[1:4]).max())

    def test_an_error_on_one_rank_ends_all(self):
        script = ("import myolines\nif myolines.rank() == 1:\n    raise RuntimeError('one rank alone')\n"
                  "myolines._core.barrier()\n")
        done = subprocess.run(["mpirun", "-np", "2", sys.executable, "-c", script], capture_output=True, text=True, timeout=120)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("one rank alone", done.stderr)


if __name__ == "__main__":
    unittest.main()
