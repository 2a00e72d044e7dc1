# SPDX-License-Identifier: BSD-3-Clause
"""Windows of frames in place of a frame: who comes when, in the arrays of the reader and of flights, and in constraints.csv.

    pvpython run.py test_arrivals.py
"""
import csv
import json
import pathlib
import tempfile
import unittest

import numpy as np
import waft
from vtkmodules.util.numpy_support import vtk_to_numpy
from waft.vtkWaftSources import vtkMotionSceneReader

FRAMES = 120
COARSE = {"Resolution": 16, "LatticeResolution": 12, "Candidates": 2, "Rounds": 0, "Starts": 1}
SHORT = {"NumberOfGasParticles": 216, "LeashIterations": 2, "MaximumNumberOfIterations": 6}
WINDOW = {"from": 50, "to": 80}
POINTS = [(0.3 * k - 1.0, 0.2 * (k % 3), 0.9 + 0.1 * (k % 2)) for k in range(8)]


def scene(order=None, spread=None, objects=None, **keyframe):
    made = waft.Scene("Arrivals", seed=4)
    made.set_time(FRAMES)
    made.add_objects("petal", count=8, region={"min": (-1.4, -1.4, 1.6), "max": (1.4, 1.4, 2.4)}, **(objects or {}))
    made.add_keyframe(WINDOW, points=POINTS, order=order, spread=spread, **keyframe)
    return made


def arrays(data, *names):
    return [vtk_to_numpy(data.GetPointData().GetArray(name)) for name in names]


def lines(run):
    """Of the report by target, their frames as numbers."""
    names = ("Target", "ObjectId", "Frame", "Arrival", "TouchDown", "Settled")
    return {int(row["Target"]): {name: int(row[name]) for name in names} for row in run.report}


class ArrivalsTest(unittest.TestCase):
    def fly(self, made, quality="preview"):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        run = waft.synthesize(made, output=pathlib.Path(folder.name) / "out", quality=quality, threads=1,
                              _settings={"Assimilation": COARSE} if quality == "preview" else {"Spacetime": SHORT})
        self.assertEqual([], [row["Message"] for row in run.report if row["Status"] != "met"])
        return run

    def check_marks(self, run):
        """Each object is at its mark at the frame of its row; that in all tables."""
        rows = lines(run)
        with open(pathlib.Path(run.folder) / "constraints.csv", encoding="utf-8", newline="") as stream:
            for line in csv.DictReader(stream):
                self.assertEqual(int(line["Frame"]), int(line["Arrival"]))
                self.assertEqual(rows[int(line["Target"])]["Arrival"], int(line["Arrival"]))
        ids = list(run.object_ids)
        for target, row in rows.items():
            there = run.positions[ids.index(row["ObjectId"]), row["Arrival"]]
            np.testing.assert_allclose(there[:2], POINTS[target][:2], atol=1e-9)
        return [rows[target]["Arrival"] for target in range(8)]

    def test_an_order_is_kept_to_the_frame(self):
        expected = [50 + round(30 * (k / 7) ** 2) for k in range(8)]
        made = scene("left-to-right", "ease-in")
        self.assertEqual(expected, self.check_marks(self.fly(made)))

    def test_the_air_chooses_frames_of_the_window(self):
        run = self.fly(scene())
        frames = self.check_marks(run)
        self.assertTrue(all(50 <= frame <= 80 for frame in frames), frames)
        self.assertGreater(len(set(frames)), 2)
        given = run.output("assimilation", 3)
        frame, first, arrival = arrays(given, "Frame", "FrameFrom", "Arrival")
        self.assertEqual([50] * 8, list(first[:8]))  # what flies on lands by rows of no scene, behind them
        self.assertEqual(list(frame), list(arrival))
        tracks = run.output("assimilation").GetCellData()
        by_object = dict(zip(vtk_to_numpy(tracks.GetArray("ObjectId")), vtk_to_numpy(tracks.GetArray("Arrival"))))
        for row in lines(run).values():
            self.assertEqual(row["Arrival"], by_object[row["ObjectId"]])
        # Without an air they come at the window's end.
        self.assertEqual([80] * 8, self.check_marks(self.fly(scene(), "paper")))

    def test_rests_lie_from_their_frames_on(self):
        for order in ("random", None):
            run = self.fly(scene(order, velocity="rest"))
            frames = self.check_marks(run)
            if order:
                self.assertEqual(sorted(50 + round(30 * k / 7) for k in range(8)), sorted(frames))
            ids = list(run.object_ids)
            for row in lines(run).values():
                touch, still = row["TouchDown"], row["Settled"]
                self.assertTrue(row["Arrival"] - 6 <= touch <= row["Arrival"], row)  # 0.2 s, of a petal
                self.assertGreaterEqual(touch, 0 if order else 50)
                self.assertLessEqual(still, touch + 30)
                path = run.positions[ids.index(row["ObjectId"])]
                np.testing.assert_array_equal(path[still:], np.broadcast_to(path[-1], path[still:].shape))

    def test_the_reader_leaves_open_what_the_air_chooses(self):
        for order, last in ((None, 80), ("outward", 50)):
            made = scene(order)
            made.add_velocity(0, 20, (0, 0, 0), radius=10.0)
            with tempfile.TemporaryDirectory() as folder:
                file = pathlib.Path(folder) / "scene.waft.json"
                made.save(file)
                reader = vtkMotionSceneReader()
                reader.SetFileName(str(file))
                reader.Update()
                frame, first, arrival = arrays(reader.GetOutputDataObject(1), "Frame", "FrameFrom", "Arrival")
            self.assertEqual([50] * 8 + [-1], list(first))
            self.assertEqual(20, arrival[8])
            self.assertEqual(last, min(frame[:8]))
            self.assertEqual([-1] * 8 if order is None else list(frame[:8]), list(arrival[:8]))

    def test_released_one_by_one_they_begin_from_rest(self):
        made = scene(objects={"release": {"from": 4, "to": 25}, "order": "right-to-left"})
        for quality in ("preview", "paper"):
            run = self.fly(made, quality)
            self.check_marks(run)
            with open(pathlib.Path(run.folder) / "constraints.csv", encoding="utf-8", newline="") as stream:
                release = {int(line["ObjectId"]): int(line["Release"]) for line in csv.DictReader(stream)}
            order = np.argsort(-run.positions[:, 0, 0])  # from the right
            self.assertEqual([4 + 3 * k for k in range(8)], [release[run.object_ids[k]] for k in order])
            for path, turns, number in zip(run.positions, run.orientations, run.object_ids):
                until = release[number] + 1
                self.assertFalse(np.ptp(path[:until], axis=0).any())
                self.assertFalse(np.ptp(turns[:until], axis=0).any())
                if quality == "preview":
                    self.assertLess(np.linalg.norm(path[until] - path[until - 1]) * 30, 0.35)
        objects = {int(number): int(frame) for number, frame in zip(*arrays(run.output("reader"), "ObjectId", "Release"))}
        self.assertEqual(release, objects)

    def test_emitted_from_one_place_they_begin_in_flight(self):
        made = waft.Scene("Emission", seed=4)
        made.set_time(FRAMES)
        made.add_objects("petal", positions=[(0.0, 0.0, 2.2)] * 8, release={"from": 4, "rate": 10.0}, appears=True)
        made.add_keyframe(WINDOW, points=POINTS, order="left-to-right")
        for quality in ("preview", "paper"):  # which flies as air
            run = self.fly(made, quality)
            self.check_marks(run)
            self.assertEqual(quality == "paper", any("flown as air" in warning for warning in run.warnings))
            first = np.argmax(run.present, axis=1)
            self.assertEqual([4 + 3 * k for k in range(8)], sorted(first))
            steps = np.linalg.norm(np.diff(run.positions, axis=1), axis=2) * 30.0
            for path, step, turns, begins in zip(run.positions, steps, run.orientations, first):
                self.assertTrue((path[:begins + 1] == (0.0, 0.0, 2.2)).all())
                self.assertFalse(np.ptp(turns[:begins + 1], axis=0).any())
                self.assertGreater(step[begins], 0.2)
                self.assertLess(abs(step[begins] - step[begins + 1]), 0.2)  # no jerk
        tracks = run.output("assimilation")
        np.testing.assert_array_equal(run.present.ravel(), vtk_to_numpy(tracks.GetPointData().GetArray("Present")) > 0)
        speeds = np.linalg.norm(vtk_to_numpy(tracks.GetPointData().GetArray("Velocity")), axis=1).reshape(8, FRAMES)
        self.assertFalse(speeds[~run.present].any())
        self.assertGreater(speeds[np.arange(8), first].min(), 0.2)
        with open(pathlib.Path(run.folder) / "poses.csv", encoding="utf-8", newline="") as stream:
            table = list(csv.DictReader(stream))
        self.assertEqual("present", list(table[0])[-1])
        np.testing.assert_array_equal(run.present.ravel(), [line["present"] == "1" for line in table])
        content = (pathlib.Path(run.folder) / "animation.glb").read_bytes()
        channels = json.loads(content[20:20 + int.from_bytes(content[12:16], "little")])["animations"][0]["channels"]
        self.assertEqual(8, sum(channel["target"]["path"] == "scale" for channel in channels))
        found = waft.load(run.folder)
        np.testing.assert_array_equal(run.present, found.present)

    def test_an_edit_of_times_moves_whom_it_touches(self):
        def rows_of(hold=12, first=50, release=10):
            made = waft.Scene("Edited", seed=4)
            made.set_time(FRAMES)
            made.add_objects("petal", count=4, region={"min": (-1.4, -1.4, 1.6), "max": (0, 1.4, 2.4)}, release=release)
            made.add_objects("petal", count=4, region={"min": (0, -1.4, 1.6), "max": (1.4, 1.4, 2.4)})
            made.add_keyframe({"from": first, "to": 70}, points=POINTS[:4], objects=[0, 1, 2, 3], hold=hold)
            made.add_keyframe({"from": 55, "to": 70}, points=POINTS[4:], objects=[4, 5, 6, 7])
            return made

        def fly(made, **more):
            folder = tempfile.TemporaryDirectory()
            self.addCleanup(folder.cleanup)
            return waft.synthesize(made, output=pathlib.Path(folder.name) / "out", quality="preview", threads=1,
                                   _settings={"Assimilation": COARSE}, **more)

        before = fly(rows_of(), keep=["state"])
        frames = {(row["Row"], row["Target"]): int(row["Arrival"]) for row in before.report}
        for change in ({"hold": 20}, {"first": 60}, {"release": 14}):
            after = fly(rows_of(**change), edit_of=before.folder)
            self.assertEqual({"met"}, {row["Status"] for row in after.report})
            is_same = (after.positions == before.positions).all(axis=(1, 2))
            np.testing.assert_array_equal([False] * 4 + [True] * 4, is_same)
            for row in after.report:  # only in a window of its own that was moved is a frame chosen anew
                if "first" in change and row["Row"] == "0":
                    self.assertTrue(60 <= int(row["Arrival"]) <= 70)
                else:
                    self.assertEqual(frames[row["Row"], row["Target"]], int(row["Arrival"]))

    def test_held_they_stay_till_all_have_come(self):
        for quality in ("preview", "paper"):
            run = self.fly(scene("left-to-right", hold=12), quality)
            frames = self.check_marks(run)
            rows, ids = lines(run), list(run.object_ids)
            ends = max(frames) + 12
            for target, begins in enumerate(frames):
                body = ids.index(rows[target]["ObjectId"])
                path, turns = run.positions[body], run.orientations[body]
                self.assertFalse(np.ptp(path[begins:ends + 1], axis=0).any())
                self.assertTrue((path[ends + 1] != path[ends]).any() and (path[begins - 1] != path[begins]).any())
                self.assertTrue(np.diff(turns[begins:ends + 1], axis=0).any(axis=1).all())  # they turn on
                if quality == "preview":
                    for step in (path[begins] - path[begins - 1], path[ends + 1] - path[ends]):
                        self.assertLess(np.linalg.norm(step) * 30.0, 0.3)  # they come to a stop, and start from rest
        to_the_end = self.fly(scene(hold=100)).positions
        self.assertTrue((to_the_end[:, -1] == to_the_end[:, -2]).all())
