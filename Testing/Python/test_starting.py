# SPDX-License-Identifier: BSD-3-Clause
"""`waft new`, `waft check`, `waft synthesize --watch` and `--progress json`, as a user calls them.

    test_starting.py WAFT       WAFT: the command of the build or of an installed tree
"""
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import zipfile

import warm

WAFT = sys.argv.pop(1)

LEAVES = {"waft": 1, "time": {"frames": 61}, "shapes": {"leaf": {"builtin": "leaf"}},
          "objects": [{"shape": "leaf", "positions": [[-1.0, -0.5, 2.6], [-0.9, 0.6, 2.4]]}]}


def position(number, frame, value, **more):
    return {"kind": "position", "object": number, "frame": frame, "value": value, **more}


class StartingTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.warm = warm.Warm(WAFT)
        cls.addClassCleanup(cls.warm.close)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def waft(self, *arguments):
        """By one process that has started, for what takes no longer than that."""
        return self.warm.run(*arguments, cwd=self.folder)

    def waft_itself(self, *arguments):
        return subprocess.run([WAFT, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, check=False)

    def write(self, name="scene.waft.json", **changes):
        (self.folder / name).write_text(json.dumps(LEAVES | changes), encoding="utf-8")

    def check(self, status, *words, **changes):
        self.write(**changes)
        done = self.waft("check", "scene.waft.json")
        self.assertEqual(status, done.returncode, done.stdout + done.stderr)
        for word in words:
            self.assertIn(word, done.stdout + done.stderr)
        return done.stdout

    def test_help_version_and_usage_come_at_once(self):
        for arguments, status in (("--help",), 0), (("--version",), 0), (("synthesize", "--help"), 0), (("fly",), 2), ((), 2), (
                ("synthesize", "x", "--output", "y", "--watch", "--resume"), 2):
            used = []
            for _ in range(3):
                began = time.monotonic()
                self.assertEqual(status, self.waft_itself(*arguments).returncode)
                used.append(time.monotonic() - began)
            self.assertLess(min(used), 1.0, arguments)  # ParaView alone takes more to start; 0.15 s on a quiet machine

    def test_the_addon_is_one_zip_and_replaces_nothing(self):
        done = self.waft_itself("blender-addon", "a.zip")
        self.assertEqual(0, done.returncode, done.stderr)
        with zipfile.ZipFile(self.folder / "a.zip") as content:
            names = content.namelist()
            self.assertIn(b'"name": "Waft"', content.read("waft_addon/__init__.py"))
        self.assertTrue(all(name.startswith("waft_addon/") and name.endswith(".py") for name in names), names)
        written = (self.folder / "a.zip").read_bytes()
        self.assertEqual(0, self.waft("blender-addon", "b.zip").returncode)
        self.assertEqual(written, (self.folder / "b.zip").read_bytes())
        for name, words in (("a.zip", "it is there"), ("a.tar", "ends with .zip"), ("none/a.zip", "a folder that is there")):
            done = self.waft("blender-addon", name)
            self.assertEqual(2, done.returncode, name)
            self.assertIn(words, done.stderr)
        self.assertEqual(written, (self.folder / "a.zip").read_bytes())
        self.assertEqual({"a.zip", "b.zip"}, {path.name for path in self.folder.iterdir()})

    def test_a_new_scene_is_commented_and_flies(self):
        done = self.waft_itself("new", "a.waft.json", "--text", "I", "--shape", "petal", "--count", 2)
        self.assertEqual(0, done.returncode, done.stderr)
        text = (self.folder / "a.waft.json").read_text(encoding="utf-8")
        self.assertGreater(text.count('"_"'), 4)
        again = self.waft("new", "a.waft.json")
        self.assertEqual(2, again.returncode)
        self.assertIn("a.waft.json: it is there", again.stderr)
        self.assertEqual(text, (self.folder / "a.waft.json").read_text(encoding="utf-8"))
        checked = self.waft_itself("check", "a.waft.json")
        self.assertEqual(0, checked.returncode, checked.stdout)
        flown = self.waft_itself("synthesize", "a.waft.json", "--output", "out", "--preview", "--progress", "json")
        self.assertEqual(0, flown.returncode, flown.stderr)
        reported = [json.loads(line) for line in flown.stdout.splitlines()]
        self.assertEqual({"fraction": 1.0, "text": "done"}, reported[-1])
        self.assertGreater(len(reported), 5)
        fractions = [one["fraction"] for one in reported]
        self.assertEqual(sorted(fractions), fractions)

    def test_a_new_scene_takes_words_pictures_curves_and_obstacles(self):
        (self.folder / "curve.csv").write_text("x,y,z\n-1.5,0,3\n0,0.5,2.5\n1.2,-0.4,2\n", encoding="utf-8")
        (self.folder / "wedge.obj").write_text("v 1 1 0\nv 1.3 1 0\nv 1 1.3 0\nv 1 1 0.3\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n",
                                               encoding="utf-8")
        done = self.waft("new", "b.waft.json", "--text", "A", "--text", "B", "--path", "curve.csv", "--obstacle", "wedge.obj",
                         "--count", 5)
        self.assertEqual(0, done.returncode, done.stderr)
        scene = json.loads((self.folder / "b.waft.json").read_text(encoding="utf-8"))
        kinds = [row["kind"] for row in scene["constraints"]]
        self.assertEqual(["path", "keyframe", "keyframe"], kinds)
        self.assertEqual("wedge.obj", scene["obstacles"][0]["file"])
        curve = scene["constraints"][0]["points"]
        self.assertEqual([1.2, -0.4, 2.0], curve[-1])
        steps = [sum((a - b) ** 2 for a, b in zip(p, q)) ** 0.5 for p, q in zip(curve, curve[1:])]
        self.assertLess(max(steps), 0.5 / 30 + 1e-5)
        checked = self.waft("check", "b.waft.json")
        self.assertEqual(0, checked.returncode, checked.stdout + checked.stderr)
        for arguments in (("--path", "none.csv"), ("--image", "none.png"), ("--obstacle", "none.obj"), ("--path", "wedge.obj"),
                          ("--shape", "birch"), ("--count", "0"), ("--text", "")):
            refused = self.waft("new", "c.waft.json", *arguments)
            self.assertEqual(2, refused.returncode, arguments)
            self.assertIn(arguments[1] or "text", refused.stderr)
            self.assertFalse((self.folder / "c.waft.json").exists())

    def test_a_new_scene_has_times(self):
        done = self.waft("new", "d.waft.json", "--text", "HI", "--then", "OH", "--release", "0s..3s", "--arrive", "5s..240", "--order",
                         "left-to-right", "--hold", "1s", "--count", 12)
        self.assertEqual(0, done.returncode, done.stderr)
        scene = json.loads((self.folder / "d.waft.json").read_text(encoding="utf-8"))
        self.assertEqual([{"from": 0, "to": 90}], [entry["release"] for entry in scene["objects"]])
        words = [(row["targets"]["text"], row["frame"], row["order"], row["hold"]) for row in scene["constraints"]]
        self.assertEqual([("HI", {"from": 150, "to": 240}, "left-to-right", 30),
                          ("OH", {"from": 420, "to": 510}, "left-to-right", 30)], words)  # 5 s after the hold
        checked = self.waft("check", "d.waft.json")
        self.assertEqual(0, checked.returncode, checked.stdout + checked.stderr)
        done = self.waft("new", "e.waft.json", "--text", "HI", "--count", 12, "--shape", "down", "--loop")
        self.assertEqual(0, done.returncode, done.stderr)
        self.assertIs(True, json.loads((self.folder / "e.waft.json").read_text(encoding="utf-8"))["time"]["loop"])
        for arguments, word in ((("--loop", "--blow-away", "left"), "expected words or pictures whose bodies stay"),
                                (("--arrive", "8s..4s"), "not reversed"), (("--arrive", "1e9s"), "a time or FIRST..LAST"),
                                (("--hold", "-1"), "a time in seconds"), (("--order", "inward"), "--order: expected a window of arrivals"),
                                (("--release", "9s"), "--release: expected the last one before the first arrival at frame 210"),
                                (("--release", "soon"), "a time or FIRST..LAST")):
            refused = self.waft("new", "c.waft.json", *arguments)
            self.assertEqual(2, refused.returncode, arguments)
            self.assertIn(word, refused.stderr)
            self.assertFalse((self.folder / "c.waft.json").exists())

    def test_check_takes_what_is_fine(self):
        said = self.check(0, "0 of them cannot be met, 0 remarks", constraints=[position(0, 60, [-0.9, -0.4, 1.9], radius=0.1)])
        self.assertEqual(1, said.count("\n"))
        self.assertEqual(["scene.waft.json"], [path.name for path in self.folder.iterdir()])

    def test_check_tells_what_is_hard(self):
        self.check(0, "hard: too fast: row 0 target 0: object 0 has 1 s for", " m to its mark at frame 30, ", " frames) or more",
                   "waft: row N is entry N of `constraints`", constraints=[position(0, 30, [0.6, -0.5, 2.0])])
        self.check(0, "hard: too fast: the loop, to the start of object ", " to its mark at frame 61, ", time={"frames": 61, "loop": True},
                   constraints=[position(0, 57, [0.6, -0.5, 2.0])])
        self.check(0, "hard: no time to fall: row 0", " s to its rest at frame 45; ", " frames) or more",
                   constraints=[{"kind": "rest", "object": 0, "frame": 45, "value": [-1, -0.5, 1]}])
        self.check(0, "hard: too near: 1 pairs of the 2 marks at frame 60",
                   constraints=[position(0, 60, [-0.9, 0.0, 2]), position(1, 60, [-0.9, 0.02, 2])])
        self.check(0, "hard: too narrow: obstacles 0 and 1 are 0.05 m apart",
                   obstacles=[{"kind": "box", "min": [1, -1, 0], "max": [1.2, 0, 2]}, {"kind": "box", "min": [1, 0.05, 0], "max": [1.2, 1, 2]}])
        self.check(0, "hard: too narrow: row 0 target 0 lies 0.02 m from obstacle 0", "move the mark of object 0 at frame 60 away by 0.03 m",
                   obstacles=[{"kind": "box", "min": [-0.5, -1, 0], "max": [-0.3, 0, 2.2]}],
                   constraints=[position(0, 60, [-0.52, -0.4, 2])])
        self.check(0, "hard: too many", domain={"min": [-1.5, -1.5, 0], "max": [1, 1, 3]},
                   shapes={"leaf": {"builtin": "leaf", "size": 1.1}})

    def test_check_names_objects_that_are_asked_to_one_place(self):
        said = self.check(0, "hard: too near: 1 pairs of the 2 marks at frame 60 are nearer than bodies are wide (0.1 m), the nearest 0 m "
                          "(objects 0 and 1, at one place): ", constraints=[position(n, 60, [-0.9, 0.0, 2]) for n in (1, 0)])
        self.assertIn("1 remarks", said)
        self.check(0, "the nearest 0.02 m (objects 0 and 1): ",
                   constraints=[position(0, 60, [-0.9, 0.0, 2]), position(1, 60, [-0.9, 0.02, 2])])
        for others in ({"frame": 59}, {"radius": 0.2}, {"object": 0, "radius": 0.05}):  # another time, room for both, the same object
            self.assertNotIn("too near", self.check(0, constraints=[position(0, 60, [-0.9, 0.0, 2]),
                                                                    {**position(1, 60, [-0.9, 0.02, 2]), **others}]))

    def test_check_measures_two_marks_by_the_bodies_that_come_there(self):
        shapes = {"leaf": {"builtin": "leaf"}, "maple": {"builtin": "maple", "size": 0.5}}
        objects = [{"shape": "leaf", "positions": [[-1.0, -0.5, 2.6], [-0.9, 0.6, 2.4]]}, {"shape": "maple", "position": [0, 0, 2.4]}]
        marks = [position(number, 60, [0.2 * number - 0.9, 0.0, 2]) for number in range(3)]  # small ones have room there
        self.check(0, "too near: 1 pairs of the 3 marks at frame 60", "(0.3 m), the nearest 0.2 m (objects 1 and 2)", shapes=shapes,
                   objects=objects, constraints=marks)

    def test_check_names_the_nearest_few_of_many_that_are_near(self):
        objects = [{"shape": "leaf", "positions": [[-1.0 + 0.2 * (n % 10), -1.0 + 0.2 * (n // 10), 2.6] for n in range(60)]}]
        said = self.check(0, "too near: 1770 pairs of the 60 marks at frame 60", objects=objects,
                          constraints=[position(n, 60, [0, 0, 2]) for n in range(60)])
        self.assertEqual(3, said.count("at one place"))
        marks = [position(n, 50 + n // 2, [-1.0 + 0.2 * (n // 2), 0, 2.2]) for n in range(16)]
        said = self.check(0, "hard: too near: 3 more", "objects 8 and 9", objects=objects, constraints=marks)
        self.assertNotIn("objects 10 and 11", said)

    def test_check_tells_the_first_few_of_what_is_alike(self):
        rows = [position(0, 30 + i, [1.7, -1.7 + 0.4 * (i % 9), 3.5]) for i in range(9)]
        said = self.check(3, "cannot be met: conflict: 3 more", constraints=rows)
        self.assertEqual(5, said.count("cannot be met: row "))
        boxes = [{"kind": "box", "min": [-1.9 + 0.25 * i, -1.9, 0.2], "max": [-1.7 + 0.25 * i, -1.7, 0.4]} for i in range(12)]
        said = self.check(0, "hard: too narrow: 6 more", obstacles=boxes)
        self.assertEqual(5, said.count("0.05 m apart"))
        self.assertIn("11 remarks", said)

    def test_check_finds_near_obstacles_among_many(self):
        boxes = [{"kind": "box", "min": [x, y, z], "max": [x + 0.1, y + 0.1, z + 0.1]}
                 for x in (-1.9, -1.2, -0.5, 0.2, 0.9) for y in (-1.9, -1.2, -0.5, 0.2, 0.9) for z in (0.3, 1.1, 1.9, 2.7, 3.5)]
        boxes.append({"kind": "box", "min": [1.03, 0.9, 3.5], "max": [1.1, 1.0, 3.6]})
        said = self.check(0, "hard: too narrow: obstacles 124 and 125 are 0.03 m apart", obstacles=boxes)
        self.assertEqual(1, said.count("too narrow"))

    def test_a_file_stands_by_the_axis_that_is_up(self):
        corners = [(x, y, z) for x in (-0.2, 0.2) for y in (0.1, 2.0) for z in (-0.2, 0.2)]  # tall along y
        faces = ["1 2 4 3", "5 7 8 6", "1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4"]
        (self.folder / "post.obj").write_text("".join(f"v {x} {y} {z}\n" for x, y, z in corners) +
                                              "".join(f"f {face}\n" for face in faces), encoding="utf-8")
        post = {"kind": "mesh", "file": "post.obj"}
        above, beside = position(0, 60, [0, 0, 1.5]), position(1, 60, [0, 1.5, 0.1])
        self.check(3, "row 0 target 0", "inside obstacle 0", obstacles=[{**post, "up": "y"}], constraints=[above])
        self.check(3, "row 0 target 0", "inside obstacle 0", obstacles=[post | {"up": "z"}], constraints=[beside])
        self.assertIn("inside obstacle 0", self.check(3, "does not say which axis is up: z was taken", obstacles=[post],
                                                      constraints=[above, beside]))
        self.assertNotIn("axis is up", self.check(0, obstacles=[{**post, "up": "y"}]))
        self.check(2, "/obstacles/0/up: expected y or z, found", obstacles=[{**post, "up": "x"}])
        (self.folder / "post.glb").write_bytes(b"glTF")
        self.check(2, "/obstacles/0", obstacles=[{"kind": "mesh", "file": "post.glb", "up": "y"}])

    def test_check_names_what_cannot_be(self):
        said = self.check(3, "row 0 target 0", "inside obstacle 0", "row 1", "outside the volume", "2 of them cannot be met",
                          obstacles=[{"kind": "box", "min": [0.9, -2, 0], "max": [1.0, 2, 4]}],
                          constraints=[position(0, 60, [0.95, 0.6, 2.2]), position(1, 60, [0, 0, 9])])
        self.assertNotIn("hard: too fast", said)
        self.check(2, "/time/frames", time={"frames": 1})
        self.assertEqual(2, self.waft("check", "none.waft.json").returncode)
        reading, writing = os.pipe()
        for command, name, found in (("check", "-", "a pipe"), ("check", f"/dev/fd/{reading}", "a pipe"), ("check", ".", "a folder"),
                                     ("synthesize", "-", "a pipe"), ("info", "-", "a pipe"), ("takes", "-", "a pipe")):
            options = {"synthesize": ("--output", "out"), "takes": ("--seeds", "1:2", "--output", "out")}.get(command, ())
            done = subprocess.run([WAFT, command, name, *options], cwd=self.folder, capture_output=True, text=True, check=False,
                                  pass_fds=(reading,))
            self.assertEqual((2, f"waft: {name}: expected a regular file, found {found}\n"), (done.returncode, done.stderr))
        os.close(reading)
        os.close(writing)
        self.assertEqual(2, self.waft("check", "scene.waft.json", "--database", "none.vtm").returncode)

    def test_watch_flies_again_when_the_scene_is_saved(self):
        short = {"time": {"frames": 13}}
        self.write(objects=LEAVES["objects"] + [{"shape": "leaf", "position": [0, 0, 2]}], **short)
        process = subprocess.Popen([WAFT, "synthesize", "scene.waft.json", "--output", "out", "--watch", "--preview"], cwd=self.folder,
                                   stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        said = []

        def wait():
            for line in process.stderr:
                said.append(line)
                if "waiting for it to be saved" in line:
                    return
            self.fail(said)
        wait()
        first = (self.folder / "out" / "poses.csv").read_text(encoding="utf-8")
        stamp = (self.folder / "out" / "page.watch.js").read_text(encoding="utf-8")
        self.assertIn(stamp.split('"')[1], (self.folder / "out" / "page.html").read_text(encoding="utf-8"))
        self.write(time={"frames": 1})
        wait()
        self.assertTrue(any("/time/frames" in line for line in said), said)
        self.assertEqual(first, (self.folder / "out" / "poses.csv").read_text(encoding="utf-8"))
        self.write(**short)
        wait()
        second = (self.folder / "out" / "poses.csv").read_text(encoding="utf-8")
        self.assertEqual((1 + 3 * 13, 1 + 2 * 13), (first.count("\n"), second.count("\n")))
        self.assertNotEqual(stamp, (self.folder / "out" / "page.watch.js").read_text(encoding="utf-8"))
        process.send_signal(signal.SIGINT)
        self.assertEqual(0, process.wait(60), said)
        process.stderr.close()
        self.assertEqual({"out", "scene.waft.json"}, {path.name for path in self.folder.iterdir()})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
