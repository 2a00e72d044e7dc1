# SPDX-License-Identifier: BSD-3-Clause
"""Work in slices from a script on a pvserver: the motion so far after each, and in the end the bytes of a session without one; and
work that goes on beside.

    pvpython test_slices.py PVSERVER"""
import os
import pathlib
import sys
import tempfile
import time
import unittest

from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy

import waft
from serving import server

PVSERVER = sys.argv.pop(1)
SLICE = 0.1   # s
FRAMES = 16
BESIDE, ARRIVED = 2, 3  # of WorkState


def make_scene(folder):
    scene = waft.Scene("Short", seed=5)
    scene.set_time(FRAMES)
    scene.add_objects("feather", positions=[(0.2, 0.1, 2.6), (-0.2, 0.1, 2.6)])
    scene.add_position(0, 12, (0.2, 0.1, 2.5), radius=0.1)
    path = os.path.join(folder, "short.waft.json")
    scene.save(path)
    return path


def poses(animation):
    data = servermanager.Fetch(animation, idx=animation["Poses"].Port)
    return vtk_to_numpy(data.GetPoints().GetData()).tobytes() + vtk_to_numpy(data.GetPointData().GetArray("Orientation")).tobytes()


def is_flagged(animation, port="Poses"):
    return animation[port].FieldData.GetArray("Complete") is not None


class SliceTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.scene = make_scene(folder.name)
        animation = simple.WaftAnimation(FileName=cls.scene)
        animation.UpdatePipeline()
        cls.whole = poses(animation)
        simple.Delete(animation)

    def check_slices(self):
        animation = simple.WaftAnimation(FileName=self.scene, Slice=SLICE)
        began = time.process_time()
        animation.UpdatePipeline()
        self.assertLess(time.process_time() - began, 2.0)
        slices = 0
        while True:
            self.assertEqual(animation["Poses"].GetDataInformation().GetNumberOfPoints(), 2 * FRAMES)
            self.assertGreater(animation["Meshes"].GetDataInformation().GetNumberOfPoints(), 0)
            self.assertTrue(is_flagged(animation))
            slices += 1
            if waft.go_on(animation):
                break
        self.assertGreater(slices, 2)
        self.assertFalse(is_flagged(animation))
        self.assertTrue(waft.go_on(animation), "nothing is left")
        self.assertEqual(poses(animation), self.whole)
        simple.Delete(animation)

    def asked(self, animation, name):
        """What the stage says, wherever it is, without an update."""
        told = animation.SMProxy.GetProperty(name)
        animation.SMProxy.UpdatePropertyInformation(told)
        return told.GetElement(0)

    def check_beside(self):
        """As the window does it: the work goes on by itself, and is asked for when it has come to its end."""
        animation = simple.WaftAnimation(FileName=self.scene)
        animation.SMProxy.InvokeCommand("WorkInSlices")
        animation.UpdatePipeline()
        self.assertTrue(is_flagged(animation))
        first = self.asked(animation, "WorkDone")
        deadline = time.monotonic() + 600.0
        while self.asked(animation, "WorkState") == BESIDE and time.monotonic() < deadline:
            self.assertEqual(self.asked(animation, "Complete"), 0)
            time.sleep(0.05)
        self.assertEqual(self.asked(animation, "WorkState"), ARRIVED)
        self.assertGreater(self.asked(animation, "WorkDone"), first)
        self.assertTrue(waft.go_on(animation))
        self.assertFalse(is_flagged(animation))
        self.assertEqual(self.asked(animation, "WorkState"), 0)
        self.assertEqual(self.asked(animation, "Message"), "done")
        self.assertEqual(poses(animation), self.whole)
        simple.Delete(animation)

    def check_deleted(self):
        """What is in the air goes with its source."""
        animation = simple.WaftAnimation(FileName=self.scene, Quality="Full")
        animation.SMProxy.InvokeCommand("WorkInSlices")
        animation.UpdatePipeline()
        self.assertEqual(self.asked(animation, "WorkState"), BESIDE)
        simple.Delete(animation)

    def test_on_a_server(self):
        with server(PVSERVER) as port:
            simple.Connect("localhost", port)
            waft.load_plugin()
            try:
                self.check_slices()
                self.check_beside()
                self.check_deleted()
            finally:
                simple.Disconnect()
                simple.Connect()

    def test_a_state_tells_nothing_of_a_window(self):
        animation = simple.WaftAnimation(FileName=self.scene, StopAfter="Plan")
        source = animation.GetClientSideObject()
        self.assertEqual(source.GetSlice(), 0.0, "a script's")
        animation.SMProxy.InvokeCommand("WorkInSlices")
        animation.UpdatePipeline()
        self.assertEqual(source.GetSlice(), 0.2)
        self.assertEqual(animation.Slice, 0.0)
        simple.Delete(animation)

    def test_wrong_values_are_named(self):
        stage = waft.vtkStylisticPlannerFilter()
        for value, held in ((-1.0, 0.0), (1e300, 1e9)):
            stage.SetSlice(value)
            self.assertEqual(stage.GetSlice(), held)
        for wrong in (None, "animation", 3):
            with self.assertRaisesRegex(waft.BadInput, "source: expected a proxy"):
                waft.go_on(wrong)


if __name__ == "__main__":
    done = unittest.main(argv=sys.argv[:1], exit=False)
    sys.exit(0 if done.result.wasSuccessful() else 1)
