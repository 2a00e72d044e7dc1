# SPDX-License-Identifier: BSD-3-Clause
"""A small folder like the one that `waft synthesize` writes, from closed formulas: leaves on
swinging arcs, two of them at rest at the end, a box, the ground, marks of every kind."""

import math
import os

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import (
    vtkCellArray,
    vtkImageData,
    vtkMultiBlockDataSet,
    vtkPolyData,
)
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkTriangleFilter
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkSphereSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataWriter, vtkXMLPolyDataWriter

FRAMES = 61
RATE = 30.0
BOUNDS = (-1.0, 1.0, -1.0, 1.0, 0.0, 2.0)


def add(attributes, name, values, kind=float):
    array = numpy_to_vtk(np.ascontiguousarray(values, kind), deep=True)
    array.SetName(name)
    attributes.AddArray(array)


def _add_scene(data):
    fields = data.GetFieldData()
    add(fields, "Bounds", [BOUNDS])
    add(fields, "NumberOfFrames", [FRAMES], np.int32)
    add(fields, "FramesPerSecond", [RATE])
    add(fields, "AirDensity", [1.2])
    add(fields, "Seed", [1], np.int32)


def _vertices(points):
    data = vtkPolyData()
    places = vtkPoints()
    places.SetData(numpy_to_vtk(np.ascontiguousarray(points, float), deep=True))
    cells = vtkCellArray()
    for index in range(len(points)):
        cells.InsertNextCell(1)
        cells.InsertCellPoint(index)
    data.SetPoints(places)
    data.SetVerts(cells)
    return data


def _write(data, path):
    writer = vtkXMLPolyDataWriter()
    writer.SetDataModeToBinary()
    writer.SetInputData(data)
    writer.SetFileName(path)
    if not writer.Write():
        raise OSError(path)


def motion():
    """Positions [object, frame, 3] and orientations (w, x, y, z) [object, frame, 4]."""
    time = np.arange(FRAMES) / RATE
    count = 6
    positions = np.empty((count, FRAMES, 3))
    orientations = np.empty((count, FRAMES, 4))
    for i in range(count):
        swing = 2.0 * math.pi * (0.7 * time + i / count)
        fall = np.minimum(time, 1.6) if i < 2 else time
        top = 1.25 + 0.1 * i
        height = top - (top - 0.014) / 1.6 * fall if i < 2 else top - 0.35 * fall
        # A leaf that has landed no longer swings.
        still = 2.0 * math.pi * (0.7 * 1.6 + i / count)
        swing = np.minimum(swing, still) if i < 2 else swing
        positions[i, :, 0] = -0.75 + 0.3 * i + 0.15 * np.sin(swing)
        positions[i, :, 1] = -0.5 + 0.22 * (i % 3) + 0.1 * np.cos(swing)
        positions[i, :, 2] = height
        tilt = 0.6 * np.cos(swing) * (np.clip(1.6 - time, 0.0, 1.0) if i < 2 else 1.0)
        yaw = 0.9 * i
        orientations[i, :, 0] = np.cos(0.5 * tilt) * math.cos(0.5 * yaw)
        orientations[i, :, 1] = np.sin(0.5 * tilt) * math.cos(0.5 * yaw)
        orientations[i, :, 2] = np.sin(0.5 * tilt) * math.sin(0.5 * yaw)
        orientations[i, :, 3] = np.cos(0.5 * tilt) * math.sin(0.5 * yaw)
    return positions, orientations


def _write_texture(path):
    """A leaf of 128 x 64 pixels: pointed outline in alpha, a pale vein."""
    u, v = np.meshgrid(np.linspace(-1.0, 1.0, 128), np.linspace(-1.0, 1.0, 64))
    width = np.clip(1.0 - np.abs(u), 0.0, None) ** 0.7 * (1.0 - 0.25 * u)
    pixels = np.empty((64, 128, 4), np.uint8)
    vein = np.exp(-((v / 0.08) ** 2))[..., None]
    pixels[..., :3] = np.array([196, 98, 32]) * (1.0 - vein) + np.array([238, 190, 110]) * vein
    pixels[..., 3] = np.where(np.abs(v) < width, 255, 0)
    data = vtkImageData()
    data.SetDimensions(128, 64, 1)
    data.GetPointData().SetScalars(numpy_to_vtk(pixels.reshape(-1, 4), deep=True))
    writer = vtkPNGWriter()
    writer.SetInputData(data)
    writer.SetFileName(path)
    writer.Write()


def _leaf():
    """A curled sheet 0.30 m long, with texture coordinates."""
    u, v = np.meshgrid(np.linspace(-1.0, 1.0, 9), np.linspace(-1.0, 1.0, 5))
    points = np.stack([0.15 * u, 0.08 * v, 0.03 * (u**2 - 0.4) + 0.01 * v**2], axis=-1)
    data = vtkPolyData()
    places = vtkPoints()
    places.SetData(numpy_to_vtk(points.reshape(-1, 3), deep=True))
    cells = vtkCellArray()
    for row in range(4):
        for column in range(8):
            first = 9 * row + column
            for triangle in ((first, first + 1, first + 10), (first, first + 10, first + 9)):
                cells.InsertNextCell(3)
                for index in triangle:
                    cells.InsertCellPoint(index)
    data.SetPoints(places)
    data.SetPolys(cells)
    coordinates = numpy_to_vtk(
        np.stack([0.5 + 0.5 * u, 0.5 + 0.5 * v], axis=-1).reshape(-1, 2).astype(np.float32), deep=True
    )
    coordinates.SetName("TextureCoordinates")
    data.GetPointData().SetTCoords(coordinates)
    return data


def _bubble():
    sphere = vtkSphereSource()
    sphere.SetRadius(0.08)
    sphere.SetThetaResolution(24)
    sphere.SetPhiResolution(16)
    sphere.Update()
    data = vtkPolyData()
    data.DeepCopy(sphere.GetOutput())
    return data


def _write_shapes(path, tint):
    blocks = vtkMultiBlockDataSet()
    for index, (name, surface, texture, density) in enumerate(
        (("leaf", _leaf(), "leaf.png", 0.1), ("bubble", _bubble(), "", 0.002))
    ):
        fields = surface.GetFieldData()
        add(fields, "Color", [[1.0, 1.0, 1.0]])
        add(fields, "Tint", [tint])
        add(fields, "AreaDensity", [density])
        add(fields, "Opacity", [0.35 if density < 0.01 else 1.0])
        names = vtkStringArray()
        names.SetName("Texture")
        names.InsertNextValue(texture)
        fields.AddArray(names)
        blocks.SetBlock(index, surface)
        blocks.GetMetaData(index).Set(blocks.NAME(), name)
    writer = vtkXMLMultiBlockDataWriter()
    writer.SetDataModeToBinary()
    writer.SetInputData(blocks)
    writer.SetFileName(path)
    if not writer.Write():
        raise OSError(path)


def _write_obstacles(path):
    both = vtkAppendPolyData()
    for number, box in enumerate(
        ((0.15, 0.75, 0.1, 0.7, 0.0, 0.5), (-1.5, 1.5, -1.5, 1.5, -0.2, 0.0))
    ):
        cube = vtkCubeSource()
        cube.SetBounds(*box)
        triangles = vtkTriangleFilter()
        triangles.SetInputConnection(cube.GetOutputPort())
        triangles.Update()
        data = vtkPolyData()
        data.CopyStructure(triangles.GetOutput())
        add(data.GetPointData(), "ObstacleId", np.full(data.GetNumberOfPoints(), number), np.int32)
        both.AddInputData(data)
    both.Update()
    _write(both.GetOutput(), path)


def _write_constraints(path, positions):
    rows = [(2, 40, 0, positions[2, 40], 0.0, 0, 0), (3, 30, 0, positions[3, 30], 0.1, 1, 0)]
    rows += [(4, k, 0, positions[4, k], 0.0, 2, 0) for k in range(20, 31)]
    rows += [(i, 48, 4, positions[i, 48], 0.0, 3 + i, 0) for i in range(2)]
    data = _vertices([row[3] for row in rows])
    columns = data.GetPointData()
    add(columns, "ObjectId", [row[0] for row in rows], np.int32)
    add(columns, "Frame", [row[1] for row in rows], np.int32)
    add(columns, "Kind", [row[2] for row in rows], np.uint8)
    add(columns, "Value", [[*row[3], 0.0] for row in rows])
    add(columns, "Radius", [row[4] for row in rows])
    add(columns, "Row", [row[5] for row in rows], np.int32)
    add(columns, "Target", [row[6] for row in rows], np.int32)
    _write(data, path)


def write(folder, tint=(1.0, 1.0, 1.0)):
    """Writes the whole folder; what was there under the same names is replaced. tint: of the textures."""
    os.makedirs(folder, exist_ok=True)
    positions, orientations = motion()
    count = len(positions)
    poses = _vertices(positions.reshape(-1, 3))
    poses.SetVerts(vtkCellArray())
    cells = vtkCellArray()
    for i in range(count):
        cells.InsertNextCell(FRAMES)
        for k in range(FRAMES):
            cells.InsertCellPoint(i * FRAMES + k)
    poses.SetLines(cells)
    add(poses.GetPointData(), "Orientation", orientations.reshape(-1, 4))
    add(poses.GetPointData(), "Frame", np.tile(np.arange(FRAMES), count), np.int32)
    add(poses.GetCellData(), "ObjectId", np.arange(count), np.int32)
    _add_scene(poses)
    _write(poses, os.path.join(folder, "poses.vtp"))
    objects = _vertices(positions[:, 0, :])
    add(objects.GetPointData(), "ObjectId", np.arange(count), np.int32)
    add(objects.GetPointData(), "ShapeId", [0] * (count - 1) + [1], np.int32)
    _add_scene(objects)
    _write(objects, os.path.join(folder, "objects.vtp"))
    _write_texture(os.path.join(folder, "leaf.png"))
    _write_shapes(os.path.join(folder, "shapes.vtm"), tint)
    _write_obstacles(os.path.join(folder, "obstacles.vtp"))
    _write_constraints(os.path.join(folder, "constraints.vtp"), positions)
