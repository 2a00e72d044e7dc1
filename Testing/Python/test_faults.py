# SPDX-License-Identifier: BSD-3-Clause
"""Runs that are killed before any of their renames: results are those of one run, whole, and users' files stay.

    LD_PRELOAD=KILL_AT_RENAME pvpython test_faults.py
"""
import ctypes
import json
import os
import pathlib
import shutil
import signal
import sys
import tempfile
import unittest

import waft
from waft.database import settle_database
from waft.results import manifest_of, read_manifest
from waft.resuming import Checkpoint
from waft.writing import result_place, write_results

# Many files of air, and small; few iterations.
COARSE = {"Assimilation": {"Resolution": 16, "LatticeResolution": 8, "Candidates": 1, "Starts": 0}}
SHORT = {"Spacetime": {"NumberOfGasParticles": 600, "LeashIterations": 5, "MaximumNumberOfIterations": 20}}
KILL = ctypes.CDLL(None).WaftKillAtRename
SCENE = {
    "waft": 1,
    "time": {"frames": 9},
    "shapes": {"leaf": {"builtin": "leaf"}},
    "objects": [{"shape": "leaf", "position": [-0.6, -0.5, 2.6]}],
    "constraints": [{"kind": "position", "object": 0, "frame": 8, "value": [-0.5, -0.4, 2.5]}],
}


def in_child(work):
    """Does the work in a child process; its exit status, negative for a signal."""
    child = os.fork()
    if child == 0:
        status = 1
        try:
            work()
            status = 0
        finally:
            os._exit(status)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


def tree(folder):
    """{name: Entry} of all that is there, temporary folders left out."""
    return {name: entry for name, entry in manifest_of(folder).items() if not name.startswith((".waft-", "checkpoint/"))}


class Faults(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)

    def attack(self, prepared, change, put_right, check):
        """Kills change(folder) at each of its renames in turn, each in a folder of its own as prepared; check(folder) holds at
        once, and again after put_right(folder). Returns how often it was killed."""
        work = self.folder / "work"
        at = 0
        while True:
            at += 1
            shutil.rmtree(work, ignore_errors=True)
            shutil.copytree(prepared, work)

            def killed():
                KILL(at)
                change(work)
            status = in_child(killed)
            with self.subTest(rename=at):
                self.assertIn(status, (0, -signal.SIGKILL))
                check(work, is_right=False)
                put_right(work)
                check(work, is_right=True)
                self.assertEqual([], [entry.name for entry in work.iterdir() if entry.name.startswith(".")])
                self.assertEqual("mine", (work / "notes.txt").read_text(encoding="utf-8"))
            if status == 0:
                return at - 1

    def test_results(self):
        scene = self.folder / "scene.waft.json"
        prepared, wanted = self.folder / "old", self.folder / "new"
        scene.write_text(json.dumps(SCENE), encoding="utf-8")
        waft.synthesize(scene, output=prepared, preview=True, threads=1, meshes=True, _settings=COARSE)
        (prepared / "notes.txt").write_text("mine", encoding="utf-8")
        run = waft.synthesize(scene, preview=True, threads=1, seed=7, _settings=COARSE)

        def change(folder):
            with result_place(folder) as place:
                checkpoint = Checkpoint(place, run.key)
                checkpoint.keep_plan(run.pipeline)
                write_results(run, place, checkpoint)
                checkpoint.clear()

        def put_right(folder):
            with result_place(folder):
                pass

        self.assertEqual(0, in_child(lambda: change(wanted)))
        whole = [read_manifest(folder / "report.json") for folder in (prepared, wanted)]

        def check(folder, is_right):
            if not (folder / "report.json").exists():
                self.assertFalse(is_right)
                return
            found = tree(folder)
            found.pop("notes.txt")
            found.pop("report.json")
            manifest = read_manifest(folder / "report.json")
            self.assertTrue(manifest in whole, "the manifest is none of those of the two runs")
            others = set() if is_right else found.keys() - manifest.keys()
            self.assertEqual(set(), {name for name in found.keys() | manifest.keys()
                                     if name not in others and found.get(name) != manifest.get(name)})

        self.assertGreater(self.attack(prepared, change, put_right, check), 50)

    def test_databases(self):
        from waft.database import make_database

        def make(folder, seed):
            make_database(folder / "air.vtm", simulations=2, frames=30, resolution=8, seed=seed, threads=1)

        prepared, wanted = self.folder / "old_air", self.folder / "new_air"
        for seed, folder in enumerate((prepared, wanted)):
            make(folder, seed)
            (folder / "notes.txt").write_text("mine", encoding="utf-8")
        whole = [tree(folder) for folder in (prepared, wanted)]
        self.assertNotEqual(*whole)

        def put_right(folder):
            settle_database(folder / "air.vtm")

        def check(folder, is_right):
            if (folder / "air" / "manifest.json").exists():
                found = {name: entry for name, entry in tree(folder).items() if not name.startswith("air.vtm.kept")}
                self.assertTrue(found in whole, "a mix of two databases")
            else:
                self.assertFalse(is_right)

        self.assertGreater(self.attack(prepared, lambda folder: make(folder, 1), put_right, check), 15)

    def test_a_checkpoint(self):
        """Killed at several writings of the optimiser's state, a run goes on to the same motion."""
        scene = self.folder / "killed.waft.json"
        scene.write_text(json.dumps(SCENE), encoding="utf-8")
        whole = self.folder / "unkilled"

        def run(folder, resume=False):
            return waft.synthesize(scene, output=folder, quality="paper", threads=1, resume=resume, checkpoint_interval=0,
                                   _settings=SHORT)

        KILL(0)
        run(whole)
        renames = KILL(0)
        for fraction in (0.0, 0.1, 0.5):
            out = self.folder / f"killed{fraction}"

            def killed():
                KILL(2 + int(fraction * renames))  # the first is that of the plan
                run(out)
            self.assertEqual(-signal.SIGKILL, in_child(killed))
            self.assertTrue((out / "checkpoint" / "key").exists())
            self.assertEqual(fraction > 0.0, (out / "checkpoint" / "spacetime.state").exists())
            again = run(out, resume=True)
            self.assertEqual([], again.warnings)
            self.assertEqual((whole / "poses.csv").read_bytes(), (out / "poses.csv").read_bytes())
            self.assertFalse((out / "checkpoint").exists())


if __name__ == "__main__":
    done = unittest.main(argv=sys.argv[:1], exit=False, verbosity=2)
    sys.stdout.flush()
    os._exit(0 if done.result.wasSuccessful() else 1)
