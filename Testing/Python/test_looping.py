# SPDX-License-Identifier: BSD-3-Clause
"""A scene that loops: the step from the last frame to the first is one like any, in places, in poses and in the air.

    pvpython run.py test_looping.py
"""
import pathlib
import tempfile
import unittest

import numpy as np
import waft
from waft.failures import InputError
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

COARSE = {"Resolution": 16, "LatticeResolution": 12, "Candidates": 2, "Rounds": 0, "Starts": 1}


def loop_of(run):
    """By object the index of the one as which it goes on; -1: none."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(pathlib.Path(run.folder) / "assimilated.vtp"))
    reader.Update()
    cells = reader.GetOutput().GetCellData()
    index = {int(number): place for place, number in enumerate(run.object_ids)}
    to = dict(zip(vtk_to_numpy(cells.GetArray("ObjectId")).tolist(), vtk_to_numpy(cells.GetArray("LoopTo")).tolist()))
    return np.array([index.get(to[int(number)], -1) for number in run.object_ids])


def over_the_seam(run, body, to, frames=12):
    """Places and poses of a body's last frames, then of the first ones of who goes on."""
    return (np.concatenate([run.positions[body, -frames:], run.positions[to, :frames]]),
            np.concatenate([run.orientations[body, -frames:], run.orientations[to, :frames]]))


def turns(poses):
    """Degrees from each pose to the next."""
    return np.degrees(2.0 * np.arccos(np.clip(np.abs((poses[:-1] * poses[1:]).sum(axis=1)), 0.0, 1.0)))


class LoopingTest(unittest.TestCase):
    def fly(self, made, name):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        return waft.synthesize(made, output=folder / name, quality="preview", threads=1, _settings={"Assimilation": COARSE})

    def check_seams(self, run, to):
        """Each step and turn over the seam is one as elsewhere in the shot."""
        own = [np.linalg.norm(np.diff(run.positions[body][run.present[body]], 2, axis=0), axis=1) for body in range(len(to))]
        usual = np.percentile(np.concatenate(own), 99.9)
        quick = max(turns(run.orientations[body][run.present[body]]).max() for body in range(len(to)))
        for body, goes_on in enumerate(to):
            if goes_on >= 0:
                places, poses = over_the_seam(run, body, goes_on)
                self.assertLess(np.linalg.norm(np.diff(places, 2, axis=0), axis=1).max(), 1.2 * usual, body)
                self.assertLess(turns(poses).max(), 1.2 * quick, body)

    def test_bubbles_go_round(self):
        made = waft.Scene("Round and round", seed=3)
        made.set_time(90, loop=True)
        made.add_objects("bubble", count=8, region={"min": (-1, -1, 1), "max": (1, 1, 3)})
        run = self.fly(made, "bubbles")
        to = loop_of(run)
        self.assertEqual(sorted(to.tolist()), list(range(8)))
        self.check_seams(run, to)
        self.assertEqual(run.positions.shape[1], 90)
        self.assertEqual([], run.warnings)

    def test_who_appears_takes_the_place_of_who_leaves(self):
        made = waft.Scene("Falling for ever", seed=4)
        made.set_time(90, loop=True)
        made.add_objects("maple", count=6, region={"min": (-1.5, -1, 1.4), "max": (1.5, 1, 3)}, leave={"frame": {"from": 20, "to": 70}, "fade": 10})
        made.add_objects("maple", count=6, region={"min": (-1.5, -1, 3.3), "max": (1.5, 1, 3.8)}, appears=True, release={"from": 10, "to": 40})
        run = self.fly(made, "leaves")
        to = loop_of(run)
        self.assertEqual([-1] * 6, to[:6].tolist())
        self.assertEqual(sorted(to[6:].tolist()), list(range(6)))
        self.check_seams(run, to)

    def test_what_cannot_loop_is_named(self):
        made = waft.Scene("No loop")
        made.set_time(90, loop=True)
        made.add_objects("maple", count=2, region={"min": (-1, -1, 1), "max": (1, 1, 3)})
        made.add_object("maple", (0, 0, 3.5), release=20, appears=True)
        with self.assertRaisesRegex(InputError, "/time/loop: .*3 are there at the last frame, 2 at the first"):
            self.fly(made, "appearing")
        made = waft.Scene("No loop")
        made.set_time(90, loop=True)
        body = made.add_object("maple", (0, 0, 3.5))
        made.add_rest(body, 70, (0, 0, 1))
        with self.assertRaisesRegex(InputError, "object 0 lies at .* to the last frame"):
            self.fly(made, "lying")


if __name__ == "__main__":
    unittest.main()
