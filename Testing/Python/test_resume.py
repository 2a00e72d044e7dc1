# SPDX-License-Identifier: BSD-3-Clause
"""A run of the command that is killed or interrupted goes on to the files of one that was not.

    pvpython test_resume.py        each run is a process of its own
"""
import json
import multiprocessing
import os
import pathlib
import shutil
import signal
import sys
import tempfile
import unittest

import warm

from waft.results import manifest_of, manifest_rows
from waft.resuming import PLAN
from waft.synthesis import synthesize
from waft.watching import NOTHING_COMPUTED, Clock, keep_stops

SHORT = {"Spacetime": {"NumberOfGasParticles": 216, "LeashIterations": 5, "MaximumNumberOfIterations": 20}}
SCENE = {
    "waft": 1,
    "seed": 5,
    "time": {"frames": 41},
    "shapes": {"leaf": {"builtin": "leaf"}},
    "objects": [{"shape": "leaf", "positions": [[-0.6, -0.5, 2.6], [0.6, 0.4, 2.8]]}],
    "constraints": [{"kind": "position", "object": 0, "frame": 40, "value": [-0.3, -0.3, 2.1]}],
}


class Flight(multiprocessing.get_context("fork").Process):
    """A run in a process of its own, a fork of this one, which has ParaView loaded.

    signal_at: (share of the optimiser's work, number); when it has done that share the run sends itself this signal.
    """

    def __init__(self, scene, out, resume=False, signal_at=None):
        super().__init__()
        self.options = {"output": out, "resume": resume}
        self.scene = scene
        self.signal_at = signal_at
        self.log = out.with_name(f"{out.name}.log")
        self.start()

    def run(self):
        log = os.open(self.log, os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
        os.dup2(log, 1)
        os.dup2(log, 2)
        keep_stops()
        if self.signal_at is not None:
            Clock.show = self.follow
        run = synthesize(self.scene, quality="paper", threads=1, _settings=SHORT, **self.options)
        os.write(1, "\n".join(run.warnings).encode())  # past the stream of pvpython, which keeps a last line without an end
        sys.exit(run.status)

    def follow(self, name, fraction, _text):
        if self.signal_at is not None and name == "spacetime" and fraction >= self.signal_at[0]:
            _, number = self.signal_at
            self.signal_at = None
            os.kill(os.getpid(), number)

    def end(self):
        """(its exit status, what it said)"""
        self.join()
        return self.exitcode, self.log.read_text(encoding="utf-8")


class Resume(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.scene = cls.folder / "scene.waft.json"
        cls.scene.write_text(json.dumps(SCENE), encoding="utf-8")
        warm.load()
        cls.whole = cls.folder / "whole"
        done = Flight(cls.scene, cls.whole).end()
        if done != (0, ""):
            raise RuntimeError(f"the whole run: {done}")

    def finish(self, out, **options):
        return Flight(self.scene, out, **options).end()

    def kill_at(self, share, out):
        """A run that is killed when the optimiser has done this share of its work."""
        child = Flight(self.scene, out, signal_at=(share, signal.SIGKILL))
        self.assertEqual(-signal.SIGKILL, child.end()[0], "it ended before it was killed")
        self.assertTrue((out / "checkpoint" / "key").exists())
        self.assertFalse((out / "poses.csv").exists())

    def expect_same(self, out):
        whole = self.whole
        names = ["poses.csv", "planned.vtp", "optimized.vtp", "poses.vtp", "vortices.vtp", "constraints.vtp",
                 "constraints.csv", "animation.glb"]
        for name in names:
            self.assertEqual((whole / name).read_bytes(), (out / name).read_bytes(), name)
        energies = [[line.split(",")[:7] for line in (folder / "convergence.csv").read_text().splitlines()]
                    for folder in (whole, out)]
        self.assertEqual(*energies)
        planned = [[{**row, "seconds": 0} for row in json.loads((folder / "report.json").read_text())["objects"]] for folder in (whole, out)]
        self.assertEqual(2, len(planned[0]))
        self.assertEqual(*planned)
        self.assertFalse((out / "checkpoint").exists())
        self.assertEqual([], [entry.name for entry in out.iterdir() if entry.name.startswith(".")])

    def test_killed_after_the_plan_and_late(self):
        for name, share in (("planned", 0.0), ("late", 0.8)):
            with self.subTest(moment=name):
                out = self.folder / name
                self.kill_at(share, out)
                status, text = self.finish(out, resume=True)
                self.assertEqual((0, ""), (status, text))
                self.assertFalse("planner" in json.loads((out / "report.json").read_text())["stages"])
                self.expect_same(out)

    def test_interrupted(self):
        """Ctrl-C writes the best so far and where to go on from."""
        energy = [float(line.split(",")[3]) for line in (self.whole / "convergence.csv").read_text().splitlines()[1:]]
        out = self.folder / "interrupted"
        child = Flight(self.scene, out, signal_at=(0.7, signal.SIGINT))
        self.assertEqual((4, ""), child.end())
        self.assertTrue((out / "poses.csv").exists())
        report = json.loads((out / "report.json").read_text())
        self.assertTrue(report["stoppedEarly"])
        self.assertLess(report["energy"]["after"], energy[0])
        self.assertEqual((0, ""), self.finish(out, resume=True))
        self.expect_same(out)

    def test_a_damaged_plan_is_said_and_planned_anew(self):
        def cut(name):
            return lambda folder: os.truncate(folder / name, 900)

        def spoil_key(folder):
            (folder / "key").write_bytes(b"\xff\xfe\x00")

        for name, damage in (("constraints.vtp", cut("constraints.vtp")), ("key", spoil_key),
                             ("vortices.vtp", lambda folder: (folder / "vortices.vtp").unlink())):
            with self.subTest(name):
                out = self.folder / f"damaged_{name}"
                self.kill_at(0.0, out)
                damage(out / "checkpoint")
                status, text = self.finish(out, resume=True)
                self.assertEqual(0, status, text)
                self.assertRegex(text, f"checkpoint/{name} is damaged.*: done from the start")
                self.expect_same(out)

    def test_a_plan_that_is_as_its_digests_say_is_looked_at(self):
        """Somebody else may have written both."""
        killed = self.folder / "somebody"
        self.kill_at(0.0, killed)
        whole = json.loads((killed / "checkpoint" / "key").read_text(encoding="utf-8"))
        row = whole["report"][0]
        lost = {name: value for name, value in row.items() if name != "Status"}
        for number, (changed, words) in enumerate((
                ({"objects": 5}, "key: objects: expected an entry"), ({"objects": [{"objectId": 1e19}]}, "key: objects: expected an entry"),
                ({"key": [1]}, "key is damaged"), ({"report": [lost]}, "key: .*Status"), ({"report": [{**row, "Row": "x"}]}, "key: .*Row"),
                ({"report": [row, lost]}, "key: report: expected rows"), ("<VTKFile/>", "planned.vtp: "))):
            with self.subTest(words):
                out = self.folder / f"somebody{number}"
                shutil.copytree(killed, out)
                if isinstance(changed, str):
                    (out / "checkpoint" / "planned.vtp").write_text(changed, encoding="utf-8")
                    manifest = manifest_rows(manifest_of(out / "checkpoint"))
                    changed = {"manifest": [entry for entry in manifest if entry["name"] in PLAN]}
                (out / "checkpoint" / "key").write_text(json.dumps({**whole, **changed}), encoding="utf-8")
                status, text = self.finish(out, resume=True)
                self.assertEqual(0, status, text)
                self.assertRegex(text, f"checkpoint/.*{words}.*: done from the start")

    def test_a_stop_while_a_clock_is_set_up_is_seen(self):
        def be_stopped():
            keep_stops()
            clock = Clock(quiet=True)
            os.kill(os.getpid(), signal.SIGTERM)  # it goes to the handler of before
            with clock:
                os._exit(0 if clock.words == NOTHING_COMPUTED and clock.should_stop() else 1)

        process = multiprocessing.get_context("fork").Process(target=be_stopped)
        process.start()
        process.join()
        self.assertEqual(0, process.exitcode)

    def test_nothing_to_go_on_from_is_said(self):
        out = self.folder / "out"
        self.kill_at(0.0, out)
        changed = self.folder / "changed.waft.json"
        changed.write_text(json.dumps(dict(SCENE, seed=6)), encoding="utf-8")
        status, text = Flight(changed, out, resume=True).end()
        self.assertEqual(0, status)
        self.assertIn("no stopped run of this scene", text)
        self.assertIn("planner", json.loads((out / "report.json").read_text())["stages"])


if __name__ == "__main__":
    done = unittest.main(argv=sys.argv[:1], exit=False, verbosity=2)
    sys.exit(0 if done.result.wasSuccessful() else 1)
