# SPDX-License-Identifier: BSD-3-Clause
"""waft.load: a flight back from its folder, and what is said of folders that are old, damaged, a stranger's or moved; the flight as tables
of pandas and PyVista; what help(waft) shows.

    pvpython run.py test_load.py         without a display: pictures are drawn on a virtual one
"""
import atexit
import csv
import functools
import importlib.util
import json
import os
import pathlib
import pydoc
import re
import shutil
import struct
import sys
import tempfile
import types
import unittest
import zlib
from unittest import mock

import numpy as np
import waft
from paraview import simple
from waft.results import manifest_of

COARSE = {"Assimilation": {"Resolution": 16, "LatticeResolution": 12, "Candidates": 2, "Rounds": 1}}


def setUpModule():
    os.environ.pop("DISPLAY", None)


def scene(folder):
    scene = waft.Scene("Back again")
    scene.set_time(41)
    skin = folder / "skin.png"
    skin.write_bytes(png(bytes((0, 255, 0))))
    scene.add_shape("plain", "leaf", color=(1, 0, 0))
    scene.add_shape("painted", "maple", texture=skin)
    scene.add_object("painted", (0, 0, 2.5), id=5)
    scene.add_objects("plain", positions=[(1, 1, 2.5), (-1, -1, 2.5)])
    scene.add_position(5, 40, (0.2, 0.1, 1.9), radius=0.1)
    scene.add_position(1, 40, (9, 9, 9))
    scene.add_box((-0.5, 1.2, 0), (0.5, 1.6, 1), motion=[{"frame": 0, "position": (0, 1.4, 0.5)}, {"frame": 40, "position": (0, 1.4, 0.9)}])
    return scene


def png(pixel):
    """A picture of one pixel."""
    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(b"\0" + pixel)) + chunk(b"IEND", b""))


@functools.cache
def flown():
    """(a folder for this test, the flight in its folder `out`)"""
    folder = tempfile.TemporaryDirectory()
    atexit.register(folder.cleanup)
    out = pathlib.Path(folder.name) / "out"
    return out.parent, waft.synthesize(scene(out.parent), output=out, quality="preview", threads=1, _settings=COARSE)


class Base(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder, cls.flown = flown()
        cls.out = cls.folder / "out"

    def copy(self):
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.folder)) / "copy"
        shutil.copytree(self.out, folder)
        return folder


class LoadTest(Base):
    def test_a_flight_comes_back_and_nothing_is_flown(self):
        before, files = simple.GetSources(), manifest_of(self.out)
        with mock.patch("waft.run.engine.Engine.__init__", side_effect=AssertionError("flown")):
            run = waft.load(self.out)
            for name in ("positions", "orientations", "times", "object_ids"):
                self.assertEqual(getattr(self.flown, name).tobytes(), getattr(run, name).tobytes())
            for name in ("report", "warnings", "status", "seed", "quality", "stopped"):
                self.assertEqual(getattr(self.flown, name), getattr(run, name))
            self.assertEqual(self.flown.marks.tolist(), run.marks.tolist())
            self.assertEqual(waft.run.Run, type(run).__mro__[1])
            self.assertEqual(self.flown.render(size=(160, 90)).tobytes(), run.render(size=(160, 90)).tobytes())
            self.assertIn("3 objects, 41 frames, 1 of 2 marks met", repr(run))
        self.assertEqual((before, files), (simple.GetSources(), manifest_of(self.out)))
        with self.assertRaisesRegex(waft.WaftError, r"seed: a flight that was read flies no more: waft.synthesize\(SCENE, seed=7\)"):
            run.seed = 7
        for name, bad in (("frame", 41), ("view", "front"), ("path", "still.jpg")):
            with self.assertRaisesRegex(waft.BadInput, f"FinishedRun.render: {name}: "):
                run.render(**{name: bad})

    def test_a_folder_of_before_is_read(self):
        folder = self.copy()
        self.change(folder, "report.json", lambda text: re.sub('"preview"', '"assimilated"', text))
        report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
        (folder / "report.json").write_text(json.dumps({key: report[key] for key in ("version", "scene", "seed", "quality")}), encoding="utf-8")
        with open(folder / "constraints.csv", encoding="utf-8", newline="") as stream:
            rows = list(csv.DictReader(stream))
        with open(folder / "constraints.csv", "w", encoding="utf-8", newline="") as stream:
            writer = csv.DictWriter(stream, [name for name in rows[0] if name not in ("TouchDown", "Settled", "LiftOff")], extrasaction="ignore")
            writer.writeheader()
            writer.writerows(rows)
        run = waft.load(folder)
        self.assertEqual(("air", 3, [], 2), (run.quality, run.status, run.warnings, len(run.marks)))
        self.assertEqual(self.flown.positions.tobytes(), run.positions.tobytes())

    def test_what_is_damaged_is_named(self):
        def cut(text):
            return text[:len(text) // 2]
        for name, change, words in (
                ("report.json", cut, "report.json: expected JSON"),
                ("report.json", lambda text: text.replace('"seed": 1', '"seed": "one"'), "report.json: /seed: expected a whole number"),
                ("report.json", lambda text: "[]", "report.json: /: expected"),
                ("report.json", None, "report.json: missing; expected the folder of a flight"),
                ("poses.vtp", cut, "poses.vtp"),
                ("poses.vtp", lambda text: text.replace('"Orientation"', '"Turn"'), "poses.vtp: the array Orientation is missing"),
                ("poses.vtp", lambda text: text.replace('"Velocity"', '"Speed"'), "poses.vtp: the array Velocity is missing"),
                ("poses.vtp", lambda text: text.replace('"Time"', '"Hour"'), "poses.vtp: the array Time is missing"),
                ("poses.vtp", None, "poses.vtp: missing"),
                ("shapes.vtm", cut, "shapes.vtm: expected a whole VTK XML file"),
                ("shapes.vtm", lambda text: text.replace('file="', 'file="../'), r"shapes.vtm: .*\.\."),
                ("objects.vtp", cut, "objects.vtp"),
                ("constraints.csv", lambda text: text.replace("position", "position", 1).replace(",40,", ",soon,"),
                 "constraints.csv: row 0: column Frame: expected a whole number, found 'soon'"),
                ("constraints.csv", None, "constraints.csv: missing"),
                ("obstacles.pvd", lambda text: text.replace('file="', 'file="/etc/'), "obstacles.pvd")):
            with self.subTest(name=name, words=words):
                folder = self.copy()
                self.change(folder, name, change)
                with self.assertRaisesRegex(waft.BadInput, words):
                    waft.load(folder)

    @staticmethod
    def change(folder, name, change):
        text = (folder / name).read_text(encoding="utf-8")
        (folder / name).unlink()
        if change is not None:
            (folder / name).write_text(change(text), encoding="utf-8")

    def test_a_strangers_folder_is_refused(self):
        secret = self.folder / "secret.vtp"
        shutil.copy(self.out / "poses.vtp", secret)
        folder = self.copy()
        (folder / "poses.vtp").unlink()
        (folder / "poses.vtp").symlink_to(secret)
        with self.assertRaisesRegex(waft.BadInput, "poses.vtp"):
            waft.load(folder)
        folder = self.copy()
        report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
        report["manifest"][0]["name"] = "../../secret.vtp"
        (folder / "report.json").write_text(json.dumps(report), encoding="utf-8")
        with self.assertRaisesRegex(waft.BadInput, "report.json: /manifest/0/name"):
            waft.load(folder)
        (self.folder / "empty").mkdir(exist_ok=True)
        for bad, words in ((self.folder / "none", "none: no such folder"), (self.out / "report.json", "report.json: no such folder"),
                           (self.folder / "empty", "report.json: missing; expected the folder of a flight"), (3, "load: folder: expected"),
                           (None, "load: folder: expected")):
            with self.assertRaisesRegex(waft.BadInput, words):
                waft.load(bad)

    def test_what_was_changed_since_is_told(self):
        folder = self.copy()
        text = (folder / "constraints.csv").read_text(encoding="utf-8")
        (folder / "constraints.csv").write_text(text + "\n", encoding="utf-8")
        run = waft.load(folder)
        self.assertEqual([*self.flown.warnings, f"{folder}/constraints.csv: it was changed since a run wrote it"], run.warnings)
        with self.assertRaisesRegex(waft.BadInput, "constraints.csv: expected the file that a run wrote, found another: nothing was copied"):
            run.save(self.folder / "nowhere")
        self.assertFalse((self.folder / "nowhere").exists())

    def test_a_folder_that_moved_is_read_from_where_it_is(self):
        folder = self.copy()
        run = waft.load(folder)
        moved = folder.with_name("moved")
        folder.rename(moved)
        self.assertEqual(self.flown.positions.tobytes(), run.positions.tobytes())
        for act in (run.page, lambda: run.save(self.folder / "nowhere"), lambda: run.page(self.folder / "p.html")):
            with self.assertRaisesRegex(waft.BadInput, "copy: no such folder"):
                act()
        again = waft.load(moved)
        self.assertEqual(self.flown.positions.tobytes(), again.positions.tobytes())
        self.assertEqual(str(moved / "page.html"), again.page())
        os.chdir(moved.parent)
        self.assertEqual(str(moved), waft.load("moved").folder)

    def test_it_is_copied_whole(self):
        run = waft.load(self.out)
        run.save(self.folder / "second")
        self.assertEqual(manifest_of(self.out), manifest_of(self.folder / "second"))
        self.assertEqual(str(self.folder / "second"), run.folder)
        self.assertEqual(self.flown.positions.tobytes(), waft.load(self.folder / "second").positions.tobytes())
        (self.folder / "mine").mkdir()
        (self.folder / "mine" / "poses.csv").write_text("mine", encoding="utf-8")
        with self.assertRaisesRegex(waft.BadInput, "poses.csv: no run of waft wrote it"):
            run.save(self.folder / "mine")
        self.assertEqual(["poses.csv"], os.listdir(self.folder / "mine"))

    def test_its_page_is_that_of_the_flight(self):
        run, page = waft.load(self.out), self.folder / "page of it.html"
        for _ in range(2):  # its own is replaced
            self.assertEqual(str(page), run.page(page))
        self.flown.page(self.folder / "page of the stages.html")
        self.assertEqual(page.read_bytes(), (self.folder / "page of the stages.html").read_bytes())
        page.write_text(page.read_text(encoding="utf-8") + "mine", encoding="utf-8")
        with self.assertRaisesRegex(waft.BadInput, "page of it.html: Waft did not write it, or it was changed since"):
            run.page(page)
        with self.assertRaisesRegex(waft.BadInput, "FinishedRun.page: path: expected a name that ends with .html"):
            run.page("page.txt")
        self.assertIn('<iframe sandbox="allow-scripts" srcdoc="&lt;!DOCTYPE html&gt;', run._repr_html_())


class TablesTest(Base):
    def test_pandas(self):
        """With pandas, else with a stand-in that has its DataFrame's beginning."""
        stand_in = types.ModuleType("pandas")
        stand_in.DataFrame = dict
        there = importlib.util.find_spec("pandas") is not None
        with mock.patch.dict(sys.modules, {} if there else {"pandas": stand_in}):
            for run in (self.flown, waft.load(self.out)):
                table = run.to_pandas()
                with open(self.out / "poses.csv", encoding="utf-8", newline="") as stream:
                    rows = list(csv.reader(stream))
                self.assertEqual(rows[0], list(table))
                written = np.array(rows[1:], float)
                found = np.array([np.asarray(table[name], float) for name in rows[0]]).T
                self.assertEqual(written.shape, found.shape)
                self.assertEqual(written[:, :10].tobytes(), np.ascontiguousarray(found[:, :10]).tobytes())
                np.testing.assert_allclose(found, written, rtol=1e-6, atol=1e-6)
        with mock.patch.dict(sys.modules, {"pandas": None}), self.assertRaisesRegex(
                waft.WaftError, "^pandas was not found .*: apt-get install python3-pandas$"):
            self.flown.to_pandas()

    def test_pyvista(self):
        """With a stand-in that has what is used of PyVista."""
        shown = []

        class MultiBlock(dict):
            pass

        class Plotter:
            def __init__(self):
                self.meshes = []

            def add_mesh(self, mesh, **look):
                self.meshes.append((mesh, look))

            def show(self, **options):
                shown.append((self.meshes, options))
                return "shown"

        stand_in = types.ModuleType("pyvista")
        stand_in.MultiBlock, stand_in.Plotter, stand_in.wrap = MultiBlock, Plotter, lambda data: data
        stand_in.read_texture = lambda path: ("texture", pathlib.Path(path).read_bytes()[:4])
        with mock.patch.dict(sys.modules, {"pyvista": stand_in}):
            for run in (self.flown, waft.load(self.out)):
                blocks = run.to_pyvista(frame=20)
                self.assertEqual(["bodies", "paths", "obstacles", "marks"], list(blocks))
                self.assertEqual({"painted", "plain"}, set(blocks["bodies"]))
                painted = blocks["bodies"]["painted"]
                index = run.object_ids.tolist().index(5)
                middle = np.array(painted.GetBounds()).reshape(3, 2).mean(axis=1)
                self.assertLess(np.linalg.norm(middle - run.positions[index, 20]), 0.1)
                self.assertEqual(41 * 3, blocks["paths"].GetNumberOfPoints())
                posed = waft.fetch(self.flown.rotation, "Meshes", time=self.flown.times[20])
                np.testing.assert_allclose(blocks["bodies"]["painted"].GetBounds(), self.bounds_of(posed, 5), atol=1e-6)
                self.assertEqual("shown", run.plot(frame=20, window_size=(64, 36)))
                meshes, options = shown.pop()
                self.assertEqual({"window_size": (64, 36)}, options)
                looks = [look for _, look in meshes]
                self.assertEqual(5, len(looks))
                self.assertIn(("texture", b"\x89PNG"), [look.get("texture") for look in looks])
                for name, bad in (("to_pyvista", 41), ("plot", -1)):
                    with self.assertRaisesRegex(waft.BadInput, f"{name}: frame: expected a whole number from 0 to 40"):
                        getattr(run, name)(frame=bad)
        with mock.patch.dict(sys.modules, {"pyvista": None}), self.assertRaisesRegex(
                waft.WaftError, "^pyvista was not found .*: pip install pyvista$"):
            self.flown.plot()

    @staticmethod
    def bounds_of(meshes, number):
        from vtkmodules.util.numpy_support import vtk_to_numpy

        own = vtk_to_numpy(meshes.GetPoints().GetData())[vtk_to_numpy(meshes.GetPointData().GetArray("ObjectId")) == number]
        return np.stack([own.min(axis=0), own.max(axis=0)], axis=1).ravel()


class HelpTest(unittest.TestCase):
    def test_nothing_private_is_in_help(self):
        text = pydoc.plain(pydoc.render_doc(waft))
        self.assertIn("load(folder", text)
        names = set(re.findall(r"(?<![\w.])_[a-zA-Z]\w*", text))
        self.assertEqual(set(), names)
        for kind in (waft.run.Run, waft.run.Result):
            self.assertEqual(set(), set(re.findall(r"(?<![\w.])_[a-zA-Z]\w*", pydoc.plain(pydoc.render_doc(kind)))))
        self.assertNotIn("_about", dir(waft.load(flown()[0] / "out")))
