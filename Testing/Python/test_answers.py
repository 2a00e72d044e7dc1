# SPDX-License-Identifier: BSD-3-Clause
"""What a run says of itself is what its files hold: rows that contradict each other, what cannot be met, who goes
where, and where bodies are laid.

    test_answers.py WAFT       WAFT: the command of the build or of an installed tree
"""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import motion_checks
import result_files

WAFT = sys.argv.pop(1)

# Leaf 0 is asked to be at two places at once, leaf 1 to be behind a wall, one of them all to lie on the ground, and
# leaf 2 is the one that has the time.
SCENE = {
    "waft": 1,
    "time": {"frames": 101},
    "shapes": {"leaf": {"builtin": "leaf"}},
    "objects": [{"shape": "leaf", "positions": [[-1.0, -0.5, 2.6], [-0.9, 0.6, 2.4], [-1.6, -1.5, 1.6]]}],
    "obstacles": [{"kind": "box", "min": [0.9, -2, 0], "max": [1.0, 2, 4]}],
    "constraints": [
        {"kind": "position", "object": 0, "frame": 60, "value": [-0.6, -0.4, 2.2]},
        {"kind": "position", "object": 0, "frame": 61, "value": [0.6, 1.4, 1.2]},
        {"kind": "position", "object": 1, "frame": 60, "value": [1.3, 0.6, 2.2], "radius": 0.05},
        {"kind": "rest", "object": -1, "frame": 90, "value": [-0.7, -0.5, 0.2]},
        {"kind": "position", "object": -1, "frame": 62, "value": [-0.6, -0.5, 2.1]},
    ],
}


class Answers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        scene = pathlib.Path(folder.name) / "scene.waft.json"
        scene.write_text(json.dumps(SCENE), encoding="utf-8")
        cls.out = pathlib.Path(folder.name) / "out"
        cls.done = subprocess.run([WAFT, "synthesize", scene, "--output", cls.out, "--preview"], capture_output=True,
                                  text=True, check=False)
        with open(cls.out / "constraints.csv", newline="", encoding="utf-8") as stream:
            cls.lines = list(csv.DictReader(stream))
        cls.poses = result_files.read_poses(cls.out / "poses.csv")

    def distance(self, tracks, line):
        x = tracks[int(line["ObjectId"])][int(line["Frame"])]
        return motion_checks.distance(getattr(x, "x", x), SCENE["constraints"][int(line["Row"])]["value"])

    def test_of_two_rows_that_contradict_each_other_one_is_met(self):
        self.assertEqual(3, self.done.returncode, self.done.stderr)
        self.assertEqual("met", self.lines[0]["Status"])
        self.assertLess(self.distance(self.poses, self.lines[0]), 4e-9)
        self.assertEqual("conflict", self.lines[1]["Status"])
        self.assertIn("contradicts row 0 target 0", self.lines[1]["Message"])

    def test_what_cannot_be_met_is_come_to_as_near_as_planned_and_reported_as_flown(self):
        line = self.lines[2]
        self.assertEqual("unreachable", line["Status"])
        flown = self.distance(self.poses, line)
        planned = self.distance(result_files.read_tracks(self.out / "planned.vtp"), line)
        self.assertLessEqual(flown, planned + 4e-9)
        self.assertAlmostEqual(flown - 0.05, float(line["Residual"]), 9)
        self.assertEqual(1, line["Message"].count("it comes within"))
        self.assertIn(f"it comes within {flown - 0.05:.3g} m", line["Message"])

    def test_rows_of_any_object_go_to_those_that_have_the_time(self):
        self.assertEqual(["met", "met"], [line["Status"] for line in self.lines[3:]], self.done.stderr)
        self.assertNotEqual(self.lines[3]["ObjectId"], self.lines[4]["ObjectId"])

    def test_poses_are_the_optimised_paths_but_where_bodies_are_laid(self):
        paths = result_files.PolyData(self.out / "optimized.vtp")
        poses = result_files.PolyData(self.out / "poses.vtp")
        most = []
        for ours, theirs, told in zip(poses.lines, paths.lines, poses.cell["Shift"]):
            moved = [motion_checks.distance(poses.points[a], paths.points[b]) for a, b in zip(ours, theirs)]
            self.assertAlmostEqual(max(moved), told, 12)
            most.append(max(moved))
        settled = json.loads((self.out / "report.json").read_text(encoding="utf-8"))["settled"]
        self.assertEqual(sum(shift > 0.0 for shift in most), settled["objects"])
        self.assertAlmostEqual(max(most), settled["largestShift"], 12)
        self.assertEqual(0.0, most[1])


if __name__ == "__main__":
    unittest.main(verbosity=2)
