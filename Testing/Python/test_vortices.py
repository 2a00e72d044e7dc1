# SPDX-License-Identifier: BSD-3-Clause
"""Vortices that the optimiser gives are edited and given back to it.

    pvpython run.py test_vortices.py"""
import math
import os
import pathlib
import sys
import tempfile
import unittest

import numpy
from paraview import simple
from paraview.simple import UpdatePipeline
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

import waft.loading  # noqa: F401 (loads the plugin)

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from small_plans import cells, ids, make, reals  # noqa: E402


def vortices(poles, **arrays):
    """A data set of vortices: pairs of poles, and arrays of as many values."""
    data = cells(vtkPolyData(), [pole for pair in poles for pole in pair],
                 [[2 * k, 2 * k + 1] for k in range(len(poles))], None)
    ids(data.GetCellData(), "VortexId", arrays.pop("VortexId"))
    for name, values in arrays.items():
        reals(data.GetCellData(), name, values)
    return data


def edited(data, shift=(0.0, 0.0, 0.0), extra=()):
    """The vortices of a data set moved, and others (center, strength, id) beside them."""
    poles = [[tuple(numpy.add(data.GetPoint(2 * k + end), shift)) for end in (0, 1)]
             for k in range(data.GetNumberOfCells())]
    names = ("VortexId", "Strength", "CenterTime", "Duration", "CoreRadius")
    arrays = {name: [data.GetCellData().GetArray(name).GetTuple1(k) for k in range(len(poles))] for name in names}
    for (x, y), strength, number in extra:
        poles.append([(x, y, 0.5), (x, y, 3.5)])
        for name, value in zip(names, (number, strength, 0.6, 1.0, 0.5)):
            arrays[name].append(value)
    arrays["VortexId"] = [int(number) for number in arrays["VortexId"]]
    return vortices(poles, **arrays)


def acceleration(data, places, times):
    """Eq. 13 with the regularised denominator, of all vortices of a data set at some places and times."""
    total = numpy.zeros_like(places)
    for k in range(data.GetNumberOfCells()):
        strength, center, duration, core = (data.GetCellData().GetArray(name).GetTuple1(k)
                                            for name in ("Strength", "CenterTime", "Duration", "CoreRadius"))
        p1, p2 = (numpy.array(data.GetPoint(2 * k + end)) for end in (0, 1))
        r0, r1, r2 = p2 - p1, places - p1, places - p2
        cross = numpy.cross(r0, r1)
        along = (r1 @ r0) / numpy.linalg.norm(r1, axis=1) - (r2 @ r0) / numpy.linalg.norm(r2, axis=1)
        size = along / ((cross * cross).sum(axis=1) + core * core * (r0 @ r0))
        size *= strength / (4.0 * math.pi) * numpy.exp(-0.5 * ((times - center) / duration) ** 2)
        total += size[:, None] * cross
    return total


class Vortices(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.files = 0
        inputs = [simple.XMLPolyDataReader(FileName=[self.write(data)]) for data in make()]
        first = vortices([[(0.2, -0.1, 0.4), (0.1, 0.2, 3.2)]], VortexId=[7], Strength=[1.5], CenterTime=[0.6],
                         Duration=[1.5], CoreRadius=[1.1])
        self.given = simple.XMLPolyDataReader(FileName=[self.write(first)])
        for reader in (*inputs, self.given):
            reader.TimeArray = "None"
        self.stage = simple.SPHSpacetimeFilter(
            Tracks=inputs[0], Objects=inputs[1], Constraints=inputs[2], Vortices=self.given, NumberOfGasParticles=216,
            NumberOfObjectParticles=3, LeashIterations=3, MaximumNumberOfIterations=12, EstimateWind=0,
            FitVortexFields=0)
        UpdatePipeline(proxy=self.stage)

    def write(self, data):
        self.files += 1
        writer = vtkXMLPolyDataWriter()
        writer.SetDataModeToBinary()
        writer.SetFileName(os.path.join(self.folder, f"{self.files}.vtp"))
        writer.SetInputDataObject(data)
        self.assertTrue(writer.Write())
        return writer.GetFileName()

    def output(self, port):
        return self.stage.GetClientSideObject().GetOutputDataObject(port)

    def points(self):
        return vtk_to_numpy(self.output(0).GetPoints().GetData()).copy()

    def update(self, data):
        """Gives vortices back; the motion that comes of them, which keeps to the rows."""
        before = self.points()
        self.given.FileName = [self.write(data)]
        UpdatePipeline(proxy=self.stage)
        after = self.points()
        frames = len(after) // 3
        for k in range(3):
            self.assertEqual(list(after[(k + 1) * frames - 1]), list(before[(k + 1) * frames - 1]))
        self.expect_felt(data)
        return after

    def expect_felt(self, data):
        """The vortices given come out again, and what the objects feel is their field."""
        found = self.output(2)
        self.assertEqual(found.GetNumberOfCells(), data.GetNumberOfCells())
        for k in range(2 * data.GetNumberOfCells()):
            numpy.testing.assert_allclose(found.GetPoint(k), data.GetPoint(k), atol=1e-9)
        for name in ("VortexId", "Strength") if data.GetNumberOfCells() else ():
            numpy.testing.assert_allclose(vtk_to_numpy(found.GetCellData().GetArray(name)),
                                          vtk_to_numpy(data.GetCellData().GetArray(name)), rtol=1e-9)
        arrays = self.output(0).GetPointData()
        felt = vtk_to_numpy(arrays.GetArray("VortexAcceleration"))
        expected = acceleration(found, self.points(), vtk_to_numpy(arrays.GetArray("Time")))
        numpy.testing.assert_allclose(felt, expected, atol=1e-4 * (1e-3 + numpy.abs(expected).max()))

    def test_one_is_moved_one_added_and_all_deleted(self):
        start = self.points()
        fitted = vtkPolyData()
        fitted.DeepCopy(self.output(2))
        self.expect_felt(fitted)

        moved = self.update(edited(fitted, shift=(0.7, 0.3, 0.0)))
        self.assertGreater(numpy.abs(moved - start).max(), 1e-3)
        added = self.update(edited(fitted, shift=(0.7, 0.3, 0.0), extra=[((-0.8, 0.4), -2.0, 9)]))
        self.assertGreater(numpy.abs(added - moved).max(), 1e-3)
        deleted = self.update(edited(vtkPolyData()))
        self.assertGreater(numpy.abs(deleted - added).max(), 1e-3)
        self.assertEqual(numpy.abs(vtk_to_numpy(self.output(0).GetPointData().GetArray("VortexAcceleration"))).max(), 0)
