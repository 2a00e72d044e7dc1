# SPDX-License-Identifier: BSD-3-Clause
"""What a user sees when a source or filter is first applied: each output of each proxy as its hints say, drawn by waft.show.

    pvbatch test_first_pictures.py XML_FOLDER SOURCE OUTPUT_FOLDER [--update]

OUTPUT_FOLDER gets a picture of each proxy. The pages show the baselines, which are links to Documentation/gallery/first_*.png."""
import math
import os
import pathlib
import shutil
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkGarbageCollector

import baseline
import picture
import sample_folder
import waft

SIDES = 6  # of a tube
MARK, NEAR = (0.6, 0.3, 2.4), (0.6, -0.9, 2.5)  # a place of a leaf at 1 s, and that of a camera
QUICK = {"Spacetime": {"NumberOfGasParticles": 216, "LeashIterations": 2, "MaximumNumberOfIterations": 6},
         "Assimilation": {"Resolution": 16, "LatticeResolution": 12, "Rounds": 0, "Candidates": 2}}
XML, SOURCE, PLACE = map(pathlib.Path, sys.argv[1:4])


def described():
    """{name: element} of each proxy of the plugin with outputs."""
    found = {}
    for path in sorted(XML.glob("*.xml")):
        for group in ElementTree.parse(path).getroot().iter("ProxyGroup"):
            found.update((e.get("name"), e) for e in group if e.tag.endswith("Proxy") and e.find("OutputPort") is not None)
    return found


def make_scene(path):
    scene = waft.Scene("First pictures", seed=5)
    scene.set_time(40)
    scene.add_objects("maple", count=5, region={"min": (-1, -1, 2.2), "max": (1, 1, 3)})
    for number, place in enumerate((MARK, (-0.5, 0.3, 2.5), (0.1, -0.4, 2.1))):
        scene.add_position(number, 30, place, radius=0.1)
    scene.add_box((-1.5, 1, 0), (-1, 1.5, 1.5))
    scene.add_vortex((0, 0, 1), (0, 0, 3), 0.1, 0.5, 0.5, 0.3)
    scene.add_wind((1, 0, 0), 0.5, (0, 0, 2), 1.0, 0.5, 0.5)
    scene.save(path)
    return str(path)


def make_all(folder):
    """{name: stage} of every proxy, with small inputs."""
    animation = simple.WaftAnimation(FileName=make_scene(folder / "first.waft.json"), Quality="Full")
    stages = waft.unfold(animation)
    for stage, values in QUICK.items():
        for name, value in values.items():
            setattr(stages[stage], name, value)
    scene, planner, drift, gas, turned = (stages[name] for name in ("Scene", "Planner", "Assimilation", "Spacetime", "Rotation"))
    animation.Quality = "Preview"  # the stages show what others have
    smoke = simple.GridSmokeSource(Resolution=[24, 24, 24], NumberOfFrames=40, WarmUpSeconds=2)
    traced = simple.TrajectoryTraceFilter(Input=smoke)
    port = simple.OutputPort
    vdb = str(SOURCE / "Testing" / "Pipeline" / "Fixtures" / "wind_0000.vdb")
    sample_folder.write(str(folder / "flight"))
    report = str(folder / "flight" / "report.json")
    pathlib.Path(report).write_text("{}", encoding="utf-8")
    photograph = str(SOURCE / "Data" / "Shapes" / "leaf-green.png")
    return {
        "WaftAnimation": animation, "MotionSceneReader": scene, "StylisticPlannerFilter": planner,
        "AirAssimilationFilter": drift, "SPHSpacetimeFilter": gas, "RotationRefineFilter": turned,
        "GridSmokeSource": smoke, "TrajectoryTraceFilter": traced,
        "TrajectoryClusterFilter": simple.TrajectoryClusterFilter(Input=traced),
        "MotionDatabaseSource": simple.MotionDatabaseSource(NumberOfSimulations=4, Resolution=16, NumberOfFrames=40),
        "VortexFitFilter": simple.VortexFitFilter(Input=port(gas, 0)),
        "ObjectSource": simple.ObjectSource(), "ConstraintSource": simple.ConstraintSource(Radius=0.2),
        "VortexSource": simple.VortexSource(CenterTime=0), "WindSource": simple.WindSource(CenterTime=0),
        "ObstacleSource": simple.ObstacleSource(Kind="Cylinder"),
        "ShapeKeyframeSource": simple.ShapeKeyframeSource(Text="WAFT", NumberOfTargets=60),
        "LeafShapeSource": simple.LeafShapeSource(), "FeatherShapeSource": simple.FeatherShapeSource(),
        "PhotographShapeSource": simple.PhotographShapeSource(Photograph=photograph),
        "MotionSceneWriter": simple.MotionSceneWriter(Objects=port(scene, 0), Constraints=port(scene, 1), Obstacles=port(scene, 2)),
        "MotionAnimationWriter": simple.MotionAnimationWriter(Poses=port(turned, 1), Objects=port(scene, 0), Shapes=port(scene, 3)),
        "MotionResultsReader": simple.MotionResultsReader(FileName=report),
        "VDBReader": simple.VDBReader(FileName=vdb),
        "VDBWriter": simple.VDBWriter(Input=port(smoke, 0)),
    }


class FirstPicturesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        PLACE.mkdir(parents=True, exist_ok=True)
        vtkGarbageCollector.DeferredCollectionPush()  # or VTK looks through all views and stages each time that one is shown
        cls.addClassCleanup(vtkGarbageCollector.DeferredCollectionPop)
        cls.stages = make_all(pathlib.Path(folder.name))
        cls.looks = {element.get("name"): element.findall("Hints/FirstPicture")
                     for element in ElementTree.parse(XML / "Representations.xml").getroot().iter("MotionRepresentationProxy")}

    def fresh_view(self):
        """Of a test alone: each step of the session's time draws all views that there are."""
        view = simple.CreateRenderView()
        self.addCleanup(simple.Delete, view)
        view.OrientationAxesVisibility = 0
        return view

    def test_every_proxy_is_there(self):
        self.assertEqual(set(self.stages), set(described()))

    def test_every_output_says_how_it_is_shown(self):
        for name, element in described().items():
            views = {hint.get("port"): hint.get("type") for hint in element.iter("View")}
            kinds = {hint.get("port"): hint.get("type") for hint in element.iter("Representation")}
            for number, port in enumerate(element.findall("OutputPort")):
                with self.subTest(proxy=name, port=port.get("name")):
                    self.assertTrue(str(number) in views or str(number) in kinds, "no entry")
                    self.assertIn(kinds.get(str(number), next(iter(self.looks))), self.looks)
                    about = simple.OutputPort(self.stages[name], number).GetDataInformation().DataInformation
                    self.stages[name].UpdatePipeline()
                    if about.GetDataClassName() == "vtkTable":
                        self.assertIn(str(number), views, "a table is not shown in space")

    def test_it_looks_as_its_kind(self):
        view = self.fresh_view()
        seen = set()
        for name, element in described().items():
            for hint in element.iter("Representation"):
                output = simple.OutputPort(self.stages[name], int(hint.get("port")))
                output.UpdatePipeline()
                if output.GetDataInformation().GetNumberOfPoints() == 0:
                    continue
                with self.subTest(proxy=name, port=hint.get("port"), kind=hint.get("type")):
                    shown = simple.Show(output, view)
                    self.assertEqual(shown.SMProxy.GetXMLName(), hint.get("type"))
                    look = next(look for look in self.looks[hint.get("type")] if not look.get("color") or is_there(output, look))
                    self.assertEqual(shown.Representation, look.get("type"))
                    self.assertEqual(shown.ColorArrayName[1] or None, look.get("color"))
                    for held in look:
                        value = shown.SMProxy.GetProperty(held.get("name"))
                        if value.IsA("vtkSMProxyProperty"):
                            self.assertEqual(value.GetProxy(0).GetXMLName(), held.get("value"))
                        elif isinstance(value.GetElement(0), str):
                            self.assertIn(held.get("value"), [value.GetElement(i) for i in range(value.GetNumberOfElements())])
                        else:
                            self.assertAlmostEqual(float(value.GetElement(0)), float(held.get("value").split()[0]))
                    seen.add(hint.get("type"))
        self.assertEqual(seen, set(self.looks), "kinds that no output was shown in")

    def test_every_picture_shows_something(self):
        for name, stage in self.stages.items():
            with self.subTest(proxy=name):
                stage.UpdatePipeline()
                views = waft.show(stage, self.fresh_view())
                for number, view in enumerate(views):
                    if hasattr(view, "CameraPosition"):
                        at_the_end()
                    path = PLACE / f"first_{name}{'_second' if number else ''}.png"
                    self.assert_as_baseline(view, path)
                    drawn = picture.read(str(path))
                    behind = np.median(drawn, axis=1, keepdims=True)  # of a line: the background changes upwards alone
                    self.assertGreater(np.mean(np.abs(drawn - behind).max(axis=2) > 24), 0.002, "next to nothing is drawn")
                for chart in views[1:]:
                    simple.Delete(chart)
                self.doCleanups()

    def assert_as_baseline(self, view, path, size=(600, 400)):
        simple.SaveScreenshot(str(path), view, ImageResolution=size)
        kept = SOURCE / "Data" / "Baseline" / path.name
        if "--update" in sys.argv:
            shutil.copyfile(path, kept)
        self.assertLessEqual(baseline.error(path, kept), baseline.THRESHOLD, path.name)

    def test_a_body_that_is_a_frame_late_is_seen(self):
        view, = waft.show(self.stages["RotationRefineFilter"], self.fresh_view())
        view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = NEAR, MARK, (0, 0, 1)
        view.ViewTime = 1.0
        self.assert_as_baseline(view, PLACE / "first_leaf.png", [300, 200])
        view.ViewTime -= 1.0 / 30.0
        simple.SaveScreenshot(str(PLACE / "late.png"), view, ImageResolution=[300, 200])
        self.assertGreater(baseline.error(PLACE / "late.png", SOURCE / "Data" / "Baseline" / "first_leaf.png"), 5 * baseline.THRESHOLD)

    def test_an_animation_snaps_to_the_frames_of_a_scene(self):
        view = self.fresh_view()
        view.ViewSize = [60, 40]
        waft.show(self.stages["WaftAnimation"], view)
        scene = simple.GetAnimationScene()
        steps = list(simple.GetTimeKeeper().TimestepValues)
        self.assertTrue(set(self.stages["WaftAnimation"].TimestepValues) <= set(steps))
        self.assertGreaterEqual(scene.NumberOfFrames, 40)
        before = str(scene.PlayMode).strip("'")
        scene.PlayMode = "Snap To TimeSteps"
        simple.SaveAnimation(str(PLACE / "snap.png"), view, FrameWindow=[0, 9])
        scene.PlayMode = before
        self.assertEqual(len(list(PLACE.glob("snap.*.png"))), 10)

    def test_numbers_of_objects_have_no_bar(self):
        view = self.fresh_view()
        for name, port, has in (("RotationRefineFilter", 0, False), ("StylisticPlannerFilter", 0, False), ("SPHSpacetimeFilter", 1, True)):
            with self.subTest(proxy=name, port=port):
                shown = simple.Show(simple.OutputPort(self.stages[name], port), view)
                self.assertEqual(bool(shown.SMProxy.SetScalarBarVisibility(view.SMProxy, True)), has)

    def test_the_sampled_air_is_shown_by_its_streamlines(self):
        drift = self.stages["AirAssimilationFilter"]
        view, = waft.show(drift, self.fresh_view(), port=1)
        at_the_end()
        simple.GetRepresentation(simple.OutputPort(drift, 1), view).RescaleTransferFunctionToDataRange()
        self.assert_as_baseline(view, PLACE / "first_AirAssimilationFilter_air.png")

    def test_streamlines_of_what_turns_are_circles(self):
        extent, length = 20, 0.5
        turning = simple.Calculator(Input=simple.Wavelet(WholeExtent=[-extent, extent] * 3), ResultArrayName="Velocity",
                                    Function="-coordsY*iHat+coordsX*jHat")
        turning.UpdatePipeline()
        shown = simple.Show(turning, self.fresh_view(), "MotionAirRepresentation")
        shown.NumberOfLines, shown.LineLength, shown.TubeRadius = 30, length, 0.001
        lines = tubes_of(shown)
        self.assertGreater(len(lines), 25, "but for some at the edge")
        diagonal = 2 * extent * math.sqrt(3)
        whole = 0
        for places in lines:
            radii = np.hypot(places[:, 0], places[:, 1])
            self.assertLess(np.ptp(radii), 0.05 + 0.001 * 2 * diagonal)
            self.assertLess(np.ptp(places[:, 2]), 0.01 + 0.001 * 2 * diagonal)
            angles = np.unwrap(np.arctan2(places[:, 1], places[:, 0]))
            self.assertGreater(angles[-1], angles[0], "lines go the way the air does, thickest at their ends")
            whole += abs((angles[-1] - angles[0]) * radii.mean() - length * diagonal) < 0.05 * length * diagonal
        self.assertGreater(whole, 15, "lines end early only where they leave the data")

    def test_spirals_turn_as_their_vortices_do(self):
        for strength in (0.5, -0.5):
            vortex = simple.VortexSource(Strength=strength, CoreRadius=0.2)
            shown = simple.Show(vortex, self.fresh_view())
            ends = vtk_to_numpy(vortex.GetClientSideObject().GetOutputDataObject(0).GetPoints().GetData())
            along = (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0])
            turns = [line for line in tubes_of(shown, 8) if len(line) > 8]  # the axis has two points
            self.assertGreater(len(turns), 3)
            for line in turns:
                away = line - ends[0]
                away -= np.outer(away @ along, along)
                np.testing.assert_allclose(np.linalg.norm(away, axis=1), 0.2, rtol=0.1)
                self.assertTrue((np.cross(away[:-1], away[1:]) @ along * strength > 0.0).all(), "each way it turns")

    def test_fields_without_vectors_have_no_streamlines(self):
        plain = simple.Wavelet()
        shown = simple.Show(plain, self.fresh_view(), "MotionAirRepresentation")
        shown.Representation = "Streamlines"
        self.assertEqual(tubes_of(shown), [])

    def test_streamlines_that_cannot_be_are_not_drawn(self):
        blowing = simple.Calculator(Input=simple.Wavelet(WholeExtent=[-5, 5] * 3), ResultArrayName="Wind", Function="iHat")
        shown = simple.Show(blowing, self.fresh_view(), "MotionAirRepresentation")
        shown.Representation = "Streamlines"
        for name, value in (("NumberOfLines", -5), ("LineLength", -1), ("LineLength", math.nan), ("TubeRadius", 0), ("TubeRadius", math.nan)):
            with self.subTest(name=name, value=value):
                usual = getattr(shown, name)
                setattr(shown, name, value)
                self.assertEqual(tubes_of(shown), [])
                setattr(shown, name, usual)
                self.assertGreater(len(tubes_of(shown)), 50)

    def test_changes_of_a_user_stay(self):
        view = self.fresh_view()
        shown = simple.Show(simple.OutputPort(self.stages["StylisticPlannerFilter"], 0), view)
        shown.LineWidth = 7
        simple.ColorBy(shown, None)
        self.stages["StylisticPlannerFilter"].UpdatePipeline()
        simple.Render(view)
        self.assertEqual(shown.LineWidth, 7)
        self.assertEqual(shown.ColorArrayName[1], "")

    def test_what_cannot_be_shown_is_said(self):
        for wrong in (None, "Planner", 3, [None]):
            with self.assertRaises(waft.BadInput) as caught:
                waft.show(wrong)
            self.assertIn("show: expected a stage", str(caught.exception))
        for wrong in (-1, 8, "Tracks"):
            with self.assertRaises(waft.BadInput) as caught:
                waft.show(self.stages["StylisticPlannerFilter"], port=wrong)
            self.assertIn("show: port: expected a whole number from 0 to 7", str(caught.exception))

    def test_costs_are_a_chart_with_a_logarithmic_axis(self):
        charts = [view for view in waft.show(self.stages["SPHSpacetimeFilter"], self.fresh_view()) if hasattr(view, "LeftAxisLogScale")]
        self.assertEqual(len(charts), 1)
        self.assertEqual(charts[0].LeftAxisLogScale, 1)
        self.assertEqual(list(charts[0].Representations[0].SeriesVisibility), ["E", "Ec", "Ev", "Ex"])


def is_there(output, look):
    """Whether the array of a look is; of vectors that are zero everywhere nothing is to be seen."""
    array = {"CELLS": output.CellData, "POINTS": output.PointData}[look.get("of")].GetArray(look.get("color"))
    return array is not None and (array.GetNumberOfComponents() != 3 or array.GetRange(-1)[1] > 1e-30)


def tubes_of(shown, sides=SIDES):
    """The middle of each line that is drawn as a tube, a point a row [m], its beginning first."""
    simple.Render(simple.GetActiveView())
    blocks = shown.SMProxy.GetClientSideObject().GetRenderedDataObject(0)
    drawn = blocks.GetPartition(0, 0) if hasattr(blocks, "GetPartition") else blocks.GetBlock(0)  # since ParaView 5.12, and before
    cells = drawn.GetStrips()
    ids = vtk_to_numpy(cells.GetConnectivityArray()) if cells.GetNumberOfCells() else np.zeros(0, int)
    ends = vtk_to_numpy(cells.GetOffsetsArray()) if cells.GetNumberOfCells() else np.zeros(1, int)
    places = vtk_to_numpy(drawn.GetPoints().GetData()) if len(ids) else np.zeros((0, 3))
    strips = [places[ids[begin:end]] for begin, end in zip(ends[:-1], ends[1:]) if end - begin > sides]
    return [np.mean([(strip[0::2] + strip[1::2]) / 2 for strip in strips[i:i + sides]], axis=0) for i in range(0, len(strips), sides)]


def at_the_end():
    scene = simple.GetAnimationScene()
    scene.AnimationTime = scene.EndTime


if __name__ == "__main__":
    done = unittest.main(argv=sys.argv[:1], exit=False)
    sys.stdout.flush()
    os._exit(0 if done.result.wasSuccessful() else 1)  # views of many kinds end in any order
