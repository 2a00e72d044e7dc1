# SPDX-License-Identifier: BSD-3-Clause
"""The store of states, seen from outside, and waft clean: what is listed and given back; nothing of others is touched.

    test_store.py PACKAGE_FOLDER"""
import contextlib
import io
import json
import os
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

sys.path.insert(0, sys.argv.pop(1))
from waft.beneath import Folder  # noqa: E402
from waft.cleaning import clean  # noqa: E402
from waft.failures import BadInput  # noqa: E402
from waft.results import Entry, manifest_rows  # noqa: E402
from waft.store import Store  # noqa: E402

KEYS = ["%064x" % number for number in (10, 11, 12)]


class StoreTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.cache = self.folder / "cache" / "waft"
        patched = mock.patch.dict(os.environ, {"WAFT_CACHE": str(self.cache), "HOME": str(self.folder)})
        patched.start()
        self.addCleanup(patched.stop)

    def keep(self, key, size=100):
        """As a run does."""
        self.cache.mkdir(parents=True, exist_ok=True)
        (self.cache / f"{key}.state").write_bytes(bytes(size))

    def test_links_and_other_files_are_left_alone(self):
        self.keep(KEYS[1])
        other = self.folder / "other"
        other.write_text("mine", encoding="utf-8")
        (self.cache / f"{KEYS[0]}.state").symlink_to(other)
        (self.cache / "notes.txt").write_text("mine", encoding="utf-8")
        self.assertFalse(Store().holds(KEYS[0]))
        self.assertTrue(Store().holds(KEYS[1]))
        self.assertFalse(Store().holds(None))
        self.assertEqual(self.clean(), 100)
        self.assertEqual(sorted(os.listdir(self.cache)), [f"{KEYS[0]}.state", "notes.txt"])

    def test_without_a_store_there_is_nothing(self):
        for values in ({"WAFT_CACHE": str(self.folder / "none")}, {"WAFT_CACHE": "", "HOME": ""}, {"WAFT_CACHE": "/proc/none"}):
            with mock.patch.dict(os.environ, values):
                self.assertEqual(Store().entries(), [])
                self.assertEqual(self.clean(), 0)

    def clean(self, *arguments, **options):
        self.said = io.StringIO()
        with contextlib.redirect_stderr(self.said):
            return clean(*arguments, **options)

    def test_clean_lists_and_then_removes(self):
        self.keep(KEYS[0], 3000000)
        self.assertEqual(self.clean(only_lists=True), 3000000)
        self.assertIn(f"{KEYS[0]}.state: 3.0 MB", self.said.getvalue())
        self.assertIn("3.0 MB to remove", self.said.getvalue())
        self.assertTrue(Store().holds(KEYS[0]))
        self.clean()
        self.assertFalse(Store().holds(KEYS[0]))

    def result(self):
        """A folder as a run leaves it."""
        folder = self.folder / "result"
        names = ["poses.csv", "air.pvd", "air/air_0000.vti", "air/air_0003.vti", "assimilated.state"]
        for name in names:
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_bytes(name.encode() * 1000)
        manifest = manifest_rows({name: Entry.below(Folder(folder), name) for name in names})
        (folder / "report.json").write_text(json.dumps({"manifest": manifest}), encoding="utf-8")
        return folder

    def test_clean_of_a_result_leaves_its_motion_and_what_is_not_its(self):
        folder = self.result()
        (folder / "air" / "mine.txt").write_text("mine", encoding="utf-8")
        (folder / "air" / "air_0003.vti").write_text("changed", encoding="utf-8")
        self.clean(folder, only_lists=True)
        self.assertTrue((folder / "air.pvd").exists())
        self.clean(folder)
        self.assertEqual(sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()),
                         ["air/air_0003.vti", "air/mine.txt", "poses.csv", "report.json"])
        self.assertIn("air: ", self.said.getvalue())

    def test_clean_of_what_is_no_result_is_refused(self):
        (self.folder / "empty").mkdir()
        for wrong, words in ((self.folder / "empty", "expected a folder of results"), (self.folder / "none", "no such folder")):
            with self.assertRaisesRegex(BadInput, words):
                self.clean(wrong)


if __name__ == "__main__":
    unittest.main()
