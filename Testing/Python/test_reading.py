# SPDX-License-Identifier: BSD-3-Clause
"""What is read is a regular file of a bounded size: nothing else is opened, waited for or read without an end.

    python3 test_reading.py WAFT        WAFT: the command
"""
import os
import pathlib
import socket
import subprocess
import sys
import tempfile
import unittest

WAFT = sys.argv.pop(1)
sys.path.insert(0, str(pathlib.Path(WAFT).resolve().parents[1] / "lib/python3/dist-packages"))
from waft import reading  # noqa: E402
from waft.failures import BadInput  # noqa: E402
from waft.scene import Scene  # noqa: E402


def make_kinds(folder):
    """{what is found: path} of what is no file."""
    os.mkfifo(folder / "pipe")
    (folder / "folder").mkdir()
    for name, target in (("endless", "/dev/zero"), ("nothing", "/dev/null"), ("lost", "nowhere"), ("circle", "circle"),
                         ("linked", "pipe")):
        (folder / name).symlink_to(target)
    with socket.socket(socket.AF_UNIX) as end:
        end.bind(str(folder / "socket"))
    return {"a pipe": folder / "pipe", "a folder": folder / "folder", "a device": folder / "endless",
            "device": folder / "nothing",
            "No such file": folder / "lost", "Too many levels": folder / "circle", "pipe": folder / "linked",
            "No such device": folder / "socket", "File name too long": folder / ("x" * 300), "null": folder / "a\0b"}


class Reading(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def refused(self, read, path, *parts):
        with self.assertRaises(BadInput) as caught:
            read(path)
        for part in parts:
            self.assertIn(part, str(caught.exception))

    def test_what_is_no_file_is_refused(self):
        for found, path in make_kinds(self.folder).items():
            for read in (reading.read_bytes, reading.read_text, reading.read_json, reading.read_rows, reading.open_stream,
                         Scene.load):
                with self.subTest(found, read=read.__name__):
                    self.refused(read, path, path.name[:5] if "\0" not in path.name else "a", found, "expected")

    def test_what_is_larger_than_its_bound_is_refused(self):
        path = self.folder / "a"
        path.write_bytes(b"1234")
        self.assertEqual(b"1234", reading.read_bytes(path, 4))
        self.refused(lambda path: reading.read_bytes(path, 3), path, "at most 3 bytes", "4")
        with open(path, "wb") as stream:
            stream.truncate(1 << 40)  # takes no room on the disk
        self.refused(reading.read_bytes, path, "at most")
        self.refused(Scene.load, path, "at most")
        self.refused(lambda path: reading.read_bytes(path, 3), "/proc/self/status", "at most 3 bytes")  # whose size is told as 0

    def test_texts_are_utf_8(self):
        path = self.folder / "a"
        path.write_bytes(b"\xef\xbb\xbf{\"a\": [1]}")
        self.assertEqual({"a": [1]}, reading.read_json(path))
        for content in (b"\xff\xfe\x00", b"\x00\x00", b"{", b"[" * 100000, b"", b"1" * 5000):
            path.write_bytes(content)
            self.refused(reading.read_json, path, str(path), "UTF-8")

    def test_rows_are_by_their_names(self):
        path = self.folder / "a"
        path.write_bytes(b"a,b\r\n1,\"x\r\ny\"\r\n")
        self.assertEqual([{"a": "1", "b": "x\r\ny"}], reading.read_rows(path))

    def test_a_collection_has_times_and_names(self):
        text = '<VTKFile><Collection><DataSet timestep="{}" file="b"/><DataSet timestep="0.5" file="a"/></Collection></VTKFile>'
        self.assertEqual([(0.5, "a"), (1.0, "b")], reading.steps_of(text.format("1"), "x.pvd"))
        for wrong in (text.format("x"), text.format("nan"), text.format("inf"), text.replace('file="b"', ""),
                      text.replace('file="b"', 'file=""'),
                      text[:50], "", text.replace('timestep="{}"', "")):
            self.refused(lambda text: reading.steps_of(text, "x.pvd"), wrong, "x.pvd: not a collection")

    def test_commands_refuse_at_once(self):
        kinds = make_kinds(self.folder)
        Scene().save(self.folder / "s.waft.json")
        for name in ("a pipe", "a device", "device", "pipe"):
            for command in (["new", "n.waft.json", "--path", kinds[name]],
                            ["takes", kinds[name], "--seeds", "1", "--output", "t"]):
                with self.subTest(name, command=command[0]):
                    done = subprocess.run([WAFT, *command], cwd=self.folder, capture_output=True, text=True, timeout=60)
                    found = done.stderr.strip().rpartition("found ")[2]
                    self.assertEqual((2, "a " + name.removeprefix("a ")), (done.returncode, found))
        self.assertFalse((self.folder / "n.waft.json").exists() or (self.folder / "t").exists())


if __name__ == "__main__":
    unittest.main()
