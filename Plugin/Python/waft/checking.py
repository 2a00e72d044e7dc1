# SPDX-License-Identifier: BSD-3-Clause
"""What of a scene cannot be, and what will be hard, before anything is flown: `waft check`."""
import dataclasses
import itertools
import os

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import mutable, vtkIdList
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStaticCellLocator
from vtkmodules.vtkFiltersCore import vtkImplicitPolyDataDistance

from waft._kinds import POSITION, POSITIONAL, REST
from waft.failures import BadInput
from waft.loading import load_plugin
from waft import reading
from waft.pipeline import Pipeline
from waft.writing import read_rows
from waft.watching import Clock

_LOST = ("infeasible", "conflict")  # by itself, or beside another
_KEPT_UP = 0.5  # share of the air's top speed that a body is carried at over a whole flight
_SINKING = 0.1  # the same of air that sinks all the way
_CROWDED = 0.05  # share of the volume that the bodies' balls of clearance may take
_JUDGED = 0.02  # progress of the planner from which on the rows are judged


@dataclasses.dataclass
class Finding:
    """A sentence about a scene. is_possible: whether it is only hard."""

    text: str
    is_possible: bool = True


class Looked:
    """A scene as the reader and the planner see it, rows judged and given to objects, nothing flown."""

    def __init__(self, scene, database=None):
        load_plugin()
        if not os.path.isfile(scene):
            raise BadInput(f"{scene}: no such scene file")
        pipeline = Pipeline(scene, database)
        try:
            with Clock(quiet=True) as clock:
                pipeline.read(clock)
                pipeline.add_planner(1)
                watch = pipeline.watch("planner", clock)
                algorithm = watch.algorithm
                algorithm.AddObserver("ProgressEvent",
                                      lambda *_: algorithm.GetProgress() > _JUDGED and algorithm.SetAbortExecute(1))
                pipeline.update("planner")
            self.report = read_rows(pipeline.output("planner", 2))
            self.warnings = [text for one in pipeline.watches.values() for text in one.warnings]
            self._take(pipeline)
        finally:
            pipeline.delete()

    def _take(self, pipeline):
        objects, rows = pipeline.output("reader", 0), pipeline.planned(3)
        fields = objects.GetFieldData()
        self.rate = fields.GetArray("FramesPerSecond").GetComponent(0, 0)
        self.bounds = vtk_to_numpy(fields.GetArray("Bounds")).ravel().copy()
        self.starts = vtk_to_numpy(objects.GetPoints().GetData()).copy()
        self.ids, self.clearance, self.settling = (
            vtk_to_numpy(objects.GetPointData().GetArray(name)).copy() for name in ("ObjectId", "ClearanceRadius", "SettlingSpeed"))
        count = rows.GetNumberOfPoints()
        self.places = vtk_to_numpy(rows.GetPoints().GetData()).copy() if count else np.empty((0, 3))
        self.object, self.frame, self.kind, self.row, self.target = (
            vtk_to_numpy(rows.GetPointData().GetArray(name)).copy() if count else np.empty(0, int)
            for name in ("ObjectId", "Frame", "Kind", "Row", "Target"))
        lost = {(int(row["Row"]), int(row["Target"])) for row in self.report if row["Status"] in _LOST}
        self.can_be = np.array([pair not in lost for pair in zip(self.row.tolist(), self.target.tolist())], bool)
        self.radius = vtk_to_numpy(rows.GetPointData().GetArray("Radius")).copy() if count else np.empty(0)
        self.top_speed = reading.read_blocks(pipeline.database_file).GetBlock(0).GetFieldData().GetArray("TopSpeed").GetComponent(0, 0)
        self.obstacles = _by_id(pipeline.output("reader", 2))
        self._surface = vtkStaticCellLocator()
        self._surface.SetDataSet(pipeline.output("reader", 2))
        self._surface.BuildLocator()

    def height_below(self, place):
        """Height of the first surface straight below a place; its own where there is none."""
        share, hit, at, piece, cell = mutable(0.0), [0.0] * 3, [0.0] * 3, mutable(0), mutable(0)
        low = [place[0], place[1], self.bounds[4] - 1.0]
        return hit[2] if self._surface.IntersectWithLine(place, low, 0.0, share, hit, at, piece, cell) else place[2]


def check(scene, database=None):
    """(Looked, [Finding]) of a scene file; raises BadInput where it is malformed."""
    looked = Looked(scene, database)
    unmet = [Finding(f"row {row['Row']} target {row['Target']} (object {row['ObjectId']}, frame {row['Frame']}, {row['Kind']}): "
                     f"{row['Status']}: {row['Message']}", False)
             for row in looked.report if row["Status"] in _LOST]
    hard = [Finding(text) for text in (*looked.warnings, *_haste(looked), *_falls(looked), *_gaps(looked), *_near_marks(looked),
                                       *_crowd(looked))]
    return looked, unmet + hard


def _by_id(surface):
    """{ObstacleId: vtkPolyData}"""
    array = surface.GetPointData().GetArray("ObstacleId")
    if array is None or surface.GetNumberOfPolys() == 0:
        return {}
    owner = vtk_to_numpy(array)
    found = {}
    corners = vtkIdList()
    cells = {}
    for cell in range(surface.GetNumberOfCells()):
        surface.GetCellPoints(cell, corners)
        cells.setdefault(int(owner[corners.GetId(0)]), []).append(cell)
    for number, own in cells.items():
        ids = vtkIdList()
        for cell in own:
            ids.InsertNextId(cell)
        part = vtkPolyData()
        part.Initialize()
        part.Allocate(len(own))
        part.SetPoints(surface.GetPoints())
        part.CopyCells(surface, ids)
        found[number] = part
    return found


def _legs(looked):
    """(object's index; place, frame and radius from; index of the row to) between an object's places in time order, those left
    out that cannot be met."""
    for index, number in enumerate(looked.ids):
        rows = np.flatnonzero((looked.object == number) & np.isin(looked.kind, POSITIONAL) & looked.can_be)
        rows = rows[np.argsort(looked.frame[rows], kind="stable")]
        place, frame, room, before = looked.starts[index], 0, 0.0, -1
        for row in rows:
            if looked.frame[row] > frame and looked.row[row] != before:  # within a given path any speed will do
                yield index, place, frame, room, row
            place, frame, room, before = looked.places[row], looked.frame[row], looked.radius[row], looked.row[row]


def _haste(looked):
    """Places that are farther apart than air carries a body in the time."""
    for index, place, frame, room, row in _legs(looked):
        seconds = (looked.frame[row] - frame) / looked.rate
        distance = float(np.linalg.norm(looked.places[row] - place)) - room - looked.radius[row]
        if distance > _KEPT_UP * looked.top_speed * seconds:
            yield (f"too fast: row {looked.row[row]} target {looked.target[row]}: object {looked.ids[index]} has {seconds:.3g} s for "
                   f"{distance:.3g} m, {distance / seconds:.3g} m/s; the fastest of the database is {looked.top_speed:.2g} m/s, and "
                   f"half of that is kept up: give it {distance / (_KEPT_UP * looked.top_speed):.2g} s or more")


def _falls(looked):
    """Rests that leave no time to come down by settling and the air together."""
    for index, place, frame, room, row in _legs(looked):
        seconds = (looked.frame[row] - frame) / looked.rate
        if looked.kind[row] != REST:
            continue
        height = float(place[2] - looked.height_below(looked.places[row])) - room
        fastest = float(looked.settling[index]) + _SINKING * looked.top_speed
        if height > fastest * seconds:
            yield (f"no time to fall: row {looked.row[row]} target {looked.target[row]}: object {looked.ids[index]} falls {height:.3g} m "
                   f"in {seconds:.3g} s; it settles at {looked.settling[index]:.2g} m/s: give it {height / fastest:.2g} s or more")


def _gaps(looked):
    """Obstacles, and obstacles and walls, between which no body passes, though there is room; and marks so near to one."""
    wide = 2.0 * float(looked.clearance.max(initial=0.0))
    distances = {}
    for number, surface in looked.obstacles.items():
        distances[number] = vtkImplicitPolyDataDistance()
        distances[number].SetInput(surface)
    for one, other in itertools.combinations(looked.obstacles, 2):
        gap = min(_nearest(distances[one], looked.obstacles[other]), _nearest(distances[other], looked.obstacles[one]))
        if 1e-6 < gap < wide:
            yield f"too narrow: obstacles {one} and {other} are {gap:.3g} m apart, the widest body needs {wide:.3g} m to pass"
    clearance = dict(zip(looked.ids.tolist(), looked.clearance.tolist()))
    for row in np.flatnonzero(looked.kind == POSITION):
        own = clearance.get(int(looked.object[row]), 0.5 * wide)
        for number, distance in distances.items():
            room = distance.EvaluateFunction(looked.places[row].tolist()) + looked.radius[row]
            if 0.0 <= room < own:
                yield (f"too narrow: row {looked.row[row]} target {looked.target[row]} lies {room:.3g} m from obstacle {number}, the "
                       f"body's clearance radius is {own:.3g} m")


_MOST_POINTS = 2000  # of a surface that are measured from


def _nearest(distance, surface):
    points = vtk_to_numpy(surface.GetPoints().GetData())
    used = np.unique(vtk_to_numpy(surface.GetPolys().GetConnectivityArray()))
    used = used[::max(1, len(used) // _MOST_POINTS)]
    return min((distance.EvaluateFunction(points[i].tolist()) for i in used), default=np.inf)


def _near_marks(looked):
    """Frames at which objects are asked to be nearer to one another than they are wide."""
    wide = 2.0 * float(np.median(looked.clearance)) if len(looked.clearance) else 0.0
    for frame in np.unique(looked.frame[looked.kind == POSITION]):
        rows = np.flatnonzero((looked.kind == POSITION) & (looked.frame == frame))
        places = looked.places[rows]
        near = 0
        smallest = np.inf
        for i in range(len(rows) - 1):
            apart = np.linalg.norm(places[i + 1:] - places[i], axis=1) + looked.radius[rows[i + 1:]] + looked.radius[rows[i]]
            near += int(np.sum(apart < wide))
            smallest = min(smallest, float(apart.min()))
        if near:
            yield (f"too near: {near} pairs of the {len(rows)} marks at frame {frame} are nearer than bodies are wide ({wide:.3g} m), the "
                   f"nearest {smallest:.3g} m: bodies will overlap there; take fewer, smaller ones, or a wider figure")


def _crowd(looked):
    box = np.diff(looked.bounds.reshape(3, 2), axis=1).ravel()
    share = float(np.sum(4.0 / 3.0 * np.pi * looked.clearance ** 3) / np.prod(box))
    if share > _CROWDED:
        yield (f"too many: the balls of clearance of {len(looked.ids)} bodies take {100.0 * share:.0f} % of the volume, "
               f"{100.0 * _CROWDED:.0f} % is what flies well")
