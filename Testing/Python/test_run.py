# SPDX-License-Identifier: BSD-3-Clause
"""waft.synthesize of a waft.Scene, in a thread beside the main one: its progress, its arrays, its pictures, its page in a notebook.

    pvpython run.py test_run.py         without a display: pictures are drawn on a virtual one
"""
import base64
import csv
import html
import inspect
import json
import os
import pathlib
import re
import shutil
import signal
import tempfile
import threading
import time
import unittest
from typing import Optional
from unittest import mock

import numpy as np
import waft
from waft.results import manifest_of
from waft.watching import collect

os.environ.pop("DISPLAY", None)


COARSE = {"Resolution": 16, "LatticeResolution": 12, "Candidates": 2, "Rounds": 1}  # an air for tests of the course


PUBLIC = {"assimilation", "database", "delete", "fit", "folder", "marks", "object_ids", "orientations", "output", "page", "planner", "plot",
          "positions", "present", "quality", "reader", "render", "report", "rotation", "save", "seed", "show", "spacetime", "status", "stopped", "times",
          "to_pandas", "to_pyvista", "warnings"}


def small_scene():
    scene = waft.Scene("Small", comment="three leaves")
    scene.set_time(61)
    scene.add_object("leaf", (0, 0, 2.5), id=5)
    scene.add_objects("petal", positions=[(1, 1, 2.5), (-1, -1, 2.5)])
    scene.add_position(5, 60, (0.2, 0.1, 1.6), radius=0.1)
    scene.add_orientation(5, 30, (1, 0, 0, 0), radius=3.0)
    return scene


class Stop(Exception):
    pass


class RunTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.reported = []
        made = []

        def fly():
            made.append(waft.synthesize(small_scene(), output=cls.folder / "out", quality="preview", threads=1,
                                        on_progress=lambda share, text: cls.reported.append((share, text))))
        thread = threading.Thread(target=fly)
        thread.start()
        thread.join()
        cls.run_, = made

    def test_progress_grows_to_done(self):
        shares = [share for share, _ in self.reported]
        self.assertEqual(sorted(shares), shares)
        self.assertTrue(0.0 <= shares[0] < 0.5)
        self.assertEqual((1.0, "done"), self.reported[-1])
        self.assertTrue(any(text.startswith("assimilation: ") for _, text in self.reported), self.reported)

    def test_arrays_are_what_poses_csv_holds(self):
        run = self.run_
        self.assertEqual(((3, 61, 3), (3, 61, 4), (61,)), (run.positions.shape, run.orientations.shape, run.times.shape))
        with open(self.folder / "out" / "poses.csv", encoding="utf-8", newline="") as stream:
            rows = list(csv.DictReader(stream))
        ids = run.object_ids.tolist()
        self.assertEqual(183, len(rows))
        for row in rows:
            place = ids.index(int(row["object"])), int(row["frame"])
            self.assertEqual([float(row[name]) for name in "xyz"], run.positions[place].tolist())
            self.assertEqual([float(row[name]) for name in ("qw", "qx", "qy", "qz")], run.orientations[place].tolist())
            self.assertEqual(float(row["time"]), run.times[place[1]])

    def test_marks_are_the_rows_of_the_report(self):
        marks = self.run_.marks
        self.assertEqual([(0, 5, 60, "position"), (1, 5, 30, "orientation")],
                         [(mark["row"], mark["object"], mark["frame"], mark["kind"]) for mark in marks])
        self.assertEqual([row["Status"] for row in self.run_.report], marks["status"].tolist())
        reached = np.linalg.norm(self.run_.positions[self.run_.object_ids.tolist().index(5), 60] - (0.2, 0.1, 1.6))
        self.assertLess(reached, 0.1 + 1e-6)

    def test_what_came_of_a_run_stays(self):
        with self.assertRaises(AttributeError):
            self.run_.status = 1

    def test_a_still_shows_the_bodies(self):
        path = self.folder / "still.png"
        first = self.run_.render(path, frame=0, size=(160, 90))
        last = self.run_.render(size=(160, 90))
        self.assertEqual(((90, 160, 3), np.uint8), (first.shape, first.dtype))
        self.assertEqual(b"\x89PNG", path.read_bytes()[:4])
        self.assertTrue(np.any(first != last))
        self.assertNotIn("DISPLAY", os.environ)
        for name, bad in (("frame", 61), ("view", "front"), ("size", (1, 1)), ("path", "still.jpg"),
                          ("style", "noon")):
            with self.assertRaisesRegex(waft.BadInput, f"Result.render: {name}: "):
                self.run_.render(**{name: bad})

    def test_a_notebook_shows_the_page_a_still_and_the_marks(self):
        page = self.run_._repr_html_()
        framed = html.unescape(re.search(r'<iframe sandbox="allow-scripts" srcdoc="([^"]*)"', page)[1])
        self.assertTrue(framed.startswith("<!DOCTYPE html>") and framed.rstrip().endswith("</html>"))
        told = json.loads(re.search(r'id="run">(.*?)</script>', framed, re.S)[1])
        self.assertEqual(("Small", 61, 2), (told["title"], told["frames"], len(told["marks"])))
        still = base64.b64decode(re.search(r'src="data:image/png;base64,([^"]+)"', page)[1])
        self.assertEqual(b"\x89PNG", still[:4])
        self.assertEqual(3, page.count("<tr>"))
        self.assertIn("<td>orientation</td>", page)
        self.assertIn("3 objects, 61 frames", repr(self.run_))

    def test_another_seed_flies_as_another_run_would(self):
        scene, settings = small_scene(), {"Assimilation": COARSE}
        run = waft.synthesize(scene, output=self.folder / "seeds", quality="preview", threads=1, _settings=settings)
        self.addCleanup(run.delete)
        first, report, planner = run.positions, run.report, run.planner
        run.seed = 7
        other = waft.synthesize(scene, quality="preview", threads=1, seed=7, _settings=settings)
        self.addCleanup(other.delete)
        self.assertGreater(np.abs(run.positions - first).max(), 0.5)
        self.assertEqual((7, other.report, other.warnings, None), (run.seed, run.report, run.warnings, run.folder))
        for name in ("positions", "orientations", "times"):
            self.assertEqual(getattr(other, name).tobytes(), getattr(run, name).tobytes())
        self.assertIs(planner, run.planner)
        run.rotation.UpdatePipeline()
        self.assertEqual(other.positions.tobytes(), run.positions.tobytes())
        run.seed = 1
        self.assertEqual((first.tobytes(), report), (run.positions.tobytes(), run.report))
        self.assertFalse((self.folder / "seeds" / "checkpoint").exists())

    def test_stages_begin_with_what_was_flown(self):
        run = waft.synthesize(small_scene(), quality="preview", threads=1, _settings={"Assimilation": COARSE})
        self.addCleanup(run.delete)
        flown = run.positions
        began = time.process_time()
        self.assertGreater(run.output("assimilation", 5).GetNumberOfRows(), 1)
        self.assertEqual(flown.tobytes(), run.positions.tobytes())  # of the rotation stage now
        self.assertLess(time.process_time() - began, 0.5 * run.watches["assimilation"].processor_seconds)
        run.assimilation.WindRounds = 0
        run.rotation.UpdatePipeline()
        self.assertGreater(np.abs(run.positions - flown).max(), 0.0)
        changed = run.positions
        run.save(self.folder / "changed")
        self.assertEqual(changed.tobytes(), waft.load(self.folder / "changed").positions.tobytes())

    def test_stages_that_live_on_write_nothing_of_the_run(self):
        run = waft.synthesize(small_scene(), output=self.folder / "over", quality="preview", threads=1, _settings={"Assimilation": COARSE})
        self.addCleanup(run.delete)
        shutil.rmtree(self.folder / "over")
        poses, warnings = run.rotation.GetClientSideObject().GetOutputDataObject(1), []
        flown = poses.GetMTime()
        run.rotation.UpdatePipeline()
        self.assertEqual(flown, poses.GetMTime(), "nothing has changed")
        collect(run.assimilation.GetClientSideObject(), "WarningEvent", warnings)
        before = run.positions
        run.assimilation.Glide = 0.5
        run.rotation.UpdatePipeline()
        self.assertGreater(np.abs(run.positions - before).max(), 0.0)
        self.assertEqual([], warnings)

    def test_a_seed_that_cannot_be_is_refused_and_changes_nothing(self):
        before = self.run_.positions
        for bad in (-1, 1.5, "7", 2 ** 60):
            with self.assertRaisesRegex(waft.BadInput, "^seed: expected a whole number"):
                self.run_.seed = bad
        first = self.folder / "first"
        run = waft.synthesize(small_scene(), output=first, quality="preview", threads=1, keep=("state",), _settings={"Assimilation": COARSE})
        edited = waft.synthesize(small_scene(), quality="preview", threads=1, edit_of=first, _settings={"Assimilation": COARSE})
        self.addCleanup(run.delete)
        self.addCleanup(edited.delete)
        with self.assertRaisesRegex(waft.BadInput, "^seed: expected a flight in an air of its own, found one in that of .*first, "):
            edited.seed = 7
        self.assertEqual((1, 1, before.tobytes()), (self.run_.seed, edited.seed, self.run_.positions.tobytes()))

    def test_a_seed_whose_flight_fails_leaves_the_one_before(self):
        run = waft.synthesize(small_scene(), quality="preview", threads=1, _settings={"Assimilation": COARSE})
        self.addCleanup(run.delete)
        before = run.positions
        run.planner.Take = 99
        with self.assertRaisesRegex(waft.BadInput, "Take|take"):
            run.seed = 7
        self.assertEqual((1, 1, before.tobytes()), (run.seed, run.planner.Seed, run.positions.tobytes()))
        run.planner.Take = 0
        run.rotation.UpdatePipeline()
        self.assertEqual(before.tobytes(), run.positions.tobytes())

    def test_it_is_saved_as_it_would_have_been_written(self):
        self.run_.render(size=(64, 36))
        self.run_.save(self.folder / "saved")
        written, saved = ({name: entry for name, entry in manifest_of(self.folder / folder).items() if name != "report.json"}
                          for folder in ("out", "saved"))
        self.assertEqual(written, saved)
        reports = [json.loads((self.folder / folder / "report.json").read_text(encoding="utf-8")) for folder in ("out", "saved")]
        for report in reports:
            self.assertGreater(report.pop("writing")["seconds"], 0.0)  # each its own
            report.pop("stages")
            report.pop("manifest")
        self.assertEqual(*reports)
        (self.folder / "saved" / "poses.csv").write_text("mine", encoding="utf-8")
        with self.assertRaisesRegex(waft.BadInput, "poses.csv: it was changed since"):
            self.run_.save(self.folder / "saved")
        self.assertEqual("mine", (self.folder / "saved" / "poses.csv").read_text(encoding="utf-8"))

    def test_nothing_private_is_shown_of_it(self):
        self.assertEqual(PUBLIC, {name for name in dir(self.run_) if not name.startswith("__")})
        self.assertEqual(self.run_.scene_file, self.run_.pipeline.scene_file)  # a name of before still is one
        with self.assertRaises(AttributeError):
            self.run_.positons

    def test_progress_stops_the_run(self):
        run = waft.synthesize(small_scene(), quality="preview", threads=1,
                              on_progress=lambda _, text: not text.startswith("assimilation"))
        self.assertTrue(run.stopped)
        self.assertEqual(4, run.status)
        # What the stages say from here on is for the caller, who may give them another input.
        for stage in (run.planner, run.assimilation):
            self.assertFalse(stage.GetClientSideObject().HasObserver("ErrorEvent"))
        before = run.positions
        run.save(self.folder / "stopped")  # as it is: it does not go on
        self.assertEqual(before.tobytes(), waft.load(self.folder / "stopped").positions.tobytes())
        run.delete()

    def test_a_signal_stops_a_loop_of_runs_once_the_results_are_put_away(self):
        def stopped_by(number, out):
            signals = [number]  # one
            return waft.synthesize(small_scene(), output=out, quality="preview", threads=1, _settings={"Assimilation": COARSE},
                                   on_progress=lambda _, text: [os.kill(os.getpid(), signals.pop())
                                                                for _ in signals[:text.startswith("assimilation")]] or True)
        for number, raised in ((signal.SIGINT, KeyboardInterrupt), (signal.SIGTERM, SystemExit)):
            out = self.folder / f"signal {int(number)}"
            with self.assertRaises(raised) as caught:
                stopped_by(number, out)
            if raised is SystemExit:
                self.assertEqual(143, caught.exception.code)
            self.assertTrue(json.loads((out / "report.json").read_text(encoding="utf-8"))["stoppedEarly"])
        got = []
        before = signal.signal(signal.SIGINT, lambda number, _frame: got.append(number))
        try:
            run = stopped_by(signal.SIGINT, self.folder / "signal mine")
            run.delete()
        finally:
            signal.signal(signal.SIGINT, before or signal.SIG_DFL)
        self.assertEqual((4, [signal.SIGINT]), (run.status, got))

    def stopped_at(self, quality, text):
        """(the run, report.json, the folder) of one that is stopped when its progress first tells a text."""
        began = []

        def goes_on(_, reported):
            began.append(reported)
            return not any(text in one for one in began)
        out = self.folder / f"stopped {quality} {text}"
        run = waft.synthesize(small_scene(), output=out, quality=quality, threads=1, on_progress=goes_on,
                              _settings={"Assimilation": COARSE})
        self.addCleanup(run.delete)
        self.assertEqual(4, run.status)
        self.assertTrue(any(text in one for one in began), began)
        report = json.loads((out / "report.json").read_text(encoding="utf-8"))
        self.assertTrue(report["stoppedEarly"])
        self.assertTrue((out / "poses.csv").is_file())
        return run, report, out

    def test_no_stage_begins_after_a_stop(self):
        for quality, text, stage, motion in (("full", "assimilation: ", "assimilation", "assimilation"),
                                             ("full", "spacetime: ", "spacetime", None),
                                             ("paper", "spacetime: ", "spacetime", None)):
            with self.subTest(quality=quality, text=text):
                run, report, out = self.stopped_at(quality, text)
                self.assertEqual(stage, report["stopped"]["in"])
                # Stopped while it looks at its inputs, the optimiser gives nothing, and the motion is that of the stage before.
                self.assertIn(report["stopped"]["motion"], (motion,) if motion else ("planner", "assimilation", "spacetime"))
                self.assertEqual(report["stopped"]["motion"] == "spacetime", "spacetime" in report["stages"])
                self.assertFalse((out / "air.pvd").exists(), "there was no air, or it waits for who resumes")
                self.assertEqual(run.spacetime is not None, (out / "convergence.csv").read_text().count("\n") > 1)
                self.assertEqual(183, len((out / "poses.csv").read_text().splitlines()) - 1)

    def test_what_progress_raises_comes_out(self):
        def raises(_share, _text):
            raise Stop("enough")
        with self.assertRaisesRegex(Stop, "enough"):
            waft.synthesize(small_scene(), output=self.folder / "none", quality="preview", threads=1, on_progress=raises)
        self.assertFalse((self.folder / "none").exists())
        with self.assertRaisesRegex(waft.BadInput, "on_progress"):
            waft.synthesize(small_scene(), on_progress=3)

    def test_a_malformed_scene_is_named_as_such(self):
        with self.assertRaisesRegex(waft.BadInput, "^scene: /objects"):
            waft.synthesize(waft.Scene("nothing flies"))


class OptionsTest(unittest.TestCase):
    def test_each_is_shown(self):
        parameters = inspect.signature(waft.synthesize).parameters
        self.assertNotIn("_settings", parameters)
        for name in parameters:
            self.assertIn(f"\n    {name}: ", waft.synthesize.__doc__)
        self.assertEqual(Optional[int], parameters["seed"].annotation)

    def test_those_after_the_database_go_by_name(self):
        with self.assertRaises(TypeError):
            waft.synthesize("scene.waft.json", "out", None, 7)
        with self.assertRaisesRegex(TypeError, "synthesize: no option sed; expected scene, output"):
            waft.synthesize("scene.waft.json", sed=7)


class MemoryTest(unittest.TestCase):
    def test_too_little_memory_is_no_fault_of_the_input(self):
        from waft.run.engine import Engine

        for message, fault, kind, status in (("a.json: found too little memory for it", "memory", waft.WaftError, 1),
                                             ("a.csv: could not be written", "disk", waft.WaftError, 1),
                                             ("Planner: expected another", "input", waft.BadInput, 2)):
            engine = Engine.__new__(Engine)
            engine.algorithm = mock.Mock()
            engine.algorithm.GetFlight.return_value = json.dumps({"fault": fault})
            said = mock.patch("waft.run.engine.collect", lambda _, event, texts, message=message: (
                mock.Mock(), texts.append(message) if event == "ErrorEvent" else None))
            with said, self.assertRaises(waft.WaftError) as raised:
                engine._update(mock.Mock())
            self.assertIs(kind, type(raised.exception))
            self.assertEqual((message, status), (str(raised.exception), raised.exception.status))
