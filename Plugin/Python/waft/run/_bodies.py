# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces of a finished motion as VTK data: the bodies as they are at a frame, and the places that they aim at."""
from typing import Any, Optional

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

from waft.render._flyers import rotation


def posed(motion: Any, frame: int, shape: Optional[int] = None) -> vtkPolyData:
    """All bodies of a results._folder.Motion that are in the shot at a frame, or those of a shape by its number: with texture coordinates where all have some,
    `ObjectId`, `ShapeId` and `Color` (of the shape: red, green, blue) on points."""
    places, corners, lengths, columns, coordinates = [], [], [], [], []
    count = 0
    for index, number in enumerate(motion.shapes.tolist()):
        if (shape is not None and number != shape) or not motion.is_present(index, frame):
            continue
        body = motion.bodies[number]
        own = vtk_to_numpy(body.surface.GetPoints().GetData()).astype(float)
        position, orientation = motion.pose(index, frame)
        places.append(own @ rotation(orientation).T + position)
        polygons = body.surface.GetPolys()
        corners.append(vtk_to_numpy(polygons.GetConnectivityArray()) + count)
        lengths.append(np.diff(vtk_to_numpy(polygons.GetOffsetsArray())))
        columns.append(np.tile([motion.object_ids[index], number, *body.color], (len(own), 1)))
        flat = body.surface.GetPointData().GetTCoords()
        coordinates.append(vtk_to_numpy(flat) if flat is not None else None)
        count += len(own)
    surface = vtkPolyData()
    if not places:
        return surface
    surface.SetPoints(_points(np.concatenate(places)))
    cells = vtkCellArray()
    offsets = np.concatenate([[0], np.cumsum(np.concatenate(lengths))])
    cells.SetData(_ids(offsets), _ids(np.concatenate(corners)))
    surface.SetPolys(cells)
    column = np.concatenate(columns)
    for name, values in (("ObjectId", column[:, 0].astype(np.int64)), ("ShapeId", column[:, 1].astype(np.int32)),
                         ("Color", column[:, 2:].astype(np.float32))):
        surface.GetPointData().AddArray(_array(name, values))
    if all(flat is not None for flat in coordinates):
        surface.GetPointData().SetTCoords(_array("TextureCoordinates", np.concatenate(coordinates)))
    return surface


def marked(motion: Any) -> vtkPolyData:
    """The places of all marks, with their `Radius`; of paths a line."""
    single = [*motion.marks.flying, *((point, 0.0) for point in motion.marks.resting)]
    radii = np.array([radius for _, radius in single] + [0.0 for path in motion.marks.paths for _ in path], float)
    surface = vtkPolyData()
    if not len(radii):
        return surface
    surface.SetPoints(_points(np.array([*(point for point, _ in single), *(point for path in motion.marks.paths for point in path)])))
    surface.GetPointData().AddArray(_array("Radius", radii))
    vertices, lines = vtkCellArray(), vtkCellArray()
    vertices.SetData(_ids(np.arange(len(single) + 1)), _ids(np.arange(len(single))))
    offsets = np.concatenate([[0], np.cumsum([len(path) for path in motion.marks.paths])])
    lines.SetData(_ids(offsets), _ids(np.arange(len(single), len(radii))))
    surface.SetVerts(vertices)
    surface.SetLines(lines)
    return surface


def _points(places):
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(places, float), deep=True))
    return points


def _ids(numbers):
    return numpy_to_vtkIdTypeArray(np.ascontiguousarray(numbers, np.int64), deep=True)


def _array(name, values):
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    return array
