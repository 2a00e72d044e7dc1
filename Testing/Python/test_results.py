# SPDX-License-Identifier: BSD-3-Clause
"""Whose files are whose: what runs wrote is replaced, whatever else is there stays.

    pvpython test_results.py
"""
import hashlib
import importlib
import json
import os
import pathlib
import resource
import signal
import sys
import tempfile
import types
import unittest
from unittest import mock

from waft import beneath
from waft.beneath import Folder
from waft.database import database_place, settle_database
from waft.failures import BadInput, WaftError
from waft.files import write_xml
from waft.resuming import Checkpoint
from waft.results import ResultPlace, manifest_of
from waft.results import place as results
from waft.writing import result_place, settled

_ADDON = types.ModuleType("addon")  # Blender's, without what knows of Blender in it
_ADDON.__path__ = [str(pathlib.Path(__file__).parents[2] / "Plugin" / "Blender" / "waft")]
sys.modules["addon"] = _ADDON
flight = importlib.import_module("addon.flight")

NAMES = ["poses.csv", "shapes/", "shapes.vtm", "report.json"]


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

    def texts(self):
        """{name: text} but for report.json."""
        return {name: (self.out / name).read_text(encoding="utf-8") for name in manifest_of(self.out)
                if name != "report.json"}

    def refused(self, name, *parts, **options):
        before = manifest_of(self.out)
        with self.assertRaises(BadInput) as caught:
            self.write("new", **options)
        for part in (str(self.out / name), "stays", *parts):
            self.assertIn(part, str(caught.exception))
        self.assertEqual(before, manifest_of(self.out))

    def die_writing(self, text):
        """A run that is killed while its results change hands, before shapes.vtm is in."""
        hand_over = Folder.move

        def dying(folder, name, target, new_name, **options):
            if target.path / new_name == self.out / "shapes.vtm":
                raise KeyboardInterrupt
            hand_over(folder, name, target, new_name, **options)
        with mock.patch.object(Folder, "move", dying), self.assertRaises(KeyboardInterrupt):
            self.write(text)


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
            self.put("report.json", json.dumps({"manifest": [{"name": name, "size": -1, "digest": ""}]}))
            self.refused("report.json")
        self.assertTrue((self.folder / "precious.txt").exists())

    def test_a_report_without_a_manifest_is_not_of_a_run(self):
        self.put("report.json", json.dumps(dict.fromkeys(("version", "scene", "seed", "stages", "constraints"), 0)))
        self.put("poses.csv", "old")
        self.refused("report.json")

    def test_one_run_at_a_time(self):
        with result_place(self.out):
            with self.assertRaisesRegex(BadInput, "another run of waft is at work there"):
                self.write("new")
        self.assertFalse(self.out.exists())  # it was made for the run alone
        child = os.fork()
        if child == 0:
            ResultPlace(self.out, "report.json").__enter__()
            os._exit(0)  # dies with it
        os.waitpid(child, 0)
        self.write("new")

    def test_what_dead_processes_left_is_swept(self):
        child = os.fork()
        if child == 0:
            with result_place(self.out) as place:
                for folder in (place.temporary(), place.temporary()):
                    (folder / "new").mkdir()
                    (folder / "new" / "poses.csv").write_text("poses", encoding="utf-8")
                place.temporary()
                os._exit(0)  # dies with them, also with one that it has only just made
        os.waitpid(child, 0)
        self.assertEqual(3, len(list(self.out.glob(".waft-*"))))
        self.write("new")
        self.assertEqual([], list(self.out.glob(".waft-*")))

    def test_the_add_on_knows_a_temporary_folder_too(self):
        with result_place(self.out) as place:
            folder = place.temporary()
            self.put(f"{folder.name}/poses.csv")
            flight.discard(self.out)
            self.assertFalse(folder.exists())

    def test_a_users_folder_stays_whatever_its_name(self):
        for name in (".waft-cam_take", ".waft-mine"):  # the first as a run's temporary folders are called
            self.put(f"{name}/notes.txt")
        (self.out / ".waft-nothings").mkdir()
        self.write("new")
        self.write("newer")
        flight.discard(self.out)
        for name in (".waft-cam_take", ".waft-mine"):
            self.assertTrue((self.out / name / "notes.txt").exists())
        self.assertTrue((self.out / ".waft-nothings").is_dir())

    def test_a_failure_in_the_middle_puts_the_old_results_back(self):
        self.write("old")
        before = manifest_of(self.out)
        move, calls = beneath.move_new, []

        def failing(source, target, *folders):
            calls.append(source)
            if len(calls) == fails_at:
                raise OSError(28, "No space left on device")
            move(source, target, *folders)

        for fails_at in range(1, 9):
            calls.clear()
            with mock.patch.object(beneath, "move_new", failing), self.assertRaises(OSError):
                self.write("new")
            with result_place(self.out):
                pass
            self.assertEqual(before, manifest_of(self.out))

    def test_a_move_waits_for_a_file_that_came_in_between(self):
        self.write("old")
        self.die_writing("new")
        self.assertFalse((self.out / "report.json").exists())
        self.put("shapes.vtm")
        with self.assertRaisesRegex(BadInput, "shapes.vtm: no run of waft wrote it"):
            self.write("last")
        self.assertEqual("mine", (self.out / "shapes.vtm").read_text(encoding="utf-8"))
        (self.out / "shapes.vtm").unlink()
        with result_place(self.out):
            pass
        self.assertEqual({"new"}, set(self.texts().values()))

    def test_new_files_that_were_damaged_meanwhile_do_not_go_in(self):
        self.write("old")
        before = manifest_of(self.out)
        hand_over = Folder.move

        def dying(folder, name, target, new_name, **options):
            hand_over(folder, name, target, new_name, **options)
            if target.path / new_name == self.out / "poses.csv":
                raise KeyboardInterrupt
        with mock.patch.object(Folder, "move", dying), self.assertRaises(KeyboardInterrupt):
            self.write("new")
        (self.out / ".waft-move" / "new" / "shapes.vtm").write_text("n", encoding="utf-8")
        with result_place(self.out):
            pass
        self.assertEqual(before, manifest_of(self.out))

    def test_a_checkpoint_folder_of_others_is_refused(self):
        for names in (("mine",), ("key",), ("key", "mine"), ("constraints.vtp",)):
            with self.subTest(names):
                self.out = self.folder / "_".join(names)
                for name in names:
                    self.put(f"checkpoint/{name}")
                with result_place(self.out) as place, self.assertRaisesRegex(BadInput, "checkpoint.*stays"):
                    Checkpoint(place, "some key")

    def test_pictures_are_put_one_by_one(self):
        self.put("frames/side_0001.png")
        names = ["frames/side_0000.png", "frames/side_0001.png"]
        with ResultPlace(self.out, "pictures.json") as place:
            with self.assertRaisesRegex(BadInput, "side_0001.png: no run"):
                place.check(names, replaces_all=False)
            place.check(names[:1], replaces_all=False)
            place.path(names[0]).write_text("drawn", encoding="utf-8")
            place.put(names[0])
            # Killed here: the picture is a run's all the same.
        for text in ("drawn", "drawn again"):
            with ResultPlace(self.out, "pictures.json") as place:
                place.check(names[:1], replaces_all=False)
                place.path(names[0]).write_text(text, encoding="utf-8")
                place.put(names[0])
                place.confirm()
        self.put("frames/side_0000.png", "retouched")
        with ResultPlace(self.out, "pictures.json") as place, self.assertRaisesRegex(BadInput, "side_0000.png: it was changed"):
            place.check(names[:1], replaces_all=False)


class Strangers(Base):
    """What seals, journals and logs of somebody else's say is looked at before anything is done."""

    MINE = {"size": 4, "digest": "sha256:" + hashlib.sha256(b"mine").hexdigest()}

    def test_a_move_that_was_cut_short_is_finished_before_reading(self):
        self.write("old")
        self.die_writing("new")
        self.assertEqual("new", settled(self.out).text("shapes.vtm"))
        self.assertTrue((self.out / "report.json").exists())
        with self.assertRaisesRegex(BadInput, "no such folder"):
            settled(self.folder / "none")

    def test_who_reads_waits_for_one_who_moves(self):
        self.write("old")
        with result_place(self.out):
            settled(self.out)  # nothing changes hands
            (self.out / ".waft-move").mkdir()
            with mock.patch.object(results, "_PATIENCE", 0.2), self.assertRaisesRegex(BadInput, "another run"):
                settled(self.out)
            (self.out / ".waft-move").rmdir()

    def test_a_killed_run_of_pictures_leaves_them_known(self):
        names = [f"frames/side_{number:04d}.png" for number in range(4)]

        def draw(text, ends=None, drawn=names):
            with ResultPlace(self.out, "pictures.json") as place:
                place.check(drawn, replaces_all=False)
                for number, name in enumerate(drawn):
                    place.path(name).write_text(text, encoding="utf-8")
                    if number == ends:
                        os._exit(0)
                    place.put(name)
                place.confirm()

        def killed(*arguments):
            child = os.fork()
            if child == 0:
                draw(*arguments)
            self.assertEqual(0, os.waitpid(child, 0)[1])

        draw("first")
        killed("second", 2)
        self.assertTrue((self.out / ".waft-put").exists())
        self.assertEqual(["second", "second", "first", "first"], [self.texts()[name] for name in names])
        with result_place(self.out):
            pass
        self.assertTrue((self.out / ".waft-put").exists(), "another's log was taken")
        self.put(names[0])  # of the user's, since then
        with self.assertRaisesRegex(BadInput, "side_0000.png: it was changed"):
            draw("third")
        self.assertFalse((self.out / ".waft-put").exists())
        (self.out / names[0]).unlink()
        killed("third", 3)
        with open(self.out / ".waft-put", "ab") as stream:
            stream.write(b'{"name": "fra')  # cut in the middle of a row
        draw("fourth", None, names[1:])
        self.assertEqual(["third", "fourth", "fourth", "fourth"], [self.texts()[name] for name in names])
        rows = json.loads((self.out / "pictures.json").read_text(encoding="utf-8"))["manifest"]
        self.assertEqual(names, sorted(row["name"] for row in rows))

    def test_a_picture_that_came_meanwhile_stays(self):
        name = "frames/side_0000.png"
        for before in ("nothing", "old"):
            self.out = self.folder / before
            if before == "old":
                with ResultPlace(self.out, "pictures.json") as place:
                    place.path(name).write_text(before, encoding="utf-8")
                    place.put(name)
                    place.confirm()
            with ResultPlace(self.out, "pictures.json") as place:
                place.check([name], replaces_all=False)
                place.path(name).write_text("new", encoding="utf-8")
                self.put(name)
                with self.assertRaisesRegex(WaftError, "side_0000.png: no run of waft wrote it"):
                    place.put(name)
                place.confirm()
            self.assertEqual("mine", self.texts()[name])

    def test_a_place_beside_others_takes_its_own_names_alone(self):
        """A database, whose folder is that of whatever lies beside it."""
        for name in ("thesis.txt", ".bashrc", "air2/x", "airx", "air/../thesis.txt"):
            with self.subTest(name):
                self.out = self.folder / name.replace("/", "_")
                self.put("thesis.txt")
                self.put("air.vtm.kept/.waft-move/new/" + name.rpartition("/")[2])
                row = {"name": name, **self.MINE}
                journal = {"seal": "air/manifest.json", "new": [row], "old": []}
                self.put("air.vtm.kept/.waft-move/journal.json", json.dumps(journal))
                before = manifest_of(self.out)
                with self.assertRaises(BadInput):
                    settle_database(self.out / "air.vtm")
                self.assertEqual(before, manifest_of(self.out))
                (self.out / "air.vtm.kept/.waft-move/journal.json").unlink()
                os.rename(self.out / "air.vtm.kept/.waft-move", self.out / "aside")
                self.put("air/manifest.json", json.dumps({"manifest": [row]}))
                with self.assertRaises(BadInput), database_place(self.out / "air.vtm") as place:
                    place.check(["air.vtm", "air/"])

    def test_a_room_that_is_a_link_is_refused(self):
        (self.folder / "precious").mkdir()
        self.put("air.vtm")
        (self.out / "air.vtm.kept").symlink_to(self.folder / "precious")
        with self.assertRaisesRegex(BadInput, "found a link"), database_place(self.out / "air.vtm"):
            pass
        self.assertEqual([], list((self.folder / "precious").iterdir()))

    def test_a_checkpoint_of_links_is_refused(self):
        for kind in ("link", "pipe", "folder"):
            self.out = self.folder / kind
            for name in ("planned.vtp", "constraints.vtp", "vortices.vtp", "report.csv", "key"):
                self.put(f"checkpoint/{name}")
            path = self.out / "checkpoint" / "assimilation.state"
            path.symlink_to(self.folder / "precious") if kind == "link" else os.mkfifo(path) if kind == "pipe" else path.mkdir()
            with result_place(self.out) as place, self.assertRaisesRegex(BadInput, "checkpoint.*stays"):
                Checkpoint(place, "some key")

    def test_temporary_folders_go_when_no_descriptor_is_left(self):
        child = os.fork()
        if child == 0:
            held = []
            with result_place(self.out) as place:
                place.path("shapes/a.vtp").write_text("a", encoding="utf-8")
                most = max(map(int, os.listdir("/proc/self/fd"))) + 8
                resource.setrlimit(resource.RLIMIT_NOFILE, (most, most))
                try:
                    while True:
                        held.append(os.dup(0))
                except OSError:
                    pass
            os._exit(len(held) and len(os.listdir(self.out)) if self.out.exists() else 0)
        self.assertEqual(0, os.waitpid(child, 0)[1])
        self.assertFalse(self.out.exists())


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
