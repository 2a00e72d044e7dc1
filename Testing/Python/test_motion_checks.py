# SPDX-License-Identifier: BSD-3-Clause
"""The measures of motion_checks.py and its helpers on motions whose figures are known.

    test_motion_checks.py DATABASE.vtm"""
import json
import math
import pathlib
import random
import struct
import sys
import tempfile
import types
import unittest
import unittest.mock
import zlib

import clearance_checks
import motion_checks
import picture_checks
import result_files
import style_checks
from result_files import ACCELERATION, ORIENTATION, POSITION, REST, VELOCITY, Pose, Row

DATABASE = pathlib.Path(sys.argv.pop(1))
RATE = 30.0


def row(kind, value, **other):
    fields = {"row": 0, "target": 0, "object": 0, "frame": 10, "until": 10, "kind": kind, "radius": 0.0,
              "status": "met"}
    return Row(**{**fields, **other, "value": tuple(value) + (0.0,) * (4 - len(value))})


def steady(velocity, frames=30):
    return [Pose(tuple(k / RATE * v for v in velocity), (1.0, 0.0, 0.0, 0.0), tuple(velocity), (0.0, 0.0, 0.0))
            for k in range(frames)]


class Files(unittest.TestCase):
    def test_segments_of_the_embedded_database(self):
        data = result_files.PolyData(DATABASE.parent / "embedded" / "embedded_0.vtp")
        lengths = [len(line) for line in data.lines]
        self.assertEqual({12: 207, 18: 1107, 27: 1864, 40: 2726, 60: 96}, {n: lengths.count(n) for n in set(lengths)})
        self.assertEqual([30.0], data.field["FramesPerSecond"])
        self.assertEqual(len(data.lines), len(data.cell["Group"]))
        # Each begins at the origin; what the compression leaves out is millimetres.
        self.assertLess(max(math.hypot(*data.points[line[0]]) for line in data.lines), 0.02)

    def test_rotation(self):
        half = math.sqrt(0.5)
        for a, b in zip((0.0, 1.0, 3.0), result_files.rotated((half, 0.0, 0.0, half), (1.0, 0.0, 3.0))):
            self.assertAlmostEqual(a, b, 15)


class Rows(unittest.TestCase):
    def worst(self, name, *rows, velocity=(0.3, 0.0, 0.0)):
        return motion_checks.residuals({0: steady(velocity)}, rows, RATE)[name]

    def test_places(self):
        at = (0.1, 0.0, 0.0)
        self.assertLess(self.worst("place", row(POSITION, at)), 1e-15)
        self.assertAlmostEqual(0.02, self.worst("place", row(POSITION, (0.1, 0.02, 0.0))))
        self.assertAlmostEqual(0.005, self.worst("place", row(POSITION, (0.1, 0.02, 0.0), radius=0.015)))
        self.assertEqual(0.0, self.worst("place", row(POSITION, (0.1, 0.02, 0.0), status="infeasible")))

    def test_a_rest_is_at_its_place_and_still(self):
        self.assertEqual(0.0, self.worst("place", row(REST, (0.0, 0.0, 9.0), until=20), velocity=(0.0, 0.0, 0.0)))
        self.assertAlmostEqual(0.1, self.worst("place", row(REST, (0.1, 0.0, 9.0), until=20)))
        falling = self.worst("place", row(REST, (0.0, 0.0, 9.0), until=16), velocity=(0.0, 0.0, -1.0))
        self.assertAlmostEqual(0.2, falling)

    def test_velocity_acceleration_orientation(self):
        self.assertAlmostEqual(0.1, self.worst("velocity", row(VELOCITY, (0.3, 0.1, 0.0))))
        self.assertAlmostEqual(0.4, self.worst("acceleration", row(ACCELERATION, (0.0, 0.0, 0.5), radius=0.1)))
        turned = (math.cos(0.1), math.sin(0.1), 0.0, 0.0)
        self.assertAlmostEqual(0.2, self.worst("orientation", row(ORIENTATION, turned)))
        self.assertAlmostEqual(0.2, self.worst("orientation", row(ORIENTATION, [-c for c in turned])))

    def test_rows_are_those_of_the_scene(self):
        points = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0]]
        scene = {"constraints": [
            {"kind": "keyframe", "frame": 10, "targets": {"points": points}, "objects": [0, 1]},
            {"kind": "position", "object": 2, "frame": 5, "value": [1, 2, 3]}]}
        good = [row(POSITION, points[0], object=1), row(POSITION, points[1], target=1),
                row(POSITION, (1.0, 2.0, 3.0), row=1, object=2, frame=5)]
        self.assertEqual([], motion_checks.row_errors(good, scene))
        for bad in (good[1:], good[:2], good + [row(POSITION, points[0], row=2)],
                    [good[0], good[1]._replace(object=1), good[2]], [good[0], good[1]._replace(object=3), good[2]],
                    [good[0], good[1]._replace(frame=11), good[2]], good[:2] + [good[2]._replace(object=0)],
                    good[:2] + [good[2]._replace(value=(1.0, 2.0, 3.1, 0.0))]):
            self.assertEqual(1, len(motion_checks.row_errors(bad, scene)), bad)


class Styles(unittest.TestCase):
    def test_helix(self):
        radius, pitch, omega = 0.4, 0.1, 3.0
        path = [(radius * math.cos(omega * k / RATE), radius * math.sin(omega * k / RATE), pitch * omega * k / RATE)
                for k in range(60)]
        style = style_checks.Style()
        style.add(path, RATE, range(1, 59))
        self.assertEqual(58, len(style.speed))
        for value, curvature, acceleration in zip(style.speed, style.log_curvature, style.acceleration):
            self.assertAlmostEqual(omega * math.hypot(radius, pitch), value, 2)
            self.assertAlmostEqual(math.log(radius / (radius ** 2 + pitch ** 2)), curvature, 2)
            self.assertAlmostEqual(omega ** 2 * radius, acceleration, 1)

    def test_kolmogorov_smirnov(self):
        for a, b, wanted in (([1, 2, 3], [3, 1, 2], 0.0), ([1, 2], [3, 4], 1.0), ([1, 2, 3, 4], [3, 4, 5, 6], 0.5),
                             ([], [1], 1.0)):
            self.assertEqual(wanted, style_checks.kolmogorov_smirnov(a, b))

    def test_database_is_as_its_page_says(self):
        style = style_checks.database_style(DATABASE)
        self.assertAlmostEqual(0.65, sorted(style.speed)[len(style.speed) // 2], 2)
        self.assertAlmostEqual(0.50, sorted(style.acceleration)[len(style.acceleration) // 2], 2)
        self.assertAlmostEqual(math.log(0.93), sorted(style.log_curvature)[len(style.log_curvature) // 2], 2)

    def test_free_frames(self):
        rows = [row(POSITION, (0, 0, 0), frame=k) for k in (20, 40, 41, 42)]
        rows += [row(REST, (0, 0, 0), frame=100, until=110), row(POSITION, (0, 0, 0), frame=60, object=1)]
        left_out = set(range(1, 199)) - set(style_checks.free_frames(0, 200, rows, RATE))
        self.assertEqual({40, 41, 42} | set(range(69, 142)), left_out)

    def test_spline_goes_through_its_marks_smoothly_and_stops_at_a_rest(self):
        marks = [(0, (0.0, 0.0, 2.0), None), (30, (1.0, 0.5, 1.5), None), (50, (0.0, 1.0, 1.2), None),
                 (90, (-1.0, 0.0, 0.0), 99), (120, (0.0, 0.0, 1.0), None)]
        path = style_checks.spline(marks)
        self.assertEqual(121, len(path))
        for frame, place, _ in marks:
            self.assertEqual(place, path[frame])
        self.assertEqual([marks[3][1]] * 10, path[90:100])
        bends = [[path[k - 1][c] - 2.0 * path[k][c] + path[k + 1][c] for c in range(3)] for k in range(1, 90)]
        jump = max(math.dist(a, b) for a, b in zip(bends, bends[1:]))
        self.assertLess(jump, 0.3 * max(math.hypot(*b) for b in bends))
        self.assertLess(math.dist(path[89], path[90]), 0.1 * math.dist(path[70], path[71]))
        lines = style_checks.straight(marks)
        self.assertAlmostEqual(0.75, lines[15][2] - 1.0)

    def test_runs_are_pooled_as_objects_are(self):
        generator = random.Random(3)
        ways = {i: [[generator.gauss(0.0, 0.1) for _ in range(3)] for _ in range(20)] for i in range(5)}

        def measure(*runs):
            made = [types.SimpleNamespace(paths={kind: run for kind in style_checks.KINDS},
                                          free={i: range(1, 19) for i in run}, flying={i: range(20) for i in run})
                    for run in runs]
            with unittest.mock.patch.object(style_checks, "Run", side_effect=made):
                return style_checks.measure(range(len(runs)), {}, DATABASE)
        together, apart = measure(ways), measure({i: ways[i] for i in (0, 2)}, {i: ways[i] for i in (1, 3, 4)})
        for name in ("KS log-curvature", "KS |a|", "KS speed", "samples"):
            self.assertEqual(together[name], apart[name])
        self.assertEqual(90.0, apart["samples"]["optimized"])
        self.assertEqual(measure({i: ways[i] for i in (0, 2)})["S(0.2 L)"], apart["S(0.2 L)"])

    def test_the_worst_of_runs(self):
        runs = [{"outside": 0.2, "picture_overlap": 0.8}, {"outside": 0.1, "picture_overlap": 0.95}]
        self.assertEqual({"outside": 0.2, "picture_overlap": 0.8}, motion_checks.worst(runs))
        self.assertEqual(0.8, motion_checks.worst(runs[::-1])["picture_overlap"])

    def test_coherence(self):
        generator = random.Random(4)
        flying = {i: range(40) for i in range(40)}

        def tracks(velocity):
            starts = [[generator.uniform(-1.0, 1.0) for _ in range(3)] for _ in flying]
            ways = [velocity(x) for x in starts]
            return {i: [tuple(a + 0.01 * k / RATE * b for a, b in zip(starts[i], ways[i])) for k in range(40)]
                    for i in flying}
        random_ways = tracks(lambda _: [generator.gauss(0.0, 1.0) for _ in range(3)])
        alone = style_checks.coherence(random_ways, flying, 0.8, RATE)
        self.assertAlmostEqual(1.0, alone, delta=0.15)
        turning = style_checks.coherence(tracks(lambda x: [-x[1], x[0], 0.0]), flying, 0.4, RATE)
        self.assertLess(turning, 0.12)


class Pictures(unittest.TestCase):
    """A picture of 8 x 4 pixels, the middle 4 x 2 opaque, 2 m wide."""

    def picture(self, folder):
        def line(number):
            return [(9, 9, 9, 255 if number in (1, 2) and 2 <= x < 6 else 0) for x in range(8)]
        rows, above = b"", [0] * 32
        for number, kind in enumerate((1, 2, 3, 4)):  # every filter
            flat = [value for pixel in line(number) for value in pixel]
            rows += bytes([kind])
            for i, value in enumerate(flat):
                a, c = (flat[i - 4], above[i - 4]) if i >= 4 else (0, 0)
                near = sorted((a, above[i], c), key=lambda v, to=a + above[i] - c: abs(to - v))[0]
                rows += bytes([(value - (a, above[i], (a + above[i]) // 2, near)[kind - 1]) % 256])
            above = flat

        def chunk(tag, data):
            return struct.pack(">I", len(data)) + tag + data + struct.pack(">I", zlib.crc32(tag + data))
        (folder / "p.png").write_bytes(
            b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 8, 4, 8, 6, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))

    def overlap(self, shift, size, **other):
        """Of one sheet of size by half the size, turned by a right angle and back by its pose."""
        half = math.sqrt(0.5)
        pose = Pose((shift, 5.0, 0.1), (half, 0.0, 0.0, half), (0, 0, 0), (0, 0, 0))
        a, b = 0.25 * size, 0.5 * size
        mesh = ([(-a, -b, 0.0), (a, -b, 0.0), (a, b, 0.0), (-a, b, 0.0)], [(0, 1, 2), (0, 2, 3)])
        targets = {"image": "p.png", "origin": [0, 5, 0], "u": [1, 0, 0], "v": [0, 1, 0], "width": 2.0}
        entry = {"kind": "keyframe", "frame": 9, "velocity": "rest", "targets": targets, **other}
        with tempfile.TemporaryDirectory() as folder:
            self.picture(pathlib.Path(folder))
            scene = pathlib.Path(folder, "s.waft.json")
            scene.write_text(json.dumps({"time": {"frames": 20}, "constraints": [entry]}), encoding="utf-8")
            with unittest.mock.patch.object(result_files, "read_shape_meshes", return_value={0: mesh}):
                return picture_checks.overlap(folder, scene, {0: [pose]})

    def test_overlap(self):
        self.assertEqual(1.0, self.overlap(0.0, 1.0))
        self.assertAlmostEqual(6.0 / 10.0, self.overlap(0.25, 1.0))  # by one pixel of four
        self.assertEqual(0.0, self.overlap(1.2, 1.0))
        self.assertAlmostEqual(8.0 / 32.0, self.overlap(0.0, 2.0))
        self.assertIsNone(self.overlap(0.0, 0.9), "it cannot cover the picture")
        self.assertIsNone(self.overlap(0.0, 1.0, until=15), "it does not rest there at the end")
        self.assertIsNone(self.overlap(0.0, 1.0, velocity=[0, 0, 0]))


class Clearances(unittest.TestCase):
    def test_distances(self):
        box = {"kind": "box", "min": [-1.0, -0.5, 0.0], "max": [1.0, 0.5, 2.0]}
        cube = clearance_checks._box(box)
        self.assertAlmostEqual(5.0, cube((4.0, 4.5, 1.0), 9.0))
        self.assertAlmostEqual(-0.4, cube((0.0, 0.1, 1.0), 9.0))
        ball = clearance_checks._sphere({"center": [1, 1, 1], "radius": 0.5})
        self.assertAlmostEqual(0.5, ball((1.0, 2.0, 1.0), 9.0))
        rod = clearance_checks._cylinder({"base": [0, 0, 0], "top": [0, 2, 0], "radius": 0.5})
        self.assertAlmostEqual(5.0, rod((3.5, 6.0, 0.0), 9.0))
        self.assertAlmostEqual(-0.1, rod((0.0, 1.9, 0.0), 9.0))
        x, y, z = zip(box["min"], box["max"])
        corner = [(a, b, c) for a in x for b in y for c in z]
        faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        halves = [half for p, q, r, s in faces for half in ((p, q, r), (p, r, s))]
        mesh = clearance_checks._mesh([[corner[i] for i in half] for half in halves])
        generator = random.Random(2)
        for _ in range(300):
            point = tuple(generator.uniform(-2.0, 2.5) for _ in range(3))
            self.assertAlmostEqual(cube(point, 9.0), mesh(point, 9.0), 12)

    def test_a_flight_through_a_box_a_wall_and_a_landing(self):
        body = [(0.1, 0.0, -0.02), (-0.1, 0.05, 0.0)]  # clearance radius 0.1
        box = {"kind": "box", "min": [0.5, -1.0, 1.0], "max": [1.0, 1.0, 2.0]}

        def measure(top, rows=(), obstacles=(), frames=45):
            # Straight down a slope from (0, 0, top) at 1.5 m/s each way.
            track = [p._replace(x=(p.x[0], 0.0, top - p.x[0])) for p in steady((1.5, 0.0, 0.0), frames)]
            with unittest.mock.patch.object(result_files, "read_shapes", return_value={0: body}):
                return clearance_checks.measure(".", {"obstacles": obstacles}, {0: track}, rows, RATE)
        # Deepest in the box at (0.75, 0, 1.5); at last 0.2 m beyond the wall x = 2.
        self.assertAlmostEqual(0.1 + 0.25, measure(2.25, obstacles=[box], frames=31).shortfall)
        self.assertAlmostEqual(0.25, measure(2.25, obstacles=[box], frames=31).depth)  # a vertex, in its middle
        self.assertAlmostEqual(0.1 + 0.2, measure(2.25).shortfall)
        self.assertEqual(0.0, measure(2.25).depth, "walls are not solid")
        # To 0.05 m over the ground: too near, unless it lands there; then its vertices count.
        self.assertAlmostEqual(0.05, measure(1.2 - 0.05, frames=23).shortfall)
        landed = row(REST, (1.1, 0.0, 0.05), frame=22, until=22)
        self.assertEqual((0.0, 0.0), measure(1.15, [landed], frames=23))
        self.assertAlmostEqual(0.01, measure(1.11, [landed], frames=23).depth)

    def test_moving_obstacle(self):
        keys = [{"frame": 10, "position": [5, 0, 0]}, {"frame": 20, "position": [6, 0, 0]},
                {"frame": 30, "position": [6, 2, 0]}]
        for frame, wanted in ((0, (0, 0, 0)), (15, (0.5, 0, 0)), (25.5, (1, 1.1, 0)), (99, (1, 2, 0))):
            for a, b in zip(wanted, clearance_checks._offset(keys[0]["position"], keys, frame)):
                self.assertAlmostEqual(a, b)


if __name__ == "__main__":
    unittest.main(verbosity=2)
