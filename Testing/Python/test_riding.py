# SPDX-License-Identifier: BSD-3-Clause
"""Places on obstacles that move: who hangs, is held or lies on one goes along with it, and takes up its velocity.

    pvpython run.py test_riding.py
"""
import math
import pathlib
import tempfile
import unittest

import numpy as np
import waft

FRAMES, RATE = 150, 30
COARSE = {"Resolution": 16, "LatticeResolution": 12, "Candidates": 2, "Rounds": 0, "Starts": 1}
SHORT = {"NumberOfGasParticles": 216, "LeashIterations": 2, "MaximumNumberOfIterations": 6}
TRAY = np.array([(0.4 * math.sin(k / 25.0), -0.2 + 0.002 * k, 0.6 + 0.1 * math.sin(k / 30.0)) for k in range(FRAMES)])
BALL = np.array([(-0.8 + 0.008 * k, 0.9, 2.8) for k in range(FRAMES)])


class RidingTest(unittest.TestCase):
    def fly(self, quality):
        made = waft.Scene("On a tray", seed=4)
        made.set_time(FRAMES)
        tray = made.add_box((-0.5, -0.5, -0.05), (0.5, 0.5, 0.05), motion=[{"frame": k, "position": TRAY[k]} for k in range(FRAMES)])
        ball = made.add_sphere((0, 0, 0), 0.15, motion=[{"frame": 0, "position": BALL[0]}, {"frame": FRAMES - 1, "position": BALL[-1]}])
        made.add_object("petal", (0, 0, -0.165), on=ball, release=40)  # nearer than its clearance
        made.add_object("petal", (0.9, 0.3, 2.2))
        made.add_object("petal", (0.2, -0.9, 2.0))
        made.add_object("petal", (-0.9, -0.4, 2.4))
        made.add_rest(1, 90, (0.2, 0.1, 0.2), on=tray)
        made.add_rest(2, {"from": 70, "to": 110}, (-0.2, 0.1, 0.2), on=tray)
        made.add_position(3, 80, (0, -0.2, 0.5), on=tray, hold=20)
        made.add_position(0, 120, (0.3, 0.4, 1.8))
        with self.assertRaisesRegex(waft.InputError, "on: expected the id of one of the scene's 2 obstacles, found 7"):
            made.add_rest(1, 140, (0, 0, 1), on=7)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        run = waft.synthesize(made, output=pathlib.Path(folder.name) / "out", quality=quality, threads=1,
                              _settings={"Assimilation": COARSE, "Spacetime": SHORT})
        self.assertEqual([], [row["Message"] for row in run.report if row["Status"] != "met"])
        return run

    def rests(self, run):
        """Of each its object, first contact and the frame from which it lies still."""
        return [(int(row["ObjectId"]), int(row["TouchDown"]), int(row["Settled"])) for row in run.report if row["Kind"] == "rest"]

    def check(self, run):
        hung, held = run.positions[0], run.positions[3]
        np.testing.assert_allclose(hung[:41], BALL[:41] + (0, 0, -0.165), atol=1e-9)
        self.assertGreater(np.linalg.norm(hung[50] - hung[40]), 0.05)  # let go
        np.testing.assert_allclose(held[80:101], TRAY[80:101] + (0, -0.2, 0.5), atol=1e-9)
        for body, _, settled in self.rests(run):
            place = (0.2, 0.1) if body == 1 else (-0.2, 0.1)
            still = run.positions[body, settled:] - TRAY[settled:]
            np.testing.assert_allclose(still[:, :2], np.broadcast_to(place, still[:, :2].shape), atol=1e-9)
            self.assertLess(np.ptp(still[:, 2]), 1e-9)
            self.assertLess(abs(still[0, 2] - 0.05), 0.03)  # on its upper side

    def test_in_the_air(self):
        run = self.fly("preview")
        self.check(run)
        steps = RATE * np.diff(run.positions, axis=1)
        ball, tray = RATE * np.diff(BALL, axis=0), RATE * np.diff(TRAY, axis=0)
        self.assertLess(np.linalg.norm(steps[0, 40] - ball[40]), 0.15)  # begins with the ball's velocity
        for body, touch, settled in self.rests(run):  # the surface takes it along, without a jump
            self.assertLess(np.linalg.norm(steps[body, touch:settled] - tray[touch:settled], axis=1).max(), 0.5)
        self.assertLess(np.linalg.norm(steps[3, 79] - tray[79]), 0.2)

    def test_in_full(self):
        self.check(self.fly("full"))


if __name__ == "__main__":
    unittest.main()
