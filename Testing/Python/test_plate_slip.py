# SPDX-License-Identifier: BSD-3-Clause
"""How bodies go through the air is what their poses, the air and numbers of their own say by the law of the page, and no free
vector: Slip of a small scene is found anew (plate_slip.py).

    pvpython run.py test_plate_slip.py
"""
import contextlib
import io
import json
import pathlib
import tempfile
import unittest

import numpy as np

import plate_slip
import replay_alone
import result_files
import waft

FRAMES = 360
SCENE = {
    "waft": 1,
    "seed": 4,
    "time": {"frames": FRAMES, "framesPerSecond": 30},
    "domain": {"min": [-3, -3, 0], "max": [3, 3, 12]},
    "shapes": {"leaf": {"builtin": "leaf"}, "feather": {"builtin": "feather"}, "petal": {"builtin": "petal"}},
    "objects": [
        {"shape": "leaf", "positions": [[-1.5, 0.5, 11.5], [-0.5, 0.9, 11.3], [0.9, -0.8, 6.4]]},
        {"shape": "feather", "positions": [[0.2, 0.3, 8.4], [1.2, 0.6, 8.8]]},
        {"shape": "petal", "positions": [[-0.9, -1.0, 9.2]]},
    ],
    "constraints": [
        {"kind": "position", "object": 0, "frame": 150, "value": [-0.4, -0.2, 7.6]},
        {"kind": "position", "object": 3, "frame": 180, "value": [0.4, -0.3, 6.2]},
        {"kind": "rest", "object": 2, "frame": 250, "value": [0.6, 0.4, 0.0]},
    ],
}
LEAVES, FEATHERS = (0, 1, 2, 5), (3, 4)  # a petal among them
LANDING = 1.0  # s before a touch-down: when bodies were turned they were to come down by so much sooner, at most


class PlateSlip(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        scene = pathlib.Path(folder.name, "scene.waft.json")
        scene.write_text(json.dumps(SCENE), encoding="utf-8")
        cls.out = pathlib.Path(folder.name, "out")
        waft.synthesize(str(scene), output=str(cls.out), quality="air", keep=("air",),
                        _settings={"Assimilation": {"Resolution": 16, "LatticeResolution": 16, "Candidates": 2, "Rounds": 1}})
        cls.own, cls.alone, cls.theirs = plate_slip.recomputed(cls.out)
        data = result_files.PolyData(cls.out / "poses.vtp")
        cls.cell = {name: dict(zip(data.cell["ObjectId"], values)) for name, values in data.cell.items()}

    def law_holds(self, number, first):
        """Frames in flight, and of these, from the first one on, those in which nothing but the law acts."""
        down = self.cell["TouchDown"][number]
        frames = np.arange(FRAMES)
        return frames < (down if down >= 0 else FRAMES), (frames >= first) & (down < 0 or frames <= down - LANDING * 30)

    def away_from(self, own, numbers, first):
        """Root mean square [m/s] over these bodies' frames from the first one on in which nothing but the law acts, and their
        part of the frames in flight."""
        flown, free, squares = 0, 0, 0.0
        for number in numbers:
            flight, law = self.law_holds(number, first)
            away = np.linalg.norm(own[number] - self.theirs[number], axis=1)[law]
            print(f"object {number}: rms {np.sqrt(np.mean(away**2)):.4f}, most {away.max():.4f} m/s")
            flown, free, squares = flown + flight.sum(), free + law.sum(), squares + np.sum(away**2)
        return np.sqrt(squares / free), free / flown

    def test_slip_is_what_poses_and_air_say(self):
        away, share = self.away_from(self.alone, LEAVES, round(plate_slip.FORGOTTEN * 30))
        self.assertGreaterEqual(share, 0.7)
        self.assertLess(away, 0.022)  # of bodies that an earlier air of the rounds turned, and that still agree with the last

    def test_it_is_so_from_the_first_frame_on(self):
        away, share = self.away_from(self.own, LEAVES, 0)
        self.assertGreaterEqual(share, 0.9)
        self.assertLess(away, 0.02)  # one that would need more control keeps the poses of an earlier air

    def test_large_light_bodies_feel_how_the_air_has_changed_since(self):
        """A feather is four times as long in the gradient of the air, which is a later one than that which turned it."""
        away, _ = self.away_from(self.own, FEATHERS, 0)
        self.assertLess(away, 0.03)

    def test_it_is_no_matter_of_course(self):
        """Slip is far from any vector that no pose is needed for."""
        for number, slip in self.theirs.items():
            _, law = self.law_holds(number, 0)
            self.assertGreater(np.sqrt(np.mean(np.sum((slip[law] - slip[law].mean(axis=0))**2, axis=1))), 0.1)

    def test_a_second_program_lets_bodies_go_to_the_same_misses(self):
        rows = waft.measure(str(self.out), tracks="assimilated")[0]
        with contextlib.redirect_stdout(io.StringIO()) as stream:
            replay_alone.main(self.out)
        said = stream.getvalue().split()
        found = {f"replay_{said[at]}{part}": float(said[at + by]) for at in (0, 3) for by, part in ((1, ""), (2, "_90"))}
        for key, value in found.items():
            self.assertAlmostEqual(rows[key].value, value, delta=1e-6, msg=key)
        self.assertLess(rows["replay_last"].value, 0.1)
        self.assertGreater(rows["replay_whole"].value, rows["replay_last"].value)
        self.assertTrue(0.0 < rows["slip"].value < 0.02, rows["slip"])

    def test_each_body_has_factors_of_its_own(self):
        for name in ("DragCoefficient", "Lift", "RotationalLift", "SlippingMass"):
            self.assertEqual(6, len(set(self.cell[name].values())), name)
        for number in (0, 1, 2):
            self.assertTrue(1.2 * 0.85 <= self.cell["DragCoefficient"][number] <= 1.2 * 1.15)
            self.assertTrue(2.9 * 0.85 <= self.cell["Lift"][number] <= 2.9 * 1.15)
        self.assertEqual({0.5}, {round(value, 6) for value in self.cell["Follow"].values()})
        self.assertTrue(all(0.0 < value <= 1.0 for value in self.cell["Pace"].values()))
