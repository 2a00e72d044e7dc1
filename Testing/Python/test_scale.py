# SPDX-License-Identifier: BSD-3-Clause
"""One scene in volumes from a box to a street: what it costs goes with its grid, its frames and its bodies, not with its metres, and its
mark is met or named beforehand.

    python3 test_scale.py WAFT [--table] [WIDTH ...]        a table prints what each took, and holds nothing
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

WIDTHS = (0.3, 1.0, 4.0, 16.0, 40.0, 200.0)
USUAL = 4.0  # m, that the others are held against
MOST_PROCESSOR, MOST_MEMORY = 1.5, 1.3
FRAMES = 300


def scene_of(width, size):
    """Two leaves of a size [m] and a mark for one of them, at places that are the same in widths of the volume."""
    def at(*place):
        return [width * part for part in place]

    return {"waft": 1, "time": {"frames": FRAMES, "framesPerSecond": 30}, "domain": {"min": at(-0.5, -0.5, 0), "max": at(0.5, 0.5, 1)},
            "shapes": {"leaf": {"builtin": "leaf", "size": size}},
            "objects": [{"shape": "leaf", "position": at(0, 0, 0.8)}, {"shape": "leaf", "position": at(0.2, 0, 0.8)}],
            "constraints": [{"kind": "position", "object": 0, "frame": 150, "value": at(0.05, 0.1, 0.55), "radius": 0.005 * width}]}


class Flight:
    """What `waft check` and a preview of the scene come to, in a process of its own."""

    def __init__(self, waft, width, size):
        self.width, self.size = width, size
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder, "scale.waft.json")
            scene.write_text(json.dumps(scene_of(width, size)), encoding="utf-8")
            environment = {**os.environ, "WAFT_CACHE": str(pathlib.Path(folder, "cache")), "WAFT_DEFAULTS": "off"}
            told = subprocess.run([waft, "check", scene], env=environment, capture_output=True, text=True, check=False)
            self.is_named = "row 0 target 0" in told.stdout + told.stderr
            flown = subprocess.Popen([waft, "synthesize", scene, "--output", pathlib.Path(folder, "out"), "--preview", "--threads", "1"],
                                     env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            _, status, used = os.wait4(flown.pid, 0)
            flown.returncode = os.waitstatus_to_exitcode(status)
            self.status = flown.returncode
            self.processor = used.ru_utime + used.ru_stime  # s
            self.memory = used.ru_maxrss / 1e6  # GB

    def __str__(self):
        return (f"{self.width:g} m, leaves of {self.size:g} m: {self.processor:.1f} CPU-s, {self.memory:.2f} GB, "
                f"{'met' if self.status == 0 else f'exit {self.status}'}{', named beforehand' if self.is_named else ''}")


def flights_of(waft, widths):
    """Of each width with bodies of a fortieth of it, and with leaves of 10 cm where these are small in it."""
    for width in widths:
        yield Flight(waft, width, width / 40.0)
        if 0.1 < 0.5 * width and 0.1 != width / 40.0:
            yield Flight(waft, width, 0.1)


class ScaleTest(unittest.TestCase):
    def test_metres_cost_nothing(self):
        usual = next(flights_of(WAFT, (USUAL,)))
        self.assertEqual(usual.status, 0, usual)
        for flight in flights_of(WAFT, [width for width in WIDTHS if width != USUAL]):
            with self.subTest(flight=str(flight)):
                self.assertIn(flight.status, (0, 3))
                self.assertTrue(flight.status == 0 or flight.is_named, "unmet, and nothing said it beforehand")
                self.assertLessEqual(flight.processor, MOST_PROCESSOR * usual.processor)
                self.assertLessEqual(flight.memory, MOST_MEMORY * usual.memory)


if __name__ == "__main__":
    WAFT = sys.argv.pop(1)
    if "--table" in sys.argv:
        for one in flights_of(WAFT, [float(width) for width in sys.argv[2:]] or WIDTHS):
            print(one, flush=True)
    else:
        unittest.main()
