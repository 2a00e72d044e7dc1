# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of the pages on smoke, tracks, clusters and the database, from a run of its own and the embedded
database.

PYTHONPATH=build/lib/python3/dist-packages xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" \\
  pvbatch Documentation/scripts/make_stage_pictures.py [smoke] [tracks] [clusters] [database]
"""

import os
import sys

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (the rendering back end)
import vtkmodules.vtkRenderingVolumeOpenGL2  # noqa: F401
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction, vtkPolyData
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals, vtkTubeFilter
from vtkmodules.vtkFiltersSources import vtkOutlineSource, vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataReader
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkColorTransferFunction,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkVolume,
)
from vtkmodules.vtkRenderingVolumeOpenGL2 import vtkSmartVolumeMapper

import waft
from waft.render._output import grab, write_png
from waft.render._scenery import lines

GALLERY = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "gallery")
SAMPLES = 3
VORTEX, WIND, NEITHER = (0.80, 0.33, 0.13), (0.16, 0.42, 0.66), (0.72, 0.72, 0.70)
AGAINST = (0.16, 0.42, 0.66)  # of a vortex that turns the other way
OBSTACLE = (0.62, 0.60, 0.56)
RUN = {"Seed": 4, "NumberOfEmitters": 3, "NumberOfObstacles": 3}
TIME = 4.0  # s
EYE = (-5.2, -10.8, 5.0)


class Picture:
    def __init__(self, width, height):
        self.renderer = vtkRenderer()
        self.renderer.SetBackground(1.0, 1.0, 1.0)
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(0)
        self.window.SetSize(width * SAMPLES, height * SAMPLES)
        self.window.AddRenderer(self.renderer)

    def show(self, surface, color, opacity=1.0, width=None):
        """A surface, or lines of a width in pixels; color None: by its scalars, three bytes a point."""
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(surface)
        mapper.SetScalarVisibility(color is None)
        actor = vtkActor()
        actor.SetMapper(mapper)
        look = actor.GetProperty()
        if color is not None:
            look.SetColor(*color)
        look.SetOpacity(opacity)
        look.SetAmbient(0.35)
        look.SetDiffuse(0.7)
        if width is not None:
            look.SetLineWidth(width * SAMPLES)
            look.LightingOff()
        self.renderer.AddActor(actor)
        return actor

    def box(self, bounds):
        outline = vtkOutlineSource()
        outline.SetBounds(*bounds)
        outline.Update()
        self.show(outline.GetOutput(), (0.6, 0.6, 0.6), width=1)

    def look_from(self, position, focus, angle=28.0):
        camera = self.renderer.GetActiveCamera()
        camera.SetPosition(*position)
        camera.SetFocalPoint(*focus)
        camera.SetViewUp(0.0, 0.0, 1.0)
        camera.SetViewAngle(angle)
        self.renderer.ResetCameraClippingRange()

    def look_down(self, center, height):
        camera = self.renderer.GetActiveCamera()
        camera.ParallelProjectionOn()
        camera.SetParallelScale(0.5 * height)
        camera.SetFocalPoint(center[0], center[1], 0.0)
        camera.SetPosition(center[0], center[1], 50.0)
        camera.SetViewUp(0.0, 1.0, 0.0)
        self.renderer.ResetCameraClippingRange()

    def write(self, name):
        self.window.Render()
        write_png(grab(self.window, SAMPLES), os.path.join(GALLERY, name))


def tubes(data, radius, sides=10):
    tube = vtkTubeFilter()
    tube.SetInputData(data)
    tube.SetRadius(radius)
    tube.SetNumberOfSides(sides)
    tube.CappingOn()
    tube.Update()
    return tube.GetOutput()


def bytes_of(color):
    return (255.0 * np.asarray(color) + 0.5).astype(np.uint8)


def colored(data, colors):
    """Colours of the points, rows of three bytes."""
    data.GetPointData().SetScalars(numpy_to_vtk(np.ascontiguousarray(colors, np.uint8), deep=True))
    return data


def smoke_run():
    source = simple.GridSmokeSource(**RUN)
    source.UpdatePipeline(TIME)
    return source


def output(proxy, port=0):
    return proxy.GetClientSideObject().GetOutputDataObject(port)


def add_obstacles(picture, source):
    normals = vtkPolyDataNormals()
    normals.SetInputData(output(source, 2))
    normals.SetFeatureAngle(40.0)
    normals.Update()
    picture.show(normals.GetOutput(), OBSTACLE)


def smoke():
    source = smoke_run()
    image = output(source)
    image.GetPointData().SetActiveScalars("Density")
    picture = Picture(820, 620)
    picture.box((-2.0, 2.0, -2.0, 2.0, 0.0, 4.0))
    add_obstacles(picture, source)
    vortices = output(source, 1)
    strength = vtk_to_numpy(vortices.GetCellData().GetArray("Strength"))
    center = vtk_to_numpy(vortices.GetCellData().GetArray("CenterTime"))
    duration = vtk_to_numpy(vortices.GetCellData().GetArray("Duration"))
    core = vtk_to_numpy(vortices.GetCellData().GetArray("CoreRadius"))
    factor = np.exp(-0.5 * ((TIME - center) / duration) ** 2)
    for cell in range(vortices.GetNumberOfCells()):
        ends = [vortices.GetPoint(vortices.GetCell(cell).GetPointId(i)) for i in range(2)]
        axis = tubes(lines(np.array(ends), [[0, 1]]), 0.35 * core[cell], 24)
        picture.show(axis, VORTEX if strength[cell] > 0.0 else AGAINST, float(0.15 + 0.85 * factor[cell]))
    mapper = vtkSmartVolumeMapper()
    mapper.SetInputData(image)
    mapper.SetSampleDistance(0.02)
    mapper.AutoAdjustSampleDistancesOff()
    volume = vtkVolume()
    volume.SetMapper(mapper)
    opacity = vtkPiecewiseFunction()
    for density, value in ((0.0, 0.0), (0.03, 0.0), (0.25, 0.08), (1.0, 0.45)):
        opacity.AddPoint(density, value)
    color = vtkColorTransferFunction()
    color.AddRGBPoint(0.0, 0.55, 0.56, 0.60)
    color.AddRGBPoint(1.0, 0.20, 0.21, 0.25)
    volume.GetProperty().SetScalarOpacity(opacity)
    volume.GetProperty().SetScalarOpacityUnitDistance(0.12)
    volume.GetProperty().SetColor(color)
    volume.GetProperty().SetInterpolationTypeToLinear()
    picture.renderer.AddVolume(volume)
    picture.look_from(EYE, (0.0, 0.0, 1.85))
    picture.write("smoke.png")


def tracks():
    source = smoke_run()
    trace = simple.TrajectoryTraceFilter(
        Input=simple.OutputPort(source, 0), Vortices=simple.OutputPort(source, 1),
        Obstacles=simple.OutputPort(source, 2))
    trace.SeedStride = 16
    trace.UpdatePipeline()
    data = output(trace)
    force = vtk_to_numpy(data.GetPointData().GetArray("ForceType"))
    palette = bytes_of([NEITHER, WIND, VORTEX])
    paths = vtkPolyData()
    paths.CopyStructure(data)
    picture = Picture(820, 620)
    picture.box((-2.0, 2.0, -2.0, 2.0, 0.0, 4.0))
    add_obstacles(picture, source)
    picture.show(tubes(colored(paths, palette[force]), 0.011, 6), None)
    picture.look_from(EYE, (0.0, 0.0, 1.85))
    picture.write("tracks.png")


class Database:
    def __init__(self):
        reader = vtkXMLMultiBlockDataReader()
        reader.SetFileName(waft.data_file("Database/embedded.vtm"))
        reader.Update()
        blocks = reader.GetOutput()
        data = {blocks.GetMetaData(i).Get(blocks.NAME()): blocks.GetBlock(i) for i in range(blocks.GetNumberOfBlocks())}
        segments, nodes = data["Segments"], data["Nodes"]
        self.points = vtk_to_numpy(segments.GetPoints().GetData())
        self.force = vtk_to_numpy(segments.GetPointData().GetArray("ForceType"))
        self.offsets = vtk_to_numpy(segments.GetLines().GetOffsetsArray())
        self.order = vtk_to_numpy(segments.GetLines().GetConnectivityArray())
        self.node = {nodes.GetColumnName(c): vtk_to_numpy(nodes.GetColumn(c))
                     for c in range(nodes.GetNumberOfColumns())}

    def segment(self, number):
        """Its point numbers."""
        return self.order[self.offsets[number]:self.offsets[number + 1]]

    def members(self, node):
        """The segments of a node: the medoids of the leaves below it."""
        first, count = self.node["FirstChild"][node], self.node["NumberOfChildren"][node]
        if count == 0:
            return [int(self.node["Medoid"][node])]
        return [segment for child in range(first, first + count) for segment in self.members(child)]

    def top(self):
        return np.flatnonzero(self.node["Parent"] < 0)


def seen(points):
    """Points as they look from the side and a little above: x to the right, y up, z towards the eye."""
    turn = vtkTransform()
    turn.RotateX(-62.0)
    turn.RotateZ(25.0)
    matrix = np.array([[turn.GetMatrix().GetElement(i, j) for j in range(3)] for i in range(3)])
    return points @ matrix.T


class Sheet:
    """Small drawings of segments in the cells of a page, each fitted into its cell, a dot where flight begins."""

    def __init__(self, base, count, columns, width, height):
        self.base = base
        self.columns = columns
        self.rows = (count + columns - 1) // columns
        self.tall = height / width * columns / self.rows  # of a cell one wide
        self.picture = Picture(width, height)

    def fit(self, number, segments):
        """The cell that later calls draw in; all of the segments find room in it."""
        points = np.concatenate([seen(self.base.points[self.base.segment(s)]) for s in segments])
        low, high = points.min(axis=0), points.max(axis=0)
        self.middle = 0.5 * (low + high)
        self.scale = 0.82 * min(1.0 / (high[0] - low[0]), self.tall / (high[1] - low[1]))
        column, row = number % self.columns, self.rows - 1 - number // self.columns
        self.place = np.array([column + 0.5, (row + 0.5) * self.tall, 0.0])

    def draw(self, segment, color, radius, height=0.0):
        """color None: by what drives it."""
        numbers = self.base.segment(segment)
        points = self.place + self.scale * (seen(self.base.points[numbers]) - self.middle) * [1.0, 1.0, 0.1]
        points[:, 2] += height
        data = lines(points, [range(len(points))])
        if color is None:
            colored(data, bytes_of([NEITHER, WIND, VORTEX])[self.base.force[numbers]])
        self.picture.show(tubes(data, radius, 8), color)
        return points[0]

    def dot(self, place, radius):
        ball = vtkSphereSource()
        ball.SetCenter(*place)
        ball.SetRadius(radius)
        ball.SetThetaResolution(16)
        ball.SetPhiResolution(12)
        ball.Update()
        self.picture.show(ball.GetOutput(), (0.25, 0.25, 0.27))

    def write(self, name):
        self.picture.look_down((0.5 * self.columns, 0.5 * self.rows * self.tall), self.rows * self.tall)
        self.picture.write(name)


def clusters():
    base = Database()
    top = base.top()
    length = np.array([len(base.segment(m)) for m in base.node["Medoid"][top]])
    size = base.node["NumberOfSegments"][top]
    long = top[length == 40]
    chosen = long[np.argsort(-size[length == 40], kind="stable")][:12]
    sheet = Sheet(base, len(chosen), 4, 820, 520)
    for number, node in enumerate(chosen):
        group = base.members(node)
        group = group[:: -(-len(group) // 40)]
        medoid = int(base.node["Medoid"][node])
        sheet.fit(number, [*group, medoid])
        for segment in group:
            sheet.draw(segment, (0.62, 0.70, 0.78), 0.004)
        sheet.dot(sheet.draw(medoid, VORTEX, 0.012, 0.5), 0.024)
    sheet.write("clusters.png")


def database():
    base = Database()
    top = base.top()
    sheet = Sheet(base, len(top), 20, 820, 260)
    for number, node in enumerate(top):
        medoid = int(base.node["Medoid"][node])
        sheet.fit(number, [medoid])
        sheet.dot(sheet.draw(medoid, None, 0.026), 0.055)
    sheet.write("database.png")


if __name__ == "__main__":
    for wanted in sys.argv[1:] or ("smoke", "tracks", "clusters", "database"):
        {"smoke": smoke, "tracks": tracks, "clusters": clusters, "database": database}[wanted]()
