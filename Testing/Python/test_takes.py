# SPDX-License-Identifier: BSD-3-Clause
"""`waft takes`: variations of a scene, their table, what goes on after a stop, what is refused.

    test_takes.py WAFT       WAFT: the command of the build or of an installed tree
"""
import contextlib
import csv
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

WAFT = sys.argv.pop(1)

SCENE = {"waft": 1, "time": {"frames": 16}, "shapes": {"leaf": {"builtin": "leaf"}},
         "objects": [{"shape": "leaf", "positions": [[-0.6, -0.5, 2.6], [0.6, 0.4, 2.4]]}],
         "constraints": [{"kind": "position", "object": 0, "frame": 15, "value": [-0.55, -0.45, 2.4], "radius": 0.1}]}


class Takes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.write(SCENE)

    def write(self, scene):
        (self.folder / "scene.waft.json").write_text(json.dumps(scene), encoding="utf-8")

    def command(self, seeds, *options):
        return [WAFT, "takes", "scene.waft.json", "--seeds", seeds, "--output", "out", "--preview", "--threads", "1", *options]

    def takes(self, seeds, *options):
        return subprocess.run(self.command(seeds, *options), cwd=self.folder, capture_output=True, text=True, check=False)

    def rows(self):
        with open(self.folder / "out" / "takes.csv", newline="", encoding="utf-8") as stream:
            return {int(row["seed"]): row for row in csv.DictReader(stream)}

    def places(self, seed):
        return (self.folder / "out" / f"take-{seed:04d}" / "poses.csv").read_bytes()

    def test_takes_differ_are_in_the_table_and_are_flown_once(self):
        with subprocess.Popen(self.command("3:4"), cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as other:
            done = self.takes("3:4", "--jobs", "2")
            said = done.stderr + other.communicate()[1]
        self.assertEqual((0, 0), (done.returncode, other.returncode), said)
        self.assertEqual(2, said.count("there already"), said)  # by the one or the other each is flown once
        rows = self.rows()
        self.assertEqual([3, 4], list(rows))
        for row in rows.values():
            self.assertEqual(("all met", "1", "1"), (row["outcome"], row["met"], row["wishes"]))
            self.assertLess(float(row["exact"] or 0.0), 1e-9)
            self.assertGreater(float(row["private_hand"]), 0.0)
        self.assertNotEqual(rows[3]["private_hand"], rows[4]["private_hand"])
        self.assertEqual(done.stdout, (self.folder / "out" / "takes.txt").read_text(encoding="utf-8"))
        self.assertEqual(3, len(done.stdout.splitlines()))
        before = {path: path.stat().st_mtime_ns for path in (self.folder / "out").rglob("poses.csv")}
        poses = self.places(4)
        again = self.takes("4:5")
        self.assertEqual(0, again.returncode, again.stderr)
        self.assertIn("take-0004: there already", again.stderr)
        self.assertEqual([3, 4, 5], list(self.rows()))
        self.assertTrue(all(path.stat().st_mtime_ns == then for path, then in before.items()))
        # A take is the scene with its seed, whoever flies it.
        self.write({**SCENE, "seed": 4})
        alone = subprocess.run([WAFT, "synthesize", "scene.waft.json", "--output", "alone", "--preview"], cwd=self.folder,
                               capture_output=True, text=True, check=False)
        self.assertEqual(0, alone.returncode, alone.stderr)
        self.assertEqual(poses, (self.folder / "alone" / "poses.csv").read_bytes())

    def test_a_changed_scene_is_flown_anew_and_what_cannot_be_met_is_reported(self):
        # Neither a texture that is missing, a TMPDIR that is no folder nor another python3 keeps a take from being flown.
        self.write({**SCENE, "shapes": {"leaf": {"builtin": "leaf", "texture": "none.png"}}})
        (self.folder / "python3").symlink_to("/bin/false")
        flown = subprocess.run(self.command("7"), cwd=self.folder, capture_output=True, text=True, check=False,
                               env={**os.environ, "TMPDIR": str(self.folder / "scene.waft.json"),
                                    "PATH": f"{self.folder}:{os.environ['PATH']}"})
        self.assertEqual(0, flown.returncode, flown.stderr)
        self.assertEqual("", self.rows()[7]["message"])
        before = self.places(7)
        far = {**SCENE["constraints"][0], "frame": 5, "value": [1.9, 1.9, 0.1]}
        self.write({**SCENE, "constraints": [far]})
        done = self.takes("7")
        self.assertEqual(3, done.returncode, done.stderr)
        self.assertIn("take-0007: not all met, 0 of 1 constraints met", done.stderr)
        self.assertEqual("not all met", self.rows()[7]["outcome"])
        self.assertNotEqual(before, self.places(7))

    def test_what_a_scene_draws_is_read_of_its_takes(self):
        drawn = {"text": "I", "origin": [-0.2, -0.3, 1.8], "u": [1, 0, 0], "v": [0, 1, 0], "width": 0.3}
        self.write({**SCENE, "time": {"frames": 46}, "constraints": [{"kind": "keyframe", "frame": 45, "targets": drawn}]})
        done = self.takes("7")
        self.assertEqual(0, done.returncode, done.stderr)
        row = self.rows()[7]
        self.assertEqual("", row["message"])
        self.assertTrue(0.0 < float(row["legibility"]) <= 1.0, row["legibility"])

    def test_a_stop_is_taken_and_gone_on_from(self):
        self.write({**SCENE, "time": {"frames": 301}})
        child = subprocess.Popen(self.command("1:40"), cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        end = time.monotonic() + 600.0
        while not list(self.folder.glob("out/take-*/.waft-*")) and not list(self.folder.glob("out/take-*/checkpoint")):
            self.assertLess(time.monotonic(), end)
            self.assertIsNone(child.poll())
            time.sleep(0.05)
        child.send_signal(signal.SIGTERM)
        self.assertEqual(4, child.wait(timeout=600), child.stderr.read())
        child.stderr.close()
        self.assertLess(len(list(self.folder.glob("out/take-*/report.json"))), 40)

    def test_a_take_that_the_system_killed_has_its_row(self):
        self.write({**SCENE, "time": {"frames": 3001}})
        with subprocess.Popen(self.command("1"), cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as flown:
            while not list(self.folder.glob("out/take-0001/checkpoint")):
                self.assertIsNone(flown.poll())
                time.sleep(0.02)
            for line in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
                with contextlib.suppress(OSError):
                    words = line.read_bytes().split(b"\0")
                    if b"synthesize" in words and str(self.folder.resolve() / "out" / "take-0001").encode() in words:
                        os.kill(int(line.parent.name), signal.SIGKILL)
            said = flown.communicate()[1]
        self.assertEqual(1, flown.returncode, said)
        self.assertEqual("failed", self.rows()[1]["outcome"])
        self.assertIn("ended by SIGKILL", self.rows()[1]["message"])

    def test_files_of_others_and_malformed_scenes_are_refused(self):
        out = self.folder / "out"
        out.mkdir()
        for name in ("takes.csv", "takes.txt", "takes.json"):
            (out / name).write_text("mine", encoding="utf-8")
            done = self.takes("1:3")
            self.assertEqual(2, done.returncode, done.stderr)
            self.assertIn(name, done.stderr)
            self.assertEqual("mine", (out / name).read_text(encoding="utf-8"))
            self.assertEqual([name], [path.name for path in out.iterdir()])
            (out / name).unlink()
        (out / "take-0001").mkdir()
        (out / "take-0001" / "poses.csv").write_text("mine", encoding="utf-8")
        done = self.takes("1:3")
        self.assertEqual(2, done.returncode, done.stderr)
        self.assertIn("poses.csv", done.stderr)
        self.assertEqual(["take-0001"], [path.name for path in out.iterdir()])  # the others are not tried
        self.write({**SCENE, "frames": 3})
        self.assertEqual(2, self.takes("1").returncode)
        self.write(SCENE)
        for seeds in ("", "x", "4:3", "-1:2", "1:2:3", "0:100000", "1.5", "2147483648"):
            done = subprocess.run([WAFT, "takes", "scene.waft.json", f"--seeds={seeds}", "--output", "none"], cwd=self.folder,
                                  capture_output=True, text=True, check=False)
            self.assertEqual(2, done.returncode, seeds)
            self.assertIn("--seeds", done.stderr)
        self.assertFalse((self.folder / "none").exists())


if __name__ == "__main__":
    unittest.main()
