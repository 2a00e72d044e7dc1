# SPDX-License-Identifier: BSD-3-Clause
"""A stage that fails says so once, is done, and all after it is silent: each filter with each of its inputs, and Waft Animation.

    pvpython run.py test_failures.py XML_FOLDER"""
import pathlib
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

from paraview import simple
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

import waft
from test_animation import make_scene
from waft.updating import failure_of
from waft.watching import collect

XML = pathlib.Path(sys.argv[1])
MISSING = "FileName: expected a scene file, found no name"


def listen(algorithm, said):
    """Collects what an algorithm and its executive report, in place of the console."""
    for speaker in (algorithm, algorithm.GetExecutive()):
        collect(speaker, "ErrorEvent", said)


def filters():
    """{name of a filter's class: names of its inputs in the order of ports}"""
    found = {}
    for path in sorted(XML.glob("*.xml")):
        for proxy in ElementTree.parse(path).getroot().iter("SourceProxy"):
            inputs = [entry for entry in proxy.iter("InputProperty")]
            if inputs:
                found[proxy.get("class")] = [entry.get("name") for entry in inputs]
    return found


def failing(kind):
    """A source that fails and gives what an input takes."""
    if kind == "vtkImageData":
        return waft.vtkVDBReader(), 0
    if kind == "vtkMultiBlockDataSet":
        return waft.vtkMotionSceneReader(), 3
    return waft.vtkMotionSceneReader(), 0


class FailuresTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.scene = make_scene(folder.name)

    def make(self, **properties):
        animation = simple.WaftAnimation(**properties)
        self.addCleanup(lambda: simple.Delete(animation))
        said = []
        listen(animation.GetClientSideObject(), said)
        return animation, said

    def test_a_filter_is_silent_after_a_failure_in_any_input(self):
        names = filters()
        self.assertGreater(len(names), 8)
        for name, inputs in names.items():
            stage = getattr(waft, name)()
            if not hasattr(stage, "Write"):
                self.check_silence(name, stage, len(inputs))

    def check_silence(self, name, stage, count):
        for failed in range(count):
            with self.subTest(filter=name, port=failed):
                stage = getattr(waft, name)()
                said, source_said = [], []
                listen(stage, said)
                for port in range(stage.GetNumberOfInputPorts()):
                    info = stage.GetInputPortInformation(port)
                    if port == failed or not info.Get(stage.INPUT_IS_OPTIONAL()):
                        kind = info.Get(stage.INPUT_REQUIRED_DATA_TYPE(), 0)
                        source, output = failing(kind)
                        listen(source, source_said)
                        stage.SetInputConnection(port, source.GetOutputPort(output))
                stage.Update()
                stage.UpdateTimeStep(1.0)
                self.assertEqual(said, [])
                self.assertGreater(len(source_said), 0)
                self.assertIn("FileName: expected", stage.GetProgressText())
                for port in range(stage.GetNumberOfOutputPorts()):
                    data = stage.GetOutputDataObject(port)
                    self.assertEqual(data.GetNumberOfElements(0), 0)
                    self.assertIsNotNone(data.GetFieldData().GetAbstractArray("Failure"))

    def test_one_sentence_once(self):
        animation, said = self.make(FileName="")
        animation.UpdatePipeline()
        self.assertEqual(said, [MISSING])
        self.assertEqual((animation.Message, animation.Complete), (MISSING, 1))
        for time in (0.2, 0.7):
            animation.UpdatePipeline(time)
        self.assertEqual(said, [MISSING])
        for raises in (waft.update, waft.go_on, waft.show):
            with self.assertRaisesRegex(waft.BadInput, f"^{MISSING}$"):
                raises(animation)
        self.assertEqual(said, [MISSING], "other times and other ports say nothing")
        animation.FileName = self.scene
        animation.StopAfter = "Plan"
        waft.update(animation)
        self.assertEqual((said, failure_of(animation), animation.Message), ([MISSING], "", "done"))
        self.assertGreater(animation["PlannedTracks"].GetDataInformation().GetNumberOfPoints(), 0)

    def test_a_stage_in_the_middle(self):
        animation, said = self.make(FileName=self.scene, StopAfter="Plan")
        waft.update(animation)
        animation.Take = 99
        with self.assertRaises(waft.BadInput) as caught:
            waft.update(animation)
        self.assertEqual(said, [str(caught.exception)])
        self.assertIn("Take is 99, expected", said[0])
        self.assertGreater(animation["Objects"].GetDataInformation().GetNumberOfPoints(), 0, "what stands before it is there")
        animation.Take = 0
        waft.update(animation)
        animation.Take = 99
        animation.UpdatePipeline()
        self.assertEqual(len(said), 2, "what was mended and is wrong again is told again")

    def test_going_on_ends(self):
        for change in ({"Take": 99}, {"FileName": "none.waft.json"}):
            with self.subTest(change=change):
                animation, said = self.make(FileName=self.scene, Slice=0.05)
                waft.update(animation)
                self.assertFalse(waft.go_on(animation))
                for name, value in change.items():
                    setattr(animation, name, value)
                with self.assertRaises(waft.BadInput):
                    while not waft.go_on(animation):
                        pass
                self.assertEqual(len(said), 1, said)
                self.assertEqual(animation.Complete, 1)

    def test_nothing_is_reported_of_what_was_before(self):
        animation, _ = self.make(FileName=self.scene, StopAfter="Plan")
        waft.update(animation)
        self.assertEqual(len(animation.TimestepValues), 40)
        animation.FileName = "none.waft.json"
        animation.UpdatePipeline()
        self.assertEqual(len(animation.TimestepValues or []), 0)
        for name in ("Objects", "Marks", "PlannedTracks", "Obstacles"):
            self.assertEqual(animation[name].GetDataInformation().GetNumberOfPoints(), 0, name)
        steps = vtkStreamingDemandDrivenPipeline.TIME_STEPS()
        source = animation.GetClientSideObject()
        for port in range(source.GetNumberOfOutputPorts()):
            self.assertFalse(source.GetOutputInformation(port).Has(steps), port)

    def test_a_repaired_file_is_read_again(self):
        path = str(self.folder / "repaired.waft.json")
        pathlib.Path(path).write_text("{", encoding="utf-8")
        for make in (lambda: self.make(FileName=path, StopAfter="Scene")[0], lambda: simple.MotionSceneReader(FileName=path)):
            pathlib.Path(path).write_text("{", encoding="utf-8")
            source = make()
            listen(source.GetClientSideObject(), [])
            with self.assertRaises(waft.BadInput):
                waft.update(source)
            pathlib.Path(path).write_bytes(pathlib.Path(self.scene).read_bytes())
            self.assertTrue(simple.ReloadFiles(source))
            waft.update(source)
            self.assertEqual(len(source.TimestepValues), 40)

    def test_what_is_no_proxy_is_said(self):
        for wrong in (None, "animation", 3):
            with self.assertRaisesRegex(waft.BadInput, "source: expected a proxy"):
                waft.update(wrong)
