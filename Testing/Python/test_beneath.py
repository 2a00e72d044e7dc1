# SPDX-License-Identifier: BSD-3-Clause
"""What is reached below a folder of somebody else: what lies in it, and nothing that a name or a link in it leads to.

    python3 test_beneath.py WAFT        WAFT: the command
"""
import os
import pathlib
import socket
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

WAFT = sys.argv.pop(1)
sys.path.insert(0, str(pathlib.Path(WAFT).resolve().parents[1] / "lib/python3/dist-packages"))
from waft import beneath, renaming  # noqa: E402
from waft.beneath import Folder, parts_of  # noqa: E402
from waft.failures import BadInput  # noqa: E402

# Names that lead out of it, or nowhere.
OUT = ("", "/", "/etc/passwd", "//a", ".", "..", "../mine/a", "in/../../mine/a", "a\0b", "x" * 256, "a/" * 70 + "b", None, 7,
       b"a", ["a"])


class Below(unittest.TestCase):
    IN_ONE_CALL = True  # as newer systems open what is below a folder

    def setUp(self):
        if not self.IN_ONE_CALL:
            self.enterContext(mock.patch.object(beneath, "_OPENAT2", 9999))
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        whole = pathlib.Path(folder.name)
        self.path, self.mine = whole / "r", whole / "mine"
        for place in (self.path / "in" / "deep", self.mine / "sub"):
            place.mkdir(parents=True)
            (place / "a").write_text(place.name, encoding="utf-8")
        (self.path / "a").write_text("r", encoding="utf-8")
        (self.mine / "a").write_text("mine", encoding="utf-8")
        for place in (self.path, self.path / "in", self.path / "in" / "deep"):
            (place / "link").symlink_to(self.mine)
            (place / "file").symlink_to(self.mine / "a")
            (place / "lost").symlink_to(self.mine / "new")
            (place / "around").symlink_to("..")
            os.mkfifo(place / "pipe")
            with socket.socket(socket.AF_UNIX) as end:
                os.chdir(place)
                end.bind("socket")
            (place / "device").symlink_to("/dev/zero")
        self.folder = Folder(self.path)
        self.before = self.picture()

    def picture(self):
        return {path: (os.lstat(path).st_ino, os.lstat(path).st_size) for path in self.mine.rglob("*")}

    def tearDown(self):
        self.assertEqual(self.before, self.picture(), "what is outside was touched")

    def acts(self):
        """{what is done: of a name}, all that there is."""
        folder = self.folder
        return {"about": folder.about, "is_file": folder.is_file, "is_folder": folder.is_folder, "names": folder.names,
                "everything": folder.everything, "stream": folder.stream, "bytes": folder.bytes, "text": folder.text,
                "json": folder.json, "rows": folder.rows, "steps": folder.steps, "check_blocks": folder.check_blocks,
                "file": folder.file, "found": folder.found, "below": folder.below, "own": folder.own,
                "make_folder": folder.make_folder, "remove": folder.remove,
                "move away": lambda name: folder.move(name, folder, "b"), "move to": lambda name: folder.move("a", folder, name),
                "move over": lambda name: folder.move("a", folder, name, replaces=True)}

    def test_names_that_lead_out_are_refused(self):
        for name in OUT:
            for act, do in self.acts().items():
                if name is None and act in ("names", "everything"):
                    continue  # all of it
                with self.subTest(act, name=str(name)[:20]), self.assertRaises(BadInput):
                    do(name)
            with self.subTest(str(name)[:20]), self.assertRaises(BadInput):
                parts_of(name)
        self.assertEqual(("a", "b"), parts_of("./a//b/"))

    def test_links_on_the_way_are_refused_at_each_level(self):
        for place in ("", "in/", "in/deep/"):
            for link in ("link", "around", "file", "pipe", "lost", "device", "socket"):
                for rest in ("a", "new", "sub/a", "in/a"):
                    for act, do in self.acts().items():
                        with self.subTest(act, name=f"{place}{link}/{rest}"), self.assertRaises(BadInput) as caught:
                            do(f"{place}{link}/{rest}")
                        self.assertIn(str(self.path / f"{place}{link}"), str(caught.exception))

    def test_what_is_no_file_is_not_read(self):
        for place in ("", "in/", "in/deep/"):
            for name in ("link", "file", "lost", "around", "pipe", "socket", "device"):
                for act in ("is_file", "stream", "bytes", "text", "json", "rows", "steps", "check_blocks", "file", "found", "own"):
                    with self.subTest(act, name=place + name), self.assertRaises(BadInput) as caught:
                        self.acts()[act](place + name)
                    self.assertIn(str(self.path / f"{place}{name}"), str(caught.exception))
                self.assertFalse(self.folder.is_regular(self.folder.about(place + name)))

    def test_what_is_there_is_reached(self):
        self.assertEqual("r", self.folder.text("a"))
        self.assertEqual("deep", self.folder.text("in/deep/a"))
        self.assertEqual(str(self.path / "in/deep/a"), self.folder.file("in//deep/a"))
        self.assertEqual(["a"], [name for name in self.folder.below("in/deep").names() if len(name) == 1])
        self.assertIsNone(self.folder.found("none/a"))
        self.assertIsNone(self.folder.about("none"))
        self.assertEqual([], self.folder.names("none"))
        with self.assertRaisesRegex(BadInput, "none: No such file"):
            self.folder.text("none")
        with self.assertRaisesRegex(BadInput, "in: expected a text, found a folder"):
            self.folder.text("in")
        found = self.folder.everything()
        self.assertEqual({"a", "in/deep/a"}, {name for name, about in found.items() if self.folder.is_regular(about)})
        self.assertEqual(3 * 7 + 2, len(found))  # links are not followed, and told

    def test_the_folder_itself_may_be_a_link(self):
        (self.path.parent / "to").symlink_to("r")
        self.assertEqual("deep", Folder(self.path.parent / "to").text("in/deep/a"))
        for wrong in ("none", "r/a", "r/pipe", "r/lost"):
            with self.subTest(wrong), self.assertRaises(BadInput):
                Folder(self.path.parent / wrong)

    def test_a_move_replaces_what_it_is_told_to(self):
        for is_known in (True, False):
            with self.subTest(renameat2=is_known), mock.patch.object(renaming, "_NO_REPLACE", 1 if is_known else 1 << 20):
                for name in ("in", "file", "lost", "pipe", "link", "in/deep/a"):
                    for source in ("a", "in"):
                        with self.assertRaises(FileExistsError if source == "a" or not name.startswith("in") else OSError):
                            self.folder.move(source, self.folder, name)
                self.folder.move("a", self.folder, "in/b")
                self.folder.move("in/b", self.folder, "a")
                self.folder.move("in", self.folder, "out")
                self.folder.move("out", self.folder, "in")
        self.folder.move("a", self.folder, "file", replaces=True)
        self.assertEqual("r", self.folder.text("file"))

    def test_removing_follows_nothing(self):
        self.folder.remove("link")
        self.folder.remove("in/file")
        self.folder.remove_all("in")
        self.assertIsNone(self.folder.about("in"))
        self.folder.remove_all("around")
        self.assertIsNotNone(self.folder.about("around"))
        self.folder.make_folder("x/y/z")
        (self.path / "x" / "w").mkdir()
        self.folder.remove_empty("x/y/z")
        self.assertEqual(["w"], self.folder.names("x"))
        self.folder.remove_empty("file/b")
        self.folder.remove_all("none")

    def test_what_is_owned_is_new_or_empty(self):
        for _ in range(2):
            with os.fdopen(self.folder.own("in/lock"), "wb"):
                self.assertEqual("", self.folder.text("in/lock"))
        for name in ("a", "in"):
            with self.assertRaisesRegex(BadInput, f"{name}: .*expected an empty file"):
                self.folder.own(name)

    def test_folders_that_are_very_deep(self):
        place = Folder(self.path)
        for _ in range(1500):
            place.make_folder("d")
            place = place.below("d")
        with self.assertRaises(BadInput):
            self.folder.everything()
        self.folder.remove_all("d")  # as far as the system lets it
        subprocess.run(["rm", "-rf", str(self.path / "d")], check=True)


class BelowByParts(Below):
    IN_ONE_CALL = False


if __name__ == "__main__":
    unittest.main()
