# SPDX-License-Identifier: LGPL-2.1-or-later
"""Requirement: scenes as objects say, check and refuse what the program does."""

import copy
import os
import pickle
import subprocess
import unittest

from common import INPUT, FolderTest, block

import myolines
from myolines import program


class Values(FolderTest):
    def setUp(self):
        super().setUp()
        self.scene = myolines.Scene(os.path.join(INPUT, "oscillator.xml"))

    def test_reads_values_with_their_kinds(self):
        self.assertEqual(self.scene["time/step"], 0.01)
        self.assertEqual(self.scene["output/series/every"], 1)
        self.assertIsInstance(self.scene["output/series/every"], int)
        self.assertEqual(self.scene["integrator/type"], "backward euler")
        self.assertIsNone(self.scene["time/steps"])
        self.assertIs(block()["output/series/reactions"], True)

    def test_attributes_are_names(self):
        self.scene.system.cubic_stiffness = 4
        self.assertEqual(self.scene["system/cubic stiffness"], 4)
        self.assertEqual(self.scene.system.cubic_stiffness, 4)
        self.assertIn("cubic_stiffness", dir(self.scene.system))

    def test_units(self):
        self.assertEqual(self.scene.unit("system/mass"), "kg")
        self.assertEqual(self.scene.system.unit("stiffness"), "N/m")
        self.scene["system/displacement"] = (30, "mm")
        self.assertAlmostEqual(self.scene["system/displacement"], 0.03, 15)
        with self.assertRaisesRegex(myolines.InputError, r"a number in a unit like \[m\]"):
            self.scene["system/displacement"] = (30, "N")

    def test_a_wrong_value_changes_nothing(self):
        with self.assertRaises(myolines.InputError) as caught:
            self.scene["system/mass"] = -1
        self.assertEqual(self.scene["system/mass"], 1)
        [problem] = caught.exception.problems
        self.assertIn("system/mass", problem.where)
        self.assertIn("out of range", problem.what)
        self.assertEqual(problem.expected, "a number [kg] > 0")
        self.assertEqual(caught.exception.exit_code, 2)

    def test_says_what_the_program_says(self):
        file = os.path.join(INPUT, "oscillator.xml")
        for setting in ("system/mas=1", "tyme/step=1", "integrator/type=bdf3", "time/step=now", "time/control/type=error "):
            said = subprocess.run([program.find(), "check", file, "--set", setting], capture_output=True, text=True).stderr.strip()
            path, _, value = setting.partition("=")
            scene = myolines.Scene(file)
            if said:
                with self.assertRaises(myolines.InputError, msg=setting) as caught:
                    scene[path] = value
                self.assertEqual(str(caught.exception).replace(" (override)", ""), said.replace(" (override)", ""))
            else:
                scene[path] = value

    def test_nearest_names(self):
        with self.assertRaisesRegex(myolines.InputError, 'nearest valid name: "mass"'):
            self.scene["system/mas"] = 1
        with self.assertRaisesRegex(myolines.InputError, 'nearest valid name: "mass"'):
            self.scene["system/mas"]  # pylint: disable=pointless-statement
        with self.assertRaisesRegex(myolines.InputError, 'nearest valid name: "time"'):
            self.scene["tyme/step"]  # pylint: disable=pointless-statement
        with self.assertRaisesRegex(myolines.InputError, 'nearest valid name: "bdf2"'):
            self.scene["integrator/type"] = "bdf3"

    def test_what_is_missing_is_told_later(self):
        self.scene["system/force/type"] = "ramp"  # without its amplitude, which comes now
        with self.assertRaisesRegex(myolines.InputError, "missing parameter \"amplitude\""):
            self.scene.check()
        self.assertIn("missing parameter", repr(self.scene))
        self.scene.update({"system/force/amplitude": 1, "system/force/duration": 0.5})
        self.assertEqual(self.scene.check(), [])

    def test_another_alternative_takes_away_what_was_for_the_former(self):
        scene = myolines.Scene(os.path.join(INPUT, "rod_linear.xml"))
        scene.update({"integrator/type": "bdf2", "time/boundary rates": "exact"})
        self.assertTrue(any("alpha" in note for note in scene.notes))
        scene.check()

    def test_lists_of_ones_own_names(self):
        scene = block()
        scene["system/boundary/pull"] = {"face": "y+", "type": "pressure", "pressure": 100}
        self.assertEqual(scene.system.boundary["pull"].face, "y+")
        self.assertIn("pull", scene["system/boundary"].keys())
        del scene["system/boundary/pull"]
        self.assertNotIn("pull", scene["system/boundary"])

    def test_points_are_rows(self):
        self.scene.update({"system/force/type": "control points", "system/force/points": [(0, 0), (0.5, 1)]})
        self.assertEqual(self.scene["system/force/points"], "0.0 0.0; 0.5 1.0")
        self.scene.check()

    def test_xml_and_back(self):
        self.scene["system/mass"] = 3
        self.scene.save(self.place("scene.xml"))
        again = myolines.Scene(self.place("scene.xml"))
        self.assertEqual(again.xml(True), self.scene.xml(True))
        self.assertNotIn("stiffness", self.scene.xml())
        self.assertIn("stiffness", self.scene.xml(True))
        for twin in (copy.copy(self.scene), pickle.loads(pickle.dumps(self.scene)), self.scene.copy()):
            self.assertEqual(twin.xml(True), self.scene.xml(True))
        twin["system/mass"] = 4
        self.assertEqual(self.scene["system/mass"], 3)

    def test_shown(self):
        self.assertIn("mass = 1 [kg]", repr(self.scene.system))
        page = self.scene._repr_html_()
        self.assertIn("<td>[kg]</td>", page)
        self.assertIn("<b>0.01</b>", page)  # what the scene itself writes
        self.assertIn("Mass m.", self.scene.help("system/mass"))
        self.assertIn("a number [kg] > 0", self.scene.system.help())

    def test_every_scene_of_the_repository(self):
        for file in ("isometric_block.xml", "one_dimensional/isometric_chain.xml", "kinked_block.xml", "bodies/fusiform.xml"):
            scene = myolines.Scene(os.path.join(INPUT, file))
            again = myolines.Scene.from_xml(scene.xml(), file)
            self.assertEqual(again.xml(True), scene.xml(True), file)

    def test_what_is_no_scene(self):
        with self.assertRaisesRegex(myolines.InputError, "malformed|document"):
            myolines.Scene.from_xml("<ParameterList name='other'/>")
        with self.assertRaises(myolines.InputError):
            myolines.Scene(self.place("nothing.xml"))

    def test_lists_of_the_program(self):
        self.assertIn("backward euler", myolines.describe("integrators"))
        self.assertIn("integrators", myolines.topics())


if __name__ == "__main__":
    unittest.main()
