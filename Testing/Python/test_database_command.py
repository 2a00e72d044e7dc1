# SPDX-License-Identifier: BSD-3-Clause
"""`waft database` as a person runs it: the same bytes whatever the threads, stops, going on, coverage.

    test_database_command.py WAFT       WAFT: the command of the build or of an installed tree
"""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

WAFT = sys.argv.pop(1)


def run(*arguments):
    return subprocess.run([WAFT, *map(str, arguments)], capture_output=True, text=True, check=False)


class DatabaseCommand(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def database_bytes(self, path):
        """Everything that the database and its coverage are made of, by name within their folder."""
        stem = path.with_suffix("")
        files = [path, path.with_suffix(".coverage.csv"), *sorted(stem.iterdir())]
        return {entry.relative_to(path.parent).name: entry.read_bytes() for entry in files}

    def database(self, path, *options, resolution=16):
        return run("database", "--output", path, "--frames", 40, "--resolution", resolution, *options)

    def test_has_the_same_bytes_on_one_and_two_threads(self):
        made = []
        for threads in (1, 2):
            path = self.folder / str(threads) / "air.vtm"
            done = self.database(path, "--simulations", 3, "--seed", 5, "--threads", threads)
            self.assertEqual(0, done.returncode, done.stderr)
            made.append(self.database_bytes(path))
            self.assertEqual(["air", "air.coverage.csv", "air.vtm"], sorted(e.name for e in path.parent.iterdir()))
        self.assertEqual(made[0].keys(), made[1].keys())
        for name in made[0]:
            self.assertEqual(made[0][name], made[1][name], name)
        header, *rows = made[0]["air.coverage.csv"].decode().splitlines()
        self.assertEqual("Simulations,NewSegments,NewShare", header)
        self.assertEqual(["1", "2"], [row.split(",")[0] for row in rows])

    def test_that_was_interrupted_is_whole_and_goes_on(self):
        path = self.folder / "air.vtm"
        options = ("--simulations", 40, "--threads", 1)
        arguments = [WAFT, "database", "--output", path, "--frames", 40, "--resolution", 16, *options]
        process = subprocess.Popen([*map(str, arguments)], stderr=subprocess.PIPE, text=True)
        kept = self.folder / "air.vtm.kept"
        deadline = time.monotonic() + 120.0
        while time.monotonic() < deadline and len(list(kept.glob("simulation*"))) < 2:
            time.sleep(0.02)
        os.kill(process.pid, signal.SIGINT)
        message = process.communicate()[1]
        self.assertEqual(4, process.returncode, message)
        self.assertIn("--resume", message)
        whole = len((self.folder / "air.coverage.csv").read_text(encoding="utf-8").splitlines())
        self.assertGreaterEqual(whole, 2)
        self.assertLess(whole, 40)
        interrupted = self.database_bytes(path)

        # The same as one made of as many.
        other = self.folder / "other" / "air.vtm"
        done = self.database(other, "--simulations", whole)
        self.assertEqual(0, done.returncode, done.stderr)
        self.assertEqual(self.database_bytes(other), interrupted)

        # Gone on with: the first ones are not simulated again, and nothing is left over.
        done = self.database(path, "--simulations", whole + 1, "--resume")
        self.assertEqual(0, done.returncode, done.stderr)
        done = self.database(other, "--simulations", whole + 1)
        self.assertEqual(0, done.returncode, done.stderr)
        self.assertEqual(self.database_bytes(other), self.database_bytes(path))
        self.assertFalse(kept.exists())

    def test_stops_when_it_is_covered(self):
        path = self.folder / "air.vtm"
        done = self.database(path, "--simulations", 9, "--until-covered", 0.999, resolution=32)
        self.assertEqual(0, done.returncode, done.stderr)
        self.assertEqual(2, len(path.with_suffix(".coverage.csv").read_text(encoding="utf-8").splitlines()))

    def test_that_was_stopped_too_early_is_not_there(self):
        path = self.folder / "air.vtm"
        done = run("database", "--output", path, "--resolution", 64, "--time-limit", 0.1)
        self.assertEqual(4, done.returncode, done.stderr)
        self.assertEqual([], list(self.folder.iterdir()))

    def test_usage(self):
        self.assertEqual(2, self.database(self.folder / "air.vtp").returncode)
        for options in (("--until-covered", 1.5), ("--simulations", 0), ("--time-limit", -1)):
            self.assertEqual(2, self.database(self.folder / "air.vtm", *options).returncode)
        self.assertEqual([], list(self.folder.iterdir()))


if __name__ == "__main__":
    unittest.main(verbosity=2)
