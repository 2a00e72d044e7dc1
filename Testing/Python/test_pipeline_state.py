# SPDX-License-Identifier: BSD-3-Clause
"""Documentation/examples/six_stages.pvsm in a process that has seen nothing else, on a coarse grid with few particles and a small
scene that stands where ParaView is told to look: the poses of six_stages.py, and a picture of each of its views.

    pvbatch test_pipeline_state.py SOURCE FOLDER [--update]       FOLDER: for the pictures
"""
import os
import pathlib
import re
import shutil
import sys
import tempfile
import unittest

from paraview import simple

import baseline
import six_stages_small
import waft

SOURCE, FOLDER = map(pathlib.Path, sys.argv[1:3])
EXAMPLES, BASELINE = SOURCE / "Documentation" / "examples", SOURCE / "Data" / "Baseline"
sys.path.insert(0, str(SOURCE / "Documentation" / "scripts"))

import make_pipeline_pictures  # noqa: E402
import make_pipeline_state  # noqa: E402

SIZE = (300, 200)
TIME = 1.0  # s
FRAME = 1.0 / 30.0  # s
LEAF = ((0.0, -0.8, 1.4), (0.0, 0.1, 1.0))  # a camera near one of the leaves, and what it looks at


class PipelineStateTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        kept = tempfile.TemporaryDirectory()
        cls.addClassCleanup(kept.cleanup)
        cls.folder = pathlib.Path(kept.name)
        FOLDER.mkdir(parents=True, exist_ok=True)
        cls.scene = cls.folder / pathlib.Path(make_pipeline_state.SCENE).name
        six_stages_small.make_scene(cls.scene, seed=7)  # as the state's scene has it, and so its stages
        cls.views = make_pipeline_pictures.load(data_directory=str(cls.folder))
        for name, settings in (("smoke", six_stages_small.AIR), ("gas", six_stages_small.SHORT)):
            for key, value in settings.items():
                setattr(simple.FindSource(name), key, value)

    def test_has_a_tab_of_each_picture_of_the_page_in_its_order(self):
        page = (SOURCE / "Documentation" / "Pipeline.md").read_text(encoding="utf-8")
        self.assertEqual(list(self.views), list(make_pipeline_state.VIEWS))
        self.assertEqual(list(self.views), re.findall(r"\(gallery/pipeline_(\w+)\.png\)", page))

    def test_names_no_place_of_who_made_it(self):
        text = (EXAMPLES / "six_stages.pvsm").read_text(encoding="utf-8")
        self.assertIn(f'"{make_pipeline_state.SCENE}"', text)
        for place in ("/home", "/root", "/tmp", "/usr", str(SOURCE)):
            self.assertNotIn(place, text)

    def test_its_stages_are_those_of_the_script(self):
        """As they are in the state, but for what the small scene changes: the same properties, and the same motion to the byte."""
        joined = six_stages_small.join(EXAMPLES / "six_stages.py", self.scene, self.folder)
        for name in ("smoke", "tracers", "database", "reader", "plan", "gas", "fit", "turn"):
            loaded = simple.FindSource(name)
            self.assertEqual(loaded.SMProxy.GetXMLName(), joined[name].SMProxy.GetXMLName())
            for key in joined[name].ListProperties():
                value = joined[name].GetPropertyValue(key)
                if isinstance(value, (int, float, str)) and not joined[name].GetProperty(key).GetInformationOnly():
                    with self.subTest(stage=name, property=key):
                        self.assertEqual(loaded.GetPropertyValue(key), value)
        poses = self.folder / "state.csv"
        reader, turn = simple.FindSource("reader"), simple.FindSource("turn")
        waft.update(simple.MotionAnimationWriter(Poses=simple.OutputPort(turn, 1), Objects=simple.OutputPort(reader, 0),
                                                 Shapes=simple.OutputPort(reader, 3), FileName=str(poses)))
        self.assertEqual(poses.read_bytes(), (self.folder / "poses.csv").read_bytes())

    def test_every_view_is_as_its_baseline(self):
        for name, view in self.views.items():
            with self.subTest(view=name):
                view.ViewTime = TIME
                drawn = FOLDER / f"pipeline_{name}.png"
                make_pipeline_pictures.draw(view, drawn, SIZE)
                self.compare(drawn)

    def test_a_leaf_that_is_a_frame_on_is_seen(self):
        view = self.views["poses"]
        make_pipeline_pictures.draw(view, FOLDER / "all.png", SIZE)
        view.CameraPosition, view.CameraFocalPoint = LEAF
        view.CameraViewUp = (0.0, 0.0, 1.0)
        for number, name in enumerate(("leaf", "later")):
            view.ViewTime = TIME + number * FRAME
            simple.SaveScreenshot(str(FOLDER / f"pipeline_{name}.png"), view, ImageResolution=SIZE)
        self.compare(FOLDER / "pipeline_leaf.png")
        self.assertGreater(baseline.error(FOLDER / "pipeline_later.png", BASELINE / "pipeline_leaf.png"), 10 * baseline.THRESHOLD)

    def compare(self, drawn):
        if "--update" in sys.argv:
            shutil.copyfile(drawn, BASELINE / drawn.name)
        self.assertLessEqual(baseline.error(drawn, BASELINE / drawn.name), baseline.THRESHOLD)


if __name__ == "__main__":
    done = unittest.main(argv=sys.argv[:1], exit=False)
    sys.stdout.flush()
    os._exit(0 if done.result.wasSuccessful() else 1)  # views of many kinds end in any order
