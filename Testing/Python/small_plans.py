# SPDX-License-Identifier: BSD-3-Clause
"""Three short plans, as small as the optimiser takes them."""
import math

from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkIntArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

FRAMES = 40


def with_scene(data):
    """Gives a data set what every stage reads of the scene."""
    for name, values in (("NumberOfFrames", [FRAMES]), ("FramesPerSecond", [30]), ("Bounds", [-2, 2, -2, 2, 0, 4])):
        reals(data.GetFieldData(), name, values)
    return data


def path(o, frame):
    """Where object o is at a frame."""
    t = frame / 30.0
    return (-0.8 + 0.7 * o + 0.3 * t, 0.2 * math.sin(2.0 * t + o), 2.6 - 0.4 * t + 0.1 * math.sin(3.0 * t + 2 * o))


def ids(attributes, name, values):
    """Adds an array of integers."""
    array = vtkIntArray()
    array.SetName(name)
    for value in values:
        array.InsertNextValue(value)
    attributes.AddArray(array)


def reals(attributes, name, values):
    """Adds an array of numbers."""
    array = vtkDoubleArray()
    array.SetName(name)
    for value in values:
        array.InsertNextValue(value)
    attributes.AddArray(array)


def cells(data, points, lines, verts):
    """Fills a vtkPolyData with points and either lines or vertices; verts may be None."""
    data.SetPoints(vtkPoints())
    data.GetPoints().SetDataTypeToDouble()
    for point in points:
        data.GetPoints().InsertNextPoint(point)
    array = vtkCellArray()
    for cell in lines or verts or []:
        array.InsertNextCell(len(cell), cell)
    (data.SetVerts if verts else data.SetLines)(array)
    return with_scene(data)


def make():
    """Tracks, Objects and Constraints of three objects, each with its last place exact."""
    tracks = cells(vtkPolyData(), [path(o, k) for o in range(3) for k in range(FRAMES)],
                   [list(range(o * FRAMES, (o + 1) * FRAMES)) for o in range(3)], None)
    ids(tracks.GetCellData(), "ObjectId", range(3))
    objects = cells(vtkPolyData(), [path(o, 0) for o in range(3)], None, [[o] for o in range(3)])
    ids(objects.GetPointData(), "ObjectId", range(3))
    rows = cells(vtkPolyData(), [path(o, FRAMES - 1) for o in range(3)], None, [[o] for o in range(3)])
    ids(rows.GetPointData(), "ObjectId", range(3))
    ids(rows.GetPointData(), "Frame", [FRAMES - 1] * 3)
    ids(rows.GetPointData(), "Kind", [0] * 3)
    value = vtkDoubleArray()
    value.SetName("Value")
    value.SetNumberOfComponents(4)
    for o in range(3):
        value.InsertNextTuple((*path(o, FRAMES - 1), 0.0))
    rows.GetPointData().AddArray(value)
    return [tracks, objects, rows]
