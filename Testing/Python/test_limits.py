# SPDX-License-Identifier: BSD-3-Clause
"""`waft check` on scenes of which one list is as long as the schema lets it be: 10 s of processor time and 1 GB.

    pvpython test_limits.py SCHEMA          the lists that take the most seconds, and the most memory
    pvpython test_limits.py SCHEMA all      every list, with a table of what each takes
"""
import json
import math
import os
import pathlib
import resource
import sys
import tempfile
import time
import unittest

import numpy as np

from warm import become, load
from waft.render._output import write_png
from waft.render._scenery import image

SCHEMA = json.loads(pathlib.Path(sys.argv.pop(1)).read_text(encoding="utf-8"))
ALL = sys.argv[1:2] == ["all"] and bool(sys.argv.pop(1))
SECONDS = 10.0  # of processor time, the start of ParaView left out
SLOWER = 3.0  # a machine that these tests have to pass on
MOST_MB = 850.0  # and some 230 of ParaView in a process of its own: the worst, a thousand spheres, takes 1041 MB in all


def grid(count, low=(-1.9, -1.9, 0.2), high=(1.9, 1.9, 3.8)):
    """Places spread evenly in a box."""
    side = math.ceil(count ** (1 / 3))
    return [[round(a + (b - a) * (i // side ** axis % side + 0.5) / side, 4) for axis, (a, b) in enumerate(zip(low, high))]
            for i in range(count)]


def leaves(count):
    return {"objects": [{"shape": "leaf", "positions": grid(count)}]}


def rows(entries, count=1, **more):
    return leaves(count) | {"constraints": entries} | more


def marks(count):
    return grid(count, (-1.5, -1.5, 0.5), (1.5, 1.5, 3.0))


def keyframe(count, targets, **more):
    return rows([{"kind": "keyframe", "frame": 200, "targets": targets, **more}], count)


def at(count, number=0, places=None, **more):
    return [{"kind": "position", "object": number, "frame": 150, "value": place, **more} for place in places or marks(count)]


def obstacles(make):
    def scene(count):
        return {"obstacles": [make(place) for place in grid(count)]}
    return scene


# By the pointer of a list in the schema, scenes with so many entries: {what: scene(count)}.
LISTS = {
    "/properties/shapes": {
        "that nobody uses": lambda n: {"shapes": {f"s{i}": {"builtin": "maple"} for i in range(n - 1)} | {"leaf": {"builtin": "leaf"}}},
        "that all are used": lambda n: {"shapes": {f"s{i}": {"builtin": "oak", "size": 0.1 + 1e-5 * i} for i in range(n)},
                                        "objects": [{"shape": f"s{i}", "position": p} for i, p in enumerate(grid(n))]}},
    "/properties/objects": {
        "one each": lambda n: {"objects": [{"shape": "leaf", "position": place} for place in grid(n)]},
        "in one region": lambda n: {"objects": [{"shape": "leaf", "count": 1, "clearanceRadius": 0.001, "region": {
            "min": [-1.9, -1.9, 0.2], "max": [1.9, 1.9, 3.8]}}] * n}},
    "/definitions/objectsInRegion/properties/count": {
        "": lambda n: {"shapes": {"leaf": {"builtin": "leaf", "size": 0.02}}, "objects": [
            {"shape": "leaf", "count": n, "region": {"min": [-1.9, -1.9, 0.2], "max": [1.9, 1.9, 3.8]}}]}},
    "/definitions/objectsAtPositions/properties/positions": {"": leaves},
    "/properties/constraints": {
        "that exclude one another": lambda n: rows(at(n)),
        "that are equal": lambda n: rows(at(n, places=[[0.0, 0.0, 1.5]] * n)),
        "that any object may fulfil": lambda n: rows(at(n, -1), n),
        "of an object each": lambda n: rows([{"kind": "position", "object": i, "frame": 200, "value": p} for i, p in enumerate(marks(n))], n),
        "of rest": lambda n: rows([{"kind": "rest", "object": i, "frame": 200, "value": p} for i, p in enumerate(marks(n))], n),
        "of velocity": lambda n: rows([{"kind": "velocity", "object": 0, "frame": i + 1, "value": [0.0, 0.0, -0.01]} for i in range(n)],
                                      time={"frames": n + 2}),
        "of orientation": lambda n: rows([{"kind": "orientation", "object": 0, "frame": i % 300, "value": [1, 0, 0, i / n]}
                                          for i in range(n)])},
    "/definitions/pathConstraint/properties/points": {
        "": lambda n: rows([{"kind": "path", "object": 0, "firstFrame": 1, "points": [[0, 0, round(2 - 1.5 * i / n, 6)] for i in range(n)]}],
                           time={"frames": n + 1})},
    "/definitions/keyframeConstraint/properties/objects": {
        "": lambda n: keyframe(n, {"points": marks(100)}, objects=list(range(n)))},
    "/definitions/pointTargets/properties/points": {
        "": lambda n: keyframe(n, {"points": marks(n)}), "of rest": lambda n: keyframe(n, {"points": marks(n)}, velocity="rest")},
    "/definitions/pointTargets/properties/classes": {
        "": lambda n: keyframe(n, {"points": marks(n), "classes": ["green"] * n}) | {"shapes": {"leaf": {"builtin": "leaf", "class": "green"}}}},
    "/definitions/imageTargets/properties/classes": {"": lambda n: keyframe(n, {
        "image": "colors.png", "origin": [0, 0, 1.5], "v": [0, 0, 1], "width": 2.5, "classes": {f"c{i}": [i / n, 0, 0] for i in range(n)}})
        | {"shapes": {f"s{i}": {"builtin": "leaf", "class": f"c{i}"} for i in range(n)},
           "objects": [{"shape": f"s{i}", "position": p} for i, p in enumerate(grid(n))]}},
    "/properties/obstacles": {
        "boxes": obstacles(lambda p: {"kind": "box", "min": [v - 0.05 for v in p], "max": [v + 0.05 for v in p]}),
        "near boxes": obstacles(lambda p: {"kind": "box", "min": [v - 0.15 for v in p], "max": [v + 0.15 for v in p]}),
        "spheres": obstacles(lambda p: {"kind": "sphere", "center": p, "radius": 0.05}),
        "cylinders": obstacles(lambda p: {"kind": "cylinder", "base": p, "top": [p[0], p[1], p[2] + 0.1], "radius": 0.05}),
        "that move": lambda n: {"time": {"frames": 10000}, "obstacles": [
            {"kind": "box", "min": [v - 0.05 for v in p], "max": [v + 0.05 for v in p],
             "motion": [{"frame": 0, "position": p}, {"frame": 9999, "position": [p[0], p[1], p[2] + 0.05]}]} for p in grid(n)]}},
    **{f"/definitions/{kind}Obstacle/properties/motion": {"": lambda n, obstacle=obstacle: {"time": {"frames": n}, "obstacles": [
        {**obstacle, "motion": [{"frame": i, "position": [1, 1, round(1 + i / n, 6)]} for i in range(n)]}]}}
       for kind, obstacle in {"box": {"kind": "box", "min": [0.8, 0.8, 0.8], "max": [1.2, 1.2, 1.2]},
                              "cylinder": {"kind": "cylinder", "base": [1, 1, 0.8], "top": [1, 1, 1.2], "radius": 0.2},
                              "mesh": {"kind": "mesh", "file": "box.obj"},
                              "sphere": {"kind": "sphere", "center": [1, 1, 1], "radius": 0.2}}.items()},
    "/definitions/domain/properties/open": {"": lambda n: leaves(1) | {"domain": {"open": ["x", "y", "top"][:n]}}},
    "/properties/winds": {"": lambda n: {"winds": [{"direction": [1, 0, 0], "strength": 0.1, "center": p, "radius": 1, "centerTime": 3,
                                                    "duration": 1} for p in grid(n)]}},
    "/properties/vortices": {"": lambda n: {"vortices": [{"p1": p, "p2": [p[0], p[1], p[2] + 0.1], "strength": 0.1, "centerTime": 3,
                                                          "duration": 1, "coreRadius": 0.2} for p in grid(n)]}},
}
WORST = (("/properties/constraints", "that exclude one another"), ("/properties/obstacles", "spheres"))


def resolved(pointer):
    field = SCHEMA
    for key in pointer.split("/")[1:]:
        field = field[key]
    return field


def lists_of(field, pointer=""):
    """Pointers of all lists in the schema whose length is not fixed, and of objects whose names are free."""
    if isinstance(field, dict):
        is_list = field.get("type") == "array" and field.get("minItems", 0) <= 1
        if is_list or (field.get("type") == "object" and "properties" not in field):
            yield pointer
        for key, value in field.items():
            yield from lists_of(value, f"{pointer}/{key}")


class LimitsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        load()
        cls._folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls._folder.cleanup)
        cls.folder = pathlib.Path(cls._folder.name)
        reds = np.zeros((100, 200, 3), np.uint8)
        reds[..., 0] = np.linspace(0, 255, 200)
        write_png(image(reds), cls.folder / "colors.png")
        corners = "".join(f"v {x} {y} {z}\n" for x in (0, 0.2) for y in (0, 0.2) for z in (0, 0.2))
        sides = ("1 2 4 3", "5 7 8 6", "1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4")
        (cls.folder / "box.obj").write_text(corners + "".join(f"f {side}\n" for side in sides), encoding="utf-8")

    def test_every_list_of_the_schema_has_a_bound_and_a_scene(self):
        found = set(lists_of(SCHEMA))
        self.assertEqual({pointer for pointer in LISTS if not pointer.endswith("/count")}, found)
        for pointer in found:
            self.assertTrue({"maxItems", "maxProperties"} & resolved(pointer).keys(), pointer)

    def test_a_check_of_the_longest_lists_is_short(self):
        for pointer, scenes in LISTS.items():
            field = resolved(pointer)
            count = field.get("maxItems", field.get("maxProperties", field.get("maximum")))
            for what, scene in scenes.items():
                if ALL or (pointer, what) in WORST:
                    with self.subTest(f"{pointer} {what}"):
                        self.check_of(f"{pointer} {what}", scene(count))

    def check_of(self, name, scene):
        base = {"waft": 1, "shapes": {"leaf": {"builtin": "leaf"}}, "objects": [{"shape": "leaf", "position": [1.97, 1.97, 3.9]}]}
        (self.folder / "s.waft.json").write_text(json.dumps(base | scene), encoding="utf-8")
        with open(self.folder / "words", "w+", encoding="utf-8") as words:
            began = time.monotonic()
            child = os.fork()
            if child == 0:
                from waft import cli
                resource.setrlimit(resource.RLIMIT_CPU, (int(SLOWER * SECONDS), int(SLOWER * SECONDS) + 1))
                become(lambda: cli.main(["check", "s.waft.json"]), self.folder, words.fileno(), words.fileno())
            _, status, used = os.wait4(child, 0)
            words.seek(0)
            said = words.read()
        seconds, megabytes = used.ru_utime + used.ru_stime, used.ru_maxrss / 1024
        if ALL:
            print(f"{name:70}{seconds:6.1f} s {megabytes:6.0f} MB  ({time.monotonic() - began:.0f} s)", flush=True)
        self.assertIn(os.waitstatus_to_exitcode(status), (0, 3), said[-500:])
        self.assertLess(megabytes, MOST_MB)
        self.assertLess(len(said), 20000)
        if ALL:
            self.assertLess(seconds, SECONDS)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
