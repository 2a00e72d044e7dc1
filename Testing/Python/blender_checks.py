# SPDX-License-Identifier: BSD-3-Clause
"""What the add-on does in Blender; test_blender.py runs it: blender -b --python blender_checks.py -- FOLDER WAFT [NAMES ...]"""
import json
import math
import os
import pathlib
import re
import signal
import struct
import subprocess
import sys
import tempfile
import time
import types
import unittest

import addon_utils
import bpy
import numpy as np
from bpy_extras.object_utils import world_to_camera_view
from mathutils import Quaternion

if "bool" not in vars(np):
    np.bool = bool  # the glTF importer of Blender 3.4 asks for this name, which NumPy 1.24 has dropped
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import blender_scenes as scenes  # noqa: E402

addon_utils.enable("waft_addon", default_set=True)

from waft_addon import bodies, command, curves, flight, flying, panel, preferences, reporting, stage, surfaces, takes  # noqa: E402

FOLDER, WAFT = sys.argv[sys.argv.index("--") + 1:][:2]
NEAR, ALIKE = 1e-5, 1e-4  # m, rad: what comes back and what goes out agree to
MOVED = ("location", "rotation_quaternion", "rotation_euler", "rotation_axis_angle", "rotation_mode", "animation_data", "matrix_basis",
         "matrix_local", "matrix_world", "dimensions", "waft")  # of a flyer that flies
FOLLOWING = ("matrix_local", "matrix_world")  # of what hangs on it


def save(name):
    """Saves the file in a folder of its own."""
    folder = pathlib.Path(FOLDER) / f"{name}-{time.monotonic_ns()}"
    folder.mkdir()
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / f"{name}.blend"))
    return folder


def fly():
    flying.found.clear()
    try:
        return bpy.ops.waft.fly() == {"FINISHED"}
    except RuntimeError:  # a report of an error
        return False


def settings_of(block):
    """All plain values of a block of data, by name."""
    found = {}
    for one in block.bl_rna.properties:
        if one.identifier in ("rna_type", "original", "users", "is_updated", "is_updated_data", "is_evaluated", "tag", "session_uid"):
            continue
        value = getattr(block, one.identifier, None)
        if one.type == "POINTER":
            found[one.identifier] = getattr(value, "name", None) if value is not None else None
            if one.identifier in ("waft", "field", "animation_data") and value is not None:
                found[one.identifier] = settings_of(value)
        elif one.type == "COLLECTION":
            found[one.identifier] = len(value)
        elif getattr(one, "is_array", False):
            found[one.identifier] = repr([list(part) if hasattr(part, "__len__") else part for part in value])
        else:
            found[one.identifier] = repr(value)
    return found


def everything(but=()):
    """What is in the file: {kind: {name: values}}, without what moves of the flyers `but`."""
    bpy.context.view_layer.update()
    found = {}
    for kind in ("objects", "meshes", "materials", "collections", "scenes", "curves", "images", "worlds", "cameras", "lights", "actions"):
        found[kind] = {block.name: settings_of(block) for block in getattr(bpy.data, kind)}
    for name, values in found["objects"].items():
        for part in MOVED if name in but else FOLLOWING if but else ():
            values.pop(part, None)
    found["points"] = {one.name: repr([tuple(point.co) for point in one.vertices]) for one in bpy.data.meshes}
    found["selected"] = [thing.name for thing in bpy.context.selected_objects]
    return found


def world_points(thing, unit):
    """The points of an object's mesh in the world [m], by Blender."""
    points, _ = surfaces.triangles_of(thing, bpy.context.evaluated_depsgraph_get())
    matrix = np.array(thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world, float)
    return surfaces.moved(points, matrix) * unit


def points_of_file(path):
    return points_of_text(pathlib.Path(path).read_text(encoding="utf-8"))


def points_of_text(text):
    numbers = text.split('NumberOfComponents="3" format="ascii">')[1].split("<")[0]
    return np.array(numbers.split(), float).reshape(-1, 3)


def waft(*arguments):
    return subprocess.run([WAFT, *map(str, arguments)], capture_output=True, text=True, check=False)


def go_to(scene, frame):
    scene.frame_set(int(frame), subframe=frame - int(frame))


def gltf_json(path):
    content = path.read_bytes()
    return json.loads(content[20:20 + struct.unpack("<I", content[12:16])[0]])


class Flown(unittest.TestCase):
    """What goes out and what comes back, against the files of the run."""

    def look(self, make, quality="preview"):
        make()
        scene = bpy.context.scene
        scene.waft.quality = quality
        folder = save(make.__name__)
        unit, first = scene.unit_settings.scale_length, scene.frame_start
        names = [thing.name for thing in scene.objects if thing.waft.role == "FLYER"]
        scene.frame_set(first)
        starts = {name: world_points(scene.objects[name], unit) for name in names}
        scene.frame_set(first + 5)
        before = everything(names)
        self.assertTrue(fly(), list(flying.found))
        after = everything(names)
        self.assertEqual(set(after["actions"]) - set(before["actions"]), {f"take-001 {name}" for name in names})
        after["actions"] = before["actions"]
        for kind in before:
            if kind != "scenes":
                self.assertEqual(before[kind], after[kind], kind)
        for one in (before, after):
            one["scenes"][scene.name].pop("waft")
        self.assertEqual(before["scenes"], after["scenes"])

        take = next(pathlib.Path(folder).glob("*-waft/take-001"))
        written = json.loads((take / "scene.waft.json").read_text(encoding="utf-8"))
        table = np.loadtxt(take / "result" / "poses.csv", delimiter=",", skiprows=1)
        frames = int(table[:, 1].max()) + 1
        self.assertEqual(frames, scene.frame_end - first + 1)
        rate = scene.render.fps / scene.render.fps_base
        self.assertAlmostEqual(table[frames - 1, 2], (frames - 1) / rate, 9)
        farthest = turned = started = 0.0
        for number, entry in enumerate(written["objects"]):
            thing = scene.objects[entry["_object"]]
            poses = table[table[:, 0] == number]
            points = points_of_file(take / written["shapes"][entry["shape"]]["mesh"])
            for frame in (*range(0, frames, 7), frames - 1):
                scene.frame_set(first + frame)
                turn = Quaternion(poses[frame, 6:10])
                wanted = points @ np.array(turn.to_matrix(), float).T + poses[frame, 3:6]
                found = world_points(thing, unit)
                farthest = max(farthest, np.abs(found - wanted).max())
                if frame == 0:
                    started = max(started, np.abs(found - starts[thing.name]).max())
                    first_matrix, first_turn = thing.matrix_world.copy(), turn
                turns = [np.array(one, float)[:3, :3] for one in (thing.matrix_world, first_matrix, turn.to_matrix(), first_turn.to_matrix())]
                apart = turns[0] @ np.linalg.inv(turns[1]) - turns[2] @ np.linalg.inv(turns[3])
                turned = max(turned, np.linalg.norm(apart) / math.sqrt(2.0))  # of a small angle
        print(f"{make.__name__}: {len(names)} objects, {frames} frames: largest distance {farthest:.1e} m, angle {turned:.1e} rad, "
              f"start {started:.1e} m")
        self.assertLess(farthest, NEAR)
        self.assertLess(started, NEAR)
        self.assertLess(turned, ALIKE)
        return take, written

    def test_leaves_and_marks(self):
        take, written = self.look(scenes.leaves_and_marks)
        rows = {(row["_object"], row["frame"]): row for row in written["constraints"]}
        self.assertEqual(set(rows), {("Place", 29), ("Hung", 39), ("Keyed", 21), ("Keyed", 43)})
        self.assertAlmostEqual(rows["Keyed", 21]["radius"], 0.1, 6)
        self.assertEqual(rows["Hung", 39]["object"], 1)
        self.assertEqual([name for name, row in rows.items() if "facing" in row], [("Place", 29)])
        self.assertLess(np.abs(np.array(rows["Place", 29]["facing"]["direction"]) - (0.0, -1.0, 0.0)).max(), 1e-6)
        pose = next(row for row in csv_rows(take / "result" / "poses.csv") if (row["object"], row["frame"]) == ("0", "29"))
        normal = Quaternion([float(pose[key]) for key in ("qw", "qx", "qy", "qz")]).to_matrix().col[2]
        self.assertLess(math.acos(-normal[1]), 0.2 + 1e-6)
        turn = Quaternion((0.6, 0.0, 0.8, 0.0))
        wanted = np.array((0.4, 0.0, 2.1)) + np.array(turn.to_matrix()) @ (0.1, 0.0, -0.4)
        self.assertLess(np.abs(np.array(rows["Hung", 39]["value"]) - wanted).max(), NEAR)
        # The centre of mass of the leaf comes to the mark.
        scene = bpy.context.scene
        scene.frame_set(44)
        points = world_points(scene.objects["Mirrored"], 1.0)
        _, triangles = surfaces.triangles_of(scene.objects["Mirrored"], bpy.context.evaluated_depsgraph_get())
        corners = points[triangles]
        areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
        center = np.average(corners.mean(axis=1), axis=0, weights=areas)
        self.assertLess(np.abs(center - (0.2, 0.5, 1.5)).max(), NEAR)

    def test_petals_in_centimetres(self):
        take, written = self.look(scenes.petals_in_centimetres)
        self.assertEqual(len(written["objects"]), 12)
        self.assertEqual(len(written["shapes"]), 1)
        self.assertAlmostEqual(written["time"]["framesPerSecond"], 30.0 / 1.001, 4)
        self.assertEqual(np.round(written["domain"]["max"], 6).tolist(), [1.8, 1.8, 2.6])
        text = written["constraints"][0]["targets"]
        self.assertEqual((text["text"], text["count"]), ("I", 12))
        self.assertLess(np.abs(np.array(text["v"]) - (0.0, 0.0, 1.0)).max(), 1e-6)
        keys = written["obstacles"][0]["motion"]
        at = np.interp(24, [key["frame"] for key in keys], [key["position"][0] for key in keys])  # Blender's frame 35, half way
        self.assertLess(abs(at), NEAR)
        self.look_at_export(take / "result", written)

    def look_at_export(self, folder, written):
        """`waft export`, imported: what surrounds the motion is where it was."""
        done = waft("export", folder)
        self.assertEqual(0, done.returncode, done.stderr)
        rate = written["time"]["framesPerSecond"]
        scene = scenes.empty_scene(0, 59, 30, 30.0 / rate)
        bpy.ops.import_scene.gltf(filepath=str(folder / "scene.glb"))
        self.assertEqual((scene["framesPerSecond"], scene["firstFrame"], scene["lastFrame"]), (rate, 0, 59))
        # The importer takes the rate without its base, from 4.0 on the rate times its base.
        laid = (scene.render.fps * (scene.render.fps_base if bpy.app.version >= (4, 0, 0) else 1.0)) / rate
        keys = written["obstacles"][0]["motion"]
        block, ground = scene.objects["obstacle-0"], scene.objects["ground"]
        for frame in (0, 17, 39, 59):
            go_to(scene, frame * laid)
            wanted = [np.interp(frame, [key["frame"] for key in keys], [key["position"][axis] for key in keys]) for axis in range(3)]
            self.assertLess(np.abs(np.array(block.matrix_world.translation) - wanted).max(), NEAR)
        self.assertLess(np.abs(np.array(block.dimensions) - (0.2, 0.2, 0.2)).max(), 0.1)
        self.assertLess(np.abs(world_points(ground, 1.0) - (0, 0, 0))[:, 2].max(), NEAR)
        marks = [thing for thing in scene.objects if thing.name.startswith("mark-")]
        self.assertEqual(12, len(marks))
        self.assertTrue(all(thing.type == "EMPTY" and thing["frame"] == 51 for thing in marks))
        go_to(scene, 51 * laid)
        flyers = {thing["ObjectId"]: thing for thing in scene.objects if thing.name.startswith("Petal")}
        for thing in marks:  # the flyer is there
            self.assertLess((flyers[thing["ObjectId"]].matrix_world.translation - thing.matrix_world.translation).length, NEAR)
        camera = next(thing for thing in scene.objects if thing.type == "CAMERA")
        for thing in flyers.values():
            x, y, depth = world_to_camera_view(scene, camera, thing.matrix_world.translation)
            self.assertTrue(0.0 < x < 1.0 and 0.0 < y < 1.0 and depth > 0.0, (x, y, depth))
        for part in ("none", "camera"):
            self.assertEqual(0, waft("export", folder, "--with", part).returncode)
            names = {node["name"] for node in gltf_json(folder / "scene.glb")["nodes"]}
            self.assertEqual(part == "camera", "camera" in names)
            self.assertFalse({"ground", "obstacle-0"} & names)
        for kind, name in (("abc", "alembic"), ("usd", "usd")):
            done = waft("export", folder, "--to", kind)
            if getattr(bpy.app.build_options, name):
                self.assertEqual(0, done.returncode, done.stderr)
                self.assertTrue((folder / f"scene.{kind}").is_file())
            else:
                self.assertEqual(1, done.returncode)
                self.assertIn("was built without this format", done.stderr)
                self.assertFalse((folder / f"scene.{kind}").exists())
        (folder / "scene.glb").write_text("mine", encoding="utf-8")
        self.assertEqual(2, waft("export", folder).returncode)
        self.assertEqual("mine", (folder / "scene.glb").read_text(encoding="utf-8"))

    def test_paper_in_wind(self):
        take, written = self.look(scenes.paper_in_wind)
        arc = next(row for row in written["constraints"] if row["_object"] == "Arc")
        self.assertEqual((arc["objects"], arc["frame"], len(arc["targets"]["points"])), ([0, 1], 40, 2))
        self.assertLess(np.abs(np.array(arc["targets"]["points"][1]) - (-0.2, 0.26, 1.5)).max(), 0.03)
        wind, vortex = written["winds"][0], written["vortices"][0]
        self.assertLess(np.abs(np.array(wind["direction"]) - (1.0, 0.0, 0.0)).max(), 1e-6)
        self.assertAlmostEqual(wind["strength"], 0.8, 6)
        self.assertAlmostEqual(vortex["strength"], 2.0 * math.pi * 0.3, 5)
        self.assertAlmostEqual(vortex["centerTime"], 20 / 25, 2)
        self.assertTrue(all(row["Status"] == "met" for row in csv_rows(take / "result" / "constraints.csv")))
        # A page lies on the table, its mesh's y axis up or down.
        scene = bpy.context.scene
        scene.frame_set(scene.frame_end)
        lowest = world_points(scene.objects["Page 3"], 1.0)[:, 2].min()
        self.assertLess(abs(lowest - 1.1), 2e-3)


def csv_rows(path):
    import csv

    with open(path, encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


class Takes(unittest.TestCase):
    def test_a_quality_of_a_file_from_before(self):
        scenes.small_scene()
        scene = bpy.context.scene
        place = save("before") / "take-001"
        (place / "result").mkdir(parents=True)
        (place / "result" / "report.json").write_text("{}", encoding="utf-8")
        stage.Stage(bpy.context).write(place)
        scene.waft["quality"] = 1  # as files have it
        bpy.ops.wm.save_mainfile()
        bpy.ops.wm.open_mainfile(filepath=bpy.data.filepath)
        scene = bpy.context.scene
        self.assertEqual(scene.waft.quality, "air")
        take = scene.waft.takes.add()
        take.name, take.folder, take.quality = "take-001", str(place), "assimilated"
        for word, name in (("air", "air"), ("full", "full"), ("assimilated", "air")):
            scene.waft.quality = word  # as scripts say it
            self.assertEqual(scene.waft.quality, name)
            edited = flying._edited(scene, stage.Stage(bpy.context), name)
            self.assertEqual(edited, str(place / "result") if name == "air" else None)

    def test_edit_swap_and_remove(self):
        scenes.leaves_and_marks()
        scene = bpy.context.scene
        one, other = scene.objects["One"], scene.objects["Other"]
        one.scale = (1.0, 1.0, 1.0)
        one.color = (0.1, 0.2, 0.3, 1.0)
        one.keyframe_insert("color", frame=1)  # an action of the user's own
        own = one.animation_data.action
        save("takes")
        names = ["One", "Other", "Mirrored"]
        before = everything()
        self.assertTrue(fly(), list(flying.found))
        first_path = keys(one)
        scene.objects["Place"].location.x += 0.1
        self.assertTrue(fly(), list(flying.found))
        self.assertEqual([take.name for take in scene.waft.takes], ["take-001", "take-002"])
        self.assertEqual(scene.waft.takes[1].edited, "take-001")
        self.assertGreater(np.abs(keys(one) - first_path).max(), 0.01)
        self.assertEqual(one.animation_data.action.name, "take-002 One")
        self.assertTrue(any(curve.data_path == "color" for curve in curves.curves_of(one)))
        second = keys(other)
        scene.waft.shown = 0
        self.assertEqual(one.animation_data.action.name, "take-001 One")
        self.assertTrue(np.array_equal(keys(other), second))  # the edit left it as it was
        self.assertTrue(np.array_equal(keys(one), first_path))
        scene.objects["Place"].location.x -= 0.1
        # Put elsewhere at the first frame, without a key, a flyer starts from there; elsewhere in time its keys hold.
        scene.frame_set(1)
        other.location = (0.3, -0.2, 2.1)
        start = stage.Stage(bpy.context).scene["objects"][1]["position"]
        self.assertLess(np.abs(np.array(start) - (0.3, -0.2, 2.1)).max(), 0.1)
        self.assertEqual([round(x, 6) for x in other.location], [0.3, -0.2, 2.1])
        scene.frame_set(5)
        other.location = (0.3, -0.2, 2.1)
        start = stage.Stage(bpy.context).scene["objects"][1]["position"]
        self.assertLess(np.abs(np.array(start) - (0.4, 0.0, 2.1)).max(), 0.1)
        while len(scene.waft.takes):
            bpy.ops.waft.remove_take()
        self.assertIs(one.animation_data.action, own)
        self.assertEqual([curve.data_path for curve in curves.curves_of(one)], ["color"] * 4)
        after = everything()
        for name in names:
            for part in ("rotation_mode", "waft"):
                self.assertEqual(before["objects"][name][part], after["objects"][name][part], name)
            for part in ("location", "scale"):
                self.assertEqual(before["objects"][name][part], after["objects"][name][part], name)
        self.assertEqual(set(before["actions"]), set(after["actions"]))


def keys(thing):
    """The values of the keys of an object's location and rotation."""
    found = []
    for curve in curves.curves_of(thing):
        if curve.data_path in ("location", "rotation_quaternion"):
            values = np.empty(2 * len(curve.keyframe_points))
            curve.keyframe_points.foreach_get("co", values)
            found.append(values)
    return np.array(found)


class BadInput(unittest.TestCase):
    """Each is said, about its object, and nothing in the file is changed."""

    def setUp(self):
        self.leaf = scenes.small_scene()
        self.scene = bpy.context.scene

    def refused(self, text, about="", is_saved=True):
        folder = save("bad") if is_saved else None
        before = everything()
        self.assertFalse(fly())
        said = [(problem.object, problem.text) for problem in flying.found if problem.is_error]
        self.assertTrue(any(name == about and text in words for name, words in said), said)
        self.assertEqual(before, everything())
        if folder is not None:
            self.assertEqual([], [one for one in folder.rglob("*") if "take" in one.name])

    def test_no_waft(self):
        preferences = bpy.context.preferences.addons["waft_addon"].preferences
        preferences.command = "/nowhere/waft"
        try:
            self.refused("/nowhere/waft (of the add-on's preferences) is no program")
        finally:
            preferences.command = ""
        for package in ("/nowhere/share/blender/scripts/addons/waft_addon", "/a"):
            path, lack = command.find_command("", package)
            if path is None:
                self.assertIn("no waft was found: name the program in Edit > Preferences > Add-ons", lack)
                self.assertNotIn("/nowhere", lack)
        self.assertEqual(command.find_command(WAFT, "/a/b/c/d/e/f"), (WAFT, ""))

    def test_no_program_of_waft(self):
        preferences = bpy.context.preferences.addons["waft_addon"].preferences
        preferences.command = "/bin/false"
        try:
            self.refused("waft ended without a word")
        finally:
            preferences.command = ""

    def test_old_blender(self):
        self.assertIn("this is Blender 3.3.9: Waft needs 3.4", stage.too_old((3, 3, 9)))
        self.assertEqual("", stage.too_old((3, 4, 0)))

    def test_unsaved(self):
        self.refused("the file is not saved", is_saved=False)

    def test_open_obstacle(self):
        scenes.obstacle("Sheet", scenes.sheet_mesh("Sheet", 0.3))
        self.refused("is not closed: 4 edges do not belong to two faces", "Sheet")

    def test_obstacle_without_faces(self):
        scenes.obstacle("Void", scenes.mesh("Void", [(0, 0, 0)], []))
        self.refused("has no faces", "Void")

    def test_flyer_without_faces(self):
        scenes.flyer("Void", scenes.mesh("Void", [(0, 0, 0), (1, 0, 0)], []), location=(0, 0, 1))
        self.refused("has no faces", "Void")

    def test_flyer_with_a_parent(self):
        self.leaf.parent = scenes.link("Parent", None)
        self.refused("hangs on a parent", "Leaf")
        self.assertEqual([("Leaf", True)], [(problem.object, problem.is_error) for problem in flying.found])  # nothing of its mark

    def test_what_else_would_move_a_flyer(self):
        def solo(leaf):
            leaf.keyframe_insert("location", frame=1)
            data = leaf.animation_data
            track = data.nla_tracks.new()
            track.strips.new("Strip", 1, data.action)
            data.action = None
            track.is_solo = True

        def half(leaf):
            solo(leaf)
            leaf.animation_data.nla_tracks[0].is_solo = False
            leaf.animation_data.action_influence = 0.5

        def rigid(leaf):
            bpy.context.view_layer.objects.active = leaf
            bpy.ops.rigidbody.object_add()

        def driven(path):
            return lambda leaf: leaf.driver_add(path, 2)

        def strip_of(path):
            def change(leaf):
                leaf.keyframe_insert(path, frame=1)
                data = leaf.animation_data
                data.nla_tracks.new().strips.new("Strip", 1, data.action)
                data.action = None
            return change

        def limited(leaf):
            leaf.constraints.new("LIMIT_LOCATION").mute = True
            leaf.keyframe_insert('constraints["Limit Location"].influence', frame=1)

        for change, text in ((driven("location"), "has a driver"), (strip_of("delta_location"), "has keys on its delta"),
                             (lambda leaf: leaf.keyframe_insert("delta_rotation_euler", frame=1), "has keys on its delta"),
                             (limited, "has keys on its delta transforms or constraints"), (driven("rotation_euler"), "has a driver"),
                             (driven("delta_location"), "has a driver"), (rigid, "is an active rigid body"), (solo, "plays solo"),
                             (half, "blends its action")):
            with self.subTest(text):
                change(scenes.small_scene())
                self.refused(text, "Leaf")
        leaf = scenes.small_scene()
        for harmless in (driven("color"), driven("scale"), strip_of("location")):
            harmless(leaf)
        leaf.driver_add("location", 1).mute = True
        rigid(leaf)
        leaf.rigid_body.kinematic = True
        self.assertEqual([], [problem.text for problem in flying.read(bpy.context).problems if problem.object and problem.is_error])

    def test_flyers_that_have_no_mesh_of_their_own(self):
        instanced = scenes.link("Copies", None, location=(0.0, 0.5, 2.0), instance_type="COLLECTION")
        instanced.instance_collection = bpy.data.collections.new("Leaves")
        instanced.waft.role = "FLYER"
        self.refused("is an instance of a collection", "Copies")
        instanced.waft.role = "NONE"
        scenes.instances_on(self.leaf, scenes.link("Seed", scenes.leaf_mesh(), location=(0.5, 0.5, 2.0)))
        self.refused("shows only instances", "Leaf")

    def test_folder_that_cannot_be_made(self):
        folder = save("taken")
        (folder / "taken-waft").write_text("mine", encoding="utf-8")
        self.assertFalse(fly())
        self.assertIn("taken-waft is no folder", "".join(problem.text for problem in flying.found if problem.is_error))
        self.assertIn("Not ready", flying.found.title)
        (folder / "taken-waft").unlink()
        make, flying._new_folder = flying._new_folder, lambda: (_ for _ in ()).throw(PermissionError(13, "Permission denied", "/full"))
        try:
            self.assertFalse(fly())
        finally:
            flying._new_folder = make
        self.assertIn("/full: Permission denied", [problem.text for problem in flying.found])

    def test_flyer_outside(self):
        self.leaf.location.z = 5.0
        self.refused("starts outside of the volume", "Leaf")

    def test_nothing_flies(self):
        self.leaf.waft.role = "NONE"
        self.scene.objects["Mark"].waft.flyer = None
        self.refused("nothing flies")

    def test_no_volume(self):
        self.scene.objects["Volume"].waft.role = "NONE"
        self.refused("there is no volume")

    def test_turned_volume(self):
        self.scene.objects["Volume"].rotation_euler = (0.0, 0.0, 0.3)
        self.refused("is turned", "Volume")

    def test_mark_outside_of_the_range(self):
        self.scene.objects["Mark"].waft.frame = 37
        self.refused("is at frame 37: expected one of the scene's, 1 to 36", "Mark")

    def test_mark_outside_of_the_volume(self):
        self.scene.objects["Mark"].location.x = 9.0
        self.refused("lies outside of the volume at frame 30", "Mark")

    def test_marks_that_disagree(self):
        scenes.mark("Second", (0.4, 0.1, 1.7), 30, self.leaf, radius=0.1)
        self.refused("disagrees with Mark: at frame 30 Leaf cannot be at both", "Second")

    def test_marks_that_agree(self):
        scenes.mark("Second", (0.15, 0.1, 1.7), 30, self.leaf, radius=0.1)
        flying.read(bpy.context)
        self.assertEqual([], [problem for problem in flying.found if problem.object])

    def test_what_is_disabled_or_excluded_takes_no_part(self):
        scenes.obstacle("Sheet", scenes.sheet_mesh("Sheet", 0.3)).hide_viewport = True
        hidden = scenes.mark("Hidden", (0.2, 0.1, 1.7), 20, self.leaf)
        hidden.hide_set(True)  # out of sight alone
        away = bpy.data.collections.new("Away")
        self.scene.collection.children.link(away)
        other = scenes.flyer("Other", self.leaf.data, location=(0.5, 0.0, 2.0))
        for holder in list(other.users_collection):
            holder.objects.unlink(other)
        away.objects.link(other)
        bpy.context.view_layer.layer_collection.children["Away"].exclude = True
        save("disabled")
        looked = flying.read(bpy.context)
        self.assertEqual([("Sheet", False), ("Other", False)], [(problem.object, problem.is_error) for problem in looked.problems])
        self.assertIn("excludes", looked.problems[1].text)
        self.assertEqual({"Mark", "Hidden"}, set(looked.sources["constraints"]))
        scenes.mark("Its", (0.5, 0.1, 1.7), 30, other)
        self.refused("is a mark of Other, which takes no part", "Its")

    def test_mark_against_the_start(self):
        scenes.mark("Early", (0.4, 0.1, 1.7), 1, self.leaf)
        self.refused("disagrees with the start of Leaf", "Early")

    def test_empty_group(self):
        word = bpy.data.curves.new("Word", "FONT")
        scenes.target("Word", word, 30).waft.group = bpy.data.collections.new("Nobody")
        self.refused("in which there is no flyer", "Word")

    def test_too_many_places(self):
        word = bpy.data.curves.new("Word", "FONT")
        scenes.target("Word", word, 30).waft.count = 5
        self.refused("has 5 places for 1 flyers", "Word")

    def test_killed(self):
        folder = save("killed")
        before = everything()
        self.assertTrue(flying.begin(bpy.context), list(flying.found))
        run = flying.running.flight
        until(lambda: run.text.startswith("assimilation"))
        os.killpg(run.pid, signal.SIGKILL)
        self.assertFalse(flying.end(bpy.context, outcome_of(run)))
        self.assertIn("waft was killed (signal 9): nothing was changed", [problem.text for problem in flying.found])
        self.assertEqual(before, everything())
        self.assertEqual([], list(folder.glob("*-waft/*")))

    def test_what_somebody_put_into_its_folder_stays(self):
        folder = save("shared")
        self.assertTrue(flying.begin(bpy.context), list(flying.found))
        run = flying.running.flight
        until(lambda: run.text.startswith("assimilation"))
        take = next(folder.glob("*-waft/*"))
        for mine in (take / "notes.txt", take / "result" / "reference.png", take / "result" / "checkpoint" / "mine.txt"):
            mine.write_text("mine", encoding="utf-8")
        os.killpg(run.pid, signal.SIGKILL)
        self.assertFalse(flying.end(bpy.context, outcome_of(run)))
        left = {str(path.relative_to(take)) for path in take.rglob("*") if path.is_file()}
        self.assertEqual({"notes.txt", "result/reference.png", "result/checkpoint/mine.txt"}, left)

    def test_stopped_at_once(self):
        save("stopped")
        before = everything()
        self.assertTrue(flying.begin(bpy.context), list(flying.found))
        run = flying.running.flight
        bpy.ops.waft.stop()
        self.assertFalse(flying.end(bpy.context, outcome_of(run)))
        self.assertIn("stopped before there was anything to keep: nothing was changed", [problem.text for problem in flying.found])
        self.assertEqual(before, everything())

    def test_stopped_with_the_best_so_far(self):
        self.scene.waft.quality = "air"
        save("stopped")
        self.assertTrue(flying.begin(bpy.context), list(flying.found))
        run = flying.running.flight
        until(lambda: "air" in run.text)
        bpy.ops.waft.stop()
        self.assertTrue(flying.end(bpy.context, outcome_of(run)), list(flying.found))
        self.assertTrue(self.scene.waft.takes[0].is_stopped)
        self.assertEqual(self.leaf.animation_data.action.name, "take-001 Leaf")

    def test_another_file_is_opened(self):
        folder = save("left")
        self.assertTrue(flying.begin(bpy.context), list(flying.found))
        pid = flying.running.flight.pid
        scenes.empty_scene()
        self.assertIsNone(flying.running)
        with self.assertRaises(ProcessLookupError):
            os.kill(pid, 0)
        self.assertEqual([], list(folder.glob("*-waft/*")))

    def test_obstacle_that_is_simulated(self):
        ball = scenes.obstacle("Ball", scenes.box_mesh("Ball", 0.1), location=(0.8, 0.0, 2.5))
        bpy.context.view_layer.objects.active = ball
        bpy.ops.rigidbody.object_add()
        bpy.context.view_layer.update()
        motion = stage.Stage(bpy.context).scene["obstacles"][0]["motion"]
        self.assertLess(motion[-1]["position"][2], 1.0)

    def test_message_selects_its_object(self):
        bpy.ops.waft.select(name="Mark")
        self.assertEqual(bpy.context.view_layer.objects.active.name, "Mark")
        bpy.ops.waft.select(name="Leaf", others="Volume\nGone")
        self.assertEqual({"Leaf", "Volume"}, {thing.name for thing in bpy.context.selected_objects})
        self.assertEqual(bpy.context.view_layer.objects.active.name, "Leaf")


class Oddities(unittest.TestCase):
    """What flies, but perhaps not as it was thought: a remark about its object."""

    def setUp(self):
        self.leaf = scenes.small_scene()

    def remarks(self):
        bpy.context.view_layer.update()
        looked = stage.Stage(bpy.context)
        self.assertFalse(looked.problems.is_fatal, list(looked.problems))
        return [(problem.object, problem.text) for problem in looked.problems]

    def expect(self, text, about="Leaf"):
        found = self.remarks()
        self.assertTrue(any(name == about and text in words for name, words in found), found)

    def test_nothing_odd(self):
        self.assertEqual([], self.remarks())

    def test_forms_that_change(self):
        def shape_keys(leaf):
            leaf.shape_key_add(name="Basis")
            leaf.shape_key_add(name="Bent").keyframe_insert("value", frame=1)

        def hooked(leaf):
            other = scenes.link("Moving", None)
            other.keyframe_insert("location", frame=1)
            leaf.modifiers.new("Hook", "HOOK").object = other

        def grown(leaf, times):
            leaf.keyframe_insert("scale", frame=1)
            leaf.scale *= times
            leaf.keyframe_insert("scale", frame=20)

        def keyed(leaf):
            leaf.modifiers.new("Wave off", "SIMPLE_DEFORM").keyframe_insert("factor", frame=1)

        for change, text in ((lambda leaf: leaf.modifiers.new("Folds", "CLOTH"), "(the modifier Folds)"),
                             (lambda leaf: leaf.modifiers.new("Soft", "SOFT_BODY"), "(the modifier Soft)"),
                             (lambda leaf: leaf.modifiers.new("Waves", "WAVE"), "(the modifier Waves)"),
                             (hooked, "(the modifier Hook)"), (keyed, "(keys on a modifier)"), (shape_keys, "shape keys)"),
                             (lambda leaf: grown(leaf, 1.2), "(keys on its scale)")):
            with self.subTest(text):
                change(scenes.small_scene())
                self.expect(f"may change its form {text}" if text[0] == "(" else text)

        grown(scenes.small_scene(), 1.0)
        self.assertEqual([], self.remarks())

    def test_two_in_one_place(self):
        copy = self.leaf.copy()
        bpy.context.scene.collection.objects.link(copy)
        self.expect("starts in the same place as Leaf", copy.name)
        copy.location.x += 0.05
        self.assertEqual([], self.remarks())

    def test_large_and_closed(self):
        scenes.flyer("Cube", scenes.box_mesh("Cube", 0.6), location=(0.5, 0.5, 1.5))
        self.expect("is 1.2 m large", "Cube")
        self.expect("is closed", "Cube")
        self.assertEqual(2, len(self.remarks()))
        scenes.flyer("Ball", scenes.box_mesh("Ball", 0.03), "BUBBLE", location=(-0.9, 0.9, 1.5))
        self.assertEqual(2, len(self.remarks()))

    def test_template_that_flies(self):
        self.leaf.location.z = 0.2
        emitter = scenes.link("Emitter", scenes.sheet_mesh("Emitter", 0.5), location=(0.0, 0.0, 2.0))
        for thing in (self.leaf, emitter):
            thing.select_set(True)
        bpy.context.view_layer.objects.active = self.leaf
        bpy.context.view_layer.update()
        bpy.ops.waft.spread(count=3, seed=2)
        self.expect("is the one that Spread copied, and flies as well")
        self.leaf.waft.role = "NONE"
        bpy.context.scene.objects["Mark"].waft.flyer = None
        self.assertEqual([], self.remarks())

    def test_instances_beside_a_mesh(self):
        emitter = scenes.flyer("Emitter", scenes.sheet_mesh("Emitter", 0.1), location=(0.5, 0.0, 2.0))
        emitter.modifiers.new("Particles", "PARTICLE_SYSTEM")
        settings = emitter.particle_systems[0].settings
        settings.render_type, settings.instance_object, settings.count, settings.frame_start = "OBJECT", self.leaf, 5, 1
        settings.frame_end = 1
        self.expect("shows instances beside its mesh", "Emitter")

    def test_parts_within_an_instance(self):
        held = bpy.data.collections.new("Held")
        held.objects.link(self.leaf)
        scenes.link("Shown", None, instance_type="COLLECTION").instance_collection = held
        self.expect("what has a part in that takes none", "Shown")

    def test_flyer_of_two_scenes(self):
        bpy.data.scenes.new("Another").collection.objects.link(self.leaf)
        self.expect("is in the scene Another, too")

    def test_mark_with_strips(self):
        mark = bpy.context.scene.objects["Mark"]
        mark.keyframe_insert("location", frame=20)
        data = mark.animation_data
        data.nla_tracks.new().strips.new("Strip", 1, data.action)
        data.action = None
        self.expect("has keys in NLA strips", "Mark")

    def test_figures(self):
        """Texts that Waft sets itself, those that are filled as they are drawn, and what rests upright."""
        def shape(body, **values):
            scenes.small_scene()
            data = bpy.data.curves.new("Word", "FONT")
            data.body, data.size = body, 0.3
            for name, value in values.items():
                setattr(data, name, value)
            scenes.target("Word", data, 30, location=(-0.4, 0.0, 1.0), rotation_euler=(math.pi / 2.0, 0.0, 0.0))
            self.remarks()
            targets = next(row for row in stage.Stage(bpy.context).scene["constraints"] if row["_object"] == "Word")["targets"]
            return "text" if "text" in targets else "mesh"

        def boxed(width):
            data = bpy.context.scene.objects["Word"].data
            data.text_boxes[0].width = width
            bpy.context.view_layer.update()
            targets = stage.Stage(bpy.context).scene["constraints"][-1]["targets"]
            return "text" if "text" in targets else "mesh"

        self.assertEqual("text", shape("TWO WORDS"))
        self.assertEqual("text", boxed(9.0))
        self.assertEqual("mesh", boxed(1.0))
        self.assertEqual("mesh", shape("ONE\nTWO"))
        self.assertEqual("mesh", shape("WIDE", space_character=2.0))
        self.assertEqual("mesh", shape("LEANS", shear=0.3))
        word = bpy.context.scene.objects["Word"]
        word.waft.is_facing = True
        word.waft.facing_tolerance = math.pi  # as Blender keeps it, a little more
        facing = stage.Stage(bpy.context).scene["constraints"][-1]["facing"]
        self.assertLess(np.abs(np.array(facing["direction"]) - (0.0, -1.0, 0.0)).max(), 1e-6)
        self.assertLessEqual(facing["tolerance"], math.pi)
        word.waft.kind = "REST"
        self.expect("stands upright and is a rest", "Word")
        self.assertNotIn("facing", stage.Stage(bpy.context).scene["constraints"][-1], "what rests lies as it comes down")
        word.rotation_euler = (0.0, 0.0, 0.4)
        self.assertEqual([], self.remarks())


class Times(unittest.TestCase):
    """What is read of a file at a frame is as it is at that frame."""

    def setUp(self):
        self.leaf = scenes.small_scene()
        self.scene = bpy.context.scene

    def keyed(self, owner, path, holder=None, **values):
        """Keys of a setting of a block of data, {f1: value, ...}, which are all that there is of it at frame 5."""
        for frame, value in values.items():
            setattr(holder or owner, path.rpartition(".")[2], value)
            owner.keyframe_insert(path, frame=int(frame[1:]))

    def read(self):
        self.scene.frame_set(5)
        looked = stage.Stage(bpy.context)
        self.assertFalse(looked.problems.is_fatal, list(looked.problems))
        self.assertEqual(self.scene.frame_current, 5)
        return looked.scene

    def row(self, name):
        return next(row for row in self.read()["constraints"] if row["_object"] == name)

    def test_times_of_flyers_and_targets(self):
        self.scene.frame_end = 90
        others = [scenes.flyer(f"Leaf {number}", scenes.leaf_mesh(), location=(0.2 * number, 0.3, 2.0)) for number in range(1, 4)]
        for thing in (self.leaf, *others):
            thing.waft.release, thing.waft.last_release = 5, 14
        others[0].waft.appears = True
        sheet = scenes.target("Sheet", scenes.sheet_mesh("Sheet", 0.1), 40, location=(0.0, 0.0, 1.0))
        sheet.waft.first_frame, sheet.waft.order, sheet.waft.hold = 31, "outward", 10
        sheet.waft.leave, sheet.waft.leave_frame, sheet.waft.last_leave = "right", 51, 61
        box = next(thing for thing in self.scene.objects if thing.waft.role == "VOLUME")
        box.waft.is_open, box.waft.breeze = (True, False, True), (0.5, 0.7)
        self.scene.objects["Mark"].waft.role = "NONE"
        self.scene.waft.loops = True
        scene = self.read()
        self.assertEqual({"frames": 90, "framesPerSecond": 24.0, "loop": True}, scene["time"])
        self.assertEqual(["x", "top"], scene["domain"]["open"])
        self.assertEqual({"breeze": [0.5, 0.0, 0.0]}, scene["air"])
        self.assertEqual([4, 7, 10, 13], sorted(entry["release"] for entry in scene["objects"]))
        self.assertEqual([("Leaf 1", True)], [(entry["_object"], entry["appears"]) for entry in scene["objects"] if "appears" in entry])
        self.assertNotIn("orientation", next(entry for entry in scene["objects"] if "appears" in entry))
        row = scene["constraints"][0]
        self.assertEqual(({"from": 30, "to": 39}, "outward", 10), (row["frame"], row["order"], row["hold"]))
        self.assertEqual({"frame": {"from": 50, "to": 60}, "order": "left-to-right", "side": "right"}, row["leave"])
        for name, value, words in (("first_frame", 40, "earlier First Frame"), ("leave_frame", 39, "Leave Frame not before frame 40")):
            before = getattr(sheet.waft, name)
            setattr(sheet.waft, name, value)
            self.assertIn(words, "; ".join(problem.text for problem in stage.Stage(bpy.context).problems))
            setattr(sheet.waft, name, before)

    def test_what_is_on_an_obstacle(self):
        ball = scenes.obstacle("Ball", scenes.box_mesh("Ball", 0.05), location=(0.0, 0.0, 1.0))
        self.keyed(ball, "location", ball, f1=(0.0, 0.0, 1.0), f31=(0.3, 0.0, 1.0))
        free = self.read()["objects"][0]["position"]
        self.leaf.waft.release, self.leaf.waft.on = 11, ball
        mark = self.scene.objects["Mark"]
        mark.parent = ball  # which takes it along
        mark.waft.frame = 21
        scene = self.read()
        number = [entry["_object"] for entry in scene["obstacles"]].index("Ball")
        self.assertEqual(number, scene["objects"][0]["on"])
        np.testing.assert_allclose(scene["objects"][0]["position"], np.subtract(free, (0.0, 0.0, 1.0)), atol=1e-6)
        row = next(entry for entry in scene["constraints"] if entry["_object"] == "Mark")
        self.assertEqual(number, row["on"])
        np.testing.assert_allclose(row["value"], mark.location, atol=1e-6)  # a child's own location
        mark.parent, mark.waft.on = None, self.leaf
        self.assertIn("is on Leaf, which is no obstacle", "; ".join(problem.text for problem in stage.Stage(bpy.context).problems))

    def test_forms_of_targets(self):
        folder = save("forms")
        sheet = scenes.target("Sheet", scenes.sheet_mesh("Sheet", 0.1), 35, location=(0.0, 0.0, 1.0))
        sheet.shape_key_add(name="Basis")
        big = sheet.shape_key_add(name="Big")
        for point in big.data:
            point.co *= 4.0
        self.keyed(sheet.data.shape_keys, 'key_blocks["Big"].value', big, f1=0.0, f20=1.0)
        self.keyed(sheet, "waft.radius", sheet.waft, f1=0.01, f20=0.05)
        wave = scenes.target("Wave", scenes.sheet_mesh("Wave", 0.1), 30, location=(0.0, 0.0, 1.0))
        lift = wave.modifiers.new("Lift", "DISPLACE")
        lift.mid_level = 0.0
        self.keyed(wave, 'modifiers["Lift"].strength', lift, f1=0.0, f20=0.4)
        data = bpy.data.curves.new("Word", "FONT")
        data.body = "I"
        scenes.target("Word", data, 35, location=(0.0, 0.0, 1.0))
        self.keyed(data, "size", f1=0.2, f20=0.6)
        image = bpy.data.images.new("Picture", 8, 8)
        image.filepath_raw, image.file_format = str(folder / "picture.png"), "PNG"
        image.save()
        picture = scenes.target("Picture", None, 35, location=(0.0, 0.0, 1.0), empty_display_type="IMAGE")
        picture.data = image
        self.keyed(picture, "empty_display_size", f1=0.2, f20=0.6)
        self.scene.frame_set(5)
        looked = stage.Stage(bpy.context)
        rows = {row["_object"]: row for row in looked.scene["constraints"]}
        sizes = {name: np.ptp(points_of_text(looked.files[rows[name]["targets"]["mesh"]]), axis=0) for name in ("Sheet", "Wave")}
        self.assertAlmostEqual(sizes["Sheet"][0], 0.8, 5)
        self.assertAlmostEqual(rows["Sheet"]["radius"], 0.05, 6)
        self.assertAlmostEqual(rows["Wave"]["targets"]["origin"][2], 1.4, 5)
        wide = rows["Word"]["targets"]["width"]
        data.animation_data_clear()
        data.size = 0.2
        self.assertAlmostEqual(self.row("Word")["targets"]["width"], wide / 3.0, 5)
        self.assertAlmostEqual(rows["Picture"]["targets"]["width"], 0.6, 6)
        image.source = "SEQUENCE"
        bpy.context.view_layer.update()
        self.assertIn(("Picture", "shows an image sequence, which is another picture at each frame: choose one picture"),
                      [(problem.object, problem.text) for problem in stage.Stage(bpy.context).problems if problem.is_error])

    def test_marks_and_fields(self):
        mark = self.scene.objects["Mark"]
        mark.waft.is_facing = True
        self.keyed(mark, "waft.facing_tolerance", mark.waft, f1=0.1, f20=0.3)
        gust = scenes.field("Gust", "WIND", 0.0)
        gust.field.use_max_distance = True
        self.keyed(gust, "field.strength", gust.field, f1=0.0, f20=2.0, f30=0.0)
        self.keyed(gust, "field.distance_max", gust.field, f1=1.0, f20=3.0)
        self.assertAlmostEqual(self.row("Mark")["facing"]["tolerance"], 0.3, 6)
        self.assertAlmostEqual(self.read()["winds"][0]["radius"], 1.5, 5)
        gust.waft.is_front, gust.waft.frame, gust.waft.front_speed = True, 11, 3.0
        front = self.read()["winds"][0]
        self.assertEqual(("front", 10, 2.0, 3.0, 8.0), tuple(front[name] for name in ("kind", "startFrame", "strength", "speed", "width")))

    def test_time_remapping(self):
        """Keys are played at twice their frames: those of marks, of obstacles, and those that a take brings."""
        self.scene.render.frame_map_old, self.scene.render.frame_map_new = 100, 200
        mark = self.scene.objects["Mark"]
        for frame, x in ((10, 0.1), (15, 0.2)):
            mark.location.x = x
            mark.keyframe_insert("location", frame=frame)
        rows = [(row["frame"], round(row["value"][0], 5)) for row in self.read()["constraints"]]
        self.assertEqual([(19, 0.1), (29, 0.2)], rows)
        looked = stage.Stage(bpy.context)
        places = np.column_stack([0.01 * np.arange(36.0), np.zeros(36), np.full(36, 2.0)])
        turns = np.tile((1.0, 0.0, 0.0, 0.0), (36, 1))
        values = {"name": "take-001", "folder": "", "quality": "preview"}
        present = np.arange(36) >= 10
        self.assertEqual(([], []), takes.add(self.scene, values, looked, [places], [turns], [present]))
        wanted = looked.placements(0, places, turns)[0]
        for frame in (11, 18, 19, 36):
            self.scene.frame_set(frame)
            self.assertLess(np.abs(np.array(self.leaf.matrix_world.translation) - wanted[frame - 1]).max(), 1e-6)
        # Who is not in the shot is hidden, and as it was once the take is gone.
        for frame, is_hidden in ((1, True), (10, True), (11, False), (36, False), (5, True)):
            self.scene.frame_set(frame)
            self.assertEqual((is_hidden, is_hidden), (self.leaf.hide_viewport, self.leaf.hide_render))
        takes.remove(self.scene, 0)
        self.assertEqual((False, False), (self.leaf.hide_viewport, self.leaf.hide_render))


JARGON = re.compile(r"\brows?\b|rms|segment|MaximumTurn|scene\.waft\.json|object \d|obstacle \d|database|/constraints|target \d")


class Checked(unittest.TestCase):
    """What `waft check` has to say, in the words of Blender."""

    def test_what_waft_finds(self):
        leaf = scenes.small_scene()
        scene = bpy.context.scene
        scene.frame_start, scene.frame_end = 11, 70
        scenes.obstacle("Post", scenes.box_mesh("Post", 0.3), location=(0.7, 0.0, 1.5))
        scenes.mark("Inside", (0.7, 0.1, 1.5), 60, leaf)
        scenes.mark("Hasty", (-1.2, 0.1, 1.2), 34, leaf)
        save("checked")
        before = everything()
        temporary = set(pathlib.Path(tempfile.gettempdir()).glob("waft-check-*"))
        self.assertEqual({"FINISHED"}, bpy.ops.waft.check())
        self.assertEqual(before, everything())
        self.assertEqual(temporary, set(pathlib.Path(tempfile.gettempdir()).glob("waft-check-*")))
        said = {problem.object: problem.text for problem in flying.found}
        self.assertRegex(said["Inside"], r"cannot be met at frame 60: the position .* inside Post")
        self.assertIn("contradicts Mark (position at frame 30): ", said["Hasty"])
        self.assertEqual("It flies, but 2 marks cannot be met", flying.found.title)
        for problem in flying.found:
            self.assertNotRegex(problem.text, JARGON)
        bpy.ops.waft.dismiss()
        self.assertEqual(("", []), (flying.found.title, list(flying.found)))

    def test_a_scene_that_waft_refuses(self):
        scenes.small_scene()
        one, other = scenes.box_mesh("A", 0.2), scenes.box_mesh("B", 0.2)
        points = [tuple(v.co) for v in one.vertices] + [(v.co.x + 0.1, v.co.y + 0.1, v.co.z + 0.1) for v in other.vertices]
        faces = [tuple(p.vertices) for p in one.polygons] + [tuple(i + 8 for i in p.vertices) for p in other.polygons]
        scenes.obstacle("Two", scenes.mesh("Two", points, faces), location=(0.5, 0.5, 1.0))
        save("refused")
        looked = flying.check(bpy.context)  # as a script does
        self.assertEqual(["Two"], [problem.object for problem in looked.problems])
        self.assertRegex(looked.problems[0].text, "^the surface cuts itself")
        self.assertIn("Not ready", flying.found.title)

    def test_sentences(self):
        """All that waft warns of, by names and frames of the scene."""
        scenes.small_scene()
        bpy.context.scene.frame_start, bpy.context.scene.frame_end = 5, 40
        scenes.flyer("Other", scenes.leaf_mesh(), location=(0.4, 0.0, 2.0))
        scenes.obstacle("Post", scenes.box_mesh("Post", 0.1), location=(0.7, 0.0, 0.5))
        looked = stage.Stage(bpy.context)
        shape = next(iter(looked.scene["shapes"]))
        report = reporting.Reporter(looked).report
        for line, about, text in (
                ("too fast: row 0 target 0: object 1 has 0.4 s for 4 m, 10 m/s; the fastest of the database is 2.2 m/s, and half of that is "
                 "kept up: give it 3.6 s or more", "Mark", "too fast: Other has 0.4 s for 4 m: give it 3.6 s or more, which is 86 frames"),
                ("no time to fall: row 0 target 0: object 0 falls 3 m in 1 s; it settles at 0.8 m/s: give it 3 s or more", "Mark",
                 "no time to fall: Leaf falls 3 m in 1 s: give it 3 s or more, which is 72 frames"),
                ("too heavy: row 0 target 0: object 1 sinks at 6 m/s, and to drift from frame 25 the air has to rise at 6 m/s under it; the "
                 "fastest of the database is 2.5 m/s, and half of that is kept up: expected a smaller settling speed", "Mark",
                 "too heavy: Other sinks at 6 m/s, the air would have to rise at 6 m/s under it: give it a smaller settling speed"),
                ("too narrow: row 0 target 0 lies 0.01 m from obstacle 0, the body's clearance radius is 0.05 m", "Mark",
                 "too narrow: lies 0.01 m from Post, a flyer turns in a ball of 0.05 m about it"),
                ("too fast: row 0 target 0: object 1 has 0.4 s for 4 m to its mark at frame 25, 10 m/s; the fastest of the database is 2.2 "
                 "m/s, and half of that is kept up: give it 3.6 s (86 frames) or more", "Mark",
                 "too fast: Other has 0.4 s for 4 m: give it 3.6 s or more, which is 86 frames"),
                ("no time to fall: row 0 target 0: object 0 falls 3 m in 1 s to its rest at frame 25; it settles at 0.8 m/s: give it 3 s (72 "
                 "frames) or more", "Mark", "no time to fall: Leaf falls 3 m in 1 s: give it 3 s or more, which is 72 frames"),
                ("too narrow: row 0 target 0 lies 0.01 m from obstacle 0, the body's clearance radius is 0.05 m: move the mark of object 0 at "
                 "frame 25 away by 0.04 m, or give it that radius", "Mark",
                 "too narrow: lies 0.01 m from Post, a flyer turns in a ball of 0.05 m about it"),
                ("too near: 29 pairs of the 31 marks at frame 25 are nearer than bodies are wide (0.1 m), the nearest 0.08 m: bodies will "
                 "overlap there; take fewer, smaller ones, or a wider figure", "Mark",
                 "too near: 29 pairs of the 31 marks at frame 30 are nearer than bodies are wide (0.1 m), the nearest 0.08 m: bodies will "
                 "overlap there; take fewer, smaller ones, or a wider figure"),
                ("too near: 1 pairs of the 2 marks at frame 3 are nearer than bodies are wide (0.1 m), the nearest 0 m (objects 0 and 1, at "
                 "one place): bodies will overlap there; take fewer, smaller ones, or a wider figure, or ask for one of them at another "
                 "frame", "Leaf",
                 "too near: 1 pairs of the 2 marks at frame 8 are nearer than bodies are wide (0.1 m), the nearest 0 m (Leaf and Other, at "
                 "one place): bodies will overlap there; take fewer, smaller ones, or a wider figure, or ask for one of them at another "
                 "frame"),
                ("conflict: 26 more", "", "26 more cannot be met"),
                ("too many: the balls of clearance of 900 bodies take 12 % of the volume, 5 % is what flies well", "",
                 "too many: 900 flyers and the room that they turn in take 12 % of the volume; up to 5 % fly well"),
                ("object 1 (rows 0, 0): the air does not take it there: what moves it besides is 37 % of the flow's velocity (rms)", "Other",
                 "the air does not take it to its marks: it is pushed besides, by 37 % of the air's speed; more time between marks helps"),
                ("3 objects, 12 frames: turning that frames cannot show is slowed to MaximumTurn (60 degrees a frame)", "",
                 "turns faster than frames can show are slowed to 60 degrees a frame (3 flyers, 12 frames)"),
                ("1 object, 1 frame: rows, rests or surfaces turn by up to 90 degrees, more than MaximumTurn (60 degrees a frame)", "",
                 "marks, rests or surfaces turn flyers by up to 90 degrees in a frame (1 flyers, 1 frames)"),
                ("object 1 (its 2 marks at frames 20 to 25): the air does not take it there: what moves it besides is 37 % of the flow's "
                 "velocity: give it more time between its marks, or marks that are nearer", "Other",
                 "the air does not take it to its marks: it is pushed besides, by 37 % of the air's speed; more time between marks helps"),
                ("1 object, 12 frames (object 1 at frames 3 to 20): turning that frames cannot show is slowed to 60 degrees a frame; where "
                 "that looks too calm, more frames per second, a wider body or more time between its marks help (what turns faster is "
                 "slowed to MaximumTurn)", "Other",
                 "turns faster than frames can show are slowed to 60 degrees a frame (1 flyers, 12 frames)"),
                ("1 object, 1 frame (object 0 at frame 31): orientations asked for, rests or surfaces turn by up to 90 degrees, more than 60 "
                 "degrees a frame: ask for orientations more frames apart, and for more time before a rest (MaximumTurn)", "Leaf",
                 "marks, rests or surfaces turn flyers by up to 90 degrees in a frame (1 flyers, 1 frames)"),
                ("object 1: the path leaves less than the clearance asked for, 0.05 m: give its marks more room beside what is in the way",
                 "Other", "comes nearer to something than it is wide"),
                ("spacetime: the motion stays as it was, since nothing can be bettered by more than Tolerance: E was 2 and is 2", "",
                 "there was nothing left to better"),
                ("object 1: its mesh lies up to 0.02 m below a surface, as its centre comes too near", "Other",
                 "cuts a surface by up to 0.02 m"),
                ("row 0 target 0 (object 0, frame 25, position): infeasible: the position (0, 0, 1) lies 0.1 m inside obstacle 0, expected "
                 "outside", "Mark", "cannot be met at frame 30: the position (0, 0, 1) lies 0.1 m inside Post, expected outside"),
                ("/tmp/a b/take-001/scene.waft.json: /constraints/0/value: row 0 and object 1 from frame 3 to 9", "Mark",
                 "Mark and Other from frame 8 to 14"),
                (f"scene.waft.json: /shapes/{shape}/mesh: it has 3 segments and (rms) MaximumTurn", "Leaf",
                 "it has 3 flights and the limit of turning"),
                ("obstacle 7 and object 99 of /winds/3: unheard of at frames 1 and 2", "", None)):
            with self.subTest(line):
                log = report(line)
                self.assertEqual(about, log.object)
                if text is not None:
                    self.assertEqual(text, log.text)
                    self.assertNotRegex(log.text, JARGON)

    def test_like_sentences_are_one(self):
        looked = [reporting.Problem(f"too fast: Leaf has 0.4 s for {d} m", "Word", False) for d in range(40)]
        other = reporting.Problem("too fast: Leaf has 0.4 s for 3 m", "Mark", False)
        log = reporting.gathered([*looked, other])
        self.assertEqual(["too fast: Leaf has 0.4 s for 0 m (and 39 more like this)", other.text],
                         [problem.text for problem in log])
        many = [reporting.Problem("hangs on a parent: clear it", f"Leaf {n}") for n in range(50)]
        log = reporting.gathered([*many, other])
        self.assertEqual(["Leaf 0", "Mark"], [problem.object for problem in log])
        self.assertEqual(tuple(f"Leaf {n}" for n in range(1, 50)), log[0].others)

    def test_paths_stay_as_they_are(self):
        scenes.small_scene()
        report = reporting.Reporter(stage.Stage(bpy.context)).report
        for line in ('the font "/home/me/objects/0/shapes/a.ttf" cannot be read', "/tmp/winds/3.vti: no such file"):
            self.assertEqual(("", line), (report(line).object, report(line).text))


class Panel(unittest.TestCase):
    """What is drawn, by a layout that notes it."""

    class Layout:
        def __init__(self, noted):
            self._noted = noted

        def __getattr__(self, name):
            if name in ("label", "operator", "prop", "template_list"):
                def note(*arguments, **values):
                    self._noted.append((name, values.get("text") or next((a for a in arguments if isinstance(a, str) and a), "")))
                    return types.SimpleNamespace(name="", others="", page=0, role="")
                return note
            return lambda *_, **__: type(self)(self._noted)

    def drawn(self, one):
        noted = []
        context = types.SimpleNamespace(scene=bpy.context.scene, window_manager=bpy.context.window_manager, active_object=None,
                                        region=types.SimpleNamespace(width=800),
                                        preferences=types.SimpleNamespace(system=types.SimpleNamespace(ui_scale=1.0)))
        one.draw(types.SimpleNamespace(layout=self.Layout(noted)), context)
        return noted

    def test_result_is_one_line_that_unfolds(self):
        scenes.small_scene()
        shown = bpy.context.window_manager.waft
        shown.is_open, shown.page = False, 0
        flying.found.put("take-001: all is well", [reporting.Problem(f"remark {n}", f"Thing {n}", False) for n in range(7)])
        folded = self.drawn(panel.WAFT_PT_fly)
        self.assertIn(("label", "take-001: all is well"), folded)
        self.assertIn(("operator", "waft.dismiss"), folded)
        self.assertFalse([text for _, text in folded if "remark" in text or text.startswith("Thing")])
        shown.is_open = True
        seen = []
        for page in range(3):
            bpy.ops.waft.turn(page=page)
            opened = self.drawn(panel.WAFT_PT_fly)
            self.assertLess(len(opened) - len(folded), 14)
            seen += [text for kind, text in opened if kind == "operator" and text.startswith("Thing")]
        self.assertEqual([f"Thing {n}" for n in range(7)], seen)
        bpy.ops.waft.dismiss()
        self.assertFalse([text for _, text in self.drawn(panel.WAFT_PT_fly) if "well" in text or "dismiss" in text])
        order = panel.CLASSES.index
        self.assertLess(order(panel.WAFT_PT_takes), order(panel.WAFT_PT_object))

    def test_errors_are_unfolded(self):
        scenes.small_scene()
        bpy.context.scene.objects["Leaf"].parent = bpy.context.scene.objects["Volume"]
        save("errors")
        self.assertFalse(fly())
        self.assertIn(("operator", "Leaf"), self.drawn(panel.WAFT_PT_fly))
        self.assertIn(("label", "Not ready: 1 thing to mend"), self.drawn(panel.WAFT_PT_fly))


class OnDisk(unittest.TestCase):
    def test_only_what_was_written_is_freed(self):
        root = pathlib.Path(tempfile.mkdtemp(dir=FOLDER))
        (root / "take" / "shapes").mkdir(parents=True)
        (root / "outside").mkdir()
        names = ("report.csv", "changed.csv", "shapes/a.vtp", "shapes/link/thesis.txt", "../outside/thesis.txt", "shapes/away.txt")
        take = root / "take"
        (take / "shapes" / "link").symlink_to(root / "outside")
        for name in names[:-1]:
            (take / name).write_text(name, encoding="utf-8")
        (root / "outside" / "thesis.txt").write_text("shapes/link/thesis.txt", encoding="utf-8")
        rows = [flight.row_of(take, name) for name in names[:-1]]
        (take / "changed.csv").write_text("mine", encoding="utf-8")
        (take / "mine.txt").write_text("mine", encoding="utf-8")
        (take / "shapes" / "away.txt").symlink_to(root / "outside" / "thesis.txt")
        rows += [{**rows[3], "name": names[-1]}, {"name": "mine.txt", "size": 4, "digest": ""}, {"name": "/etc/passwd"}, {}, None, 7,
                 {"name": "..", "size": 1, "digest": "sha256:"}]
        self.assertEqual(len("report.csv") + len("shapes/a.vtp"), flight.free(take, rows))
        left = {str(path.relative_to(root)) for path in root.rglob("*") if path.is_file()}
        self.assertEqual({"take/changed.csv", "take/mine.txt", "take/shapes/away.txt", "outside/thesis.txt"}, left)
        self.assertEqual([], flight.manifest_of(take))
        for content in ("", "{", "[]", '{"manifest": 7}', '{"manifest": [7]}'):
            (take / "report.json").write_text(content, encoding="utf-8")
            self.assertEqual([], flight.manifest_of(take))

    def test_versions(self):
        for program, text in ((WAFT, "waft "), ("/bin/true", "this is no waft"), ("/nowhere", "cannot be run: No such file")):
            done = []
            asked = command.Version(program, lambda: done.append(True))
            until(lambda: done)
            self.assertTrue(asked.text.startswith(text), asked.text)
        preferences.version_of("/nowhere")
        until(lambda: preferences.version_of("/nowhere") == "cannot be run: No such file or directory")
        self.assertEqual("Blender.md", preferences.manual_of(WAFT).name)
        self.assertIsNone(preferences.manual_of("/bin/sh"))


class Linked(unittest.TestCase):
    """Objects of other files."""

    def setUp(self):
        scenes.small_scene()
        self.library = save("library") / "library.blend"
        scenes.small_scene()
        bpy.data.objects.remove(bpy.context.scene.objects["Leaf"])

    def linked(self, name):
        with bpy.data.libraries.load(str(self.library), link=True) as (_, brought):
            brought.objects = [name]
        return brought.objects[0]

    def test_a_linked_flyer_is_refused(self):
        leaf = self.linked("Leaf")
        bpy.context.scene.collection.objects.link(leaf)
        bpy.context.scene.objects["Mark"].waft.flyer = leaf
        save("user")
        self.assertFalse(fly())
        self.assertEqual([("Leaf [library.blend]", True)], [(problem.object, problem.is_error) for problem in flying.found])
        bpy.ops.waft.select(name="Leaf [library.blend]")
        self.assertEqual(leaf, bpy.context.view_layer.objects.active)

    def test_doubles_are_told_apart(self):
        """A mark of the file, and one of the same name that is linked."""
        scenes.flyer("Own", scenes.leaf_mesh(), location=(0.0, 0.0, 2.0))
        mark = self.linked("Mark")
        bpy.context.scene.collection.objects.link(mark)
        bpy.context.scene.objects["Mark"].location.x = -0.3
        bpy.context.view_layer.update()
        looked = stage.Stage(bpy.context)
        self.assertIn(("Mark [library.blend]", True), [(problem.object, problem.is_error) for problem in looked.problems])
        rows = {row["_object"]: row["value"] for row in looked.scene["constraints"]}
        self.assertAlmostEqual(-0.3, rows["Mark"][0], 5)

    def test_an_override_flies_and_keeps_its_motion(self):
        leaf = self.linked("Leaf").override_create()
        bpy.context.scene.collection.objects.link(leaf)
        leaf.location.x = 0.1
        mark = bpy.context.scene.objects["Mark"]
        mark.waft.flyer, mark.waft.frame = leaf, 30
        other = scenes.flyer("Other", scenes.leaf_mesh(), location=(0.5, 0.0, 2.0))
        folder = save("override")

        def move(*_):
            if other.animation_data is not None:
                other.delta_location = (0.0, 0.0, 0.2)

        bpy.app.handlers.frame_change_post.append(move)  # as another add-on might
        try:
            self.assertTrue(fly(), list(flying.found))
        finally:
            bpy.app.handlers.frame_change_post.remove(move)
        self.assertEqual(["Other"], [problem.object for problem in flying.found if "something else in the file moves it" in problem.text])
        self.assertIn("take-001: all 1 marks are met", flying.found.title)
        scene = bpy.context.scene
        scene.frame_set(30)
        there = leaf.matrix_world.translation.copy()
        scene.waft.takes.add().name = "take-009"  # of which nothing is left
        bpy.ops.wm.save_mainfile()
        self.library.rename(self.library.with_suffix(".away"))
        bpy.ops.wm.open_mainfile(filepath=bpy.data.filepath)  # without the library nobody knows what is left
        self.assertEqual(2, len(bpy.context.scene.waft.takes))
        self.library.with_suffix(".away").rename(self.library)
        bpy.ops.wm.open_mainfile(filepath=bpy.data.filepath)
        scene = bpy.context.scene
        leaf = scene.objects["Leaf"]
        self.assertEqual(["take-001"], [take.name for take in scene.waft.takes])
        self.assertEqual("take-001 Leaf", leaf.animation_data.action.name)
        self.assertLess((leaf.matrix_world.translation - there).length, 1e-6)
        self.assertGreater(2.0 - there.z, 0.1)
        # Removed, the run's files go, and what somebody put there stays.
        take = next(folder.glob("*-waft/take-001"))
        (take / "result" / "mine.txt").write_text("mine", encoding="utf-8")
        scene.waft.shown = 0
        self.assertEqual({"FINISHED"}, bpy.ops.waft.remove_take())
        self.assertEqual(["result/mine.txt"], [str(path.relative_to(take)) for path in take.rglob("*") if path.is_file()])
        self.assertEqual((0, "XYZ"), (len(leaf.waft.takes), leaf.rotation_mode))
        self.assertIsNone(leaf.animation_data.action)
        self.assertAlmostEqual(0.1, leaf.location.x, 6)


def until(holds, seconds=120.0):
    end = time.monotonic() + seconds
    while not holds():
        if time.monotonic() > end:
            raise AssertionError(f"not within {seconds} s")
        time.sleep(0.02)


def outcome_of(run):
    found = []
    until(lambda: found.append(run.poll()) or found[-1] is not None)
    return found[-1]


class Bodies(unittest.TestCase):
    def test_a_mesh_on_its_axes_keeps_them(self):
        scenes.empty_scene()
        body = bodies.body_of(scenes.flyer("Sheet", scenes.sheet_mesh("Sheet", 0.1)), bpy.context.evaluated_depsgraph_get(), 1.0)
        self.assertTrue(np.array_equal(body.axes, np.eye(3)))

    def test_least_spread_is_z(self):
        scenes.empty_scene()
        body = bodies.body_of(scenes.flyer("Leaf", scenes.leaf_mesh()), bpy.context.evaluated_depsgraph_get(), 2.0)
        self.assertLess(np.abs(body.axes.T @ body.axes - np.eye(3)).max(), 1e-12)
        self.assertAlmostEqual(np.linalg.det(body.axes), 1.0, 12)
        spread = np.ptp(body.points, axis=0)
        self.assertTrue(spread[0] > spread[1] > spread[2])
        self.assertGreater(body.axes[2, 2], 0.0)


if __name__ == "__main__":
    names = sys.argv[sys.argv.index("--") + 3:]
    loader = unittest.defaultTestLoader
    tests = loader.loadTestsFromNames(names, sys.modules[__name__]) if names else loader.loadTestsFromModule(sys.modules[__name__])
    sys.exit(not unittest.TextTestRunner(verbosity=2).run(tests).wasSuccessful())
