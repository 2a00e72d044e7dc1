# SPDX-License-Identifier: BSD-3-Clause
"""The hero view, the styles and the looping animation of `waft render`, on a small fixed folder.

    pvbatch run.py test_looks.py WORK_FOLDER"""

import contextlib
import dataclasses
import io
import os
import shutil
import sys
import unittest
from unittest import mock

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import numpy as np  # noqa: E402
from PIL import Image  # noqa: E402
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy  # noqa: E402
from vtkmodules.vtkFiltersSources import vtkSphereSource  # noqa: E402

import datafiles  # noqa: E402
import sample_folder  # noqa: E402

from waft import cli  # noqa: E402
from waft.failures import BadInput  # noqa: E402
from waft.render import Stage, render  # noqa: E402
from waft.render import _styles  # noqa: E402
from waft.render._cameras import Cameras  # noqa: E402
from waft.render._styles import STYLES  # noqa: E402
from waft.results._folder import load  # noqa: E402

WORK = sys.argv[1]
SIZE = (320, 180)
LAST = sample_folder.FRAMES - 1


def folder(name):
    place = f"{WORK}-{name}"
    shutil.rmtree(place, ignore_errors=True)
    sample_folder.write(place)
    return place


def on_picture(camera, places, reach):
    """Where the balls about places lie on the picture: low and high of x and y, from -1 to 1."""
    corners = reach / np.sqrt(3.0) * np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    points = (places[:, None, :] + corners).reshape(-1, 3)
    matrix = camera.GetCompositeProjectionTransformMatrix(SIZE[0] / SIZE[1], -1.0, 1.0)
    entries = np.array([[matrix.GetElement(row, column) for column in range(4)] for row in range(4)])
    seen = np.append(points, np.ones((len(points), 1)), axis=1) @ entries.T
    seen = seen[:, :2] / seen[:, 3:]
    return seen.min(axis=0), seen.max(axis=0)


class HeroTest(unittest.TestCase):
    def setUp(self):
        self.motion = load(folder("hero"))
        self.cameras = Cameras(self.motion, SIZE[0] / SIZE[1])
        self.reach = 0.5 * max(body.extent for body in self.motion.bodies)

    def fill(self, view, frame, places):
        low, high = on_picture(self.cameras.at(view, frame), places, self.reach)
        return float(np.max(high - low)) / 2.0

    def test_all_are_in_the_picture_and_fill_it(self):
        for view in ("hero", "top", "follow"):
            for frame in range(LAST + 1):
                places = self.motion.positions[:, frame]
                low, high = on_picture(self.cameras.at(view, frame), places, self.reach)
                self.assertGreater(low.min(), -1.0, (view, frame))
                self.assertLess(high.max(), 1.0, (view, frame))
                self.assertGreater(self.fill(view, frame, places), 0.5, (view, frame))
                self.assertGreater(self.fill(view, frame, self.motion.positions.reshape(-1, 3)), 2.0 / 3.0, (view, frame))

    def test_it_never_jumps(self):
        for view in ("hero", "top", "follow"):
            eyes = np.array([self.cameras.at(view, frame).GetPosition() for frame in range(LAST + 1)])
            away = np.array([self.cameras.at(view, frame).GetDistance() for frame in range(LAST + 1)])
            self.assertLess(np.abs(np.diff(eyes, axis=0)).max(), 0.03 * away[0], view)
            self.assertLess(np.abs(np.diff(eyes, n=2, axis=0)).max(), 0.01 * away[0], view)

    def test_of_many_that_fly_some_are_cut_off_but_none_of_what_they_lay(self):
        motion, last = self.motion, 200
        many = np.random.RandomState(1).uniform(-1.0, 1.0, (60, 1, 3))
        fall = np.clip(1.0 - np.arange(last + 1) / 150.0, 0.0, 1.0)[None, :, None]
        motion.positions = many * [1.0, 1.0, 0.0] + (many * [0.0, 0.0, 1.0] + [0.0, 0.0, 2.0]) * fall
        motion.shapes = np.zeros(60, int)

        def lost(frame, resting, flying=0):
            motion.marks.resting, motion.marks.flying = [np.zeros(3)] * resting, [(np.zeros(3), 0.0)] * flying
            camera = Cameras(motion, 16 / 9).at("hero", frame)
            seen = [np.abs(on_picture(camera, place[None], 0.0)).max() for place in motion.positions[:, frame]]
            return int(np.sum(np.array(seen) > 1.0))

        self.assertTrue(1 <= lost(60, 60) <= 10, lost(60, 60))
        self.assertEqual((lost(last, 60), lost(60, 60, flying=60)), (0, 0))

    def test_one_object_is_followed_from_near(self):
        motion = self.motion
        motion.positions = np.zeros((1, 301, 3)) + [0.0, 0.0, 1.0]
        motion.positions[0, :, 0] = 0.6 * np.arange(301) / sample_folder.RATE  # 6 m in 10 s
        self.cameras = Cameras(motion, SIZE[0] / SIZE[1])
        for frame in range(301):
            low, high = on_picture(self.cameras.at("hero", frame), motion.positions[:, frame], self.reach)
            self.assertLess(max(-low.min(), high.max()), 1.0, frame)
        self.assertGreater(self.fill("hero", 150, motion.positions[:, 150]), 2.0 * self.fill("side", 150, motion.positions[:, 150]))

    def test_it_is_the_higher_the_more_lies(self):
        def pitch(frame=LAST + 60):
            return -Cameras(self.motion, 16 / 9).at("hero", frame).GetDirectionOfProjection()[2]

        stay = np.repeat(self.motion.positions[:, -1:], 150, axis=1)
        self.motion.positions = np.append(self.motion.positions, stay, axis=1)

        self.motion.marks.resting = []
        low = pitch()
        self.motion.marks.resting = [np.zeros(3)] * len(self.motion.positions)
        self.assertAlmostEqual(low, np.sin(np.radians(20.0)), places=6)
        self.assertAlmostEqual(pitch(LAST + 150), np.sin(np.radians(50.0)), places=6)
        self.assertLess(pitch(0), np.sin(np.radians(25.0)))


class MarksTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.motion = load(folder("marks"))

    def drawn(self, view="hero", motion=None, **choice):
        taken = Stage(motion or self.motion, SIZE, 1, paths=False, **choice).draw(view, 20)
        return vtk_to_numpy(taken.GetPointData().GetScalars()).astype(float).reshape(SIZE[1], SIZE[0], 3)

    def test_the_hero_has_none_unless_they_are_asked_for(self):
        for view, has in (("hero", False), ("side", True), ("top", True), ("follow", True)):
            by_itself, none, asked = (self.drawn(view, **choice) for choice in ({}, {"targets": False}, {"targets": True}))
            self.assertGreater(np.abs(asked - none).max(), 60.0, view)
            self.assertEqual(np.abs(by_itself - (asked if has else none)).max(), 0.0, view)

    def test_they_are_small_and_of_a_colour_that_no_body_has(self):
        for color in ((0.95, 0.15, 0.75), (0.8, 0.1, 0.1), (1.0, 1.0, 1.0)):
            bodies = [dataclasses.replace(body, texture="", color=color) for body in self.motion.bodies]
            motion = dataclasses.replace(self.motion, bodies=bodies)
            without = self.drawn("follow", motion, targets=False)
            marked = np.abs(self.drawn("follow", motion) - without).max(axis=2) > 60.0
            self.assertTrue(10 < marked.sum() < 0.01 * marked.size, marked.sum())
            ring = self.drawn("follow", motion)[marked]
            hue = np.median(ring / ring.max(axis=1, keepdims=True), axis=0)
            self.assertGreater(np.linalg.norm(hue - np.array(color) / max(color)), 0.6, color)


def ball(x, facets=24):
    """A closed obstacle beside what flies."""
    source = vtkSphereSource()
    source.SetCenter(x, 0.0, 1.0)
    source.SetRadius(0.5)
    source.SetThetaResolution(facets)
    source.SetPhiResolution(facets)
    source.Update()
    return source.GetOutput()


class ObstaclesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.motion = load(folder("obstacles"))

    def test_they_are_where_they_are_in_the_first_picture_too(self):
        moved = dataclasses.replace(self.motion, obstacles=[(0.0, ball(-1.0)), (1.0, ball(1.0))])
        stage = Stage(moved, SIZE, 1, paths=False, targets=False)
        first, last, again = (vtk_to_numpy(stage.draw("side", frame).GetPointData().GetScalars()).astype(int) for frame in (0, LAST, 0))
        self.assertGreater(np.abs(first - last).max(), 60)
        self.assertEqual(np.abs(first - again).max(), 0)

    def test_a_shadow_lies_as_what_is_under_its_body(self):
        scenery = Stage(dataclasses.replace(self.motion, obstacles=[(0.0, ball(0.0))]), SIZE, 1, paths=False)._scenery
        scenery.move_to(0)
        points = np.array([(0.12 * x, 0.12 * y, 1.6) for x in (-1, 0, 1) for y in (-1, 0, 1)] + [(3.0, 0.0, 1.6)])
        self.assertFalse(scenery.is_level(np.array([0.0, 0.0, 1.0]), points[:9]))
        places, ways = scenery.cast(points, 0.2)
        away = np.linalg.norm(places[:9] - [0.0, 0.0, 1.0], axis=1)
        self.assertLess(np.abs(away - 0.5).max(), 0.01)
        np.testing.assert_allclose(points + ways[:, None] * scenery.sun, places, atol=1e-3)
        self.assertAlmostEqual(ways[9], ways[:9].mean())
        inner, _ = scenery.cast(np.array([[0.0, 0.0, 1.45]]), 0.2)  # not out below
        self.assertGreater(inner[0, 2], 1.45)


class StyleTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.motion = load(folder("style"))

    def drawn(self, style, frame=LAST, view="hero", motion=None, **changes):
        with mock.patch.dict(_styles.STYLES, {style: dataclasses.replace(STYLES[style], **changes)}):
            taken = Stage(motion or self.motion, SIZE, 1, paths=False, targets=False, style=style).draw(view, frame)
        return vtk_to_numpy(taken.GetPointData().GetScalars()).astype(float).reshape(SIZE[1], SIZE[0], 3)

    def test_each_has_its_own_ground(self):
        means = {style: np.median(self.drawn(style).mean(axis=2)) for style in ("studio", "paper", "dark")}
        self.assertLess(means["dark"], 70.0)
        self.assertGreater(means["paper"], 220.0)
        self.assertTrue(means["dark"] < means["studio"] < means["paper"], means)

    def test_leaves_let_the_sun_through(self):
        clear = self.drawn("dark", 20, translucency=0.7)
        opaque = self.drawn("dark", 20, translucency=0.0)
        self.assertGreaterEqual((clear - opaque).min(), -1.0)
        self.assertGreater(((clear - opaque).max(axis=2) > 8.0).sum(), 5)

    def test_a_wide_sun_makes_half_shades(self):
        # Where a leaf is low over the ground: between no shadow and the whole of it.
        def half(radius):
            shaded = self.drawn("paper", 40, sun_radius=radius).mean(axis=2)
            return self.drawn("paper", 40, sun_radius=radius, shadow=0.0).mean(axis=2) - shaded

        hard, soft = half(0.0), half(0.3)
        self.assertGreater(hard.max(), 20.0)
        between = [((shade > 0.15 * shade.max()) & (shade < 0.6 * shade.max())).sum() for shade in (hard, soft)]
        self.assertGreater(between[1], 1.3 * between[0])

    def test_what_lies_on_an_obstacle_hides_its_shadow(self):
        motion = load(folder("lies"))
        motion.positions[0] = [0.45, 0.4, 0.512]  # on the box, which its middle touches
        motion.orientations[0] = [1.0, 0.0, 0.0, 0.0]
        shaded, plain = (self.drawn("studio", view="top", motion=motion, shadow=shadow) for shadow in (STYLES["studio"].shadow, 0.0))
        leaf = plain[..., 0] > 1.5 * plain[..., 2]
        self.assertGreater(leaf.sum(), 50)
        self.assertGreater((plain - shaded).max(), 20.0)
        self.assertLess((plain - shaded)[leaf].max(), 8.0)

    def test_tone_mapping_changes_brightness(self):
        dim, bright = (self.drawn("studio", exposure=exposure).mean() for exposure in (0.6, 1.4))
        self.assertLess(1.2 * dim, bright)

    def test_clear_is_bodies_and_shadows_alone(self):
        place = folder("clear")
        render(place, frames=str(LAST), size=SIZE, views="hero", samples=2, style="clear", paths=False, targets=False)
        with Image.open(os.path.join(place, "frames", f"hero_{LAST:04d}.png")) as made:
            self.assertEqual(made.mode, "RGBA")
            drawn = np.asarray(made, int)
        alpha = drawn[..., 3]
        self.assertGreater((alpha == 0).mean(), 0.5)
        self.assertGreater((alpha == 255).sum(), 100)  # bodies and the box
        shadow = (alpha > 5) & (alpha < 200) & (drawn[..., :3].max(axis=2) < 10)
        self.assertGreater(shadow.sum(), 20)
        # Colours are not those of black that shows through: at a body's edge as bright as within.
        edge = (alpha > 100) & (alpha < 200) & ~shadow
        self.assertGreater(np.median(drawn[edge].max(axis=1)), 0.6 * np.median(drawn[alpha == 255][:, :3].max(axis=1)))
        with self.assertRaisesRegex(BadInput, "style 'clear': a movie has no transparency"):
            render(place, frames="0", style="clear", movie=True)

    def test_an_unknown_one_is_named(self):
        with self.assertRaisesRegex(BadInput, "style 'noon': expected one of day, studio, paper, dark, clear"):
            render(folder("noon"), style="noon")


class LoopTest(unittest.TestCase):
    def loop(self, name, limit, frames="0::6"):
        place = folder(name)
        written = render(place, frames=frames, size=SIZE, views="hero", samples=1, style="dark", loop=limit)
        path = os.path.join(place, "hero.webp")
        self.assertIn(path, written)
        return path

    def test_it_begins_again_stays_at_the_end_and_keeps_its_frames(self):
        path = self.loop("loop", 3.0)
        self.assertLess(os.path.getsize(path), 3e6)
        with Image.open(path) as made:
            self.assertEqual((made.format, made.size, made.info["loop"]), ("WEBP", SIZE, 0))
            drawn = len(range(0, sample_folder.FRAMES, 6))
            self.assertEqual(made.n_frames, drawn + 8)
            times, pictures = [], []
            for frame in range(made.n_frames):
                made.seek(frame)
                made.load()
                times.append(made.info["timestamp"])
                pictures.append(np.asarray(made.convert("RGB"), float))
        # VTK's sixth of 30 frames a second: 200 ms each; the last one drawn stays.
        self.assertEqual(np.diff(times)[: drawn - 1].tolist(), [200] * (drawn - 1))
        self.assertEqual(times[drawn] - times[drawn - 1], 1600)
        with Image.open(os.path.join(os.path.dirname(path), "frames", "hero_0060.png")) as still:
            self.assertLess(np.abs(np.asarray(still, float) - pictures[drawn - 1]).mean(), 4.0)
        # Each picture of the fade is near what it is made of: none keeps blocks of the one before.
        with Image.open(os.path.join(os.path.dirname(path), "frames", "hero_0000.png")) as still:
            begun = np.asarray(still, float)
        with Image.open(os.path.join(os.path.dirname(path), "frames", "hero_0060.png")) as still:
            ended = np.asarray(still, float)
        for step in range(1, 9):
            meant = ended + (begun - ended) * step / 9
            self.assertLess(np.abs(pictures[drawn - 1 + step] - meant).mean(), 1.5, step)
        # The fade ends near where the loop begins.
        begin = [np.abs(picture - pictures[0]).mean() for picture in pictures]
        self.assertLess(begin[-1], 0.4 * begin[drawn - 1])

    def test_a_scene_that_loops_needs_no_fade(self):
        place = folder("round")
        poses = load(place).poses
        for name, data, values in (("Loops", poses.GetFieldData(), [1]), ("LoopTo", poses.GetCellData(), range(poses.GetNumberOfCells()))):
            array = numpy_to_vtk(np.array(values, np.int32), deep=True)
            array.SetName(name)
            data.AddArray(array)
        datafiles.write_xml(poses, os.path.join(place, "poses.vtp"))
        render(place, frames="0::6", size=SIZE, views="hero", samples=1, loop=3.0)
        with Image.open(os.path.join(place, "hero.webp")) as made:
            self.assertEqual(made.n_frames, len(range(0, sample_folder.FRAMES, 6)))

    def test_the_limit_holds(self):
        large = os.path.getsize(self.loop("large", 3.0))
        small = os.path.getsize(self.loop("small", 0.6e-6 * large))
        self.assertLessEqual(small, 0.6 * large)

    def test_one_frame_is_a_loop_too(self):
        with Image.open(self.loop("one", 1.0, frames="5")) as made:
            self.assertEqual(made.n_frames, 1)

    def test_what_cannot_be_is_reported(self):
        place = folder("limits")
        for limit in (0.0, -1.0, 1001.0, float("nan")):
            with self.subTest(limit), self.assertRaisesRegex(BadInput, "loop .*: expected its largest size"):
                render(place, loop=limit)
        with self.assertRaisesRegex(BadInput, "61 frames of 16000x9000 .* too much"):
            render(place, loop=3.0, size=(16000, 9000))
        self.assertFalse(os.path.exists(os.path.join(place, "frames")))
        with self.assertRaisesRegex(BadInput, "hero.webp: does not fit into 0.0005 megabytes"):
            render(place, frames="0::12", size=SIZE, views="hero", samples=1, loop=0.0005)
        self.assertFalse(os.path.exists(os.path.join(place, "hero.webp")))
        self.assertTrue(os.path.exists(os.path.join(place, "frames", "hero_0000.png")))

    def test_a_file_of_somebody_stays(self):
        place = folder("theirs")
        path = os.path.join(place, "hero.webp")
        with open(path, "w", encoding="utf-8") as file:
            file.write("mine")
        with self.assertRaisesRegex(BadInput, "hero.webp"):
            render(place, frames="0", size=SIZE, views="hero", samples=1, loop=1.0)
        with open(path, encoding="utf-8") as file:
            self.assertEqual(file.read(), "mine")


class CommandTest(unittest.TestCase):
    @staticmethod
    def parsed(*words):
        return cli.parser().parse_args(["render", "out", *words])

    def test_options(self):
        plain = self.parsed()
        self.assertEqual((plain.style, plain.loop, plain.views), ("day", None, ("hero", "top")))
        self.assertEqual((self.parsed("--loop").loop, self.parsed("--loop", "0.5").loop), (3.0, 0.5))
        self.assertEqual(self.parsed("--views", "hero,follow").views, ("hero", "follow"))
        self.assertEqual(self.parsed("--style", "paper").style, "paper")
        self.assertEqual([self.parsed(*words).marks for words in ((), ("--marks",), ("--no-marks",))], [None, True, False])

    def test_bad_ones_are_reported(self):
        cases = (("--style", "noon", "invalid choice: 'noon'"), ("--loop", "0", "megabytes above 0, at most 1000"),
                 ("--loop", "much", "megabytes above 0, at most 1000"), ("--loop", "nan", "megabytes above 0, at most 1000"),
                 ("--views", "heroes", "names of hero, side, top and follow"))
        for option, value, wanted in cases:
            said = io.StringIO()
            with self.subTest(option=option, value=value), contextlib.redirect_stderr(said):
                with self.assertRaises(SystemExit) as stopped:
                    self.parsed(option, value)
                self.assertEqual(stopped.exception.code, 2)
                self.assertIn(wanted, said.getvalue())
