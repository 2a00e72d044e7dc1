# SPDX-License-Identifier: BSD-3-Clause
"""waft.Scene by plain Python: what it writes is what the reader of scene files takes, and each wrong argument is refused at once.

    test_scene.py SCENES         by a Python without ParaView; SCENES: the folder of scene files
    pvpython test_scene.py SCENES   reads what was written, too
"""
import collections
import decimal
import fractions
import glob
import inspect
import itertools
import json
import os
import pathlib
import re
import shutil
import sys
import tempfile
import types
import unittest

import waft
from waft.scene import _entries, _schema

SCENES = sys.argv.pop(1)
METHODS = {"time": "set_time", "domain": "set_domain", "ground": "set_ground", "air": "set_air", "shape": "add_shape",
           "singleObject": "add_object", "objectsInRegion": "add_objects", "objectsAtPositions": "add_objects",
           "positionConstraint": "add_position", "velocityConstraint": "add_velocity",
           "accelerationConstraint": "add_acceleration", "orientationConstraint": "add_orientation",
           "restConstraint": "add_rest", "pathConstraint": "add_path", "keyframeConstraint": "add_keyframe",
           "pointTargets": "add_keyframe", "textTargets": "add_keyframe", "imageTargets": "add_keyframe",
           "meshTargets": "add_keyframe", "boxObstacle": "add_box", "sphereObstacle": "add_sphere",
           "cylinderObstacle": "add_cylinder", "meshObstacle": "add_mesh", "analyticWind": "add_wind",
           "windFile": "add_wind_file", "windFront": "add_front", "vortex": "add_vortex"}


def everything():
    scene = waft.Scene("Everything", seed=3, comment="a comment")
    scene.set_time(60, 25.0)
    scene.set_domain((-3, -3, 0), (3, 3, 5))
    scene.set_ground(0.1)
    scene.set_air(1.1, breeze=[0.0, 0.0, 0.0])
    scene.add_shape("red", "maple", size=0.12, settling_speed=0.8, color=(1, 0.2, 0), class_="red")
    one = scene.add_object("red", (0, 0, 3), velocity=(0, 0, -0.1), mass=0.001)
    many = scene.add_objects("leaf", count=5, region={"min": (-2, -2, 1.5), "max": (2, 2, 4)}, seed=2)
    given = scene.add_objects("petal", positions=[(2, 2, 4), (-2, 2, 4)], comment="two petals")
    scene.add_position(one, 20, (0, 0, 2.5), radius=0.3)
    scene.add_velocity(one, 20, (0, 0, -0.5), radius=1.0)
    scene.add_acceleration(one, 20, (0, 0, 0), radius=1.0)
    scene.add_orientation(one, 20, (1, 0, 0, 0), radius=0.5)
    scene.add_rest(-1, 50, (1, 1, 1), until=55)
    scene.add_path(given[0], 5, [(2, 2, 3.9), (2, 2, 3.88)], radius=0.2)
    scene.add_keyframe(55, text="L", origin=(0, 0, 1), v=(0, 0, 1), width=2, count=4, objects=many[:4], assign="inOrder")
    scene.add_keyframe(57, points=[(0, 0, 1)], velocity="rest", until=59, face_up="up")
    scene.add_keyframe(50, image=os.path.join(SCENES, "star.png"), origin=(0, 0, 2), width=2)
    box = scene.add_box((2, 2, 0.1), (3, 3, 1), motion=[{"frame": 0, "position": (2.5, 2.5, 0.6)}])
    scene.add_sphere((-2, -2, 1), 0.2, id=7)
    scene.add_cylinder((2, -2, 0.1), (2, -2, 1), 0.2)
    scene.add_wind((1, 0, 0), 0.2, (0, 0, 2), 1, 0.5, 0.5)
    scene.add_vortex((0, 0, 1), (0, 0, 2), 0.1, 0.5, 0.5, 0.2)
    assert (one, many, given, box) == (0, [1, 2, 3, 4, 5], [6, 7], 0)
    return scene


class SceneTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_every_field_of_the_schema_is_an_argument(self):
        entries = {name for name, kind in _schema.schema()["definitions"].items() if kind.get("additionalProperties") is False}
        self.assertEqual({"region", "motionKey", "facing", "window", "orderDirection", "releases", "leave"}, entries - METHODS.keys())
        for name, method in METHODS.items():
            arguments = set(inspect.signature(getattr(waft.Scene, method)).parameters)
            fields = {_entries.argument_name(field) for field in _schema.definition(name)["properties"]} - {"kind", "targets"}
            self.assertEqual(set(), fields - arguments, name)
            for argument in fields:
                self.assertIn(f"\n{argument}: ", getattr(waft.Scene, method).__doc__)

    def test_names_of_fields_and_arguments(self):
        for field, argument in (("settlingSpeed", "settling_speed"), ("class", "class_"), ("p1", "p1"), ("u", "u")):
            self.assertEqual((field, argument), (_entries.field_name(argument), _entries.argument_name(field)))

    def test_what_is_saved_is_loaded_again_from_another_folder(self):
        scene = everything()
        (self.folder / "deep").mkdir()
        path = self.folder / "deep" / "scene.waft.json"
        scene.save(path)
        written = json.loads(path.read_text(encoding="utf-8"))
        image = written["constraints"][8]["targets"]["image"]
        self.assertFalse(os.path.isabs(image))
        self.assertTrue(os.path.samefile(path.parent / image, os.path.join(SCENES, "star.png")))
        again = waft.Scene.load(path)
        self.assertTrue(os.path.samefile(again.as_dict()["constraints"][8]["targets"]["image"],
                                         os.path.join(SCENES, "star.png")))
        other = self.folder / "scene.waft.json"
        again.save(other)
        waft.Scene.load(other).save(path)
        self.assertEqual(written, json.loads(path.read_text(encoding="utf-8")))
        self.assertEqual(scene.objects, again.objects)
        self.assertEqual("a comment", written["_"])
        self.assertEqual(["deep", "scene.waft.json"], sorted(os.listdir(self.folder)))

    def test_scenes_that_come_with_waft_are_loaded(self):
        for path in glob.glob(os.path.join(SCENES, "*.waft.json")):
            self.assertTrue(waft.Scene.load(path).objects, path)

    def test_a_loaded_scene_that_is_malformed_names_file_and_place(self):
        for text, place in (('{"waft": 1, "time": {"frames": 1}}', "/time/frames: expected a whole number from 2 to 1000000, found 1"),
                            ('{"waft": 1, "tme": {}}', "/tme: "), ('{"waft": 2}', "/waft: expected 1, found 2"),
                            ('{"waft": 1, "air": {"density": NaN}}', "NaN"), ("{", "JSON"), ("[]", "/: expected")):
            path = self.folder / "bad.waft.json"
            path.write_text(text, encoding="utf-8")
            with self.assertRaises(waft.BadInput) as caught:
                waft.Scene.load(path)
            self.assertIn(str(path), str(caught.exception))
            self.assertIn(place, str(caught.exception))
        with self.assertRaises(waft.BadInput):
            waft.Scene.load(self.folder / "none.waft.json")

    def test_wrong_arguments_are_refused_at_once(self):
        scene = everything()
        before = scene.as_dict()
        bad = [
            ("title: expected a text, found 3", lambda: waft.Scene(3)),
            ("title: expected a text without control characters", lambda: waft.Scene("a\u202eb")),
            ("name: expected a text without control characters", lambda: scene.add_shape("a\x01b", "leaf")),
            ("class_: expected a text without control characters", lambda: scene.add_shape("x", "leaf", class_="a\n")),
            ("text: expected a text without control", lambda: scene.add_keyframe(10, text="a\x9f", origin=(0, 0, 1), width=1)),
            ("seed: ", lambda: waft.Scene(seed=-1)),
            ("frames: expected a whole number from 2 to 1000000, found 1", lambda: scene.set_time(1)),
            ("frames: ", lambda: scene.set_time(True)),
            ("max: expected a list of 3 numbers", lambda: scene.set_domain(max=(1, 2))),
            ("enabled: expected true or false, found 1", lambda: scene.set_ground(enabled=1)),
            ("name: ", lambda: scene.add_shape("red", "leaf")),
            ("expected builtin or mesh", lambda: scene.add_shape("x")),
            ("builtin: expected one of leaf, ", lambda: scene.add_shape("x", "birch")),
            ("size: expected a number from 1e-09 to 1000000, found \"1\"", lambda: scene.add_shape("x", "leaf", size="1")),
            ("mesh: expected a file that is there", lambda: scene.add_shape("x", mesh=self.folder / "none.obj")),
            ("shape: expected one of red, ", lambda: scene.add_object("lea", (0, 0, 1))),
            ("position: ", lambda: scene.add_object("leaf", "above")),
            ("id: expected an id that no object has, found 3", lambda: scene.add_object("leaf", (0, 0, 1), id=3)),
            ("region: ", lambda: scene.add_objects("leaf", count=2)),
            ("count: ", lambda: scene.add_objects("leaf", count=2.5, region={"min": (0, 0, 0), "max": (1, 1, 1)})),
            ("region.max: ", lambda: scene.add_objects("leaf", count=2, region={"min": (0, 0, 0)})),
            ("object: expected the id of one of the scene's 8 objects, found 8", lambda: scene.add_position(8, 1, (0, 0, 0))),
            ("frame: expected a frame from 0 to 59", lambda: scene.add_position(0, 60, (0, 0, 0))),
            ("until: ", lambda: scene.add_rest(0, 40, (0, 0, 0), until=60)),
            ("value: expected a list of 4 numbers", lambda: scene.add_orientation(0, 1, (0, 0, 0))),
            ("points: expected a frame from 0 to 59", lambda: scene.add_path(0, 55, [(0, 0, 1)] * 6)),
            ("points[1][2]: ", lambda: scene.add_path(0, 5, [(0, 0, 1), (0, 0, float("nan"))])),
            ("points or text or image or mesh: ", lambda: scene.add_keyframe(10)),
            ("origin: ", lambda: scene.add_keyframe(10, text="A", width=1)),
            ("velocity: ", lambda: scene.add_keyframe(10, points=[(0, 0, 1)], velocity="fast")),
            ("width: ", lambda: scene.add_keyframe(10, points=[(0, 0, 1)], width=2)),
            ("objects: ", lambda: scene.add_keyframe(10, points=[(0, 0, 1)], objects=[99])),
            ("radius: ", lambda: scene.add_sphere((0, 0, 0), -1)),
            ("motion[0].position: ", lambda: scene.add_box((0, 0, 0), (1, 1, 1), motion=[{"frame": 0, "position": (0, 0)}])),
            ("unexpected keyword argument 'colour'", lambda: scene.add_box((0, 0, 0), (1, 1, 1), colour=1)),
            ("missing a required argument: 'max'", lambda: scene.add_box((0, 0, 0))),
            ("file: expected a file that is there", lambda: scene.add_mesh("none.obj")),
            ("file: expected series", lambda: scene.add_wind_file("none.obj")),
            ("up: expected one of y, z", lambda: scene.add_wind_file("none.vti", up="x")),
            ("first_frame: expected a whole number from 0", lambda: scene.add_wind_file("none.vti", first_frame=-1)),
            ("scale: expected a number from 1e-09", lambda: scene.add_wind_file("none.vti", scale=0)),
            ("array: expected a text of 1 to", lambda: scene.add_wind_file("none.vti", array="")),
            ("comment: expected a text, found 3", lambda: scene.add_wind_file("none.vti", comment=3)),
            ("path: ", lambda: scene.save(3)),
        ]
        for words, call in bad:
            with self.subTest(words):
                with self.assertRaises(waft.BadInput) as caught:
                    call()
                self.assertIn(words, str(caught.exception))
        self.assertEqual(before, scene.as_dict())

    def test_what_gives_numbers_is_a_list_and_what_is_as_large_a_number(self):
        class Vector:  # as mathutils has it: a sequence, no list
            def __init__(self, *numbers):
                self.numbers = numbers

            def __len__(self):
                return len(self.numbers)

            def __getitem__(self, place):
                return self.numbers[place]

        quarter = fractions.Fraction(1, 4)
        for positions, wanted in ((zip([0, .4], [0, 0], [1, 1]), [[0, 0, 1], [.4, 0, 1]]), (map(tuple, [[0, 0, 1]]), [[0, 0, 1]]),
                                  ({"a": (0, 0, 1)}.values(), [[0, 0, 1]]), (((x, 0, 1) for x in (0, 1)), [[0, 0, 1], [1, 0, 1]]),
                                  (collections.deque([(0, 0, 1)]), [[0, 0, 1]]), ([Vector(0, 0, 1)], [[0, 0, 1]]),
                                  ([(quarter, decimal.Decimal("0.5"), 1)], [[.25, .5, 1]])):
            scene = waft.Scene()
            scene.add_objects("leaf", positions=positions)
            self.assertEqual(wanted, scene.as_dict()["objects"][0]["positions"])
        motion = ({"frame": frame, "position": Vector(0, 0, frame)} for frame in (0, 5))
        scene.add_box(Vector(0, 0, 0), map(int, "111"), motion=map(types.MappingProxyType, motion))
        self.assertEqual([0, 5], [step["frame"] for step in scene.as_dict()["obstacles"][0]["motion"]])
        self.assertEqual(7, scene.with_seed(quarter * 28).as_dict()["seed"])
        ring = []
        ring.append(ring)
        for words, value in (("position: expected a list of 3 numbers", itertools.repeat(0)), ("position: expected a value", ring),
                             ("position[0]: expected a number", (b"1", 0, 0)), ("position[0]: expected a number", (1j, 0, 0)),
                             ("position[0]: expected a number", (fractions.Fraction(10 ** 400), 0, 0)),
                             ("position[0]: expected a number", (decimal.Decimal("NaN"), 0, 0)),
                             ("position: expected a list", object()), ("position: expected a list", b"123")):
            with self.assertRaisesRegex(waft.BadInput, f"Scene.add_object: {re.escape(words)}"):
                scene.add_object("leaf", value)
        with self.assertRaisesRegex(waft.BadInput, r"Scene.add_objects: region.1\]: expected one of min, max"):
            scene.add_objects("leaf", count=2, region={"min": (0, 0, 0), "max": (1, 1, 1), 1: ()})

    def test_lists_end_where_the_schema_says(self):
        scene = waft.Scene()
        for call, words in ((lambda: scene.add_objects("leaf", positions=[(0, 0, 1)] * 20001),
                             "add_objects: positions: expected at most 20000 entries, found 20001"),
                            (lambda: scene.add_path(0, 0, [(0, 0, 1)] * 100001),
                             "add_path: points: expected at most 100000 entries, found 100001"),
                            (lambda: scene.add_sphere((0, 0, 1), 0.1, motion=[{"frame": 0, "position": (0, 0, 1)}] * 10001),
                             "add_sphere: motion: expected at most 10000 entries, found 10001")):
            with self.assertRaisesRegex(waft.BadInput, words):
                call()
        scene.add_objects("leaf", positions=[(0, 0, 1)] * 20000)
        with self.assertRaisesRegex(waft.BadInput, "add_object: objects: expected at most 20000 in a scene, found 20001"):
            scene.add_object("leaf", (0, 0, 1))
        for _ in range(1000):
            scene.add_wind((1, 0, 0), 1, (0, 0, 1), 1, 0, 1)
        with self.assertRaisesRegex(waft.BadInput, "add_wind: winds: expected at most 1000 of them in a scene, found 1001"):
            scene.add_wind((1, 0, 0), 1, (0, 0, 1), 1, 0, 1)
        data = scene.as_dict()
        data["shapes"] = {f"s{i}": {"builtin": "leaf"} for i in range(1001)}
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "many.waft.json"
            path.write_text(json.dumps(data), encoding="utf-8")
            with self.assertRaisesRegex(waft.BadInput, "many.waft.json: /shapes: expected at most 1000 entries, found 1001"):
                waft.Scene.load(path)

    def test_what_there_is_to_see_is_public(self):
        names = [name for name in dir(waft) if not name.startswith("__") and not name.startswith("vtk")]
        self.assertEqual(sorted(waft.__all__), sorted(names))
        self.assertFalse(hasattr(waft, "vtkNothing"))
        self.assertFalse(hasattr(waft, "nothing"))

    @unittest.skipIf("paraview.simple" not in sys.modules, "without ParaView")
    def test_the_reader_takes_what_is_saved(self):
        import numpy as np
        from waft import vtkMotionSceneReader

        scene = everything()
        # By a link: what the scene names is beside the file that it leads to.
        (self.folder / "deep").mkdir()
        shutil.copy(os.path.join(SCENES, "star.png"), self.folder / "deep/star.png")
        scene.add_keyframe(45, image=self.folder / "deep/star.png", origin=(0, 0, 2), width=2, count=4)
        scene.add_shape("starry", "leaf", texture=self.folder / "deep/star.png")
        scene.add_position(np.int64(1), 30, np.array([0.5, 0.25, 3.0], np.longdouble), radius=np.longdouble(0.5))
        scene.save(self.folder / "deep/scene.waft.json")
        (self.folder / "scene.waft.json").symlink_to("deep/scene.waft.json")
        self.assertIn(str(self.folder / "deep/star.png"), waft.Scene.load(self.folder / "scene.waft.json").files())
        errors, warnings = [], []
        from waft.watching import collect
        reader = vtkMotionSceneReader()
        collect(reader, "ErrorEvent", errors)
        collect(reader, "WarningEvent", warnings)
        reader.SetFileName(str(self.folder / "scene.waft.json"))
        reader.Update()
        self.assertEqual(([], []), (errors, [text for text in warnings if "star.png" in text]))
        self.assertEqual(8, reader.GetOutputDataObject(0).GetNumberOfPoints())
        self.assertEqual((0.5, 0.25, 3.0), reader.GetOutputDataObject(1).GetPoint(reader.GetOutputDataObject(1).GetNumberOfPoints() - 1))

    @unittest.skipIf("paraview.simple" in sys.modules, "with ParaView")
    def test_nothing_of_paraview_is_imported(self):
        everything()
        self.assertEqual([], [name for name in sys.modules if name.startswith(("paraview", "vtkmodules", "numpy"))])

    def test_an_object_in_place_of_a_choice_of_values_is_refused(self):
        path = self.folder / "x.waft.json"
        for velocity in ({}, {"x": 1}, 10 ** 400, [[]]):
            row = {"kind": "keyframe", "frame": 1, "velocity": velocity, "targets": {"points": []}}
            path.write_text(json.dumps({"waft": 1, "constraints": [row]}), encoding="utf-8")
            with self.assertRaisesRegex(waft.BadInput, "constraints/0/velocity: expected"):
                waft.Scene.load(path)

    def test_what_the_reader_would_refuse_is_refused_by_the_call(self):
        """Each: how a scene is begun, the call, its argument, words of the message."""
        origin, key = (0, 0, 1), {"frame": 50, "position": (0, 0, 1)}
        for begin, call, argument, words in (
                (lambda s: s.add_position(0, 50, origin), lambda s: s.set_time(20), "set_time: frames", "more than 50, a frame of constraint 0"),
                (lambda s: s.add_path(0, 40, [origin] * 5), lambda s: s.set_time(44), "set_time: frames", "more than 44"),
                (lambda s: s.add_sphere(origin, 0.1, motion=[key]), lambda s: s.set_time(50), "set_time: frames", "a frame of obstacle 0"),
                (None, lambda s: s.add_sphere(origin, 0.1, motion=[{**key, "frame": 60}]), "add_sphere: motion", "frames from 0 to 59"),
                (None, lambda s: s.add_rest(0, 40, origin, until=39), "add_rest: until", "a frame from 40 on"),
                (None, lambda s: s.add_keyframe(40, points=[origin], velocity="rest", until=39), "add_keyframe: until", "from 40 on"),
                (None, lambda s: s.add_keyframe(40, points=[origin] * 2, objects=[0]), "add_keyframe: objects", "2 or more"),
                (None, lambda s: s.add_keyframe(40, points=[origin], objects=[]), "add_keyframe: objects", "1 or more"),
                (None, lambda s: s.add_keyframe(40, points=[origin] * 2, objects=[1, 1]), "add_keyframe: objects", "each object once"),
                (None, lambda s: s.add_keyframe(40, points=[origin], objects=[-1]), "add_keyframe: objects", "only with assign inOrder"),
                (None, lambda s: s.add_keyframe(40, points=[origin], classes=["red"]), "add_keyframe: classes", "none has one"),
                (lambda s: s.add_shape("r", "leaf", class_="red"), lambda s: s.add_keyframe(40, points=[origin] * 2, classes=["red"]),
                 "add_keyframe: classes", "2 classes, one a point"),
                (lambda s: s.add_keyframe(40, points=[origin] * 4), lambda s: s.save(self.folder / "x.waft.json"), "save: constraints[0]",
                 "at most 3 targets, the number of objects, found 4"),
                (lambda s: s.add_keyframe(40, text="A", origin=origin, width=1, count=4), lambda s: s.save(self.folder / "x.waft.json"),
                 "save: constraints[0]", "at most 3 targets"),
                (None, lambda s: s.add_keyframe(40, text="  ", origin=origin, width=1), "add_keyframe: text", "something to draw"),
                (None, lambda s: s.add_keyframe(40, text="\u05e9", origin=origin, width=1), "add_keyframe: text", "from left to right"),
                (None, lambda s: s.add_keyframe(40, mesh=__file__, origin=origin), "add_keyframe: mesh", "ends with .vtp"),
                (None, lambda s: s.add_keyframe(40, image=__file__, origin=origin, width=1), "add_keyframe: image", "ends with .png"),
                (None, lambda s: s.add_mesh(__file__), "add_mesh: file", "ends with .vtp"),
                (None, lambda s: s.add_wind_file(__file__), "add_wind_file: file", ".vti, .pvd or .vdb"),
                (None, lambda s: s.add_shape("m", mesh=__file__), "add_shape: mesh", "ends with .vtp"),
                (None, lambda s: s.set_ground(height=4), "set_ground: height", "below the top of the volume, found 4 m and 4 m"),
                (lambda s: s.set_ground(height=3), lambda s: s.set_domain(max=(2, 2, 2)), "set_domain: max", "below the top"),
                (None, lambda s: s.set_domain((0, 0, 0), (1e-4, 1e-4, 1e-4)), "set_domain: max", "sides from 0.001 m on"),
                (None, lambda s: s.set_domain((0, 0, 0), (9, 9, 0.0089)), "set_domain: max", "at most 1000 times the shortest"),
                (lambda s: s.add_object("leaf", origin, id=4), lambda s: s.add_object("leaf", origin), "add_object: id", "found 4"),
                (lambda s: s.add_object("leaf", origin, id=6), lambda s: s.add_objects("leaf", positions=[origin] * 3), "add_objects: id",
                 "found 6"),
                (lambda s: s.add_sphere(origin, 0.1, id=1), lambda s: s.add_sphere(origin, 0.1), "add_sphere: id", "found 1"),
                (None, lambda s: s.add_orientation(0, 9, (1e-13, 0, 0, 0)), "add_orientation: value", "not zero"),
                (None, lambda s: s.add_position(0, 9, origin, comment="\ud800"), "add_position: comment", "whole letters"),
                (None, lambda s: waft.Scene("\udc00"), "__init__: title", "whole letters")):
            with self.subTest(argument=argument, words=words):
                scene = waft.Scene()
                scene.set_time(60)
                scene.add_objects("leaf", positions=[(0, 0, 2), (0.5, 0, 2), (1, 0, 2)])
                if begin is not None:
                    begin(scene)
                before = scene.as_dict()
                with self.assertRaises(waft.BadInput) as refused:
                    call(scene)
                self.assertTrue(str(refused.exception).startswith(f"Scene.{argument}: expected "), refused.exception)
                self.assertIn(words, str(refused.exception))
                self.assertEqual(before, scene.as_dict())

    def test_fields_that_do_not_go_together_are_refused(self):
        scene = everything()
        before = scene.as_dict()
        ball = ((0, 0, 0), 1.0, 1.0, 1.0)
        for call, parts in ((lambda: scene.add_box((0, 0, 1), (1, 1, 0)), ("add_box: max", "above min")),
                            (lambda: scene.add_cylinder((1, 1, 1), (1, 1, 1), 0.1), ("add_cylinder: top", "apart from base")),
                            (lambda: scene.add_objects("leaf", count=2, region={"min": (1, 0, 0), "max": (0, 1, 1)}),
                             ("add_objects: region", "not below its min")),
                            (lambda: scene.add_keyframe(9, text="A", origin=(0, 0, 1), u=(0, 0, 2), v=(0, 0, -1), width=1),
                             ("add_keyframe: v", "not parallel")),
                            (lambda: scene.add_keyframe(9, text="A", origin=(0, 0, 1), u=(0, 3, 0), width=1), ("add_keyframe: u", "not parallel")),
                            (lambda: scene.add_keyframe(9, text="A", origin=(0, 0, 1), u=(0, 0, 0), width=1), ("add_keyframe: u", "not zero")),
                            (lambda: scene.add_wind((0, 0, 0), 1.0, *ball), ("add_wind: direction", "not zero")),
                            (lambda: scene.add_vortex((0, 0, 1), (0, 0, 1), 1.0, 1.0, 1.0, 0.1), ("add_vortex: p2", "apart from p1")),
                            (lambda: scene.add_orientation(0, 9, (0, 0, 0, 0)), ("add_orientation: value", "not zero")),
                            (lambda: scene.add_object("leaf", (0, 0, 1), orientation=(0, 0, 0, 0)), ("add_object: orientation", "not zero")),
                            (lambda: scene.add_sphere((0, 0, 1), 0.1, motion=[{"frame": 5, "position": (0, 0, 1)}] * 2),
                             ("add_sphere: motion", "frames that grow")),
                            (lambda: scene.set_domain(max=(9, 9, -9)), ("set_domain: max", "above its min")),
                            (lambda: scene.save("/nonexistent/x.waft.json"), ("save: path", "a folder that is there"))):
            with self.assertRaises(waft.BadInput) as refused:
                call()
            for part in parts:
                self.assertIn(part, str(refused.exception))
            self.assertNotIn(".part", str(refused.exception))
        self.assertEqual(before, scene.as_dict())
        scene = waft.Scene()
        scene.set_domain(min=(-9, -9, -9))
        scene.set_domain(max=(-5, -5, -5))  # the corners together


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
