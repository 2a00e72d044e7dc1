# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of the planner's page, and its table of takes, from the scenes in Data/Scenes.

PYTHONPATH=build/lib/python3/dist-packages xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" \\
  pvbatch Documentation/scripts/make_plan_pictures.py [trees] [maze] [spiral] [takes]
"""

import os
import sys

import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import waft  # noqa: E402
from make_stage_pictures import EYE, OBSTACLE, VORTEX, WIND, Picture, output, tubes  # noqa: E402
from waft.render._scenery import lines  # noqa: E402

BOX = (-2.0, 2.0, -2.0, 2.0, 0.0, 4.0)
FOCUS = (0.0, 0.0, 1.85)
PATH = (0.16, 0.16, 0.18)
TREES = (WIND, VORTEX)  # from the start, from the goal
TAKES = ((0.16, 0.42, 0.66), (0.80, 0.33, 0.13), (0.30, 0.55, 0.30), (0.55, 0.35, 0.60))


class Plan:
    """A scene from Data/Scenes, planned with the embedded database."""

    def __init__(self, scene, **options):
        self.reader = simple.MotionSceneReader(FileName=waft.data_file(f"Scenes/{scene}.waft.json"))
        self.reader.UpdatePipeline()
        database = simple.XMLMultiBlockDataReader(FileName=[waft.data_file("Database/embedded.vtm")])
        database.TimeArray = "None"
        objects, constraints, obstacles = (simple.OutputPort(self.reader, port) for port in (0, 1, 2))
        self.planner = simple.StylisticPlannerFilter(
            Database=database, Objects=objects, Constraints=constraints, Obstacles=obstacles, **options)
        self.planner.UpdatePipeline()

    def path(self, number=0):
        tracks = output(self.planner)
        points = vtk_to_numpy(tracks.GetPoints().GetData())
        return points.reshape(tracks.GetNumberOfLines(), -1, 3)[number]

    def marks(self):
        """The start, and where the path is at the frames of its rows."""
        frames = vtk_to_numpy(output(self.planner, 3).GetPointData().GetArray("Frame"))
        return self.path()[[0, *frames]]

    def show_path(self, picture, color=PATH, radius=0.02):
        path = self.path()
        picture.show(tubes(lines(path, [range(len(path))]), radius), color)

    def show_marks(self, picture):
        for place in self.marks():
            ball = vtkSphereSource()
            ball.SetCenter(*place)
            ball.SetRadius(0.055)
            ball.SetThetaResolution(24)
            ball.SetPhiResolution(16)
            ball.Update()
            picture.show(ball.GetOutput(), PATH)

    def show_trees(self, picture):
        data = output(self.planner, 1)
        side = vtk_to_numpy(data.GetCellData().GetArray("Tree"))
        points = vtk_to_numpy(data.GetPoints().GetData())
        offsets = vtk_to_numpy(data.GetLines().GetOffsetsArray())
        order = vtk_to_numpy(data.GetLines().GetConnectivityArray())
        for tree in (0, 1):
            cells = np.flatnonzero(side == tree)
            branches = lines(points, [order[offsets[k]:offsets[k + 1]] for k in cells])
            picture.show(branches, TREES[tree], 0.45, width=1)

    def show_walls(self, picture):
        """All obstacles but the ground, to be looked through."""
        data = output(self.reader, 2)
        points = vtk_to_numpy(data.GetPoints().GetData())
        walls = vtkPolyData()
        walls.DeepCopy(data)
        walls.BuildLinks()
        for cell in range(walls.GetNumberOfCells()):
            ids = walls.GetCell(cell).GetPointIds()
            corners = points[[ids.GetId(i) for i in range(ids.GetNumberOfIds())]]
            if corners[:, 2].max() < 1e-6:
                walls.DeleteCell(cell)
        walls.RemoveDeletedCells()
        picture.show(walls, OBSTACLE, 0.28)


def page():
    picture = Picture(820, 620)
    picture.box(BOX)
    return picture


def trees():
    plan = Plan("feather-waypoints", Seed=3)
    picture = page()
    plan.show_trees(picture)
    plan.show_path(picture)
    plan.show_marks(picture)
    picture.look_from(EYE, FOCUS)
    picture.write("plan_trees.png")


def maze():
    plan = Plan("feather-maze", Seed=2)
    picture = page()
    plan.show_walls(picture)
    plan.show_trees(picture)
    plan.show_path(picture)
    plan.show_marks(picture)
    picture.renderer.SetUseDepthPeeling(1)
    picture.window.SetAlphaBitPlanes(1)
    picture.look_from((-2.6, -11.6, 5.2), FOCUS)
    picture.write("plan_maze.png")


def spiral():
    plan = Plan("feather-spiral", Seed=5)
    picture = page()
    plan.show_path(picture)
    plan.show_marks(picture)
    picture.look_from(EYE, FOCUS)
    picture.write("plan_spiral.png")


def takes():
    picture = page()
    for take, color in enumerate(TAKES):
        plan = Plan("feather-waypoints", Seed=3, NumberOfTakes=len(TAKES), Take=take)
        plan.show_path(picture, color, 0.014)
    plan.show_marks(picture)
    picture.look_from(EYE, FOCUS)
    picture.write("plan_takes.png")
    table = output(plan.planner, 5)
    names = [table.GetColumnName(c) for c in range(table.GetNumberOfColumns())]
    print("| " + " | ".join(names) + " |")
    print("|---" * len(names) + "|")
    for row in range(table.GetNumberOfRows()):
        values = [table.GetColumn(c).GetValue(row) for c in range(len(names))]
        print("| " + " | ".join(f"{v:.3f}" if isinstance(v, float) else str(v) for v in values) + " |")


if __name__ == "__main__":
    for wanted in sys.argv[1:] or ("trees", "maze", "spiral", "takes"):
        {"trees": trees, "maze": maze, "spiral": spiral, "takes": takes}[wanted]()
