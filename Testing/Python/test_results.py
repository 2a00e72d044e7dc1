# SPDX-License-Identifier: BSD-3-Clause
"""Whose files are whose, and how results change hands: what runs wrote is replaced, whatever else is there stays.

    pvpython test_results.py
"""
import contextlib
import errno
import fcntl
import hashlib
import importlib
import itertools
import json
import os
import pathlib
import resource
import signal
import subprocess
import sys
import tempfile
import time
import types
import unittest
from unittest import mock

from datafiles import write_xml
from waft import beneath, renaming
from waft.beneath import Folder
from waft.failures import BadInput, WaftError
from waft.results import Busy, ResultPlace, manifest_in, manifest_of
from waft.results import place as results
from waft.loading import command
from waft.temporary import temporary_name
from waft.writing import result_place, settled

_ADDON = types.ModuleType("addon")  # Blender's, without what knows of Blender in it
_ADDON.__path__ = [str(pathlib.Path(__file__).parents[2] / "Plugin" / "Blender" / "waft")]
sys.modules["addon"] = _ADDON
flight = importlib.import_module("addon.flight")

LEAF = {"waft": 1, "time": {"frames": 3}, "shapes": {"leaf": {"builtin": "leaf"}}, "objects": [{"shape": "leaf", "position": [0, 0, 2]}]}
NAMES = ["poses.csv", "shapes/", "shapes.vtm", "report.json"]


def in_child(work):
    """Does the work in a child process; its exit status."""
    child = os.fork()
    if child == 0:
        status = 1
        try:
            work()
            status = 0
        finally:
            os._exit(status)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


def killed(work, at):
    """Does the work in a child process that is killed before the so many-th name comes, goes or changes; its exit status."""
    left = itertools.count(1)

    def dying(do):
        def changing(*arguments, **options):
            if next(left) == at:
                os._exit(9)
            return do(*arguments, **options)
        return changing

    with contextlib.ExitStack() as patched:
        for module, name in ((os, "rename"), (os, "unlink"), (os, "rmdir"), (os, "mkdir"), (beneath, "move_new")):
            patched.enter_context(mock.patch.object(module, name, dying(getattr(module, name))))
        return in_child(work)


class Base(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.out = self.folder / "out"

    def put(self, name, text="mine"):
        path = self.out / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def write(self, text, *names, check=NAMES):
        with result_place(self.out) as place:
            place.check(check)
            for name in names or ("poses.csv", "shapes/leaf.vtp", "shapes.vtm"):
                place.path(name).write_text(text, encoding="utf-8")
            place.commit({"text": text})

    def draw(self, text, *names):
        with ResultPlace(self.out, "pictures.json") as place:
            place.check(names, replaces_all=False)
            for name in names:
                place.path(name).write_text(text, encoding="utf-8")
                place.path("frames/unfinished.png")
                place.commit({}, [name])

    def put_right(self):
        with result_place(self.out):
            pass

    def texts(self):
        """{name: text} but for seals."""
        return {name: (self.out / name).read_text(encoding="utf-8") for name in manifest_of(self.out) if not name.endswith(".json")}

    def refused(self, name, *parts, **options):
        before = manifest_of(self.out)
        with self.assertRaises(BadInput) as caught:
            self.write("new", **options)
        for part in (str(self.out / name), *(parts or ("stays as it is",))):
            self.assertIn(part, str(caught.exception))
        self.assertEqual(before, manifest_of(self.out))

    def assert_not_flown(self, words):
        """The program, which has places of its own, refuses to fly into the folder, and leaves it as it is."""
        before = set(self.out.rglob("*"))
        scene = self.folder / "scene.waft.json"
        scene.write_text(json.dumps(LEAF), encoding="utf-8")
        done = subprocess.run([command(), "synthesize", scene, "--output", self.out, "--preview"], capture_output=True, text=True, check=False)
        self.assertEqual(2, done.returncode, done.stderr)
        self.assertRegex(done.stderr, words)
        self.assertEqual(before, set(self.out.rglob("*")))

    def cut_short(self):
        """A run that is killed while its results change hands, before shapes.vtm is in."""
        move_in = ResultPlace._move_in

        def dying(place, staged, name, old):
            if name == "shapes.vtm":
                os._exit(9)
            move_in(place, staged, name, old)

        with mock.patch.object(ResultPlace, "_move_in", dying):
            self.assertEqual(9, in_child(lambda: self.write("new")))


class Results(Base):
    def test_a_run_replaces_what_a_run_wrote_and_nothing_else(self):
        self.put("notes.txt")
        self.put("shapes.txt/deep")
        self.write("old")
        self.write("new", "poses.csv", "shapes/leaf.vtp")  # and no more shapes.vtm
        self.assertEqual({"notes.txt": "mine", "shapes.txt/deep": "mine", "poses.csv": "new", "shapes/leaf.vtp": "new"},
                         self.texts())
        report = json.loads((self.out / "report.json").read_text(encoding="utf-8"))
        self.assertEqual("new", report["text"])
        self.assertEqual(["poses.csv", "shapes/leaf.vtp"], [row["name"] for row in report["manifest"]])
        self.assertEqual({"name", "size", "digest"}, set(report["manifest"][0]))
        self.write("last", "poses.csv")
        self.assertFalse((self.out / "shapes").exists())

    def test_files_of_others_are_refused(self):
        for name in ("poses.csv", "shapes/mine.obj", "shapes/in/it", "poses.csv/mine", "shapes", "report.json"):
            with self.subTest(name):
                self.out = self.folder / name.replace("/", "_")
                self.put(name)
                self.refused(name if name != "poses.csv/mine" else "poses.csv", "no run of waft wrote it")

    def test_files_of_others_among_results_are_refused(self):
        self.write("old")
        self.put("shapes/mine.obj")
        self.refused("shapes/mine.obj")

    def test_results_that_were_changed_are_refused(self):
        for name in ("poses.csv", "shapes/leaf.vtp"):
            with self.subTest(name):
                self.out = self.folder / name.replace("/", "_")
                self.write("old")
                self.put(name, "old+")
                self.refused(name, "changed")

    def test_what_came_while_a_run_computed_stays(self):
        self.write("old")
        with self.assertRaisesRegex(WaftError, "poses.csv: it was changed"), result_place(self.out) as place:
            place.check(NAMES)
            place.path("poses.csv").write_text("new", encoding="utf-8")
            self.put("poses.csv")
            place.commit({})
        self.assertEqual({"mine", "old"}, set(self.texts().values()))
        self.assertTrue((self.out / "report.json").exists())

    def test_links_are_nobodys_results(self):
        self.write("old")
        (self.out / "poses.csv").rename(self.folder / "elsewhere.csv")
        (self.out / "poses.csv").symlink_to(self.folder / "elsewhere.csv")
        self.refused("poses.csv")
        self.assertTrue((self.folder / "elsewhere.csv").is_file())
        (self.out / "poses.csv").unlink()
        (self.out / "shapes").rename(self.folder / "shapes")
        (self.out / "shapes").symlink_to(self.folder / "shapes")
        self.refused("shapes")

    def test_manifests_name_nothing_outside(self):
        self.put("../precious.txt")
        for name in ("../precious.txt", str(self.folder / "precious.txt"), ""):
            self.put("report.json", json.dumps({"manifest": [{"name": name, **Strangers.ROW}]}))
            self.refused("report.json", "/manifest/0/name: ")
        self.assertTrue((self.folder / "precious.txt").exists())

    def test_a_report_without_a_manifest_is_not_of_a_run(self):
        self.put("report.json", json.dumps(dict.fromkeys(("version", "scene", "seed", "stages", "constraints"), 0)))
        self.put("poses.csv", "old")
        self.refused("report.json")

    def test_a_checkpoint_folder_of_others_is_refused(self):
        for names in (("mine",), ("key",), ("key", "mine"), ("constraints.vtp",)):
            with self.subTest(names):
                self.out = self.folder / "_".join(names)
                for name in names:
                    self.put(f"checkpoint/{name}")
                self.assert_not_flown("checkpoint.*stays")

    def test_a_checkpoint_of_links_is_refused(self):
        for kind in ("link", "pipe", "folder"):
            self.out = self.folder / kind
            for name in ("planned.vtp", "constraints.vtp", "vortices.vtp", "report.csv", "key"):
                self.put(f"checkpoint/{name}")
            path = self.out / "checkpoint" / "assimilation.state"
            path.symlink_to(self.folder / "precious") if kind == "link" else os.mkfifo(path) if kind == "pipe" else path.mkdir()
            self.assert_not_flown("checkpoint.*stays")


class Pictures(Base):
    NAMES = ("frames/side_0000.png", "frames/side_0001.png")

    def test_those_of_other_names_stay(self):
        self.draw("first", *self.NAMES)
        self.draw("second", self.NAMES[1])
        self.assertEqual(["first", "second"], list(self.texts().values()))
        self.assertEqual(set(self.NAMES), set(manifest_in(Folder(self.out), "pictures.json")))
        self.put(self.NAMES[0], "retouched")
        self.draw("third", self.NAMES[1])
        with self.assertRaisesRegex(BadInput, "side_0000.png: it was changed"):
            self.draw("third", *self.NAMES)
        self.assertEqual(["retouched", "third"], list(self.texts().values()))
        self.put("frames/side_0002.png")
        with self.assertRaisesRegex(BadInput, "side_0002.png: no run"):
            self.draw("third", "frames/side_0002.png")
        (self.out / self.NAMES[0]).unlink()
        self.draw("fourth", self.NAMES[1])
        self.assertEqual({self.NAMES[1]}, set(manifest_in(Folder(self.out), "pictures.json")))

    def test_what_was_put_in_before_a_kill_is_known(self):
        self.draw("first", *self.NAMES)

        def killed():
            with ResultPlace(self.out, "pictures.json") as place:
                for name in self.NAMES:
                    place.path(name).write_text("second", encoding="utf-8")
                place.commit({}, self.NAMES[:1])
                os._exit(9)

        self.assertEqual(9, in_child(killed))
        self.assertEqual("first", self.texts()[self.NAMES[1]])
        self.draw("third", *self.NAMES)
        self.assertEqual({"third"}, set(self.texts().values()))


class Places(Base):
    """Whatever the folder is, it never moves, and nothing beside it comes or goes."""

    def whole(self, out):
        self.out, above = out, out.absolute().parent
        about = out.stat(), above.stat()
        self.write("old")
        self.write("new", "poses.csv", "frames/a")
        self.assertEqual({"poses.csv": "new", "frames/a": "new"}, self.texts())
        self.assertEqual({"poses.csv", "frames", "report.json"}, set(os.listdir(out)))
        self.assertTrue(os.path.samestat(about[0], out.stat()))
        self.assertEqual(about[1].st_mtime_ns, above.stat().st_mtime_ns, "something came or went beside it")

    def test_the_working_folder(self):
        self.addCleanup(os.chdir, os.getcwd())
        self.out.mkdir()
        os.chdir(self.out)
        self.whole(pathlib.Path("."))

    def test_a_link_to_a_folder(self):
        self.out.mkdir()
        (self.folder / "link").symlink_to("out")
        self.whole(self.folder / "link")
        self.assertTrue((self.folder / "link").is_symlink())

    def test_a_stick_without_links_and_an_old_system(self):
        for name in ("link", "symlink"):
            self.enterContext(mock.patch.object(os, name, side_effect=OSError(errno.EPERM, "no links here")))
        self.enterContext(mock.patch.object(renaming, "_NO_REPLACE", 1 << 20))
        self.enterContext(mock.patch.object(beneath, "_OPENAT2", 9999))
        self.out.mkdir()
        self.whole(self.out)

    def test_one_that_may_not_be_written(self):
        self.write("old")
        before = manifest_of(self.out)
        with mock.patch.object(os, "access", return_value=False), self.assertRaisesRegex(BadInput, "that may be written in"):
            self.write("new")
        self.cut_short()
        with mock.patch.object(os, "access", return_value=False), self.assertRaisesRegex(BadInput, "waits for a command"):
            settled(self.out)
        self.assertNotEqual(before, manifest_of(self.out))

    def test_what_is_made_for_a_run_alone_goes(self):
        self.out = self.folder / "deep" / "out"
        with result_place(self.out):
            self.assertTrue((self.out / results.LOCK).exists())
        self.assertEqual([], os.listdir(self.folder))

    def test_a_full_disk(self):
        self.write("old")
        before = manifest_of(self.out)
        full = OSError(errno.ENOSPC, "No space left on device")
        with self.assertRaises(OSError), result_place(self.out) as place:
            place.path("poses.csv").write_text("new", encoding="utf-8")
            raise full
        self.assertEqual(before, manifest_of(self.out))
        self.assertEqual({"poses.csv", "shapes", "shapes.vtm", "report.json"}, set(os.listdir(self.out)))
        # A name that finds no room while results change hands: the next run gives it one.
        with mock.patch.object(ResultPlace, "_move_in", side_effect=full), self.assertRaises(OSError):
            self.write("new")
        self.put_right()
        self.assertEqual({"new"}, set(self.texts().values()))


class Locks(Base):
    def test_one_run_at_a_time(self):
        with result_place(self.out):
            self.assertTrue(results.is_at_work(Folder(self.out)))
            with self.assertRaisesRegex(Busy, "another run of waft is at work there"):
                self.write("new")
        self.assertFalse(self.out.exists())  # it was made for the run alone
        self.assertEqual(9, in_child(lambda: (ResultPlace(self.out, "report.json").__enter__(), os._exit(9))))
        self.assertEqual([results.LOCK], os.listdir(self.out))
        self.assertFalse(results.is_at_work(Folder(self.out)))
        self.write("new")
        self.assertFalse((self.out / results.LOCK).exists())

    def test_the_lock_is_a_file_that_is_written(self):
        """As network file systems have it, which know none of folders."""
        self.out.mkdir()
        with open(self.out / results.LOCK, "wb") as other:
            fcntl.flock(other, fcntl.LOCK_EX)
            with self.assertRaises(Busy):
                self.write("new")
        self.write("new")

    def test_a_lock_that_went_meanwhile_is_none(self):
        """Its run ended after it was opened here: who comes then makes another."""
        flock, lock = fcntl.flock, self.out / results.LOCK
        ends = iter([lock.unlink])

        def late(descriptor, how):
            next(ends, lambda: None)()
            flock(descriptor, how)

        with mock.patch.object(fcntl, "flock", late), result_place(self.out):
            self.assertTrue(lock.exists())

    def test_a_lock_that_comes_and_goes_is_one_runs(self):
        def race():
            for _ in range(100):
                with contextlib.suppress(Busy), result_place(self.out):
                    os.mkdir(self.folder / "held")
                    os.rmdir(self.folder / "held")

        other = os.fork()
        if other == 0:
            os._exit(in_child(race))
        self.assertEqual([0, 0], [in_child(race), os.waitstatus_to_exitcode(os.waitpid(other, 0)[1])])

    def test_a_folder_that_another_run_takes_away_meanwhile_can_be_made(self):
        self.out.mkdir()
        look = os.access

        def going(path, mode):
            if self.out.exists():
                self.out.rmdir()
            return os.path.exists(path) and look(path, mode)

        with mock.patch.object(os, "access", going):
            results.check_folder(self.out)

    def test_a_users_file_of_the_locks_name_stays(self):
        self.out.mkdir()
        lock = self.out / results.LOCK
        for make in (lambda: lock.write_text("mine"), lambda: lock.symlink_to(self.folder / "precious"), lock.mkdir, lambda: os.mkfifo(lock)):
            make()
            about = lock.lstat()
            with self.assertRaisesRegex(BadInput, f"{results.LOCK}: .*expected an empty file"):
                self.write("new")
            flight.discard(self.out)
            self.assertTrue(os.path.samestat(about, lock.lstat()))
            lock.rmdir() if lock.is_dir() else lock.unlink()
        self.assertEqual([], os.listdir(self.out))
        self.assertFalse((self.folder / "precious").exists())


class CutShort(Base):
    """Killed at any moment, a change of hands ends with whole results, old or new, by whoever comes next."""

    def attack(self, change, put_right, whole, is_there):
        """Kills change() before each of its steps, and once more while that is put right. whole: the two trees that there may be in the
        end. is_there: the seal. Returns how often it was killed."""
        old = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
        os.rename(self.out, old / "out")
        for at in itertools.count(1):
            self.out = self.folder / f"killed-{at}"
            self.copy(old / "out", self.out)
            status = killed(change, at)
            self.assertIn(status, (0, 9))
            for again in (2, 5, None):
                if (self.out / is_there).exists():  # it is whole, whatever else lies there
                    tree = manifest_of(self.out)
                    self.assertTrue(any(tree.items() >= those.items() for those in whole), at)
                if again is not None:
                    killed(put_right, again)
            put_right()
            with self.subTest(step=at):
                self.assertIn(manifest_of(self.out), whole)
                self.assertEqual([], [name for name in os.listdir(self.out) if name.startswith(".waft-")])
            if status == 0:
                return at - 1

    @staticmethod
    def copy(source, target):
        for name in manifest_of(source):
            (target / name).parent.mkdir(parents=True, exist_ok=True)
            (target / name).write_bytes((source / name).read_bytes())

    def both(self, first, second):
        """The trees after a change, and after a second one."""
        trees = []
        for change in (second, first):
            self.put("notes.txt")
            first()
            change()
            trees.append(manifest_of(self.out))
            out, self.out = self.out, self.folder / "again"
        self.out = out
        return trees

    def test_results(self):
        def old():
            self.write("old", "poses.csv", "shapes/a", "shapes/b", "wind/0", "wind/1")

        def new():
            self.write("new", "poses.csv", "shapes/a", "shapes/c", "air/0", "air.pvd")

        self.assertGreater(self.attack(new, self.put_right, self.both(old, new), "report.json"), 20)

    def test_pictures(self):
        self.put("notes.txt")
        self.draw("old", *Pictures.NAMES)
        self.draw("new", Pictures.NAMES[0])
        whole = [manifest_of(self.out)]
        self.draw("old", Pictures.NAMES[0])
        whole.append(manifest_of(self.out))
        self.assertGreater(self.attack(lambda: self.draw("new", Pictures.NAMES[0]), self.put_right, whole, "pictures.json"), 8)

    def test_results_beside_others(self):
        def database_place():
            return ResultPlace(self.out, "air/manifest.json", room="air.vtm.kept", owns=lambda name: name.startswith("air"))

        def make(text):
            with database_place() as place:
                place.check(["air.vtm", "air/"])
                for name in ("air.vtm", "air/0.vtp", f"air/{text}.vtp"):
                    place.path(name).write_text(text, encoding="utf-8")
                place.commit({})

        def put_right():
            with database_place():
                pass

        whole = self.both(lambda: make("old"), lambda: make("new"))
        self.assertGreater(self.attack(lambda: make("new"), put_right, whole, "air/manifest.json"), 10)

    def test_it_is_finished_before_reading(self):
        self.write("old")
        self.cut_short()
        self.assertFalse((self.out / "report.json").exists())
        flight.discard(self.out)
        self.assertEqual("new", settled(self.out).text("shapes.vtm"))
        self.assertTrue((self.out / "report.json").exists())
        with self.assertRaisesRegex(BadInput, "no such folder"):
            settled(self.folder / "none")

    def test_who_reads_waits_for_one_who_moves(self):
        self.write("old")
        self.cut_short()
        with open(self.out / results.LOCK, "wb") as other:
            fcntl.flock(other, fcntl.LOCK_EX)
            with mock.patch.object(results, "_PATIENCE", 0.2), self.assertRaisesRegex(BadInput, "another run"):
                settled(self.out)
            child = os.fork()
            if child == 0:
                time.sleep(0.3)
                os._exit(0)  # the last who holds the lock
        settled(self.out)
        os.waitpid(child, 0)
        self.assertEqual({"new"}, set(self.texts().values()))

    def test_a_file_that_came_in_between_stays(self):
        self.write("old")
        self.cut_short()
        self.put("shapes.vtm")
        for _ in range(2):
            with self.assertRaisesRegex(BadInput, "shapes.vtm: .*stays as it is.*wait in .*/.waft-"):
                self.write("last")
        self.assertEqual("mine", (self.out / "shapes.vtm").read_text(encoding="utf-8"))
        (self.out / "shapes.vtm").unlink()
        self.put_right()
        self.assertEqual({"new"}, set(self.texts().values()))

    def test_what_takes_the_place_of_the_seal_stays(self):
        self.write("old")
        remove = Folder.remove

        def removing(folder, name):
            remove(folder, name)
            if name == "report.json":
                self.put(name)

        with mock.patch.object(Folder, "remove", removing), self.assertRaises(FileExistsError):
            self.write("new")
        self.assertEqual("mine", (self.out / "report.json").read_text(encoding="utf-8"))

    def test_a_staged_file_that_was_damaged_is_named(self):
        self.write("old")
        self.cut_short()
        staged = next(self.out.glob(".waft-*/new/shapes.vtm"))
        staged.write_text("n", encoding="utf-8")
        with self.assertRaisesRegex(BadInput, f"{staged}: expected the file that a run left there.*remove "):
            self.put_right()

    def test_what_was_not_staged_whole_is_swept(self):
        self.write("old")
        before = manifest_of(self.out)

        def die():
            with result_place(self.out) as place:
                place.path("poses.csv").write_text("new", encoding="utf-8")
                (self.out / place._staging / "part").write_text("{", encoding="utf-8")
                os._exit(9)

        in_child(die)
        self.assertEqual(1, len(list(self.out.glob(".waft-*/"))))
        settled(self.out)  # nothing changes hands
        self.assertEqual(1, len(list(self.out.glob(".waft-*/"))))
        self.put_right()
        self.assertEqual(before, manifest_of(self.out))
        in_child(die)
        flight.discard(self.out)
        self.assertEqual(before, manifest_of(self.out))

    def test_what_former_versions_left_is_named(self):
        for name in (".waft-move/new/poses.csv", ".waft-put"):
            self.out = self.folder / name[6:9]
            self.put(name)
            for act in (lambda: settled(self.out), self.put_right):
                with self.assertRaisesRegex(BadInput, f"{self.out}/.waft-.*: an earlier build of Waft"):
                    act()
            self.assertEqual({name: "mine"}, self.texts())

    def test_a_users_folder_stays_whatever_its_name(self):
        for name in (".waft-cam_take", ".waft-mine"):  # the first as a run's temporary folders are called
            self.put(f"{name}/manifest.json")
        (self.out / ".waft-nothings").mkdir()
        self.write("new")
        self.write("newer")
        flight.discard(self.out)
        for name in (".waft-cam_take", ".waft-mine"):
            self.assertTrue((self.out / name / "manifest.json").exists())
        self.assertTrue((self.out / ".waft-nothings").is_dir())


class Strangers(Base):
    """What a manifest of somebody else's says is looked at before anything is done."""

    ROW = {"size": 4, "digest": "sha256:" + hashlib.sha256(b"mine").hexdigest()}

    def made(self, *options):
        """What the program says where it is to make a database of this folder."""
        return subprocess.run([command(), "database", "--output", self.out / "air.vtm", *options, "--simulations", "1", "--resolution", "8",
                               "--frames", "30"], capture_output=True, text=True, check=False)

    def test_a_place_beside_others_takes_its_own_names_alone(self):
        """A database, whose folder is that of whatever lies beside it."""
        for name in ("thesis.txt", ".bashrc", "air2/x", "airx", "air/../thesis.txt"):
            with self.subTest(name):
                self.out = self.folder / name.replace("/", "_")
                self.put("thesis.txt")
                staging = temporary_name()
                row, seal = {"name": name, **self.ROW}, {"name": "air/manifest.json", **self.ROW}
                for staged in (name.rpartition("/")[2], "air/manifest.json"):
                    self.put(f"air.vtm.kept/{staging}/new/{staged}")
                for change in ({"new": [seal, row], "old": []}, {"new": [seal], "old": [row]}):
                    self.put(f"air.vtm.kept/{staging}/manifest.json", json.dumps({"seal": "air/manifest.json", **change}))
                    before = manifest_of(self.out)
                    self.assertEqual(2, self.made().returncode)
                    self.assertEqual(before, manifest_of(self.out))
                os.rename(self.out / "air.vtm.kept", self.out / "aside")
                self.put("air/manifest.json", json.dumps({"manifest": [row]}))
                self.assertEqual(2, self.made().returncode)

    def test_a_room_that_is_a_link_is_refused(self):
        (self.folder / "precious").mkdir()
        self.put("air.vtm")
        (self.out / "air.vtm.kept").symlink_to(self.folder / "precious")
        self.assertRegex(self.made().stderr, "air.vtm.kept: .*is no folder")
        self.assertEqual([], list((self.folder / "precious").iterdir()))

    def test_a_change_without_its_seal_is_none(self):
        self.put("thesis.txt")
        self.put(f"{temporary_name()}/manifest.json",
                 json.dumps({"seal": "report.json", "new": [], "old": [{"name": "thesis.txt", **self.ROW}]}))
        before = manifest_of(self.out)
        with self.assertRaisesRegex(BadInput, "manifest.json: expected names of these results"):
            self.put_right()
        self.assert_not_flown("manifest.json: expected names of these results")
        self.assertEqual(before, manifest_of(self.out))


class FullDisks(unittest.TestCase):
    def test_a_file_that_is_not_whole_is_reported_and_vtk_is_silent(self):
        from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet
        from vtkmodules.vtkFiltersSources import vtkPlaneSource

        plane = vtkPlaneSource()
        plane.SetResolution(200, 200)
        plane.Update()
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, plane.GetOutput())
        with tempfile.TemporaryDirectory() as folder:
            for name, data in (("plane.vtp", plane.GetOutput()), ("planes.vtm", blocks)):
                with self.subTest(name):
                    said = pathlib.Path(folder, "said")
                    child = os.fork()
                    if child == 0:
                        os.dup2(os.open(said, os.O_CREAT | os.O_WRONLY | os.O_TRUNC), 2)
                        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
                        resource.setrlimit(resource.RLIMIT_FSIZE, (4000, 4000))
                        try:
                            write_xml(data, pathlib.Path(folder, name))
                        except OSError as error:
                            os._exit(0 if "could not be written" in str(error) else 1)
                        os._exit(2)
                    self.assertEqual(0, os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
                    self.assertEqual("", said.read_text(encoding="utf-8"))


class Forks(unittest.TestCase):
    def test_a_fork_works_after_vtk_has_used_its_threads(self):
        from vtkmodules.vtkCommonCore import vtkSMPTools
        from vtkmodules.vtkCommonDataModel import vtkCellTypes
        from vtkmodules.vtkFiltersSources import vtkPlaneSource

        from waft.loading import set_threads

        self.addCleanup(vtkSMPTools.SetBackend, vtkSMPTools.GetBackend())
        set_threads(2)
        plane = vtkPlaneSource()
        plane.SetResolution(200, 200)
        plane.Update()
        plane.GetOutput().GetCellTypes(vtkCellTypes())  # a loop that VTK divides
        child = os.fork()
        if child == 0:
            signal.alarm(60)
            plane.GetOutput().GetCellTypes(vtkCellTypes())
            os._exit(0)
        self.assertEqual(0, os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))


if __name__ == "__main__":
    done = unittest.main(argv=sys.argv[:1], exit=False, verbosity=2)
    sys.stdout.flush()
    os._exit(0 if done.result.wasSuccessful() else 1)
