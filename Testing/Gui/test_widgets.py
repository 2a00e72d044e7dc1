# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's own window on a virtual screen: the sources of the Waft menu, their panels, handles and Apply.

    test_widgets.py PARAVIEW XVFB PLUGINS MODULES"""

import itertools
import json
import math
import pathlib
import tempfile
from xml.etree import ElementTree

from window import HERE, WindowTest, main, play, run_paraview


def effort(events):
    """(clicks, typed fields) of an event script as a hand does it: a choice opens a list first, what stands in a menu's own
    list opens the menu and the list."""
    clicks = fields = 0
    for event in ElementTree.fromstring(events):
        command = event.get("command")
        if command == "set_string":
            fields += 1
        elif command == "activated":
            clicks += 2
        elif command == "activate" and "/menubar/" in event.get("object"):
            clicks += 3
        elif command in ("activate", "set_boolean", "mousePress"):
            clicks += 1
        elif command not in ("mouseRelease", "pause"):
            raise ValueError(f"what {command} takes is not known")
    return clicks, fields


class WidgetTest(WindowTest):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            cls.status, cls.printed, cls.notes = play("widgets.xml", pathlib.Path(folder))

    def of(self, source):
        return [note for note in self.notes if note["source"] == source]

    def shown(self, note):
        return [widget["kind"] for widget in note["widgets"] if widget["shown"]]

    def check_run(self, status, printed, signs=("ERR|", "WARN|", "FATL|", "Traceback", "critical:")):
        super().check_run(status, printed, signs)

    def test_panels_open_without_a_complaint(self):
        self.check_run(self.status, self.printed)

    def test_a_scene_is_made_planned_and_kept(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            self.check_run(*run_paraview(folder, [f"--script={HERE / 'panels.py'}"]))
            result = json.loads((folder / "log").read_text(encoding="utf-8"))
            kept = json.loads((folder / "kept.waft.json").read_text(encoding="utf-8"))
        self.assertEqual(result["tracks"], 1)
        self.assertEqual(result["statuses"], ["met", "met", "met"])
        self.assertEqual(len(kept["constraints"]), 3)
        self.assertEqual(kept["objects"][0]["position"], [-1, 0, 3])

    def test_files_open_without_a_question(self):
        with tempfile.TemporaryDirectory() as folder:
            status, printed, notes = play("open.xml", pathlib.Path(folder), "watch_open.py")
        self.check_run(status, printed)
        scene, flight = {"kept.waft.json": "WaftAnimation"}, {"autumn": "MotionResultsReader"}
        film = ["MotionBodiesRepresentation", "MotionObstaclesRepresentation"]
        whole = sorted([*film, "MotionFaintPathsRepresentation", "MotionMarksRepresentation"])
        flown = {"kept.waft.json": "WaftAnimation, flown"}  # once it is applied
        wanted = [[{}, []], [scene, []], [{**scene, **flight}, []], *([{**flown, **flight}, shown] for shown in (whole, film, whole))]
        found = [note for note in notes if note in wanted]  # what is shown comes one by one
        self.assertEqual([note for number, note in enumerate(found) if number == 0 or note != found[number - 1]], wanted)

    def test_undo_and_redo_take_the_stages_along(self):
        with tempfile.TemporaryDirectory() as folder:
            status, printed, notes = play("undo.xml", pathlib.Path(folder), "watch_undo.py")
        self.check_run(status, printed)  # the script looks at the box
        self.assertEqual([0, 2, 0, 2], notes)

    def test_a_scene_from_nothing_flies_after_few_clicks(self):
        with tempfile.TemporaryDirectory() as folder:
            status, printed, notes = play("byhand.xml", pathlib.Path(folder), "watch_byhand.py", frames=120)
        self.check_run(status, printed)
        last, flight = notes[-1], notes[-1]["flight"]
        self.assertEqual((flight["bodies"], flight["frames"], flight["statuses"]), (5, 120, 5 * ["met"]))
        self.assertGreater(flight["triangles"], 5 * 100, "leaves with meshes")
        for start, half, end in zip(flight["starts"], flight["half"], flight["ends"]):
            self.assertEqual(start[2], 3)
            self.assertGreater(half[2], 0.1, "in the air")
            self.assertGreater(math.dist(start, half), 0.1)
            self.assertLess(end[2], 1.1, "at rest on the ground or the box")
        self.assertLess(min(flight["turned"]), 0.9, "turned")
        self.assertEqual(last["shown"], {"Rotation": ["0:MotionBodiesRepresentation", "1:MotionFaintPathsRepresentation"],
                                         "Assimilation": ["3:MotionMarksRepresentation"],
                                         "Obstacle1": ["0:MotionObstaclesRepresentation"]})
        clicks, fields = effort((HERE / "byhand.xml").read_text(encoding="utf-8"))
        self.assertLessEqual(clicks, 15)
        self.assertLessEqual(fields, 2)

    def test_fly_says_what_is_missing_and_joins_what_is_added(self):
        with tempfile.TemporaryDirectory() as folder:
            status, printed, notes = play("fly.xml", pathlib.Path(folder), "watch_byhand.py", frames=30)
            saved = json.loads((pathlib.Path(folder) / "flown.waft.json").read_text(encoding="utf-8"))
        self.check_run(status, printed)  # the script looks at what the tool bar says
        self.assertIn("Fly: 2 objects, 3 constraints, 2 of them cannot be met", printed, "before it flew")
        flown = [note for note in notes if note["flight"].get("statuses")]
        one = flown[0]
        stages = ["Assimilation", "Planner", "Rotation"]
        self.assertEqual(one["sources"], sorted(["Constraint1", "Leaf", "Object1", *stages]))
        self.assertEqual(one["joined"]["Rotation"]["Tracks"], ["Assimilation"])
        self.assertEqual(one["joined"]["Object1"]["Shapes"], ["Leaf"], "whose body nobody gave")
        more = [note for note in flown if note["flight"]["bodies"] == 2]
        self.assertEqual(more[0]["sources"], sorted([*one["sources"], "Object2", "Objects", "Wind1"]), "no second chain")
        self.assertEqual(more[0]["joined"]["Objects"]["Input"], ["Object1", "Object2"])
        for stage in stages:
            self.assertEqual(more[0]["joined"][stage]["Objects"], ["Objects"])
        self.assertEqual(more[0]["joined"]["Assimilation"]["Wind"], ["Wind1"])
        resolutions = [number for number, _ in itertools.groupby(note["resolution"]["Assimilation"] for note in more)]
        self.assertEqual(resolutions, [32, 64, 32], "a preview's, those of the quality that was chosen, and undone")
        self.assertEqual(sorted(flown[-1]["flight"]["statuses"]), ["infeasible", "infeasible", "met"], "as many targets as objects")
        self.assertEqual(sum(len(entry.get("positions", [0])) for entry in saved["objects"]), 2)
        self.assertEqual(sum(len(entry.get("targets", {}).get("points", [0])) for entry in saved["constraints"]), 3)
        self.assertEqual(len(saved["winds"]), 1)
        followed = [note for note in flown if note["time"] > 0.9]
        for own, wanted in zip(followed[-1]["focus"], followed[-1]["flight"]["middle"]):
            self.assertAlmostEqual(own, wanted, places=5, msg="the camera looks at the middle of the bodies")
        self.assertEqual(followed[-1]["views"], ["RenderView", "SpreadSheetView"])
        shown = {step for note in notes for step in note["steps"] if "RenderView" in step or "MotionRepresentation" in step}
        self.assertEqual(shown, set(), "what Waft sets of a view is no step")

    def test_a_start_is_typed_and_dragged(self):
        notes = self.of("ObjectSource")
        self.assertTrue(all(self.shown(note) == ["HandleWidgetRepresentation"] for note in notes), notes)
        self.assertIn([[-1.25, 0, 3]], [note["points"] for note in notes], "typed into the panel, applied")
        dragged = notes[-1]["points"][0]
        self.assertGreater(math.dist(dragged, [-1.25, 0, 3]), 0.01, "the handle was dragged aside, applied")
        self.assertAlmostEqual(dragged[2], 3.0, places=6)
        place = [widget["place"] for widget in notes[-1]["widgets"] if widget["shown"]][0]
        for axis in range(3):
            self.assertAlmostEqual(place[axis], dragged[axis], places=5)

    def test_vortices_winds_and_boxes_have_handles(self):
        with tempfile.TemporaryDirectory() as folder:
            status, printed, notes = play("forces.xml", pathlib.Path(folder))
        self.check_run(status, printed)
        vortex = [note for note in notes if note["source"] == "VortexSource" and note["points"]][-1]
        self.assertEqual(self.shown(vortex), ["LineSourceWidgetRepresentation"])
        self.assertEqual(vortex["points"], [[-1.25, 0, 0.5], [0, 0, 3.5]], "typed into the panel, applied")
        wind = [note for note in notes if note["source"] == "WindSource" and note["points"]][-1]
        self.assertIn("SphereWidgetRepresentation", self.shown(wind))
        self.assertEqual(len(wind["points"]), 17 ** 3)
        box = [note for note in notes if note["source"] == "ObstacleSource" and note["points"]][-1]
        self.assertEqual(self.shown(box), ["BoxWidgetRepresentation"])
        self.assertEqual([min(box["points"]), max(box["points"])], [[-1.25, -0.5, 0], [-0.25, 0.5, 2]])

    def test_a_constraint_is_one_place_and_then_a_way(self):
        notes = self.of("ConstraintSource")
        one = [note for note in notes if note["points"] == [[0, 0, 2.5]]]
        self.assertTrue(one, notes)
        self.assertEqual(self.shown(one[0]), ["HandleWidgetRepresentation"])
        self.assertEqual(notes[-1]["points"], [[-0.5, 0, 2], [0.5, 0, 2]])
        self.assertEqual(self.shown(notes[-1]), ["PolyLineWidgetRepresentation"])


if __name__ == "__main__":
    main()
