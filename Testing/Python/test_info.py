# SPDX-License-Identifier: BSD-3-Clause
"""`waft info`: what it tells of folders and scenes, in words and as JSON, and that it changes nothing.

    PYTHONPATH=PACKAGE python3 test_info.py SOURCE
"""
import contextlib
import fcntl
import io
import json
import os
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

SOURCE = pathlib.Path(sys.argv.pop(1)).resolve()

from waft import cli  # noqa: E402
from waft.beneath import Folder  # noqa: E402
from waft.results import Entry, manifest_rows  # noqa: E402
from waft.run.request import TOLD  # noqa: E402
from waft.run.resuming import PLAN  # noqa: E402
from waft.scene import _schema  # noqa: E402

KEY = "ab" * 32
ANSWERS = json.loads((SOURCE / "Documentation" / "command.schema.json").read_text(encoding="utf-8"))
NAMES = ("poses.csv", "planned.vtp", "air.pvd", "air/air_0000.vti", "air/air_0003.vti")
REPORT = {
    "version": "0.1.0", "scene": "word.waft.json", "title": "A word", "seed": 7, "key": KEY, "quality": "air",
    "stages": {"planner": {"seconds": 1.5, "processorSeconds": 1.25, "peakMemoryMB": 100.0}},
    "defaults": {"threads": {"value": 2, "from": "waft.toml"}}, "time": {"frames": 60, "framesPerSecond": 30.0},
    "energy": {}, "settled": {"objects": 0, "largestShift": 0.0}, "stoppedEarly": False, "without": [], "warnings": ["beware"],
    "objects": [{"objectId": 0}, {"objectId": 1}],
    "constraints": {"met": 1, "infeasible": 0, "conflict": 0, "unreachable": 1, "unmet": [
        {"Row": "1", "Target": "0", "ObjectId": "4", "Frame": "30", "Kind": "position", "Residual": "0.2", "Status": "unreachable",
         "Message": "too far"}]},
}


def tree(folder):
    return {str(path.relative_to(folder)): (path.stat().st_mtime_ns, path.read_bytes()) for path in folder.rglob("*") if path.is_file()}


class Info(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.out = self.folder / "out"
        patched = mock.patch.dict(os.environ, {"WAFT_CACHE": str(self.folder / "cache")})
        patched.start()
        self.addCleanup(patched.stop)

    def put(self, names, folder=None):
        """Files with something in them; the rows of their manifest."""
        folder = folder or self.out
        for name in names:
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_bytes(name.encode() * 100)
        return manifest_rows({name: Entry.below(Folder(folder), name) for name in names})

    def result(self, **changed):
        self.out.mkdir(exist_ok=True)
        report = {**REPORT, "manifest": self.put(NAMES), **changed}
        (self.out / "report.json").write_text(json.dumps(report), encoding="utf-8")

    def checkpoint(self, *states):
        folder = self.out / "checkpoint"
        manifest = self.put([*PLAN, "report.csv"], folder)
        (folder / "key").write_text(json.dumps({"key": KEY, "objects": [], "manifest": manifest}), encoding="utf-8")
        for state in states:
            (folder / state).write_bytes(b"state")

    def ask(self, place, *options, status=0):
        """stdout and stderr of the command."""
        out, errors = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
            self.assertEqual(status, cli.main(["info", str(place), *options]), errors.getvalue())
        return out.getvalue(), errors.getvalue()

    def document(self, place, status=0):
        said, errors = self.ask(place, "--json", status=status)
        self.assertEqual(status == 0, errors == "", errors)
        document = json.loads(said)
        with mock.patch.object(_schema, "schema", lambda: ANSWERS):
            self.assertIsNone(_schema.fault(document, ANSWERS, ""))
            self.assertIsNotNone(_schema.fault({**document, "more": 1}, ANSWERS, ""), "the schema is asked")
        self.assertEqual(("info", status), (document["command"], document["status"]))
        return document

    def test_a_result(self):
        self.result()
        (self.out / "notes.txt").write_text("mine", encoding="utf-8")
        before = tree(self.out)
        held = self.document(self.out)["result"]
        self.assertEqual(("A word", 7, "air", 2), tuple(held[name] for name in ("title", "seed", "quality", "objects")))
        self.assertEqual({"frames": 60, "framesPerSecond": 30.0}, held["time"])
        self.assertEqual([{"row": 1, "target": 0, "objectId": 4, "frame": 30, "kind": "position", "status": "unreachable",
                           "message": "too far"}], held["constraints"]["unmet"])
        self.assertTrue(held["finished"] and held["whole"] and not held["atWork"])
        files = {file["name"]: file for file in held["files"]}
        self.assertEqual({"poses.csv", "planned.vtp", "air.pvd", "air/", "report.json", "notes.txt"}, set(files))
        self.assertEqual((2, 3200, "synthesize"), tuple(files["air/"][name] for name in ("files", "bytes", "command")))
        self.assertIsNone(files["notes.txt"]["command"])
        self.assertEqual(sum(path.stat().st_size for path in self.out.rglob("*") if path.is_file()), held["bytes"])
        said, _ = self.ask(self.out)
        for part in (f"{self.out}: A word (word.waft.json), quality air, seed 7, by Waft 0.1.0\n",
                     "2 objects, 60 frames at 30 a second (2 s)",
                     "1 of 2 constraints met, 1 unreachable", "row 1 target 0 (object 4, frame 30, position): unreachable: too far",
                     "planner 1.5 s", "threads 2, by waft.toml", "warning: beware", "notes.txt 0.00 (not Waft's)", "in 2 files",
                     "--edit-of flies anew"):
            self.assertIn(part, said)
        self.assertEqual(before, tree(self.out))

    def test_what_was_cleaned_changed_or_is_missing(self):
        self.result(manifest=self.put(NAMES))
        (self.out / "air/air_0003.vti").unlink()
        self.assertTrue(self.document(self.out)["result"]["whole"], "the motion does without")
        (self.out / "poses.csv").write_text("mine now", encoding="utf-8")
        (self.out / "planned.vtp").unlink()
        held = self.document(self.out)["result"]
        self.assertFalse(held["whole"])
        self.assertEqual({"air/": "cleaned", "poses.csv": "changed", "planned.vtp": "missing", "air.pvd": "whole", "report.json": "whole"},
                         {file["name"]: file["state"] for file in held["files"]})
        said, _ = self.ask(self.out)
        self.assertIn("poses.csv: changed since synthesize wrote it", said)
        self.assertIn("planned.vtp: missing since synthesize wrote it", said)

    def test_other_commands_files(self):
        self.result()
        (self.out / "page.json").write_text(json.dumps({"manifest": self.put(["page.html"])}), encoding="utf-8")
        (self.out / "pictures.json").write_text("{}", encoding="utf-8")  # a user's
        commands = {file["name"]: file["command"] for file in self.document(self.out)["result"]["files"]}
        self.assertEqual(("page", "page", None), tuple(commands[name] for name in ("page.html", "page.json", "pictures.json")))

    def test_what_can_be_gone_on_with(self):
        self.result()
        goes_on = self.document(self.out)["result"]["goesOn"]
        self.assertEqual({"possible": False, "stages": [], "why": "nothing was stopped"}, goes_on["resume"])
        self.assertEqual({"possible": False, "from": None}, goes_on["edit"])
        (self.folder / "cache").mkdir(exist_ok=True)
        state = self.folder / "cache" / f"{KEY}.state"
        state.write_bytes(b"air")
        os.utime(state, (1000, 1000))
        self.assertEqual("store", self.document(self.out)["result"]["goesOn"]["edit"]["from"])
        self.assertEqual(1000, state.stat().st_mtime, "a look is no use of it")
        (self.out / "assimilated.state").write_bytes(b"air")
        self.assertEqual("assimilated.state", self.document(self.out)["result"]["goesOn"]["edit"]["from"])

        self.checkpoint("assimilation.state")
        resume = self.document(self.out)["result"]["goesOn"]["resume"]
        self.assertEqual({"possible": True, "stages": ["planner", "assimilation"], "why": ""}, resume)
        self.assertIn("--resume goes on, with what is there of planner, assimilation", self.ask(self.out)[0])
        (self.out / "checkpoint" / "planned.vtp").write_bytes(b"torn")
        resume = self.document(self.out)["result"]["goesOn"]["resume"]
        self.assertFalse(resume["possible"])
        self.assertIn("checkpoint/planned.vtp is damaged", resume["why"])

    def test_a_run_that_was_killed_before_there_were_results(self):
        self.checkpoint()
        held = self.document(self.out)["result"]
        self.assertEqual((False, False), (held["finished"], held["whole"]))
        self.assertNotIn("scene", held)
        self.assertEqual(["planner"], held["goesOn"]["resume"]["stages"])
        self.assertIn("no results yet: a run was stopped before", self.ask(self.out)[0])
        lock = self.enterContext(open(self.out / ".waft-lock", "wb"))
        fcntl.flock(lock, fcntl.LOCK_EX)  # as a run at work does
        self.assertTrue(self.document(self.out)["result"]["atWork"])
        self.assertIn("a run is at work there", self.ask(self.out)[0])

    def test_an_older_report_has_less(self):
        self.result()
        report = {name: REPORT[name] for name in ("version", "scene", "seed")}
        (self.out / "report.json").write_text(json.dumps(report), encoding="utf-8")
        held = self.document(self.out)["result"]
        self.assertEqual((None, None, 0), (held["time"], held["objects"], held["constraints"]["met"]))
        self.assertIn("quality unknown", self.ask(self.out)[0])

    def test_what_is_neither(self):
        (self.folder / "empty").mkdir()
        (self.folder / "junk.waft.json").write_text("junk", encoding="utf-8")
        os.mkfifo(self.folder / "pipe.waft.json")
        for place, part in (("none", "no such folder of results, and no such scene file"), ("empty", "expected a folder of results with"),
                            ("junk.waft.json", "expected JSON"), ("pipe.waft.json", "found a pipe")):
            with self.subTest(place):
                document = self.document(self.folder / place, status=2)
                self.assertIn(part, document["error"])
                self.assertIn(part, self.ask(self.folder / place, status=2)[1])
        for wrong in ({"version": 1}, {"time": 5}, {"time": {"frames": 1, "framesPerSecond": 0}}, {"defaults": {"threads": 3}},
                      {"warnings": "x"}, {"constraints": {"met": 1, "unmet": [{"Row": "x"}]}}, {"constraints": {"unmet": [5]}},
                      {"manifest": [{"name": "../x"}]},
                      {"stages": {"planner": {"seconds": "1"}}}, {"objects": 3}, {"without": [1]}, {"stopped": []}, {"title": 7}):
            with self.subTest(wrong):
                self.result(**wrong)
                document = self.document(self.out, status=2)
                self.assertIn("report.json", document["error"])

    def test_links_and_pipes_in_a_folder_are_looked_at_and_not_followed(self):
        self.result()
        (self.out / "far").symlink_to("/etc")
        os.mkfifo(self.out / "pipe")
        held = self.document(self.out)["result"]
        self.assertTrue(held["whole"])
        self.assertLessEqual({"far", "pipe"}, {file["name"] for file in held["files"]})
        (self.out / "poses.csv").unlink()
        (self.out / "poses.csv").symlink_to("/etc/passwd")
        self.assertFalse(self.document(self.out)["result"]["whole"])

    def test_scenes(self):
        for scene in sorted((SOURCE / "Data" / "Scenes").glob("*.waft.json")):
            held = self.document(scene)["scene"]
            content = json.loads(scene.read_text(encoding="utf-8"))
            self.assertEqual(content.get("title", ""), held["title"])
            self.assertEqual(len(content.get("constraints", ())), sum(held["constraints"].values()))
            self.assertEqual(held["objects"], sum(held["shapes"].values()))
            self.assertTrue(all(file["found"] for file in held["files"]), scene)
        self.assertIn("feather-barred.png", json.dumps(self.document(SOURCE / "Data/Scenes/feather-waypoints.waft.json")["scene"]["files"]))
        bare = self.folder / "bare.waft.json"
        bare.write_text('{"waft": 1, "shapes": {"l": {"mesh": "gone.obj"}}, "objects": [{"shape": "l", "position": [0, 0, 1]}]}',
                        encoding="utf-8")
        held = self.document(bare)["scene"]
        self.assertEqual({"min": [-2, -2, 0], "max": [2, 2, 4]}, held["volume"])
        self.assertEqual((300, 30, 1), (held["time"]["frames"], held["time"]["framesPerSecond"], held["seed"]))
        self.assertEqual([{"name": "gone.obj", "found": False}], held["files"])
        self.assertIn("gone.obj: no such file", self.ask(bare)[0])

    def test_the_schema_is_the_pages(self):
        page = (SOURCE / "Documentation" / "Command.md").read_text(encoding="utf-8")
        named = set()
        waiting = [ANSWERS]
        while waiting:
            one = waiting.pop()
            if isinstance(one, dict):
                if isinstance(one.get("properties"), dict):
                    named |= set(one["properties"])
                waiting += one.values()
            elif isinstance(one, list):
                waiting += one
        in_report = {"seconds", "processorSeconds", "threadSeconds", "peakMemoryMB", "before", "after", "largestShift", "in", "motion", "leftOut"}
        self.assertGreater(len(named), 50)
        self.assertEqual([], [name for name in sorted(named - in_report) if f"`{name}`" not in page])
        own = [name for name, told in TOLD["own"].items() if any(said["name"] == "json" for said in told["options"])]
        self.assertEqual({*cli.command.ANSWERING, *own}, set(ANSWERS["definitions"]) - {"result", "scene", "error"})


if __name__ == "__main__":
    unittest.main()
