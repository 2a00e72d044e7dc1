# SPDX-License-Identifier: BSD-3-Clause
"""What Apply on a Waft Animation shows in ParaView's own window on a virtual screen, and for how long the window is dead; while
nothing else runs.

    test_apply.py PARAVIEW XVFB PLUGINS MODULES"""

import json
import pathlib
import tempfile

from window import WindowTest, main, play


class ApplyTest(WindowTest):
    def test_one_apply_shows_an_animation_and_its_stages(self):
        with tempfile.TemporaryDirectory() as folder:
            status, printed, notes = play("animation.xml", pathlib.Path(folder), "watch_animation.py", size=(1400, 1700))
            report = json.loads((pathlib.Path(folder) / "flight" / "report.json").read_text(encoding="utf-8"))
            self.assertEqual(1, report["constraints"]["met"], "the flight was saved")
            gap = float((pathlib.Path(folder) / "log.gap").read_text(encoding="utf-8"))
            self.assertLess(gap, 5.0, "seconds in which the window was dead")
        self.check_run(status, printed)
        self.assertIn({"Meshes": "MotionBodiesRepresentation", "Poses": "MotionFaintPathsRepresentation",
                       "Obstacles": "MotionObstaclesRepresentation", "Marks": "MotionMarksRepresentation"},
                      [note["shown"] for note in notes])
        self.assertEqual({note["views"] for note in notes}, {1}, "no spreadsheet or chart on Apply")
        self.assertEqual(notes[-1]["sources"], ["Assimilation", "Planner", "Rotation", "Scene", "WaftAnimation1"])
        alone = [note for note in notes if len(note["sources"]) == 1]
        self.assertIn((4, 4), [(len(note["shown"]), note["eyes"]) for note in alone], "the browser has open eyes for what is shown")
        before, after = alone[0]["ends"], alone[-1]["ends"]
        longer = [port for port in range(1, 20) if after[port] - before[port] > 30]
        self.assertEqual(longer, list(range(13, 20)), "(empty) stands beside the names of those that are, and of no other")


if __name__ == "__main__":
    main()
