# SPDX-License-Identifier: BSD-3-Clause
"""The source Waft Animation: its stages give what waft.synthesize gives, run as far as they are asked, and can be shown.

    pvpython test_animation.py"""
import os
import pathlib
import sys
import tempfile
import unittest

import numpy as np
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy

from vtkmodules.vtkCommonCore import VTK_STRING

import waft

STAGES = ("Scene", "Planner", "Vortices", "Assimilation", "Spacetime", "Rotation")
QUICK = {"Spacetime": {"NumberOfGasParticles": 216, "LeashIterations": 2, "MaximumNumberOfIterations": 6},
         "Assimilation": {"Resolution": 16, "LatticeResolution": 12, "Rounds": 0, "Candidates": 2}}


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


def stage_of(animation, name):
    """The proxy of a stage, with Python's attributes."""
    return servermanager._getPyProxy(animation.SMProxy.GetProxy(name))


def output(animation, stage, port=0):
    return stage_of(animation, stage).GetClientSideObject().GetOutputDataObject(port)


def places(data):
    return vtk_to_numpy(data.GetPoints().GetData()) if data.GetNumberOfPoints() else np.empty((0, 3))


class AnimationTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.scene = make_scene(folder.name)

    def make(self, settings=None, **properties):
        """An animation that has run, its stages coarse unless told otherwise."""
        animation = simple.WaftAnimation(FileName=self.scene, **properties)
        self.addCleanup(lambda: simple.Delete(animation))
        for stage, values in (QUICK if settings is None else settings).items():
            for name, value in values.items():
                setattr(stage_of(animation, stage), name, value)
        animation.UpdatePipeline()
        return animation

    def ports(self, animation):
        """{port: points of a surface or picture, rows of a table}"""
        found = {}
        for name in (animation.SMProxy.GetOutputPortName(i) for i in range(animation.SMProxy.GetNumberOfOutputPorts())):
            about = animation[name].GetDataInformation()
            found[name] = about.GetNumberOfPoints() or about.DataInformation.GetNumberOfRows()
        return found

    def test_gives_what_synthesize_gives(self):
        run = waft.synthesize(self.scene, quality="preview")
        animation = self.make({})
        for stage, port in (("planner", 0), ("assimilation", 0), ("rotation", 1)):
            ours, wanted = output(animation, stage.capitalize(), port), run.output(stage, port)
            np.testing.assert_array_equal(places(ours), places(wanted))
        ours, wanted = (vtk_to_numpy(data.GetPointData().GetArray("Orientation")) for data in (ours, wanted))
        np.testing.assert_array_equal(ours, wanted)
        run.delete()

    def test_each_quality_joins_its_stages(self):
        drifts = ("AssimilatedTracks", "Air", "AssimilatedReport")
        optimises = ("OptimisedTracks", "Gas", "Convergence")
        for quality, filled, empty in (("Preview", drifts, optimises), ("Full", drifts + optimises, ()),
                                       ("Paper", optimises, drifts)):
            with self.subTest(quality=quality):
                animation = self.make(Quality=quality)
                ports = self.ports(animation)
                self.assertTrue(all(ports[name] > 0 for name in filled + ("Meshes", "Poses", "PlannedTracks", "Marks")), ports)
                self.assertTrue(all(ports[name] == 0 for name in empty), ports)
                last = stage_of(animation, "Rotation").Tracks
                self.assertEqual(last.SMProxy.GetXMLName(),
                                 "SPHSpacetimeFilter" if quality != "Preview" else "AirAssimilationFilter")

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
        animation = simple.WaftAnimation(FileName=path, Quality="Paper", StopAfter="Plan")
        self.addCleanup(lambda: simple.Delete(animation))
        rotation = stage_of(animation, "Rotation")
        animation.UpdatePipeline()
        rotation.Active = 1
        rotation.UpdatePipeline()
        points = output(animation, "Rotation").GetPointData()
        colors, shapes = (vtk_to_numpy(points.GetArray(name)) for name in ("Color", "ShapeId"))
        plain, painted, tinted = (colors[shapes == k].astype(int) for k in range(3))
        self.assertEqual({tuple(color) for color in plain}, {(51, 102, 255)})
        self.assertGreater(len(np.unique(painted, axis=0)), 5, "the texture's, at each point")
        self.assertGreater(painted[:, 0].mean(), 2 * painted[:, 2].mean(), "red")
        np.testing.assert_allclose(tinted, painted * np.array([0.5, 1, 1]), atol=1)

    def test_stops_where_it_is_asked_to(self):
        firsts = {"Scene": "Objects", "Plan": "PlannedTracks", "Assimilation": "AssimilatedTracks",
                  "Optimisation": "OptimisedTracks", "Rotation": "Meshes"}
        animation = self.make(Quality="Full", StopAfter="Scene")
        for done, stop in enumerate(firsts, 1):
            animation.StopAfter = stop
            animation.UpdatePipeline()
            ports = self.ports(animation)
            self.assertEqual([ports[name] > 0 for name in firsts.values()], [k < done for k in range(5)], (stop, ports))

    def test_a_seed_is_another_motion_and_minus_one_the_scenes(self):
        animation = self.make(StopAfter="Plan")
        own = places(output(animation, "Planner")).copy()
        self.assertEqual(stage_of(animation, "Planner").Seed, 5)
        for seed, same in ((6, False), (5, True), (-1, True)):
            animation.Seed = seed
            animation.UpdatePipeline()
            self.assertEqual(np.array_equal(places(output(animation, "Planner")), own), same, seed)
        self.assertEqual([stage_of(animation, stage).Seed for stage in ("Assimilation", "Rotation")], [5, 5])

    def test_the_detail_of_a_stage_stays_as_it_was_set(self):
        animation = self.make({}, StopAfter="Scene")
        drift = stage_of(animation, "Assimilation")
        self.assertEqual([drift.Resolution, drift.LatticeResolution, drift.Rounds], [32, 32, 1])
        drift.Resolution = 24
        animation.Seed = 7
        animation.UpdatePipeline()
        self.assertEqual(drift.Resolution, 24)
        for word in ("Air", "Assimilated"):  # what it is called, and was before
            animation.Quality = word
            animation.UpdatePipeline()
            self.assertEqual(animation.Quality, "Air")
            self.assertEqual([drift.Resolution, drift.LatticeResolution, drift.Rounds], [64, 48, 3])
            animation.Quality = "Preview"
            animation.UpdatePipeline()
            self.assertEqual([drift.Resolution, drift.LatticeResolution, drift.Rounds], [32, 32, 1])

    def test_stages_can_be_shown_and_hidden(self):
        animation = self.make(StopAfter="Plan")
        self.assertIsNone(simple.FindSource("Planner"))
        animation.ShowStages = 1
        animation.UpdatePipeline()
        for name in STAGES:
            self.assertIs(simple.FindSource(name).SMProxy, stage_of(animation, name).SMProxy)
        planned = places(output(animation, "Planner")).copy()
        simple.FindSource("Planner").Seed = 99  # a stage's own property: this run's, until a Seed is set here
        simple.FindSource("Planner").UpdatePipeline()
        self.assertFalse(np.array_equal(places(output(animation, "Planner")), planned))
        animation.ShowStages = 0
        animation.UpdatePipeline()
        self.assertIsNone(simple.FindSource("Planner"))

    def test_names_what_is_wrong(self):
        animation = self.make(StopAfter="Scene")
        said = []

        def hear(_caller, _event, text):
            said.append(text)

        hear.CallDataType = VTK_STRING
        scene = stage_of(animation, "Scene").GetClientSideObject()
        for speaker in (animation.SMProxy, scene, scene.GetExecutive()):
            speaker.AddObserver("ErrorEvent", hear)
        for name, values, expected in (("Quality", (-1, 4), "Quality: expected 0 (Preview) to 3 (Paper), found"),
                                       ("StopAfter", (-1, 5), "StopAfter: expected 0 (Scene) to 4 (Rotation), found"),
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
        state = str(self.folder / "kept.pvsm")
        simple.SaveState(state)
        text = pathlib.Path(state).read_text(encoding="utf-8")
        self.assertNotIn("embedded.vtm", text)
        before = places(output(animation, "Planner")).copy()
        simple.ResetSession()
        waft.load_plugin()
        simple.LoadState(state)
        again = next(s for s in simple.GetSources().values() if s.SMProxy.GetXMLName() == "WaftAnimation")
        again.UpdatePipeline()
        self.assertEqual([again.Quality, again.StopAfter, again.Seed], ["Paper", "Plan", 3])
        np.testing.assert_array_equal(places(output(again, "Planner")), before)
        simple.Delete(again)


if __name__ == "__main__":
    done = unittest.main(argv=sys.argv[:1], exit=False)
    sys.exit(0 if done.result.wasSuccessful() else 1)
