# SPDX-License-Identifier: BSD-3-Clause
"""What File > Open makes of Waft's files, and how a finished flight looks: skins, rings, ground, by numbers on pictures.

    pvbatch run.py test_opened.py OUTPUT_FOLDER"""
import json
import pathlib
import shutil
import sys
import tempfile
import unittest

import numpy as np
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

import sample_folder
import waft
from waft.watching import collect

PLACE = pathlib.Path(sys.argv[1])
SIZE = (640, 360)
LEAST_SHARE = 0.0025  # of the picture that the sample's five leaves, seen from the side, and a bubble take
LEAST_CONTRAST = 40.0  # of 255, of bodies against what is behind them


def pixels(view, name):
    path = PLACE / f"{name}.png"
    simple.SaveScreenshot(str(path), view, ImageResolution=list(SIZE))
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    drawn = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())[:, :3]
    return drawn.reshape(SIZE[1], SIZE[0], 3).astype(float)


def surface(output):
    return output.GetClientSideObject().GetOutputDataObject(output.Port)


def results(folder, **changes):
    """A folder of the sample's results; its report.json."""
    folder = pathlib.Path(folder)
    sample_folder.write(str(folder), **changes)
    (folder / "report.json").write_text(json.dumps({"version": "0", "manifest": []}), encoding="utf-8")
    return folder / "report.json"


class OpenedTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        PLACE.mkdir(parents=True, exist_ok=True)
        cls.root = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.report = results(cls.root / "flight")
        cls.positions, _ = sample_folder.motion()

    def setUp(self):
        self.addCleanup(simple.ResetSession)

    def messages(self, report):
        """What a reader says of a folder."""
        reader, said = simple.MotionResultsReader(FileName=str(report)), []
        collect(reader.GetClientSideObject(), "ErrorEvent", said)
        with self.assertRaises(waft.BadInput) as caught:
            waft.update(reader)
        self.assertEqual(surface(reader["Meshes"]).GetNumberOfPoints(), 0)
        self.assertEqual(len(said), 1, said)
        return str(caught.exception)

    def test_a_scene_opens_as_what_flies_it(self):
        scene = waft.Scene(seed=5)
        scene.set_time(20)
        scene.add_objects("maple", positions=[(0, 0, 2)])
        scene.save(self.root / "one.waft.json")
        self.assertEqual(simple.OpenDataFile(str(self.root / "one.waft.json")).SMProxy.GetXMLName(), "WaftAnimation")

    def test_results_open_by_their_report_and_poses_as_data(self):
        self.assertEqual(simple.OpenDataFile(str(self.report)).SMProxy.GetXMLName(), "MotionResultsReader")
        poses = simple.OpenDataFile(str(self.report.with_name("poses.vtp")))
        self.assertEqual(poses.SMProxy.GetXMLName(), "XMLPolyDataReader")

    def test_bodies_are_where_the_poses_are(self):
        reader = simple.MotionResultsReader(FileName=str(self.report))
        self.assertEqual(len(reader.TimestepValues), sample_folder.FRAMES)
        for frame in (0, 33, 60):
            reader.UpdatePipeline(frame / sample_folder.RATE)
            meshes = surface(reader["Meshes"])
            places = vtk_to_numpy(meshes.GetPoints().GetData())
            ids = vtk_to_numpy(meshes.GetPointData().GetArray("ObjectId"))
            for number, at in enumerate(self.positions[:, frame]):
                own = places[ids == number]
                self.assertLess(np.abs((own.min(axis=0) + own.max(axis=0)) / 2 - at).max(), 0.2)
        names = meshes.GetFieldData().GetAbstractArray("Texture")
        self.assertEqual([names.GetValue(i) for i in range(2)], [str(self.report.with_name("leaf.png")), ""])

    def test_bodies_say_how_fast_they_are_and_when_they_lie(self):
        reader = simple.MotionResultsReader(FileName=str(self.report))
        for frame, before, after in ((0, 0, 1), (33, 32, 34), (60, 59, 60)):
            reader.UpdatePipeline(frame / sample_folder.RATE)
            arrays = surface(reader["Meshes"]).GetPointData()
            ids, speeds, settled = (vtk_to_numpy(arrays.GetArray(name)) for name in ("ObjectId", "Speed", "Settled"))
            ways = self.positions[:, after] - self.positions[:, before]
            wanted = np.linalg.norm(ways, axis=1) * sample_folder.RATE / (after - before)
            np.testing.assert_allclose(speeds, wanted[ids], rtol=1e-5, atol=1e-6)
            np.testing.assert_array_equal(settled, np.where(ids < 2, 48, -1))

    def test_rests_say_on_what_bodies_come_to_lie(self):
        reader = simple.MotionResultsReader(FileName=str(self.report))
        waft.update(reader)
        rows = surface(reader["Marks"])
        kinds = vtk_to_numpy(rows.GetPointData().GetArray("Kind"))
        heights = vtk_to_numpy(rows.GetFieldData().GetArray("LandingHeight"))
        np.testing.assert_array_equal(np.isnan(heights), kinds != 4)
        np.testing.assert_allclose(heights[kinds == 4], self.positions[:2, 48, 2])  # these bodies have no height of rest

    def test_marks_say_what_became_of_them(self):
        reader = simple.MotionResultsReader(FileName=str(self.report))
        waft.update(reader)
        self.assertEqual(set(vtk_to_numpy(surface(reader["Marks"]).GetPointData().GetArray("Status")).tolist()), {0})
        missed = results(self.root / "missed")
        positions = self.positions.copy()
        positions[2, 40] += 0.3
        sample_folder._write_constraints(str(missed.with_name("constraints.vtp")), positions)
        reader = simple.MotionResultsReader(FileName=str(missed))
        waft.update(reader)
        marks = surface(reader["Marks"]).GetPointData()
        rows, statuses = (vtk_to_numpy(marks.GetArray(name)) for name in ("Row", "Status"))
        self.assertEqual(set(rows[statuses != 0].tolist()), {0})

    def test_a_state_reads_the_folder_again(self):
        waft.show(simple.MotionResultsReader(FileName=str(self.report), registrationName="Flight"))
        state = str(self.root / "flight.pvsm")
        simple.SaveState(state)
        simple.ResetSession()
        simple.LoadState(state)
        reader = simple.FindSource("Flight")
        waft.update(reader)
        self.assertGreater(surface(reader["Meshes"]).GetNumberOfPoints(), 0)

    def test_what_is_missing_or_wrong_is_named(self):
        for name in ("poses.vtp", "objects.vtp", "shapes/shapes_0.vtp", "obstacles.vtp"):
            report = results(self.root / f"without-{name.replace('/', '-')}")
            report.with_name(name).unlink() if "/" not in name else (report.parent / name).unlink()
            with self.subTest(name):
                self.assertIn(f"{report.parent / name}: expected a file that `waft synthesize` wrote, found none", self.messages(report))
            (report.parent / name).write_text("half", encoding="utf-8")
            with self.subTest(name, wrong=True):
                self.assertIn(str(report.parent / name), self.messages(report))
        self.assertIn("no-such/report.json: expected the report of a folder of results", self.messages(self.root / "no-such" / "report.json"))

    def test_no_name_leads_out_of_the_folder(self):
        outside = self.root / "outside.png"
        shutil.copy(self.report.with_name("leaf.png"), outside)
        linked = results(self.root / "linked")
        linked.with_name("leaf.png").unlink()
        linked.with_name("leaf.png").symlink_to(outside)
        reader = simple.MotionResultsReader(FileName=str(linked))
        waft.update(reader)
        self.assertEqual(surface(reader["Meshes"]).GetFieldData().GetAbstractArray("Texture").GetValue(0), "")
        shapes = results(self.root / "above")
        shutil.move(shapes.parent / "shapes", self.root / "elsewhere")
        (shapes.parent / "shapes").symlink_to(self.root / "elsewhere")
        self.assertIn("shapes_0.vtp: expected a file that `waft synthesize` wrote, found none", self.messages(shapes))
        texts = shapes.with_name("shapes.vtm")
        texts.write_text(texts.read_text(encoding="utf-8").replace("shapes/shapes_0.vtp", "../../../etc/passwd"), encoding="utf-8")
        self.assertNotIn("passwd", self.messages(shapes))

    def test_a_repaired_folder_is_read_again(self):
        report = results(self.root / "repaired")
        poses = report.with_name("poses.vtp")
        poses.rename(report.with_name("kept"))
        reader = simple.MotionResultsReader(FileName=str(report))
        collect(reader.GetClientSideObject(), "ErrorEvent", [])
        with self.assertRaises(waft.BadInput):
            waft.update(reader)
        report.with_name("kept").rename(poses)
        self.assertTrue(simple.ReloadFiles(reader))
        waft.update(reader)
        self.assertGreater(surface(reader["Meshes"]).GetNumberOfPoints(), 0)


class PictureTest(unittest.TestCase):
    """The sample's leaves have a brown skin with a pale vein, cut to their outline; its bubbles are films."""

    @classmethod
    def setUpClass(cls):
        cls.root = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        simple.ResetSession()
        cls.reader = simple.MotionResultsReader(FileName=str(results(cls.root)))
        cls.view = simple.CreateRenderView()
        cls.view.ViewSize = list(SIZE)
        cls.view.OrientationAxesVisibility = 0
        waft.show(cls.reader, cls.view)
        cls.shown = {name: simple.GetRepresentation(cls.reader[name], cls.view) for name in ("Meshes", "Poses", "Marks", "Obstacles")}

    def at(self, frame):
        simple.GetAnimationScene().AnimationTime = frame / sample_folder.RATE

    def taken(self, name, port="Meshes"):
        """(what is seen, what is behind, mask) of an output; shadows, which darken all colours alike, are not in the mask."""
        seen = pixels(self.view, name)
        self.shown[port].Visibility = 0
        behind = pixels(self.view, f"{name}_without")
        self.shown[port].Visibility = 1
        darker = behind - seen
        return seen, behind, (np.abs(darker).max(axis=2) > 8) & ((darker.min(axis=2) < 0.0) | (np.ptp(darker, axis=2) > 16.0))

    def test_bodies_are_seen_in_their_skins(self):
        self.at(20)
        seen, behind, mask = self.taken("bodies")
        self.assertGreater(mask.mean(), LEAST_SHARE)
        self.assertGreater(np.abs(seen - behind).max(axis=2)[mask].mean(), LEAST_CONTRAST)
        red, green, blue = np.moveaxis(seen[mask], 1, 0)
        brown = (red > 1.3 * green) & (green > 1.1 * blue)
        self.assertGreater(brown.mean(), 0.25, "the texture's colour")
        self.assertEqual([self.shown[name].Representation for name in ("Meshes", "Marks", "Obstacles")], ["Skins", "Rings", "Scenery"])

    def test_the_outline_is_cut_out_and_films_let_the_back_be_seen(self):
        self.at(20)
        _, _, mask = self.taken("outline")
        self.shown["Meshes"].Representation = "Surface"
        try:
            _, _, whole = self.taken("whole")
        finally:
            self.shown["Meshes"].Representation = "Skins"
        self.assertLess(mask.sum(), 0.97 * whole.sum(), "corners of the sheets are clear")

    def test_an_array_that_is_asked_for_colours_bodies(self):
        self.at(20)
        skins = pixels(self.view, "skins")
        simple.ColorBy(self.shown["Meshes"], ("POINTS", "ObjectId"))
        try:
            colored = pixels(self.view, "colored")
        finally:
            simple.ColorBy(self.shown["Meshes"], None)
        self.assertGreater(np.abs(colored - skins).max(axis=2).max(), 60)
        again = pixels(self.view, "again")
        self.assertLess(np.abs(again - skins).mean(), 1.0)

    def test_opacity_and_places_of_a_representation_hold(self):
        self.at(20)
        whole, behind, mask = self.taken("opaque")
        self.shown["Meshes"].Opacity = 0.3
        try:
            faint = pixels(self.view, "faint")
        finally:
            self.shown["Meshes"].Opacity = 1.0
        self.assertLess(np.abs(faint - behind)[mask].mean(), 0.6 * np.abs(whole - behind)[mask].mean())

    def test_bodies_can_be_picked(self):
        self.at(20)
        for name in ("Poses", "Marks", "Obstacles"):
            self.shown[name].Visibility = 0
        try:
            simple.Render(self.view)
            simple.SelectSurfaceCells(Rectangle=[0, 0, SIZE[0] - 1, SIZE[1] - 1], View=self.view)
            self.assertIsNotNone(self.reader.SMProxy.GetSelectionInput(0), "cells of the meshes")
        finally:
            simple.ClearSelection()
            for name in ("Poses", "Marks", "Obstacles"):
                self.shown[name].Visibility = 1

    def test_rings_are_green_once_they_are_met(self):
        colors = {}
        for frame in (10, 60):
            self.at(frame)
            seen, _, mask = self.taken(f"rings_{frame}", "Marks")
            self.assertGreater(mask.sum(), 20)
            colors[frame] = np.median(seen[mask], axis=0)
        self.assertGreater(colors[10][0], 1.3 * colors[10][1], "orange before")
        self.assertGreater(colors[60][1], 1.3 * colors[60][0], "green after")

    def on_picture(self, places):
        """Column and row of places in the picture, [n, 2]."""
        camera = self.view.GetActiveCamera().GetCompositeProjectionTransformMatrix(SIZE[0] / SIZE[1], -1.0, 1.0)
        matrix = np.array([[camera.GetElement(row, column) for column in range(4)] for row in range(4)])
        seen = np.append(places, np.ones((len(places), 1)), axis=1) @ matrix.T
        return ((seen[:, :2] / seen[:, 3:] + 1.0) * 0.5 * SIZE).astype(int)

    def test_rings_of_rests_lie_where_bodies_do(self):
        self.at(60)
        seen, _, mask = self.taken("lying", "Marks")
        rows = surface(self.reader["Marks"])
        kinds = vtk_to_numpy(rows.GetPointData().GetArray("Kind"))
        heights = vtk_to_numpy(rows.GetFieldData().GetArray("LandingHeight"))
        angles = np.arange(16) * np.pi / 8
        away = 0.86 * 2.5 * 0.006 * np.linalg.norm([2.0, 2.0, 2.0])  # in the middle of the band
        for rest in np.flatnonzero(kinds == 4):
            x, y, _ = rows.GetPoint(rest)
            places = np.column_stack([x + away * np.cos(angles), y + away * np.sin(angles), np.full(16, heights[rest])])
            found = [mask[row - 1:row + 2, column - 1:column + 2].any() for column, row in self.on_picture(places)]
            self.assertGreater(sum(found), 8, "the body may hide a part")

    def test_bodies_have_shadows_on_the_ground(self):
        self.at(20)
        seen, behind, _ = self.taken("shadows")
        positions, _ = sample_folder.motion()
        below = positions[[0, 1, 5], 20] * [1.0, 1.0, 0.0]  # those that nothing stands under
        for column, row in self.on_picture(below):
            darker = (behind - seen)[row, column]
            self.assertGreater(darker.min(), 15.0)

    def test_colours_are_taken_as_they_are(self):
        self.at(20)
        skins = self.shown["Meshes"]
        simple.ColorBy(skins, ("POINTS", "Color"))
        try:
            drawn, _, mask = self.taken("colors")
            self.assertEqual(skins.MapScalars, 0)
        finally:
            simple.ColorBy(skins, ("POINTS", "Speed"))
            self.assertEqual(skins.MapScalars, 1)
            simple.ColorBy(skins, None)
        red, green, blue = np.moveaxis(drawn[mask], 1, 0)
        self.assertGreater(((red > 1.2 * green) & (green > 1.05 * blue)).mean(), 0.25, "the texture's brown")

    def test_paths_that_are_coloured_are_tubes(self):
        self.at(20)
        faint = self.taken("faint", "Poses")[2].sum()
        simple.ColorBy(self.shown["Poses"], ("CELLS", "ObjectId"))
        try:
            colored = self.taken("tubes", "Poses")[2].sum()
        finally:
            simple.ColorBy(self.shown["Poses"], None)
        self.assertGreater(colored, 2 * faint)

    def test_films_go_at_the_pace_of_the_scene(self):
        proxies = servermanager.ActiveConnection.Session.GetSessionProxyManager()
        saving = proxies.NewProxy("misc", "SaveAnimation")
        controller = servermanager.vtkSMParaViewPipelineController()
        controller.PreInitializeProxy(saving)
        controller.PostInitializeProxy(saving)
        self.assertEqual(servermanager.vtkSMPropertyHelper(saving, "FrameRate").GetAsInt(), 30)
        self.assertEqual(simple.GetAnimationScene().Duration, 2)

    def test_the_ground_passes_into_the_background(self):
        self.at(20)
        self.assertEqual(str(self.view.BackgroundColorMode).strip("'"), "Gradient")
        picture = pixels(self.view, "ground")
        for edge in (picture[:, :3], picture[:, -3:]):
            steps = np.abs(np.diff(edge.mean(axis=1), axis=0)).max()
            self.assertLess(steps, 12.0, "no edge of a slab is seen")

    def test_a_background_that_was_chosen_stays(self):
        view = simple.CreateRenderView()
        view.UseColorPaletteForBackground = 0
        view.Background = [1, 1, 1]
        waft.show(self.reader, view)
        self.assertEqual((list(view.Background), str(view.BackgroundColorMode).strip("'")), ([1, 1, 1], "Single Color"))
