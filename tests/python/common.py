# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the tests of the Python package share."""

import os
import shutil
import tempfile
import unittest

import myolines

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
INPUT = os.path.join(ROOT, "input")


def oscillator(**values):
    """m u'' + c u' + k u = f(t), f steered, by a method of high order."""
    scene = myolines.Scene(os.path.join(INPUT, "oscillator.xml"))
    scene.update({"integrator/type": "sdirk3", "system/force/type": "steered", "time/end": 4, "time/step": 0.01})
    return scene.update(values)


def unit(masses=0):
    """Muscle and tendon; length and excitation are steered, the activation is solved with the motion."""
    scene = myolines.Scene.template("muscle-tendon unit", "sdirk3")
    length = scene["system/data/optimal unit length"] or 0.5
    return scene.update({
        "system/masses": masses, "system/activation": "unknown", "time/end": 2, "time/step": 1e-3,
        "system/data/optimal unit length": length,
        "system/input": {"type": "profiles", "length": {"type": "steered", "value": length}, "excitation": {"type": "steered", "value": 0.1}}})


def block():
    """One cell of muscle on which an end is moved; quick."""
    scene = myolines.Scene.template("muscle 3d", "backward euler")
    return scene.update({
        "system/geometry/refinement": 0,
        "system/boundary/moving end/strain/type": "steered",
        "system/activation": {"type": "steered"},
        "time/end": 0.1, "time/step": 0.01, "time/control/type": "fixed"})


class FolderTest(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="myolines-test-")
        self.addCleanup(shutil.rmtree, self.folder)

    def place(self, name):
        return os.path.join(self.folder, name)
