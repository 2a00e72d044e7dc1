# SPDX-License-Identifier: BSD-3-Clause
"""What the files of a run keep of its data, and what they leave out to be small.

    pvpython run.py test_files.py
"""
import pathlib
import tempfile
import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkMultiBlockDataSet, vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

import waft
from result_files import PolyData
from datafiles import write_xml


def poses(objects=3, frames=50):
    random = np.random.RandomState(2)
    data = vtkPolyData()
    points = vtkPoints()
    points.SetDataTypeToDouble()
    points.SetData(numpy_to_vtk(random.standard_normal((objects * frames, 3)), deep=True))
    data.SetPoints(points)
    lines = vtkCellArray()
    for first in range(0, objects * frames, frames):
        lines.InsertNextCell(frames, list(range(first, first + frames)))
    data.SetLines(lines)
    for name, width in (("Orientation", 4), ("Velocity", 3), ("AngularVelocity", 3), ("Torque", 3), ("Time", 1)):
        array = numpy_to_vtk(random.standard_normal((objects * frames, width)), deep=True)
        array.SetName(name)
        data.GetPointData().AddArray(array)
    frame = numpy_to_vtk(np.tile(np.arange(frames, dtype=np.int32), objects), deep=True)
    frame.SetName("Frame")
    data.GetPointData().AddArray(frame)
    return data


def arrays(data):
    point = data.GetPointData()
    return {"Points": vtk_to_numpy(data.GetPoints().GetData()),
            **{point.GetArrayName(i): vtk_to_numpy(point.GetArray(i)) for i in range(point.GetNumberOfArrays())}}


def image(values):
    data = vtkImageData()
    data.SetDimensions(values.shape[2::-1])
    array = numpy_to_vtk(values.reshape(-1, 3), deep=True)
    array.SetName("Velocity")
    data.GetPointData().AddArray(array)
    return data


def read(reader, path):
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_a_file_reads_back_bit_for_bit_with_and_without_vtk(self):
        data = poses()
        write_xml(data, self.folder / "poses.vtp")
        for name, values in arrays(read(vtkXMLPolyDataReader(), self.folder / "poses.vtp")).items():
            self.assertTrue(np.array_equal(values, arrays(data)[name]), name)
        plain = PolyData(self.folder / "poses.vtp")
        self.assertTrue(np.array_equal(plain.points, arrays(data)["Points"]))
        self.assertTrue(np.array_equal(plain.point["Orientation"], arrays(data)["Orientation"]))
        self.assertEqual([50, 50, 50], [len(line) for line in plain.lines])


class Portable(unittest.TestCase):
    """VTK 9.1 reads no data after the tags with Expat 2.6, nor with the fixes of 2.5 that Debian 12 has."""

    def test_data_are_within_the_tags(self):
        block = vtkMultiBlockDataSet()
        block.SetBlock(0, poses())
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for data, file in ((poses(), "a.vtp"), (image(np.zeros((2, 3, 4, 3), np.float32)), "b.vti"), (block, "c.vtm")):
                write_xml(data, folder / file)
            written = sorted(path for path in folder.rglob("*") if path.is_file())
            self.assertEqual(len(written), 4)
            for path in written:
                self.assertNotIn(b"<AppendedData", path.read_bytes(), path)

    def test_so_are_those_that_come_with_waft(self):
        folder = pathlib.Path(waft.data_file("Database/embedded.vtm")).parents[1]
        shipped = [path for path in folder.rglob("*.vt?") if path.is_file()]
        self.assertGreater(len(shipped), 6)
        for path in shipped:
            self.assertNotIn(b"<AppendedData", path.read_bytes(), path)
