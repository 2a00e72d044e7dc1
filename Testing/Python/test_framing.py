# SPDX-License-Identifier: BSD-3-Clause
"""What `waft render` draws by default of scenes of Data/Scenes, flown in coarse air: bodies are framed, large, and stand out from what
is behind them, and the pictures are not pale. The cameras and colours were chosen by the first three scenes; the others
show whether that holds.

    pvbatch run.py test_framing.py SCENES WORK_FOLDER [SCENE ...]        SCENES: the folder Data/Scenes; without names all"""

import inspect
import os
import pathlib
import shutil
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import numpy as np  # noqa: E402

import framing  # noqa: E402

import waft  # noqa: E402
from waft.render import render  # noqa: E402
from waft.results._folder import load  # noqa: E402

SCENES, WORK = map(pathlib.Path, sys.argv[1:3])
CHOSEN = ("leaves-letters", "feather-waypoints", "leaves-in-wind")
OTHERS = ("bubbles-stairs", "confetti-hall", "leaves-pillar", "feather-spiral", "scraps-doorway", "leaves-disturbed", "bubbles-two-marks",
          "examples/leaves-gate", "examples/snow-name", "examples/feather-hand")
COARSE = {"Assimilation": {"Resolution": 16, "LatticeResolution": 12, "Candidates": 2, "Rounds": 1}}
PARTS = (0.1, 0.4, 0.7, 1.0)  # of the shot

VIEWS = inspect.signature(render).parameters["views"].default  # those that are drawn by default
BOX = 2.0 / 3.0  # of the frame's height or width
LOST = {"hero": 0.2}  # of the bodies at most; of other views none
PALE = 0.1  # of the frame at most
CONTRAST, OF_FILMS = 0.18, 0.1  # at least, median over the frames; films let through what is behind them


def faults(shown, view):
    """Sentences: what is wrong with a picture."""
    found = []
    if shown.shot < BOX:
        found.append(f"what flies takes {shown.shot:.2f} of the frame's height or width")
    if shown.lost > LOST.get(view, 0.0):
        found.append(f"{shown.lost:.2f} of the bodies are outside")
    if shown.pale > PALE:
        found.append(f"{shown.pale:.2f} of the frame is nearly white")
    return found


class FramingTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.shown = {}  # (scene, view): one for each part of the shot
        cls.has_films = {}
        for scene in sys.argv[3:] or CHOSEN + OTHERS:
            folder = WORK / pathlib.Path(scene).name
            shutil.rmtree(folder, ignore_errors=True)
            waft.synthesize(str(SCENES / f"{scene}.waft.json"), output=str(folder), quality="air", _settings=COARSE)
            motion = load(str(folder))
            cls.has_films[scene] = any(body.opacity < 1.0 for body in motion.bodies)
            measure = framing.Framing(motion)
            frames = [round(part * (motion.number_of_frames - 1)) for part in PARTS]
            for view in {*VIEWS, "side"}:
                cls.shown[scene, view] = [measure.shown(view, frame) for frame in frames]
                for frame, shown in zip(frames, cls.shown[scene, view]):
                    print(f"{scene:20s} {view:6s} {frame:4d} {shown}")

    def test_default_views_show_what_flies(self):
        found = [f"{scene}, {view}, at {part} of the shot: {sentence}" for (scene, view), row in self.shown.items() if view in VIEWS
                 for part, shown in zip(PARTS, row) for sentence in faults(shown, view)]
        self.assertEqual([], found)

    def test_bodies_stand_out_from_what_is_behind_them(self):
        for (scene, view), row in self.shown.items():
            if view in VIEWS:
                contrast = np.median([shown.contrast for shown in row])
                self.assertGreater(contrast, OF_FILMS if self.has_films[scene] else CONTRAST, (scene, view))

    def test_bodies_are_larger_than_from_where_all_of_the_motion_is_in_sight(self):
        for scene in self.has_films:
            near, far = (np.mean([shown.bodies for shown in self.shown[scene, view]]) for view in (VIEWS[0], "side"))
            self.assertGreater(near, 1.5 * far, scene)

    def test_48_leaves_take_more_than_a_hundredth(self):
        row = [shown.bodies for shown in self.shown["leaves-letters", VIEWS[0]]]
        self.assertGreater(min(row), 0.01)
        self.assertGreater(np.mean(row), 0.02)
