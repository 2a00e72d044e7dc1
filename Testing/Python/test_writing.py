# SPDX-License-Identifier: BSD-3-Clause
"""Single files that are written: whole or not at all, nothing of a user's in their stead, nothing left.

    python3 test_writing.py WAFT        WAFT: the command
"""
import io
import json
import os
import pathlib
import resource
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import zipfile
from unittest import mock

WAFT = sys.argv.pop(1)
sys.path.insert(0, str(pathlib.Path(WAFT).resolve().parents[1] / "lib/python3/dist-packages"))
from waft import marks, renaming, temporary  # noqa: E402
from waft.failures import BadInput  # noqa: E402
from waft.files import whole_file, write_text  # noqa: E402
from waft.scene import Scene  # noqa: E402


class InFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.path = self.folder / "a.txt"

    def write(self, text="new", is_own=None, path=None):
        with whole_file(str(path or self.path), is_own) as part:
            write_text(part, text)

    def names(self):
        return sorted(os.listdir(self.folder))

    def make_kinds(self):
        """{name: what reads it, or None} of what may be in the way."""
        (self.folder / "precious").write_text("mine", encoding="utf-8")
        (self.folder / "file").write_text("mine", encoding="utf-8")
        (self.folder / "empty").touch()
        os.mkfifo(self.folder / "pipe")
        (self.folder / "folder").mkdir()
        for name, target in (("link", "precious"), ("lost", "nowhere"), ("device", "/dev/null"), ("endless", "/dev/zero"),
                             ("circle", "circle"),
                             ("linked", "folder")):
            (self.folder / name).symlink_to(target)
        with socket.socket(socket.AF_UNIX) as end:
            end.bind(str(self.folder / "socket"))
        return [name for name in self.names() if name != "precious"]

    def picture(self):
        """All that is there, so that a change is seen."""
        found = {}
        for name in self.names():
            about = os.lstat(self.folder / name)
            found[name] = (about.st_ino, about.st_mode, about.st_mtime_ns, about.st_size)
        return found


class WholeFiles(InFolder):
    def test_it_is_there_when_it_is_whole(self):
        with whole_file(str(self.path)) as part:
            self.assertFalse(self.path.exists())
            self.assertEqual([os.path.basename(part)], self.names())
            write_text(part, "new")
        self.assertEqual(("new", ["a.txt"]), (self.path.read_text(encoding="utf-8"), self.names()))
        mask = os.umask(0)
        os.umask(mask)
        self.assertEqual(0o666 & ~mask, self.path.stat().st_mode & 0o777)

    def test_nothing_is_left_when_it_fails(self):
        self.write("old")
        with self.assertRaises(ZeroDivisionError), whole_file(str(self.path), lambda _: True) as part:
            write_text(part, "half")
            raise ZeroDivisionError
        self.assertEqual(("old", ["a.txt"]), (self.path.read_text(encoding="utf-8"), self.names()))

    def test_nothing_is_replaced_that_may_not_be(self):
        kinds = self.make_kinds()
        before = self.picture()
        for name in kinds:
            for is_own in (None, lambda _: False):
                with self.subTest(name), self.assertRaises(BadInput) as caught:
                    self.write(path=self.folder / name, is_own=is_own)
                self.assertIn(name, str(caught.exception))
        for name in ("link", "lost", "device", "circle", "folder", "linked"):  # whoever says what of them
            with self.subTest(name), self.assertRaises(BadInput):
                self.write(path=self.folder / name, is_own=lambda _: True)
        self.assertEqual(before, self.picture())

    def test_a_file_that_came_meanwhile_stays(self):
        for is_known in (True, False):
            with self.subTest(renameat2=is_known), mock.patch.object(renaming, "_NO_REPLACE", 1 if is_known else 1 << 20):
                with self.assertRaisesRegex(BadInput, "a.txt: it is there, and stays"), whole_file(str(self.path)) as part:
                    write_text(part, "new")
                    self.path.write_text("mine", encoding="utf-8")
                self.assertEqual(("mine", ["a.txt"]), (self.path.read_text(encoding="utf-8"), self.names()))
                self.path.unlink()
                self.write()  # by the other way, too
                self.assertEqual(("new", ["a.txt"]), (self.path.read_text(encoding="utf-8"), self.names()))
                self.path.unlink()

    def test_own_files_are_replaced_and_others_stay(self):
        self.write("old")
        self.write("new", is_own=lambda path: pathlib.Path(path).read_text(encoding="utf-8") == "old")
        with self.assertRaisesRegex(BadInput, "Waft did not write it"):
            self.write("newer", is_own=lambda path: pathlib.Path(path).read_text(encoding="utf-8") == "old")
        self.assertEqual(("new", ["a.txt"]), (self.path.read_text(encoding="utf-8"), self.names()))

    def test_names_of_temporary_files_are_by_chance(self):
        seen = {temporary.temporary_name() for _ in range(50)}
        self.assertEqual(50, len(seen))
        self.assertTrue(all(map(temporary.is_temporary, seen)))
        others = (".waft-cam_take", ".waft-mine", ".waft-nothings", "a.part", ".waft-move")
        self.assertFalse(any(map(temporary.is_temporary, others)))

    def test_a_temporary_name_that_is_taken_is_not_taken_again(self):
        names = [temporary.temporary_name() for _ in range(4)]
        (self.folder / "precious").write_text("mine", encoding="utf-8")
        (self.folder / names[0]).symlink_to("precious")
        os.mkfifo(self.folder / names[1])
        (self.folder / names[2]).mkdir()
        with mock.patch.object(temporary, "temporary_name", side_effect=names):
            self.write()
        self.assertEqual(sorted([*names[:3], "a.txt", "precious"]), self.names())
        self.assertEqual("mine", (self.folder / "precious").read_text(encoding="utf-8"))

    def test_what_dead_processes_left_is_swept_and_what_the_living_write_stays(self):
        child = os.fork()
        if child == 0:
            with whole_file(str(self.folder / "b.txt")):
                os.kill(os.getpid(), signal.SIGKILL)
        os.waitpid(child, 0)
        self.assertTrue(temporary.is_temporary(*self.names()))
        (self.folder / "a.txt.part").write_text("a browser's", encoding="utf-8")
        with whole_file(str(self.folder / "c.txt")) as part:
            write_text(part, "living")
            self.write()
            self.assertEqual(sorted([os.path.basename(part), "a.txt", "a.txt.part"]), self.names())
        self.assertEqual(["a.txt", "a.txt.part", "c.txt"], self.names())

    def test_many_at_once_each_are_whole(self):
        def work():
            for _ in range(30):
                self.write("x" * 5000, is_own=lambda _: True)
        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        while any(thread.is_alive() for thread in threads):
            if self.path.exists():
                self.assertEqual("x" * 5000, self.path.read_text(encoding="utf-8"))
            time.sleep(0.001)
        self.assertEqual(["a.txt"], self.names())

    def test_on_a_full_disk_the_older_file_stays(self):
        self.write("old")
        child = os.fork()
        if child == 0:
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))
            try:
                self.write("x" * 1000, is_own=lambda _: True)
            except OSError:
                os._exit(0)
            os._exit(1)
        self.assertEqual(0, os.waitpid(child, 0)[1])
        self.assertEqual(("old", ["a.txt"]), (self.path.read_text(encoding="utf-8"), self.names()))

    def test_a_folder_is_needed(self):
        for path in (self.folder / "none" / "a", "/dev/null/a", "/proc/none"):
            with self.subTest(path), self.assertRaises((BadInput, OSError)):
                self.write(path=path)
        os.chdir(self.folder)
        self.write(path="bare")
        self.assertEqual(["bare"], self.names())


class Marks(InFolder):
    """A mark tells what Waft wrote, and every change of it."""

    def altered(self, content):
        yield b""
        yield content[:-1]
        yield content + b" "
        yield content[:len(content) // 2]
        for place in range(0, len(content), max(1, len(content) // 40)):
            yield content[:place] + bytes([content[place] ^ 1]) + content[place + 1:]

    def check(self, content, is_marked, is_changed=lambda content: True):
        self.path.write_bytes(content)
        self.assertTrue(is_marked(self.path))
        for other in filter(is_changed, self.altered(content)):
            self.path.write_bytes(other)
            self.assertFalse(is_marked(self.path), other)
        self.path.unlink()
        for name in self.make_kinds():
            self.assertFalse(is_marked(self.folder / name), name)

    def test_pictures(self):
        plain = b"\x89PNG\r\n\x1a\n" + b"picture" * 50 + marks._PNG_END
        self.path.write_bytes(plain)
        self.assertFalse(marks.is_marked_png(self.path))
        self.check(marks.marked_png(plain), marks.is_marked_png)

    def test_archives(self):
        made = io.BytesIO()
        with zipfile.ZipFile(made, "w") as archive:
            archive.writestr("a", b"content")
        self.path.write_bytes(made.getvalue())
        self.assertFalse(marks.is_marked_zip(self.path))
        marked = marks.marked_zip(made.getvalue())
        self.assertEqual(b"content", zipfile.ZipFile(io.BytesIO(marked)).read("a"))
        self.check(marked, marks.is_marked_zip)

    def test_rows(self):
        rows = [{"folder": "out", "rows": [{"key": "a", "value": 0.1}]}, {"folder": "b", "rows": []}]
        marked = marks.marked_rows(rows)
        self.assertEqual(marked, marks.marked_rows(marked))
        self.assertEqual(rows, [{name: value for name, value in row.items() if name != "digest"} for row in marked])

        def is_changed(content):
            try:
                return json.loads(content) != marked
            except ValueError:
                return True
        self.check(json.dumps(marked, indent=2).encode(), marks.is_marked_json, is_changed)
        for other in (rows, [], {}, [7], [{}], [{"digest": ""}], "x", None, {"waft": 1}, [*marked, marked[0]], marked[:1],
                      marked[::-1]):
            self.path.write_text(json.dumps(other), encoding="utf-8")
            self.assertFalse(marks.is_marked_json(self.path), other)


class Commands(InFolder):
    def waft(self, *arguments):
        return subprocess.run([WAFT, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=120)

    def test_what_is_there_stays(self):
        kinds = self.make_kinds()
        for ending in (".waft.json", ".zip"):
            for name in kinds:
                (self.folder / name).rename(self.folder / f"{name}{ending}")
            before = self.picture()
            for name in ("file", "link", "lost", "pipe", "folder", "device"):
                command = ["new", f"{name}{ending}", "--text", "A"] if ending != ".zip" else ["blender-addon", f"{name}{ending}"]
                with self.subTest(command):
                    done = self.waft(*command)
                    self.assertEqual(2, done.returncode, done.stderr)
                    self.assertIn(f"{name}{ending}", done.stderr)
            self.assertEqual(before, self.picture())
            for name in kinds:
                (self.folder / f"{name}{ending}").rename(self.folder / name)

    def test_what_is_there_beside_stays(self):
        """Names that a program could take for its own."""
        (self.folder / "precious").write_text("mine", encoding="utf-8")
        for name in ("n.waft.json", "n.zip"):
            (self.folder / f"{name}.part").symlink_to("precious")
            os.mkfifo(self.folder / f"{name}~")
            (self.folder / f".{name}.tmp").write_text("mine", encoding="utf-8")
        before = self.picture()
        self.assertEqual(0, self.waft("new", "n.waft.json", "--text", "A").returncode)
        self.assertEqual(0, self.waft("blender-addon", "n.zip").returncode)
        after = self.picture()
        self.assertEqual({"n.waft.json", "n.zip"}, after.keys() - before.keys())
        self.assertEqual(before, {name: after[name] for name in before})

    def test_a_scene_is_saved_over_a_scene_alone(self):
        scene = Scene("mine")
        for name in self.make_kinds():
            if name == "empty":
                continue
            before = self.picture()
            with self.subTest(name), self.assertRaises(BadInput):
                scene.save(self.folder / name)
            self.assertEqual(before, self.picture())
        scene.save(self.folder / "empty")
        for _ in range(2):
            scene.save(self.folder / "s.waft.json")
        self.assertEqual("mine", Scene.load(self.folder / "s.waft.json").as_dict()["title"])
        with self.assertRaises(BadInput):
            scene.save(self.folder / "s.waft.json", is_new=True)


if __name__ == "__main__":
    unittest.main()
