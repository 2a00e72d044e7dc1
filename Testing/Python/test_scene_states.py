# SPDX-License-Identifier: BSD-3-Clause
"""The states of scenes in Documentation/examples, each loaded where ParaView is told to look for its scene: it has the flight that the
scene has, shown as waft.show shows it, and names no place of who made it.

    pvbatch run.py test_scene_states.py SOURCE
"""
import os
import pathlib
import sys
import tempfile
import unittest

from paraview import simple

import waft

SOURCE = pathlib.Path(sys.argv[1])
EXAMPLES, SCENES = SOURCE / "Documentation" / "examples", SOURCE / "Data" / "Scenes"
sys.path.insert(0, str(SOURCE / "Documentation" / "scripts"))

from make_scene_states import SCENES as NAMES  # noqa: E402

LOOKS = {"Meshes": "Skins", "Poses": "Faint Paths", "Obstacles": "Scenery", "Marks": "Rings"}


class SceneStateTest(unittest.TestCase):
    def load(self, name):
        for proxy in [*simple.GetSources().values(), *simple.GetViews()]:
            simple.Delete(proxy)
        simple.LoadState(str(EXAMPLES / (name + ".pvsm")), data_directory=str(SCENES))
        return simple.FindSource("Flight"), simple.FindView("Flight")

    def test_they_open_as_the_scene_flies(self):
        for name in NAMES:
            with self.subTest(name):
                flight, view = self.load(name)
                self.assertEqual(pathlib.Path(flight.FileName).resolve(), (SCENES / (name + ".waft.json")).resolve())
                self.assertEqual((str(flight.Quality).strip("'"), flight.Edits), ("Preview", ""))
                for port, look in LOOKS.items():
                    shown = simple.GetRepresentation(flight[port], view)
                    self.assertEqual((str(shown.Representation).strip("'"), shown.Visibility), (look, 1))
                flight.StopAfter = "Plan"
                waft.update(flight)
                plan = flight.GetClientSideObject().GetOutputDataObject(5)
                self.assertEqual(plan.GetNumberOfPoints(), len(flight.TimestepValues) * plan.GetNumberOfLines())

    def test_their_scene_is_found_from_any_folder(self):
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                for name, reader, points in ((NAMES[0], "Flight", "Objects"), ("six_stages", "reader", "Constraints")):
                    simple.ResetSession()
                    simple.LoadState(str(EXAMPLES / (name + ".pvsm")))
                    stage = simple.FindSource(reader)
                    if name != "six_stages":
                        stage.StopAfter = "Scene"
                    waft.update(stage)
                    self.assertGreater(waft.fetch(stage, points).GetNumberOfPoints(), 0, name)
            finally:
                os.chdir(before)

    def test_the_flight_is_seen(self):
        flight, view = self.load(NAMES[0])
        view.ViewSize = [300, 200]
        simple.Render(view)
        self.assertTrue(flight.GetClientSideObject().GetComplete())
        bodies = flight.GetClientSideObject().GetOutputDataObject(0)
        renderer = view.GetRenderer()
        for corner in ([bodies.GetBounds()[2 * axis + end] for axis in range(3)] for end in (0, 1)):
            renderer.SetWorldPoint(*corner, 1.0)
            renderer.WorldToView()
            self.assertTrue(all(abs(place) < 1.0 for place in renderer.GetViewPoint()[:2]), "within the picture")

    def test_they_name_no_place_of_who_made_them(self):
        for name in NAMES:
            text = (EXAMPLES / (name + ".pvsm")).read_text(encoding="utf-8")
            self.assertIn(f'"Data/Scenes/{name}.waft.json"', text)
            for place in ("/home", "/root", "/tmp", "/usr", str(SOURCE)):
                self.assertNotIn(place, text)
