# SPDX-License-Identifier: BSD-3-Clause
"""The command as a person runs it: exit status, messages, files that are whole or untouched.

    test_command.py WAFT       WAFT: the command of the build or of an installed tree

What is refused is asked of one process that has started (warm.py); runs are processes of their own.
"""
import hashlib
import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import time
import unittest
from xml.etree import ElementTree

import motion_checks
import warm

WAFT = sys.argv.pop(1)

# Small enough for a test, and every stage runs: two leaves to a mark each, the one rests on the ground.
SCENE = {
    "waft": 1,
    "title": "Two leaves",
    "time": {"frames": 91},
    "shapes": {"leaf": {"builtin": "leaf"}},
    "objects": [{"shape": "leaf", "positions": [[-0.6, -0.5, 2.6], [0.6, 0.4, 2.8]]}],
    "constraints": [
        {"kind": "position", "object": 0, "frame": 90, "value": [0.3, -0.2, 1.6]},
        {"kind": "rest", "object": 1, "frame": 80, "value": [0.2, 0.3, 1.0]},
    ],
}


def run(*arguments, **options):
    return subprocess.run([WAFT, *map(str, arguments)], capture_output=True, text=True, check=False, **options)


def gltf_json(path):
    """The JSON chunk of a .glb file."""
    content = path.read_bytes()
    magic, _, _, length, kind = struct.unpack("<4sIII4s", content[:20])
    assert (magic, kind) == (b"glTF", b"JSON")
    return json.loads(content[20:20 + length])


def tree(folder):
    """{name: bytes} of all files below a folder."""
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


class Command(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.warm = warm.Warm(WAFT)
        cls.addClassCleanup(cls.warm.close)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def scene(self, change=None, name="scene.waft.json"):
        content = json.loads(json.dumps(SCENE))
        if change:
            change(content)
        path = self.folder / name
        path.write_text(json.dumps(content), encoding="utf-8")
        return path

    def refused(self, scene, *parts, status=2, options=()):
        """Exit status, message and untouched old results of a run that must be refused."""
        out = self.folder / "out"
        out.mkdir(exist_ok=True)
        (out / "poses.csv").write_text("old", encoding="utf-8")
        digest = "sha256:" + hashlib.sha256(b"old").hexdigest()
        (out / "report.json").write_text(json.dumps(
            {"manifest": [{"name": "poses.csv", "size": 3, "digest": digest}]}), encoding="utf-8")
        before = tree(out)
        done = self.warm.run("synthesize", scene, "--output", out, *options)
        self.assertEqual(status, done.returncode, done.stderr)
        for part in parts:
            self.assertIn(part, done.stderr)
        self.assertEqual(before, tree(out))

    def test_missing_scene(self):
        scene = self.folder / "none.waft.json"
        self.refused(scene, "none.waft.json", "no such")
        cold = run("synthesize", scene, "--output", self.folder / "out")  # all of the command, as the process that has started says it
        started = self.warm.run("synthesize", scene, "--output", self.folder / "out")
        self.assertEqual((started.returncode, started.stdout, started.stderr), (cold.returncode, cold.stdout, cold.stderr))

    def test_broken_json(self):
        path = self.folder / "broken.waft.json"
        path.write_text('{"waft": 1,\n "objects": [}', encoding="utf-8")
        self.refused(path, "broken.waft.json", "line 2")

    def test_numbers_that_are_none(self):
        for number, parts in (("NaN", ("line 1", "column")), ("1e999", ("line 1", "column", "finite", "1e999")),
                              ('"nan"', ("/constraints/0/value/2", "finite"))):
            path = self.scene()
            path.write_text(path.read_text(encoding="utf-8").replace("1.6", number), encoding="utf-8")
            with self.subTest(number=number):
                self.refused(path, "scene.waft.json", *parts)

    def test_no_objects(self):
        self.refused(self.scene(lambda s: s.update(objects=[], constraints=[])), "scene.waft.json", "/objects",
                     "at least one")

    def test_unknown_field(self):
        self.refused(self.scene(lambda s: s["objects"][0].update(colour=1)), "/objects/0", "colour")

    def test_unknown_object(self):
        self.refused(self.scene(lambda s: s["constraints"][0].update(object=7)), "/constraints/0/object", "7")

    def test_frame_out_of_range(self):
        self.refused(self.scene(lambda s: s["constraints"][0].update(frame=91)), "/constraints/0/frame", "91")

    def test_missing_database(self):
        self.refused(self.scene(), "none.vtm", options=("--database", self.folder / "none.vtm"))

    def test_empty_database(self):
        path = self.folder / "empty.vtm"
        path.write_text('<?xml version="1.0"?><VTKFile type="vtkMultiBlockDataSet" version="1.0">'
                        "<vtkMultiBlockDataSet/></VTKFile>", encoding="utf-8")
        self.refused(self.scene(), "empty.vtm", "Segments", options=("--database", path))

    def test_what_is_no_database(self):
        for name, text, part in (("junk.vtm", "junk", "no XML"), ("nothing.vtm", "", "no XML"),
                                 ("x.vtp", '<VTKFile type="PolyData"><PolyData/></VTKFile>', "found PolyData"),
                                 ("lost.vtm", '<VTKFile type="vtkMultiBlockDataSet"><vtkMultiBlockDataSet>'
                                  '<DataSet index="0" name="Segments" file="lost/lost_0.vtp"/>'
                                  "</vtkMultiBlockDataSet></VTKFile>", "lost_0.vtp")):
            path = self.folder / name
            path.write_text(text, encoding="utf-8")
            with self.subTest(name=name):
                self.refused(self.scene(), name, part, options=("--database", path))

    def test_output_that_is_a_file_is_refused_before_anything_is_computed(self):
        path = self.folder / "taken"
        path.write_text("old", encoding="utf-8")
        for out in (path, path / "below"):
            done = self.warm.run("synthesize", self.scene(), "--output", out)
            self.assertEqual(2, done.returncode, done.stderr)
            self.assertIn("taken: expected a folder", done.stderr)
        self.assertEqual("old", path.read_text(encoding="utf-8"))

    def test_open_obstacle(self):
        (self.folder / "open.obj").write_text("v 0 0 1\nv 1 0 1\nv 0 1 1\nf 1 2 3\n", encoding="utf-8")
        self.refused(self.scene(lambda s: s.update(obstacles=[{"kind": "mesh", "file": "open.obj"}])),
                     "closed")

    def test_files_of_the_user_stay(self):
        """A project whose own mesh is where a run puts its shapes, and results that were changed."""
        (self.folder / "shapes").mkdir()
        (self.folder / "shapes" / "my.obj").write_text("v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nf 1 2 3\n", encoding="utf-8")
        scene = self.scene(lambda s: s["shapes"].update(leaf={"mesh": "shapes/my.obj"}))
        before = tree(self.folder)
        for options in ((), ("--resume",), ("--preview",)):
            done = self.warm.run("synthesize", scene, "--output", self.folder, *options)
            self.assertEqual(2, done.returncode, done.stderr)
            self.assertIn("shapes/my.obj: no run of waft wrote it", done.stderr)
        done = self.warm.run("database", "--output", self.folder / "shapes.vtm", "--simulations", 1, "--resolution", 8, "--frames", 30)
        self.assertEqual(2, done.returncode, done.stderr)
        self.assertIn("shapes/my.obj: no run of waft wrote it", done.stderr)
        self.assertEqual(before, tree(self.folder))
        self.assertEqual({"scene.waft.json", "shapes"}, {entry.name for entry in self.folder.iterdir()})

    def test_two_runs_into_one_folder(self):
        out = self.folder / "out"
        arguments = [WAFT, "synthesize", str(self.scene()), "--output", str(out), "--preview"]
        first = subprocess.Popen(arguments, stderr=subprocess.PIPE)
        try:
            while first.poll() is None and not (out / "checkpoint").exists():
                time.sleep(0.01)
            second = self.warm.run("synthesize", self.scene(), "--output", out)
            self.assertEqual(2, second.returncode, second.stderr)
            self.assertIn("another run of waft is at work", second.stderr)
        finally:
            first.kill()
            first.communicate()

    def test_unknown_command_and_option(self):
        self.assertEqual(2, run("fly").returncode)
        for option, value, part in (("--seed", "x", "whole number"), ("--seed", "-1", "from 0"),
                                    ("--threads", "0", "from 1 to 1024"), ("--threads", "1" + 18 * "0", "from 1"), ("--time-limit", "nan", "positive"),
                                    ("--memory-limit", "0", "above 0")):
            done = self.warm.run("synthesize", self.scene(), "--output", self.folder / "o", option, value)
            self.assertEqual(2, done.returncode)
            self.assertRegex(done.stderr, f"{option}: expected .*{part}.*, found '{value}'")

    def test_a_memory_limit_that_is_too_low_is_named(self):
        self.refused(self.scene(), "MemoryLimit", "at least", options=("--memory-limit", 1))

    def test_a_flight_in_full_and_its_files(self):
        def change(scene):
            scene["time"]["frames"] = 64  # bodies are flown again by what drives them from frame 30 on for a second
            scene["objects"][0]["positions"][1] = [0.6, 0.4, 1.2]
            scene["constraints"] = [
                {"kind": "position", "object": 0, "frame": 63, "value": [-0.3, -0.4, 1.9]},
                {"kind": "rest", "object": 1, "frame": 57, "value": [0.5, 0.4, 0.3]},
                {"kind": "keyframe", "frame": 25, "targets": {"points": [[0.57, 0.39, 0.85], [-0.5, -0.46, 2.3]]}}]
            (self.folder / "torn.png").write_text("torn", encoding="utf-8")
            scene["shapes"]["leaf"].update(texture="torn.png", color=[0.1, 0.6, 0.2])
        scene = self.scene(change)
        out = self.folder / "out"
        done = run("synthesize", scene, "--output", out, "--threads", 2, "--meshes", "--particles")
        self.assertEqual(0, done.returncode, done.stderr)
        self.assertIn("waft: warning: shape 'leaf'", done.stderr)
        meshes = ElementTree.parse(out / "meshes.pvd").findall(".//DataSet")
        self.assertEqual(64, len(meshes))
        self.assertTrue(all((out / mesh.get("file")).is_file() for mesh in meshes))
        self.assertAlmostEqual(2.1, float(meshes[-1].get("timestep")), places=9)
        particles = ElementTree.parse(out / "particles.pvd").findall(".//DataSet")
        self.assertEqual(64, len(particles))
        self.assertIn(b'"Residual"', (out / particles[32].get("file")).read_bytes())
        dynamics = json.loads((out / "report.json").read_text(encoding="utf-8"))["dynamics"]
        self.assertEqual({"replayError", "gasReplayError", "gasHiddenHand", "repairedFraction", "largestRepair"}, set(dynamics))
        self.assertLess(dynamics.pop("replayError"), 1.0)  # of two bodies that must hasten to their marks
        self.assertLess(max(dynamics.values()), 0.5, dynamics)
        figures = motion_checks.measure(out, scene)
        self.assertEqual([], motion_checks.violations(figures))
        self.assertEqual(("initial", "final"), (figures["first_stage"], figures["last_stage"]))
        wanted = {"planned.vtp", "optimized.vtp", "poses.vtp", "poses.csv", "vortices.vtp", "wind.pvd",
                  "convergence.csv", "constraints.csv", "animation.glb", "report.json"}
        self.assertLessEqual(wanted, {entry.name for entry in out.iterdir()})
        # The results have all that is drawn, pictures included, wherever they go.
        (self.folder / "torn.png").unlink()
        moved = out.rename(self.folder / "elsewhere")
        drawn = run("render", moved, "--frames", "0:0:1", "--size", "64x48", "--views", "side", cwd="/")
        self.assertEqual(0, drawn.returncode, drawn.stderr)
        self.assertIn(str(moved / "shapes" / "picture_0.png"), drawn.stderr)  # as it is torn
        out = moved.rename(out)
        report = json.loads((out / "report.json").read_text(encoding="utf-8"))
        for name, effort in {**report["stages"], "writing": report["writing"]}.items():
            self.assertTrue(effort["seconds"] > 0.0 and effort["processorSeconds"] >= 0.99 * effort["threadSeconds"] > 0.0, name)
        warnings = [warning for warning in report["warnings"] if "torn.png" in warning]
        self.assertEqual(1, len(warnings), report["warnings"])
        self.assertIn("torn.png is neither PNG nor JPEG", warnings[0])
        # The texture is none, so the leaf has its own colour.
        gltf = gltf_json(out / "animation.glb")
        self.assertEqual(["leaf-0", "leaf-1"], [node["name"] for node in gltf["nodes"]])
        factor = gltf["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"]
        for expected, found in zip([0.010023, 0.318547, 0.033105, 1.0], factor):  # of 0.1, 0.6, 0.2, as light
            self.assertAlmostEqual(expected, found, places=5)
        self.assertTrue(gltf["materials"][0]["doubleSided"])
        self.assertEqual(30, gltf["asset"]["extras"]["framesPerSecond"])
        # The measures see a target that is missed by a micrometre.
        lines = (out / "poses.csv").read_text(encoding="utf-8").splitlines()
        place = next(i for i, line in enumerate(lines) if line.startswith("1,25,"))
        cells = lines[place].split(",")
        lines[place] = ",".join([*cells[:3], repr(float(cells[3]) + 1e-6), *cells[4:]])
        (out / "poses.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
        self.assertTrue(any("exact_residual" in text
                            for text in motion_checks.violations(motion_checks.measure(out, scene))))

    def test_a_row_that_cannot_be_met_is_named_and_the_others_are_met(self):
        def inside(scene):
            scene["obstacles"] = [{"kind": "sphere", "center": [0.9, -0.9, 1.5], "radius": 0.3}]
            scene["constraints"].append({"kind": "position", "object": 0, "frame": 45, "value": [0.9, -0.9, 1.5]})
            # 2.6 m in a third of a second
            scene["constraints"].append({"kind": "position", "object": 1, "frame": 10, "value": [-1.4, -1.2, 1.9]})
        out = self.folder / "out"
        scene = self.scene(inside)
        done = run("synthesize", scene, "--output", out, "--preview")
        self.assertEqual(3, done.returncode, done.stderr)
        self.assertIn("row 2", done.stderr)
        self.assertIn("infeasible", done.stderr)
        self.assertRegex(done.stderr, "row 3.*unreachable.*top speed")
        self.assertFalse((out / "meshes.pvd").exists())
        report = (out / "constraints.csv").read_text(encoding="utf-8").splitlines()
        self.assertEqual(5, len(report))
        self.assertEqual(2, sum(",met," in line for line in report))
        tracks = motion_checks.read_poses(out / "poses.csv")
        self.assertLessEqual(motion_checks.distance(tracks[0][90].x, SCENE["constraints"][0]["value"]), 4e-9)
        steps = [motion_checks.distance(a.x, b.x) * 30.0 for a, b in zip(tracks[1], tracks[1][1:])]
        self.assertLess(max(steps), 4.0)  # nobody is thrown at a mark that is too far


if __name__ == "__main__":
    unittest.main(verbosity=2)
