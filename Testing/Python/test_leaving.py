# SPDX-License-Identifier: BSD-3-Clause
"""Open sides, who leaves by them or fades, and fronts: in the arrays of flights, in poses.csv and constraints.csv.

    pvpython run.py test_leaving.py
"""
import csv
import json
import pathlib
import tempfile
import unittest

import numpy as np
import waft
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLImageDataReader

FRAMES = 150
COARSE = {"Resolution": 16, "LatticeResolution": 12, "Candidates": 2, "Rounds": 0, "Starts": 1}
POINTS = [(0.4 * k - 0.8, 0.1 * k, 1.6) for k in range(5)]


class LeavingTest(unittest.TestCase):
    def fly(self, leave, front=True, quality="preview", **keyframe):
        made = waft.Scene("Leaving", seed=4)
        made.set_time(FRAMES)
        if front:
            made.set_domain(open=["x", "top"])
        made.add_objects("petal", count=5, region={"min": (-1.2, -1.2, 1.4), "max": (1.2, 1.2, 2.2)})
        made.add_keyframe(50, points=POINTS, leave=leave, **keyframe)
        if front:
            made.add_front((1, 0, 0), 3.0, 8.0, width=8.0, start_frame=62, origin=(-1, 0, 0))
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        run = waft.synthesize(made, output=pathlib.Path(folder.name) / "out", quality=quality, threads=1, _settings={"Assimilation": COARSE})
        self.assertEqual([], [row["Message"] for row in run.report if row["Status"] != "met"])
        return run

    def leaves(self, run):
        """By target the object's index and the frame from which it is gone, the same in all tables."""
        with open(pathlib.Path(run.folder) / "constraints.csv", encoding="utf-8", newline="") as stream:
            rows = {int(line["Target"]): (list(run.object_ids).index(int(line["ObjectId"])), int(line["Leave"])) for line in csv.DictReader(stream)}
        tracks = run.output("assimilation").GetCellData()
        for body, leave in rows.values():
            self.assertEqual(leave, int(vtk_to_numpy(tracks.GetArray("Leave"))[body]))
            end = leave if leave >= 0 else FRAMES
            np.testing.assert_array_equal(np.arange(FRAMES) < end, run.present[body])
            self.assertFalse(np.ptp(run.positions[body, end - 1:], axis=0).any())  # its place is its last
            self.assertFalse(np.ptp(run.orientations[body, end - 1:], axis=0).any())
        return [rows[target] for target in range(5)]

    def test_a_front_carries_a_row_out_one_by_one(self):
        run = self.fly({"side": "right", "frame": {"from": 62, "to": 78}, "order": "left-to-right"}, hold=12)
        for target, (body, leave) in enumerate(self.leaves(run)):
            begins = 62 + 4 * target
            path = run.positions[body]
            self.assertFalse(np.ptp(path[50:begins + 1], axis=0).any())  # held until it goes
            self.assertTrue((path[begins + 1] != path[begins]).any())
            self.assertGreater(leave, begins)
            self.assertGreater(path[leave - 1, 0], 1.5)  # by the right
        self.assertFalse([warning for warning in run.warnings if "still in the volume" in warning])

    def test_a_share_fades_where_it_is(self):
        run = self.fly({"frame": 70, "share": 0.6, "fade": 10}, front=False, quality="full", hold=12)
        self.assertTrue(any("flown as air" in warning for warning in run.warnings))  # with no side open
        found = self.leaves(run)
        self.assertEqual([-1, -1, 80, 80, 80], sorted(leave for _, leave in found))
        content = (pathlib.Path(run.folder) / "animation.glb").read_bytes()
        channels = json.loads(content[20:20 + int.from_bytes(content[12:16], "little")])["animations"][0]["channels"]
        self.assertEqual(3, sum(channel["target"]["path"] == "scale" for channel in channels))
        with open(pathlib.Path(run.folder) / "poses.csv", encoding="utf-8", newline="") as stream:
            present = [line["present"] == "1" for line in csv.DictReader(stream)]
        np.testing.assert_array_equal(run.present.ravel(), present)

    def test_objects_without_marks_leave(self):
        made = waft.Scene("Confetti", seed=4)
        made.set_time(FRAMES)
        made.set_domain(open=["x"])
        made.add_objects("petal", positions=[(0.0, 0.0, 2.2)] * 6, release={"from": 0, "rate": 6.0}, appears=True,
                         leave={"frame": {"from": 50, "to": 75}, "order": [0, 1, 2, 3, 4, 5], "fade": 5})
        made.add_objects("petal", positions=[(1.0, 0.2 * k - 0.5, 2.4) for k in range(4)], leave={"frame": 30, "side": "right"})
        with tempfile.TemporaryDirectory() as folder:
            run = waft.synthesize(made, output=pathlib.Path(folder) / "out", quality="preview", threads=1, _settings={"Assimilation": COARSE})
            leaves = vtk_to_numpy(run.output("assimilation").GetCellData().GetArray("Leave"))
            self.assertEqual([55, 60, 65, 70, 75, 80], list(leaves[:6]))
            for body in range(6, 10):
                self.assertTrue(30 < leaves[body] < FRAMES)
                self.assertGreater(run.positions[body, leaves[body] - 1, 0], 1.5)
                self.assertLess(run.positions[body, :31, 0].max(), 2.0)  # inside until then
            self.assertTrue((run.present.sum(axis=1) < FRAMES).all())

    def test_what_lies_to_the_end_is_lifted_by_the_front(self):
        run = self.fly(None, velocity="rest")
        for row in run.report:
            lies = 62 + 30 * (POINTS[int(row["Target"])][0] + 1.0) / 3.0  # until the edge is there
            path = run.positions[list(run.object_ids).index(int(row["ObjectId"]))]
            until = int(np.ceil(lies - 1e-9))
            settled = int(row["Settled"])
            self.assertLess(settled, until)
            self.assertFalse(np.ptp(path[settled:until + 1], axis=0).any())
            self.assertTrue(np.ptp(path[until:], axis=0).any())

    def test_a_row_goes_to_a_place_in_a_breeze(self):
        made = waft.Scene("To a place", seed=4)
        made.set_time(FRAMES)
        made.set_domain(open=["x"])
        made.set_air(breeze=(0.5, 0, 0))
        made.add_objects("petal", count=5, region={"min": (-1.2, -1.2, 1.4), "max": (0.2, 1.2, 2.2)})
        made.add_keyframe(50, points=POINTS, hold=5, leave={"place": (1.4, 0, 1.2), "frame": 60, "fade": 6})
        with tempfile.TemporaryDirectory() as folder:
            run = waft.synthesize(made, output=pathlib.Path(folder) / "out", quality="preview", threads=1, keep=["air"],
                                  _settings={"Assimilation": COARSE})
            for body, leave in self.leaves(run):
                self.assertGreater(leave, 66)
                self.assertLess(np.linalg.norm(run.positions[body, leave - 6] - (1.4, 0, 1.2)), 0.3)
            reader, means = vtkXMLImageDataReader(), []
            for file in sorted((pathlib.Path(folder) / "out" / "air").glob("*.vti"))[::30]:
                reader.SetFileName(str(file))
                reader.Update()
                means.append(vtk_to_numpy(reader.GetOutput().GetPointData().GetArray("Velocity"))[:, 0].mean())
            self.assertAlmostEqual(0.5, np.mean(means), delta=0.15)


if __name__ == "__main__":
    unittest.main(verbosity=2)
