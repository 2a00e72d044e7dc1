# SPDX-License-Identifier: BSD-3-Clause
"""Waft in Python with VTK and without ParaView: a scene is read, planned, assimilated and turned.

    python3 test_plain_vtk.py SCENES
"""
import importlib.util
import pathlib
import sys
import tempfile
import unittest

import waft
from vtkmodules.vtkCommonCore import vtkVersion
from waft import vtkAirAssimilationFilter, vtkMotionSceneReader, vtkRotationRefineFilter, vtkStylisticPlannerFilter


class PlainVTK(unittest.TestCase):
    def test_there_is_no_paraview(self):
        self.assertIsNone(importlib.util.find_spec("paraview"))
        self.assertGreaterEqual((vtkVersion.GetVTKMajorVersion(), vtkVersion.GetVTKMinorVersion()), (9, 1))

    def test_reads_a_scene_that_comes_with_waft(self):
        reader = vtkMotionSceneReader()
        reader.SetFileName(str(pathlib.Path(sys.argv[1]) / "feather-waypoints.waft.json"))
        reader.Update()
        self.assertGreater(reader.GetOutputDataObject(0).GetNumberOfPoints(), 0)
        self.assertGreater(reader.GetOutputDataObject(1).GetNumberOfPoints(), 0)

    def test_flies(self):
        scene = waft.Scene(seed=3)
        scene.set_time(40)
        leaves = scene.add_objects("maple", count=2, region={"min": (-0.5, -0.5, 2.5), "max": (0.5, 0.5, 3)})
        scene.add_position(leaves[0], 30, (0.2, 0.1, 2.5), radius=0.1)
        reader = vtkMotionSceneReader()
        with tempfile.TemporaryDirectory() as folder:
            scene.save(f"{folder}/two.waft.json")
            reader.SetFileName(f"{folder}/two.waft.json")
            reader.Update()
        planner, air, turned = vtkStylisticPlannerFilter(), vtkAirAssimilationFilter(), vtkRotationRefineFilter()
        air.SetResolution(16)
        for stage, inputs in ((planner, {1: (reader, 0), 2: (reader, 1), 3: (reader, 2)}),
                              (air, {0: (planner, 0), 1: (reader, 0), 2: (planner, 3), 3: (reader, 2)}),
                              (turned, {0: (air, 0), 1: (reader, 0), 2: (reader, 3), 3: (reader, 2)})):
            for port, (source, output) in inputs.items():
                stage.SetInputConnection(port, source.GetOutputPort(output))
        turned.Update()
        poses = turned.GetOutputDataObject(1)
        self.assertEqual((poses.GetNumberOfLines(), poses.GetNumberOfPoints()), (2, 2 * 40))
        report = air.GetOutputDataObject(4)
        self.assertEqual([report.GetValueByName(k, "Status").ToString() for k in range(report.GetNumberOfRows())], ["met"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
