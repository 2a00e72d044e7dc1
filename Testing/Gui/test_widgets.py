# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's own window on a virtual screen: the sources of the Waft menu, their panels, handles and Apply.

    test_widgets.py PARAVIEW XVFB PLUGINS MODULES"""

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
        elif command != "mouseRelease":
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

    def test_one_apply_shows_an_animation_and_its_stages(self):
        with tempfile.TemporaryDirectory() as folder:
            status, printed, notes = play("animation.xml", pathlib.Path(folder), "watch_animation.py")
        super().check_run(status, printed)
        self.assertIn({"Meshes": "MotionBodiesRepresentation", "Poses": "MotionFaintPathsRepresentation",
                       "Obstacles": "MotionObstaclesRepresentation", "Marks": "MotionMarksRepresentation"},
                      [note["shown"] for note in notes])
        self.assertEqual({note["views"] for note in notes}, {1}, "no spreadsheet or chart on Apply")
        self.assertEqual(notes[-1]["sources"], ["Assimilation", "Planner", "Rotation", "Scene", "WaftAnimation1"])

    def test_files_open_without_a_question(self):
        with tempfile.TemporaryDirectory() as folder:
            status, printed, notes = play("open.xml", pathlib.Path(folder), "watch_open.py")
        self.check_run(status, printed)
        self.assertEqual(notes, [[], ["WaftAnimation"], ["MotionResultsReader", "WaftAnimation"]])

    def test_undo_and_redo_take_the_stages_along(self):
        with tempfile.TemporaryDirectory() as folder:
            status, printed, notes = play("undo.xml", pathlib.Path(folder), "watch_undo.py")
        self.check_run(status, printed)  # the script looks at the box
        self.assertEqual([0, 2, 0, 2], notes)

    def test_a_scene_by_hand_takes_few_clicks(self):
        with tempfile.TemporaryDirectory() as folder:
            status, printed, notes = play("byhand.xml", pathlib.Path(folder))
        self.check_run(status, printed)
        self.assertEqual((notes[-1]["source"], len(notes[-1]["points"])), ("StylisticPlannerFilter", 5 * 300))
        self.assertEqual(notes[-1]["statuses"], 5 * ["met"])
        clicks, fields = effort((HERE / "byhand.xml").read_text(encoding="utf-8"))
        self.assertLessEqual(clicks, 28)
        self.assertLessEqual(fields, 3)

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
