# SPDX-License-Identifier: LGPL-2.1-or-later
"""Requirement: runs and studies from Python are those of the program, and their results come back as arrays with units."""

import os
import signal
import subprocess
import unittest

import numpy as np
from common import INPUT, FolderTest, block, oscillator

import myolines
from myolines import program


class Runs(FolderTest):
    def test_is_the_run_of_the_program(self):
        file = os.path.join(INPUT, "oscillator.xml")
        run = myolines.run(file, self.place("python"))
        subprocess.run([program.find(), "run", file, "--out", self.place("program"), "--quiet"], check=True)
        with open(self.place("python/trajectory.csv")) as one, open(self.place("program/trajectory.csv")) as other:
            self.assertEqual(one.read(), other.read())
        self.assertTrue(run.done)
        self.assertGreater(run.ledger["counts"]["accepted steps"], 600)
        self.assertEqual(run.scene["time/step"], 0.01)

    def test_tables(self):
        run = myolines.run(oscillator(), self.place("run"))
        table = run["trajectory"]
        self.assertEqual(table.units["Displacement [m]"], "m")
        np.testing.assert_allclose(table["Displacement"], np.cos(table["Time [s]"]), atol=1e-5)
        self.assertEqual(table.array().dtype.names[0], "Time [s]")
        self.assertIn("Velocity", table)
        self.assertIn("<th>Time [s]</th>", table._repr_html_())
        with self.assertRaisesRegex(myolines.InputError, 'nearest: "Displacement"'):
            table["Displacment"]  # pylint: disable=pointless-statement
        with self.assertRaisesRegex(myolines.InputError, 'nearest: "trajectory"'):
            run["trajectoy"]  # pylint: disable=pointless-statement

    def test_progress(self):
        seen = []
        myolines.run(oscillator(**{"time/end": 0.1}), self.place("run"), progress=lambda t, steps: seen.append((t, steps)))
        self.assertEqual([steps for _, steps in seen], list(range(11)))
        self.assertEqual(seen[-1][0], 0.1)

    def test_an_error_in_the_progress_ends_the_run(self):
        def fail(t, steps):
            if steps == 3:
                raise KeyError("mine")

        with self.assertRaisesRegex(KeyError, "mine"):
            myolines.run(oscillator(), self.place("run"), progress=fail)

    def test_interrupted_and_resumed(self):
        scene = oscillator()
        whole = myolines.run(scene, self.place("whole"))

        def interrupt(t, steps):
            if steps == 57:
                signal.raise_signal(signal.SIGINT)

        with self.assertRaises(KeyboardInterrupt) as caught:
            myolines.run(scene, self.place("run"), progress=interrupt)
        self.assertIsInstance(caught.exception, myolines.Interrupted)
        self.assertFalse(myolines.Run(self.place("run")).done)
        resumed = myolines.run(scene, self.place("run"), resume=True)
        self.assertTrue(resumed.done)
        for column in whole["trajectory"]:
            np.testing.assert_allclose(resumed["trajectory"][column], whole["trajectory"][column], atol=1e-12)

    def test_errors(self):
        with self.assertRaisesRegex(myolines.SolveError, "The step from t") as caught:
            myolines.run(block().update({"system/boundary/moving end/strain/type": "constant", "system/boundary/moving end/strain/value": -0.99,
                                         "solver/nonlinear/maximum iterations": 2}), self.place("run"))
        self.assertEqual(caught.exception.exit_code, 3)
        with open(self.place("file"), "w"):
            pass
        with self.assertRaises(myolines.InputError):
            myolines.run(oscillator(), self.place("file/run"))

    def test_fields_pictures_and_report(self):
        scene = block()
        scene["output/fields"] = {"what": "displacement", "every": 5}
        run = myolines.run(scene, self.place("run"))
        np.testing.assert_allclose(run.field_times, [0, 0.05, 0.1])
        body = run.fields(at=0.1)
        self.assertEqual(body.rest.shape, body.now.shape)
        self.assertEqual(body.fields["displacement"].shape, body.rest.shape)
        np.testing.assert_allclose(body.now - body.rest, body.fields["displacement"])
        self.assertEqual(body.cells.shape[1], 8)
        self.assertTrue((body.cells < len(body.rest)).all())
        self.assertEqual(body.faces.shape, (0, 4))
        scene["output/fields"] = {"what": "displacement", "every": 5, "surface only": True}
        surface = myolines.run(scene, self.place("surface")).fields(at=0.1)
        self.assertEqual((surface.cells.shape, surface.faces.shape[1]), ((0, 8), 4))
        first, second, third, fourth = (surface.rest[surface.faces[:, corner]] for corner in range(4))
        np.testing.assert_allclose(np.cross(third - first, fourth - second).sum(axis=0), 0, atol=1e-12)
        self.assertEqual(run.picture(width=300)._repr_png_()[:4], b"\x89PNG")
        self.assertIn("<iframe", run.report()._repr_html_())


class Studies(FolderTest):
    def test_study(self):
        study = myolines.study(os.path.join(INPUT, "studies", "convergence_oscillator.xml"), self.place("study"), jobs=2)
        self.assertEqual(study.table.n_rows, 7)
        self.assertIn("<Study", repr(study))

    def test_interrupted_and_gone_on_with(self):
        def interrupt(*_):
            raise KeyboardInterrupt

        def study(**more):
            return myolines.study(os.path.join(INPUT, "studies", "convergence_oscillator.xml"), self.place("study"), jobs=1, **more)

        self.addCleanup(signal.signal, signal.SIGALRM, signal.signal(signal.SIGALRM, interrupt))
        signal.setitimer(signal.ITIMER_REAL, 0.15)
        with self.assertRaises(myolines.Interrupted):
            study()
        self.assertEqual(study().table.n_rows, 7)

    def test_errors_of_the_program(self):
        with self.assertRaisesRegex(myolines.InputError, "nothing.xml"):
            myolines.study(self.place("nothing.xml"), self.place("study"))


if __name__ == "__main__":
    unittest.main()
