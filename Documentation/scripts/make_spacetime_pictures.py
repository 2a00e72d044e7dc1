# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of the optimiser's page, from one run of a scene.

PYTHONPATH=build/lib/python3/dist-packages xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" \\
  pvbatch Documentation/scripts/make_spacetime_pictures.py [SCENE.waft.json] [PROPERTY=NUMBER ...]

SCENE is leaves-letters without one; properties are those of SPHSpacetimeFilter.
"""

import os
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkChartsCore import vtkAxis, vtkChart, vtkChartXY
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkGlyph3D
from vtkmodules.vtkFiltersSources import vtkArrowSource, vtkSphereSource
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkViewsContext2D import vtkContextView

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import waft  # noqa: E402
from paraview import simple  # noqa: E402
from make_coverage_picture import SAMPLES, add, name_axis  # noqa: E402
from make_stage_pictures import AGAINST, GALLERY, VORTEX, WIND, Picture, colored, output, tubes  # noqa: E402
from waft.files import table_rows  # noqa: E402
from waft.loading import load_plugin  # noqa: E402
from waft.loading import set_threads  # noqa: E402
from waft.render._output import grab, write_png  # noqa: E402
from waft.render._scenery import lines  # noqa: E402

EYE = (-6.3, -11.2, 6.0)
FOCUS = (0.0, 0.0, 1.75)
PLANNED, FOUND = WIND, VORTEX
SLOW, FAST = np.array((0.80, 0.84, 0.88)), np.array((0.10, 0.27, 0.52))
OBJECT = (0.90, 0.55, 0.10)
TIME = 4.0  # s


class Run:
    """A scene, planned and optimised, its proxies alive."""

    def __init__(self, scene, properties):
        load_plugin()
        set_threads(None)
        animation = simple.WaftAnimation(FileName=scene, Quality="Paper")
        self.planner, self.filter = (waft.unfold(animation)[name] for name in ("Planner", "Spacetime"))
        for name, value in properties.items():
            setattr(self.filter, name, value)
        self.filter.UpdatePipeline(TIME)
        bounds = output(self.planner).GetFieldData().GetArray("Bounds")
        self.bounds = tuple(bounds.GetValue(k) for k in range(6))

    def paths(self, planned):
        data = output(self.planner if planned else self.filter)
        points = vtk_to_numpy(data.GetPoints().GetData())
        return points.reshape(data.GetNumberOfLines(), -1, 3)


def balls(places, radius, colors):
    """A small ball at each place; colors: rows of three bytes."""
    cloud = vtkPolyData()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(places, float), deep=True))
    cloud.SetPoints(points)
    colored(cloud, colors)
    ball = vtkSphereSource()
    ball.SetRadius(radius)
    ball.SetThetaResolution(10)
    ball.SetPhiResolution(8)
    glyph = vtkGlyph3D()
    glyph.SetInputData(cloud)
    glyph.SetSourceConnection(ball.GetOutputPort())
    glyph.ScalingOff()
    glyph.SetColorModeToColorByScalar()
    glyph.Update()
    return glyph.GetOutput()


def arrows(places, vectors, scale):
    cloud = vtkPolyData()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(places, float), deep=True))
    cloud.SetPoints(points)
    cloud.GetPointData().SetVectors(numpy_to_vtk(np.ascontiguousarray(vectors, float), deep=True))
    arrow = vtkArrowSource()
    arrow.SetTipResolution(12)
    arrow.SetShaftResolution(8)
    arrow.SetTipRadius(0.14)
    arrow.SetShaftRadius(0.05)
    glyph = vtkGlyph3D()
    glyph.SetInputData(cloud)
    glyph.SetSourceConnection(arrow.GetOutputPort())
    glyph.SetVectorModeToUseVector()
    glyph.SetScaleModeToScaleByVector()
    glyph.SetScaleFactor(scale)
    glyph.Update()
    return glyph.GetOutput()


def paths(run):
    """Planned paths, then those of one body of air, a picture each."""
    for planned, color, name in ((True, PLANNED, "spacetime_planned.png"), (False, FOUND, "spacetime_found.png")):
        picture = Picture(540, 480)
        picture.box(run.bounds)
        for path in run.paths(planned):
            picture.show(tubes(lines(path, [range(len(path))]), 0.010, 6), color)
        picture.look_from(EYE, FOCUS)
        picture.write(name)


def gas(run):
    """The gas by its speed, objects, and the vortices as strong as they are at that time."""
    data = output(run.filter, 1)
    places = vtk_to_numpy(data.GetPoints().GetData())
    speed = np.linalg.norm(vtk_to_numpy(data.GetPointData().GetArray("Velocity")), axis=1)
    kind = vtk_to_numpy(data.GetPointData().GetArray("Kind"))
    air = kind == 0
    share = np.clip(speed[air] / np.percentile(speed[air], 98), 0.0, 1.0)[:, None]
    shades = (255.0 * (SLOW + share * (FAST - SLOW))).astype(np.uint8)
    picture = Picture(820, 620)
    picture.box(run.bounds)
    picture.show(balls(places[air], 0.030, shades), None, 0.55)
    objects = np.array([path[int(round(TIME * 30.0))] for path in run.paths(False)])
    picture.show(balls(objects, 0.075, np.tile((255 * np.array(OBJECT)).astype(np.uint8), (len(objects), 1))), None)
    vortices = output(run.filter, 2)
    cells = {name: vtk_to_numpy(vortices.GetCellData().GetArray(name))
             for name in ("Strength", "CenterTime", "Duration", "CoreRadius")}
    for cell in range(vortices.GetNumberOfCells()):
        strength = np.exp(-0.5 * ((TIME - cells["CenterTime"][cell]) / cells["Duration"][cell]) ** 2)
        if strength < 0.05:
            continue
        ends = [vortices.GetPoint(vortices.GetCell(cell).GetPointId(i)) for i in range(2)]
        picture.show(tubes(lines(np.array(ends), [[0, 1]]), 0.2 * cells["CoreRadius"][cell], 24),
                     VORTEX if cells["Strength"][cell] > 0.0 else AGAINST, float(0.2 + 0.7 * strength))
    picture.look_from(EYE, FOCUS)
    picture.write("spacetime_gas.png")


def wind(run):
    image = output(run.filter, 3)
    vectors = vtk_to_numpy(image.GetPointData().GetArray("Wind"))
    places = np.array([image.GetPoint(i) for i in range(image.GetNumberOfPoints())])
    fastest = np.linalg.norm(vectors, axis=1).max()
    picture = Picture(540, 480)
    picture.box(run.bounds)
    if fastest > 0.0:
        picture.show(arrows(places, vectors, 0.6 / fastest), WIND)
    picture.look_from(EYE, FOCUS)
    picture.write("spacetime_wind.png")
    print(f"strongest wind at {TIME:g} s: {fastest:.3g} m/s^2")


def convergence(run):
    """E of each iteration against the time since the start, a line a level."""
    header, rows = table_rows(output(run.filter, 4))
    rows = [dict(zip(header, row)) for row in rows]
    chart = vtkChartXY()
    chart.SetShowLegend(True)
    groups = (("every fourth frame", lambda s: s.endswith("coarser"), PLANNED),
              ("every second frame", lambda s: s.startswith("free") and not s.endswith("coarser"), (0.30, 0.55, 0.30)),
              ("all frames", lambda s: s.startswith("fine"), FOUND))
    for label, belongs, color in groups:
        chosen = [row for row in rows if belongs(row["Stage"])]
        if chosen:
            add(chart, vtkChart.LINE, np.array([float(row["Seconds"]) for row in chosen]),
                np.array([float(row["E"]) for row in chosen]), label, color, 2.0)
    values = [float(row["E"]) for row in rows]
    name_axis(chart.GetAxis(vtkAxis.BOTTOM), "seconds", 0.0, float(rows[-1]["Seconds"]))
    chart.GetAxis(vtkAxis.LEFT).SetLogScale(True)
    name_axis(chart.GetAxis(vtkAxis.LEFT), "E", 0.8 * min(values), 1.25 * max(values))
    chart.GetLegend().GetLabelProperties().SetFontSize(12 * SAMPLES)
    view = vtkContextView()
    view.GetRenderer().SetBackground(1.0, 1.0, 1.0)
    view.GetRenderWindow().SetOffScreenRendering(1)
    view.GetRenderWindow().SetMultiSamples(0)
    view.GetRenderWindow().SetSize(820 * SAMPLES, 420 * SAMPLES)
    view.GetScene().AddItem(chart)
    view.GetRenderWindow().Render()
    write_png(grab(view.GetRenderWindow(), SAMPLES), os.path.join(GALLERY, "spacetime_convergence.png"))


if __name__ == "__main__":
    words = sys.argv[1:]
    scene = next((word for word in words if "=" not in word), waft.data_file("Scenes/leaves-letters.waft.json"))
    numbers = {name: float(value) if "." in value else int(value)
               for name, value in (word.split("=") for word in words if "=" in word)}
    made = Run(str(scene), numbers)
    for draw in (paths, gas, wind, convergence):
        draw(made)
