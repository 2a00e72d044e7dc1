# SPDX-License-Identifier: BSD-3-Clause
"""`waft render` with a shutter, a lens and contact sheets, on a small fixed folder.

    pvbatch run.py test_exposure.py WORK_FOLDER"""

import os
import shutil
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import numpy as np  # noqa: E402
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402

import picture  # noqa: E402
import sample_folder  # noqa: E402

from waft.failures import BadInput  # noqa: E402
from waft.render import Stage, render  # noqa: E402
from waft.render._exposure import Exposure, Film, seen_through  # noqa: E402
from waft.results._folder import load  # noqa: E402

WORK = sys.argv[1]
SIZE = (320, 180)
FRAME = 20  # all objects fly


def folder(name):
    place = f"{WORK}-{name}"
    shutil.rmtree(place, ignore_errors=True)
    sample_folder.write(place)
    return place


def pixels(drawn):
    width, height, _ = drawn.GetDimensions()
    return vtk_to_numpy(drawn.GetPointData().GetScalars()).reshape(height, width, -1).astype(int)


def projected(camera, point):
    """Where a point lies on the picture, from -1 to 1."""
    matrix = camera.GetCompositeProjectionTransformMatrix(SIZE[0] / SIZE[1], -1.0, 1.0)
    seen = np.array(matrix.MultiplyPoint([*point, 1.0]))
    return seen[:2] / seen[3]


class FilmTest(unittest.TestCase):
    def test_light_is_averaged_and_not_bytes(self):
        film = Film()
        film.add(np.full((1, 1, 3), 255, np.uint8))
        film.add(np.zeros((1, 1, 3), np.uint8))
        self.assertEqual(film.mean().tolist(), [[[188, 188, 188]]])  # half the light, by sRGB's curve

    def test_every_byte_is_its_own_mean(self):
        ramp = np.arange(256, dtype=np.uint8).reshape(16, 16, 1).repeat(3, axis=2)
        film = Film()
        for _ in range(3):
            film.add(ramp)
        self.assertTrue((film.mean() == ramp).all())

    def test_alpha_is_no_light(self):
        film = Film()
        for alpha in (255, 0):
            film.add(np.array([[[10, 10, 10, alpha]]], np.uint8))
        self.assertEqual(film.mean().tolist(), [[[10, 10, 10, 128]]])


class ExposureTest(unittest.TestCase):
    def test_moments_are_spread_evenly(self):
        exposure = Exposure(shutter=0.5, aperture=100.0, subframes=64)
        moments = list(exposure.moments())
        times = [time for time, _, _ in moments]
        self.assertAlmostEqual(min(times), -0.25 + 0.25 / 64)
        self.assertAlmostEqual(max(times), 0.25 - 0.25 / 64)
        lens = np.array([point for _, point, _ in moments])
        self.assertLessEqual(np.linalg.norm(lens, axis=1).max(), 0.05)
        self.assertLess(np.linalg.norm(lens.mean(axis=0)), 0.005)
        # Of a disk as many lie within 0.707 of its radius as without.
        self.assertAlmostEqual(np.mean(np.linalg.norm(lens, axis=1) < 0.05 / np.sqrt(2.0)), 0.5, delta=0.06)

    def test_the_lens_keeps_what_it_looks_at_and_moves_the_rest(self):
        motion = load(folder("lens"))
        stage = Stage(motion, SIZE)
        camera = stage._cameras.at("hero", FRAME)
        moved = seen_through(camera, np.array([0.03, -0.02]), np.zeros(2), np.array(SIZE))
        focus = np.array(camera.GetFocalPoint())
        self.assertLess(np.linalg.norm(projected(moved, focus) - projected(camera, focus)), 1e-6)
        nearer = focus + 0.3 * (np.array(camera.GetPosition()) - focus)
        self.assertGreater(np.linalg.norm(projected(moved, nearer) - projected(camera, nearer)), 0.003)

    def test_poses_between_frames(self):
        motion = load(folder("pose"))
        motion.orientations[2, FRAME + 1] *= -1.0  # the same attitude
        place, turn = motion.pose(2, FRAME + 0.25)
        wanted = 0.75 * motion.positions[2, FRAME] + 0.25 * motion.positions[2, FRAME + 1]
        self.assertLess(np.abs(place - wanted).max(), 1e-12)
        self.assertAlmostEqual(np.linalg.norm(turn), 1.0)
        self.assertGreater(turn @ motion.orientations[2, FRAME], 0.99)
        self.assertIs(motion.pose(2, float(FRAME))[0].base, motion.positions)

    def test_a_shutter_blurs_what_moves_alone(self):
        motion = load(folder("shutter"))
        motion.positions[:] = motion.positions[:, FRAME:FRAME + 1]
        motion.orientations[:] = motion.orientations[:, FRAME:FRAME + 1]
        fast, way = 3, 0.15  # m, in a frame
        motion.positions[fast, :, 0] += way * (np.arange(sample_folder.FRAMES) - FRAME)
        kept = [pixels(Stage(motion, SIZE, paths=False, targets=False, exposure=exposure).draw("side", FRAME))
                for exposure in (Exposure(aperture=1e-6, subframes=32), Exposure(shutter=1.0, subframes=32))]
        change = np.abs(kept[1] - kept[0]).max(axis=2)
        camera = Stage(motion, SIZE)._cameras.at("side", FRAME)

        def changed(point):
            x, y = (0.5 + 0.5 * projected(camera, point)) * SIZE
            return change[int(y) - 3:int(y) + 3, int(x) - 3:int(x) + 3].mean()
        for index, position in enumerate(motion.positions[:, FRAME]):
            if index == fast:
                for side in (-0.4, 0.0, 0.4):  # of the way of a frame
                    self.assertGreater(changed(position + [side * way, 0.0, 0.0]), 4.0, side)
            else:
                self.assertLess(changed(position), 0.5, index)

    def test_bad_values_are_named(self):
        place = folder("bad")
        for wrong, value in (("shutter", -0.1), ("shutter", 1.5), ("shutter", float("nan")), ("aperture", -1.0),
                             ("aperture", 2000.0), ("subframes", 1), ("subframes", 1000)):
            with self.assertRaisesRegex(BadInput, f"{wrong} {value}"):
                render(place, **{wrong: value})
        self.assertFalse(os.path.exists(os.path.join(place, "frames")))


class SheetTest(unittest.TestCase):
    def test_pictures_stand_in_rows_with_their_frames(self):
        place = folder("sheet")
        written = render(place, frames="0:50:10", size=SIZE, views="side", samples=1, sheet=True)
        path = os.path.join(place, "side_sheet.png")
        self.assertIn(path, written)
        sheet = picture.read(path)[::-1]  # from the top
        self.assertEqual(sheet.shape[:2], (2 * SIZE[1] + 4, 3 * SIZE[0] + 8))
        for index, frame in enumerate(range(0, 51, 10)):
            drawn = picture.read(os.path.join(place, "frames", f"side_{frame:04d}.png"))[::-1]
            row, column = index // 3 * (SIZE[1] + 4), index % 3 * (SIZE[0] + 4)
            tile = sheet[row:row + SIZE[1], column:column + SIZE[0]]
            self.assertEqual(np.abs(tile[30:] - drawn[30:]).max(), 0, frame)
            self.assertEqual(tile[0, 0].tolist(), [40, 40, 40])  # the label's field
            self.assertGreater(tile[:20, :40].max(), 200)
        labels = [sheet[:20, column:column + 24].tobytes() for column in (0, SIZE[0] + 4, 2 * SIZE[0] + 8)]
        self.assertEqual(len(set(labels)), 3)

    def test_of_many_pictures_twenty(self):
        place = folder("many")
        render(place, frames="0:60", size=(80, 48), views="top", samples=1, sheet=True)
        self.assertEqual(picture.read(os.path.join(place, "top_sheet.png")).shape[:2], (4 * 52 - 4, 5 * 84 - 4))
