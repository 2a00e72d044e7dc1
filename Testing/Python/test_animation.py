# SPDX-License-Identifier: BSD-3-Clause
"""The source Waft Animation: its colours, seeds, stages, states and errors. That its stages run as
far as they are asked and give what waft.synthesize gives is for test_faces.py.

    pvpython run.py test_animation.py"""
import contextlib
import os
import pathlib
import tempfile
import unittest

import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

from vtkmodules.vtkCommonCore import VTK_STRING, vtkOutputWindow

import waft
from waft.watching import collect

# As version 0.1 saved a source that bundled its stages, but for their times.
OLD_STATE = """<ParaView><ServerManagerState version="5.11.0">
<Proxy group="sources" type="WaftAnimation" id="2761" servers="1">
  <Property name="Quality" id="2761.Quality" number_of_elements="1"><Element index="0" value="0"/></Property>
  <Property name="Seed" id="2761.Seed" number_of_elements="1"><Element index="0" value="9"/></Property>
  <Property name="ShowStages" id="2761.ShowStages" number_of_elements="1"><Element index="0" value="1"/></Property>
  <Property name="Slice" id="2761.Slice" number_of_elements="1"><Element index="0" value="0"/></Property>
  <Property name="StopAfter" id="2761.StopAfter" number_of_elements="1"><Element index="0" value="1"/></Property>
  <Property name="FileName" id="2761.FileName" number_of_elements="1"><Element index="0" value="SCENE"/></Property>
  <Property name="NumberOfTakes" id="2761.NumberOfTakes" number_of_elements="1"><Element index="0" value="1"/></Property>
  <Property name="Take" id="2761.Take" number_of_elements="1"><Element index="0" value="0"/></Property>
</Proxy>
<ProxyCollection name="sources"><Item id="2761" name="Flight" logname="Flight"/></ProxyCollection>
</ServerManagerState></ParaView>"""


def make_scene(folder):
    """A scene of 40 frames: two leaves, two marks and a wind."""
    scene = waft.Scene("Short", seed=5)
    scene.set_time(40)
    scene.add_objects("maple", count=2, region={"min": (-0.5, -0.5, 2.5), "max": (0.5, 0.5, 3)})
    scene.add_position(0, 30, (0.2, 0.1, 2.5), radius=0.1)
    scene.add_position(1, 30, (-0.2, 0.1, 2.5), radius=0.1)
    scene.add_wind((1, 0, 0), 0.5, (0, 0, 2), 1.0, 0.5, 0.5)
    path = os.path.join(folder, "short.waft.json")
    scene.save(path)
    return path


def output(source, port=0):
    """The data of a port, by number or name."""
    number = port if isinstance(port, int) else source[port].Port
    return source.GetClientSideObject().GetOutputDataObject(number)


def places(data):
    return vtk_to_numpy(data.GetPoints().GetData()) if data.GetNumberOfPoints() else np.empty((0, 3))


class AnimationTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.scene = make_scene(folder.name)

    def make(self, **properties):
        """An animation that has run."""
        animation = simple.WaftAnimation(FileName=self.scene, **properties)
        self.addCleanup(lambda: simple.Delete(animation))
        animation.UpdatePipeline()
        return animation

    @contextlib.contextmanager
    def unfolded(self, animation):
        stages = waft.unfold(animation)
        try:
            yield stages
        finally:
            for stage in reversed(list(stages.values())):
                simple.Delete(stage)

    def ports(self, animation):
        """{port: points of a surface or picture, rows of a table}"""
        found = {}
        for name in (animation.SMProxy.GetOutputPortName(i) for i in range(animation.SMProxy.GetNumberOfOutputPorts())):
            about = animation[name].GetDataInformation()
            found[name] = about.GetNumberOfPoints() or about.DataInformation.GetNumberOfRows()
        return found

    def test_bodies_have_the_colours_of_their_shapes(self):
        scene = waft.Scene(seed=5)
        scene.set_time(10)
        scene.add_shape("plain", builtin="disc", color=(0.2, 0.4, 1.0))
        scene.add_shape("painted", builtin="maple", texture=waft.data_file("Shapes/maple-red.png"))
        scene.add_shape("tinted", builtin="maple", texture=waft.data_file("Shapes/maple-red.png"), color=(0.5, 1.0, 1.0))
        for shape, x in (("plain", -1), ("painted", 0), ("tinted", 1)):
            scene.add_object(shape, (x, 0, 3))
        path = str(self.folder / "coloured.waft.json")
        scene.save(path)
        animation = simple.WaftAnimation(FileName=path)
        self.addCleanup(lambda: simple.Delete(animation))
        animation.UpdatePipeline()
        points = output(animation, "Meshes").GetPointData()
        colors, shapes = (vtk_to_numpy(points.GetArray(name)) for name in ("Color", "ShapeId"))
        plain, painted, tinted = (colors[shapes == k].astype(int) for k in range(3))
        self.assertEqual({tuple(color) for color in plain}, {(51, 102, 255)})
        self.assertGreater(len(np.unique(painted, axis=0)), 5, "the texture's, at each point")
        self.assertGreater(painted[:, 0].mean(), 2 * painted[:, 2].mean(), "red")
        np.testing.assert_allclose(tinted, painted * np.array([0.5, 1, 1]), atol=1)

    def test_a_seed_is_another_motion_and_minus_one_the_scenes(self):
        animation = self.make(StopAfter="Plan")
        own = places(output(animation, "PlannedTracks")).copy()
        for seed, same in ((6, False), (5, True), (-1, True)):
            animation.Seed = seed
            animation.UpdatePipeline()
            self.assertEqual(np.array_equal(places(output(animation, "PlannedTracks")), own), same, seed)

    def test_what_a_quality_was_called_before_names_it(self):
        animation = self.make(StopAfter="Scene")
        for word in ("Air", "Assimilated"):
            animation.Quality = word
            self.assertEqual(animation.Quality, "Air")

    def test_unfolds_into_stages_of_their_own(self):
        for quality, seed, detail in (("Preview", -1, [32, 32, 0]), ("Air", 9, [64, 48, 2])):
            with self.subTest(quality=quality):
                animation = self.make(Quality=quality, Seed=seed, StopAfter="Scene", NumberOfTakes=2, Take=1)
                animation.StopAfter = "Rotation"
                with self.unfolded(animation) as stages:
                    self.assertEqual(set(stages), {"Scene", "Planner", "Assimilation", "Rotation"})
                    self.assertEqual(animation.Unfold, 0)
                    drift, planner = stages["Assimilation"], stages["Planner"]
                    self.assertEqual([drift.Resolution, drift.LatticeResolution, drift.Rounds], detail)
                    self.assertEqual([stages[name].Seed for name in ("Planner", "Assimilation", "Rotation")], 3 * [max(seed, 5)])
                    self.assertEqual([planner.NumberOfTakes, planner.Take, stages["Scene"].FileName], [2, 1, self.scene])
                    self.assertEqual(stages["Rotation"].Tracks.SMProxy, drift.SMProxy)
                    planner.Seed = 99  # a stage's own
                    self.assertEqual(animation.Seed, seed)

    def test_unfolded_paper_takes_the_vortices_of_scene_and_plan(self):
        animation = self.make(Quality="Paper", StopAfter="Plan")
        with self.unfolded(animation) as stages:
            self.assertEqual(set(stages), {"Scene", "Planner"}, "no more than it runs")
        animation.StopAfter = "Rotation"
        with self.unfolded(animation) as stages:
            vortices = stages["Spacetime"].Vortices
            self.assertEqual(vortices.SMProxy.GetXMLName(), "AppendPolyData")
            self.assertEqual([one.SMProxy.GetXMLName() for one in vortices.Input], ["MotionSceneReader", "StylisticPlannerFilter"])

    def test_what_cannot_be_unfolded_is_said(self):
        reader = simple.MotionSceneReader(FileName=self.scene)
        self.addCleanup(lambda: simple.Delete(reader))
        for wrong, words in ((reader, "expected a Waft Animation"), (3, "expected a proxy")):
            with self.assertRaisesRegex(waft.BadInput, words):
                waft.unfold(wrong)

    def test_an_old_word_unfolds_too(self):
        animation = self.make(StopAfter="Plan")
        before = len(simple.GetSources())
        animation.ShowStages = 1
        animation.UpdateVTKObjects()
        self.assertEqual(len(simple.GetSources()), before + 2)
        for name in ("Planner", "Scene"):
            simple.Delete(simple.FindSource(name))

    def test_names_what_is_wrong(self):
        animation = self.make(StopAfter="Scene")
        said = []

        def hear(_caller, _event, text):
            said.append(text)

        hear.CallDataType = VTK_STRING
        source = animation.GetClientSideObject()
        for speaker in (animation.SMProxy, source, source.GetExecutive()):
            speaker.AddObserver("ErrorEvent", hear)
        for name, values, expected in (("Quality", (-1, 4), "Quality: expected 0 (Preview) to 3 (Paper), found"),
                                       ("StopAfter", (-1, 6), "StopAfter: expected 0 (Scene) to 5 (VortexFit), found"),
                                       ("FileName", (str(self.folder / "none.waft.json"),), "none.waft.json")):
            for value in values:
                with self.subTest(name=name, value=value):
                    said.clear()
                    held = animation.SMProxy.GetProperty(name)
                    before = held.GetElement(0)
                    held.SetElement(0, value)
                    animation.UpdateVTKObjects()
                    animation.UpdatePipeline()
                    self.assertIn(expected, "".join(said))
                    held.SetElement(0, before)
                    animation.UpdateVTKObjects()
                    animation.UpdatePipeline()
        self.assertGreater(self.ports(animation)["Objects"], 0, "what was right before is right again")

    def test_the_time_of_the_scene_is_its_own(self):
        animation = self.make(StopAfter="Scene")
        times = list(animation.TimestepValues)
        self.assertEqual(len(times), 40)
        self.assertAlmostEqual(times[-1], 39 / 30)

    def test_the_session_has_the_frames_of_the_scene(self):
        self.make(StopAfter="Scene")
        self.assertEqual(len(simple.GetTimeKeeper().TimestepValues), 40)
        scene = simple.GetAnimationScene()
        scene.UpdateAnimationUsingDataTimeSteps()
        self.assertAlmostEqual(scene.EndTime, 39 / 30)
        scene.AnimationTime = 1.0
        self.assertAlmostEqual(scene.AnimationTime, 1.0)

    def test_a_state_keeps_it(self):
        animation = self.make(StopAfter="Plan", Quality="Paper", Seed=3)
        waft.unfold(animation)
        state = str(self.folder / "kept.pvsm")
        simple.SaveState(state)
        text = pathlib.Path(state).read_text(encoding="utf-8")
        self.assertNotIn("embedded.vtm", text)
        before = places(output(animation, "PlannedTracks")).copy()
        simple.ResetSession()
        waft.load_plugin()
        simple.LoadState(state)
        again = next(s for s in simple.GetSources().values() if s.SMProxy.GetXMLName() == "WaftAnimation")
        again.UpdatePipeline()
        self.assertEqual([again.Quality, again.StopAfter, again.Seed], ["As in the 2005 paper", "Plan", 3])
        np.testing.assert_array_equal(places(output(again, "PlannedTracks")), before)
        planner = simple.FindSource("Planner")
        self.assertEqual(planner.Seed, 3)
        planner.UpdatePipeline()
        np.testing.assert_array_equal(places(output(planner)), before)

    def test_a_state_from_before_loads_with_a_sentence(self):
        said = []
        text = OLD_STATE.replace("SCENE", self.scene)
        state = self.folder / "old.pvsm"
        state.write_text(text, encoding="utf-8")
        window = vtkOutputWindow.GetInstance()
        collect(window, "WarningEvent", said)
        simple.LoadState(str(state))
        window.RemoveObservers("WarningEvent")
        again = next(s for s in simple.GetSources().values() if s.SMProxy.GetXMLName() == "WaftAnimation")
        self.addCleanup(lambda: simple.Delete(again))
        self.assertEqual([again.Seed, again.StopAfter, again.FileName], [9, "Plan", self.scene])
        self.assertEqual(len([text for text in said if "of what was set on a stage the state holds nothing" in text]), 1, said)
        self.assertEqual(len(simple.GetSources()), 1, "stages that were shown come back by themselves")
