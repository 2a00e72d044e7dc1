# SPDX-License-Identifier: BSD-3-Clause
"""Stops of the command, by signal and by time limit, in all that it does: each is seen within a second.

    test_stopping.py WAFT       WAFT: the command of the build or of an installed tree
"""
import contextlib
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
SEEN_WITHIN = 1.0  # s
LOADED = 4.0  # s more, for a machine that does other things as well
STOPPED_EARLY = 4


def scene(frames, objects, **more):
    return {"waft": 1, "time": {"frames": frames}, "shapes": {"leaf": {"builtin": "leaf"}},
            "objects": [{"shape": "leaf", **objects}], **more}


MEDIUM = scene(121, {"positions": [[0.4 * i - 1.0, 0.2 * j, 2.6] for i in range(6) for j in range(3)]},
               constraints=[{"kind": "position", "object": i, "frame": 100, "value": [0.4 * (i // 3) - 0.9, 0.2 * (i % 3) + 0.1, 1.8]}
                            for i in range(18)])
THIMBLE = scene(91, {"count": 20000, "region": {"min": [0, 0, 1], "max": [0.01, 0.01, 1.01]}})
LONG = scene(8000, {"positions": [[-0.6, -0.5, 2.6]]})
MILLION = scene(1000000, {"positions": [[0.4 * i - 1.0, -0.5, 2.6] for i in range(6)]})  # planned for far more than 8 s
ANY_MEMORY = ("--memory-limit", 1e6)  # MB: it is stopped long before it takes that


class Stopping(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def synthesize(self, content, *options):
        path = self.folder / "scene.waft.json"
        path.write_text(json.dumps(content), encoding="utf-8")
        return [WAFT, "synthesize", path, "--output", self.folder / "out", "--preview", *options]

    def database(self, *options):
        return [WAFT, "database", "--output", self.folder / "air.vtm", "--resolution", "8", "--frames", "40", *options]

    def stop_after(self, arguments, seconds, number=signal.SIGTERM):
        """Ends a run by a signal; returns (seconds until it had ended, what it said)."""
        process = subprocess.Popen([*map(str, arguments)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.kill)
        time.sleep(seconds)
        self.assertIsNone(process.poll(), "it ended before it was stopped")
        asked = time.monotonic()
        process.send_signal(number)
        _, said = process.communicate(timeout=120.0)
        took = time.monotonic() - asked
        self.assertEqual(STOPPED_EARLY, process.returncode, said)
        for trace in ("Traceback", "ERR|", "Loguru", "vtk"):
            self.assertNotIn(trace, said)
        return took, said

    def expect_seen(self, took, said):
        self.assertLess(took, SEEN_WITHIN + LOADED, said)
        self.assertEqual(1, len(said.splitlines()), said)
        self.assertRegex(said, "^waft: stopped before ")
        self.assertFalse((self.folder / "out").exists())

    def find_child(self, pid, name):
        """The process of this name that `pid` starts; a shell in front of Python may have others first."""
        deadline = time.monotonic() + 30.0
        while time.monotonic() < deadline:
            for child in pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split():
                with contextlib.suppress(FileNotFoundError):
                    if pathlib.Path(f"/proc/{child}/comm").read_text().strip() == name:
                        return int(child)
            time.sleep(0.02)
        raise self.failureException(f"it started no {name}")

    def test_while_it_starts(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGUSR1):
            for seconds in (0.02, 0.06):
                with self.subTest(number=number, seconds=seconds):
                    self.expect_seen(*self.stop_after(self.synthesize(MEDIUM), seconds, number))

    def test_while_many_objects_are_laid_in_a_thimble(self):
        for seconds in (2.0, 5.0):
            with self.subTest(seconds=seconds):
                self.expect_seen(*self.stop_after(self.synthesize(THIMBLE), seconds))

    def test_while_a_million_frames_are_made(self):
        for seconds in (3.0, 8.0):
            with self.subTest(seconds=seconds):
                self.expect_seen(*self.stop_after(self.synthesize(MILLION, *ANY_MEMORY), seconds))

    def test_by_a_time_limit_in_a_million_frames(self):
        began = time.monotonic()
        command = self.synthesize(MILLION, *ANY_MEMORY, "--time-limit", 1.0)
        done = subprocess.run([*map(str, command)], capture_output=True, text=True, check=False, timeout=120.0)
        start = 10.0  # s that ParaView may take to start, from which the limit does not count
        self.expect_seen(time.monotonic() - began - 1.0 - start, done.stderr)
        self.assertEqual(STOPPED_EARLY, done.returncode)

    def stop_when_planned(self, content):
        """Ends a run by a signal as soon as its plan is kept; returns the seconds until it had ended."""
        out = self.folder / "out"
        process = subprocess.Popen([*map(str, self.synthesize(content))], stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.kill)
        deadline = time.monotonic() + 120.0
        while time.monotonic() < deadline and process.poll() is None and not (out / "checkpoint").is_dir():
            time.sleep(0.05)
        asked = time.monotonic()
        process.send_signal(signal.SIGTERM)
        _, said = process.communicate(timeout=120.0)
        self.assertEqual(STOPPED_EARLY, process.returncode, said)
        self.assertTrue((out / "poses.csv").is_file(), list(out.iterdir()))
        return time.monotonic() - asked

    def test_while_it_optimises_writes_the_best_so_far(self):
        self.stop_when_planned(MEDIUM)

    def test_while_the_air_of_many_frames_is_drawn(self):
        self.assertLess(self.stop_when_planned(LONG), SEEN_WITHIN + LOADED)
        self.assertFalse((self.folder / "out/air.pvd").exists(), "there was no air yet")

    def test_that_has_written_all_changes_nothing(self):
        process = subprocess.Popen([*map(str, self.synthesize(scene(11, {"positions": [[0, 0, 2.6]]})))], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.kill)
        while not (self.folder / "out/report.json").exists():
            self.assertIsNone(process.poll())
            time.sleep(0.01)
        time.sleep(0.05)  # another file or two
        while process.poll() is None:
            process.send_signal(signal.SIGTERM)
            time.sleep(0.02)
        self.assertEqual(0, process.returncode, process.stderr.read())

    def test_by_a_second_interrupt_at_once(self):
        out = self.folder / "out"
        process = subprocess.Popen([*map(str, self.synthesize(LONG))], stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.kill)
        while not (out / "checkpoint").is_dir():
            self.assertIsNone(process.poll())
            time.sleep(0.02)
        process.send_signal(signal.SIGTERM)
        for _ in range(2):
            process.send_signal(signal.SIGINT)
            time.sleep(0.02)
        _, said = process.communicate(timeout=30.0)
        self.assertEqual((-signal.SIGINT, ""), (process.returncode, said))
        self.assertFalse((out / "report.json").exists())

    def test_that_the_system_killed_says_so(self):
        """Of a command that Python carries out, in a process that is watched."""
        process = subprocess.Popen([WAFT, "demo", "--output", self.folder / "demo"], stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.kill)
        os.kill(self.find_child(process.pid, "pvpython"), signal.SIGKILL)
        _, said = process.communicate(timeout=30.0)
        self.assertEqual((-signal.SIGKILL, "waft: ended by SIGKILL, as systems do when memory runs out\n"),
                         (process.returncode, said))

    def test_in_as_many_simulations_as_there_may_be(self):
        # What is whole by then is clustered to the end, which takes the longer the more of it there is.
        took, said = self.stop_after(self.database("--simulations", 1000000), 3.0)
        self.assertLess(took, SEEN_WITHIN + LOADED, said)


if __name__ == "__main__":
    unittest.main()
