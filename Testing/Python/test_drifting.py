# SPDX-License-Identifier: BSD-3-Clause
"""A form that is held and drifts: exact when it comes, then one form to within the radius, moved by the air.

    pvpython run.py test_drifting.py
"""
import json
import pathlib
import tempfile
import unittest

import numpy as np
import waft

FRAMES, HOLD, RADIUS = 150, 50, 0.07
COARSE = {"Resolution": 16, "LatticeResolution": 12, "Candidates": 2, "Rounds": 0, "Starts": 1}
POINTS = np.array([(0.3 * (k % 4) - 0.45, 0.0, 1.7 + 0.3 * (k // 4)) for k in range(12)])


class DriftingTest(unittest.TestCase):
    def test_it_stays_a_form(self):
        made = waft.Scene("Drifting", seed=4)
        made.set_time(FRAMES)
        made.add_objects("petal", count=12, region={"min": (-1.2, -1.2, 1.2), "max": (1.2, 1.2, 3.2)})
        made.add_keyframe({"from": 50, "to": 70}, points=POINTS, hold=HOLD, drift=True, hold_radius=RADIUS)
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder) / "drifting.waft.json"
            made.save(scene)
            run = waft.synthesize(scene, output=pathlib.Path(folder) / "out", quality="preview", threads=1, _settings={"Assimilation": COARSE})
            self.assertEqual([], [row["Message"] for row in run.report if row["Status"] != "met"])
            arrivals = {int(row["ObjectId"]): (int(row["Target"]), int(row["Arrival"])) for row in run.report}
            begin = max(arrival for _, arrival in arrivals.values())
            order = sorted(arrivals, key=lambda body: arrivals[body][0])
            for body, (target, arrival) in arrivals.items():
                waits = run.positions[body, arrival:begin + 1]
                np.testing.assert_allclose(waits, np.broadcast_to(POINTS[target], waits.shape), atol=1e-9)
            arms = np.column_stack([POINTS - POINTS.mean(axis=0), np.ones(12)])
            for frame in range(begin + 5, begin + HOLD + 1, 5):
                now = run.positions[order, frame]
                fit, *_ = np.linalg.lstsq(arms, now, rcond=None)
                off = np.linalg.norm(now - arms @ fit, axis=1)
                self.assertLess(off.max(), 2.0 * RADIUS)
                stretch = np.linalg.svd(fit[[0, 2]], compute_uv=False)
                self.assertLess(abs(stretch - 1.0).max(), 0.1 + RADIUS / 0.45)
            moved = run.positions[order, begin + HOLD].mean(axis=0) - POINTS.mean(axis=0)
            self.assertGreater(np.linalg.norm(moved), 0.1)
            self.assertGreater(moved[2], -0.15 * HOLD / 30.0 - RADIUS)
            edited = waft.Scene.load(scene).as_dict()
            edited["constraints"][0]["targets"]["points"][0][1] = 0.1
            scene.write_text(json.dumps(edited), encoding="utf-8")
            again = waft.synthesize(scene, output=pathlib.Path(folder) / "again", quality="preview", threads=1, edit_of=run.folder,
                                    _settings={"Assimilation": COARSE})
            body = order[0]
            others = [number for number in order if number != body]
            np.testing.assert_array_equal(run.positions[others], again.positions[others])
            self.assertTrue((run.positions[body] != again.positions[body]).any())

    def test_each_leaves_the_form_at_its_own_frame(self):
        made = waft.Scene("One by one", seed=4)
        made.set_time(FRAMES)
        made.set_domain(open=["x"])
        made.add_objects("petal", count=12, region={"min": (-1.2, -1.2, 1.2), "max": (1.2, 1.2, 3.2)})
        made.add_keyframe(50, points=POINTS, hold=HOLD, drift=True, hold_radius=RADIUS,
                          leave={"side": "left", "frame": {"from": 60, "to": 115}, "order": "left-to-right"})
        with tempfile.TemporaryDirectory() as folder:
            run = waft.synthesize(made, output=pathlib.Path(folder) / "out", quality="preview", threads=1, _settings={"Assimilation": COARSE})
            order = [int(row["ObjectId"]) for row in sorted(run.report, key=lambda row: row["Target"])]
            first = [body for target, body in enumerate(order) if target % 4 == 0]  # who go, at frame 60 and after
            last = [body for target, body in enumerate(order) if target % 4 == 3]
            gone = run.positions[first, 105, 0].mean() - run.positions[first, 60, 0].mean()
            stays = run.positions[last, 90, 0].mean() - run.positions[last, 60, 0].mean()
            self.assertLess(gone - stays, -0.3)


if __name__ == "__main__":
    unittest.main()
