# SPDX-License-Identifier: BSD-3-Clause
"""What of a scene cannot be, and what will be hard, before anything is flown: `waft check`."""
import collections
import dataclasses

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import mutable, vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData, vtkStaticCellLocator
from vtkmodules.vtkFiltersCore import vtkImplicitPolyDataDistance

from waft.loading import load_plugin
from waft.reading import check_scene_file
from waft.results.writing import read_rows
from waft.run.pipeline import Pipeline
from waft.scene._kinds import POSITION, POSITIONAL, REST
from waft.watching import Clock

_LOST = ("infeasible", "conflict")  # by itself, or beside another
_KEPT_UP = 0.5  # share of the air's top speed that a body is carried at over a whole flight
_SINKING = 0.1  # the same of air that sinks all the way
_CROWDED = 0.05  # share of the volume that the bodies' balls of clearance may take
_JUDGED = 0.02  # progress of the planner from which on the rows are judged


_ALIKE = 5  # findings of one kind that are reported; the others are counted


@dataclasses.dataclass
class Finding:
    """A sentence about a scene. is_possible: whether it is only hard; kind: what it has in common with others."""

    text: str
    is_possible: bool = True
    kind: str = ""

    @classmethod
    def hard(cls, text):
        return cls(text, True, text.partition(":")[0])


def first_of_each(findings):
    """(whether it is only hard, sentence): the first few findings of each kind, and how many more there are of it."""
    shown = collections.Counter()
    for finding in findings:
        kind = (finding.is_possible, finding.kind)
        shown[kind] += 1
        if not finding.kind or shown[kind] <= _ALIKE:
            yield finding.is_possible, finding.text
    for (is_possible, kind), count in shown.items():
        if kind and count > _ALIKE:
            yield is_possible, f"{kind}: {count - _ALIKE} more"


class Looked:
    """A scene as the reader and the planner see it, rows judged and given to objects, nothing flown."""

    def __init__(self, scene, database=None):
        load_plugin()
        check_scene_file(scene)
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
            self._surface = vtkPolyData()
            self._surface.ShallowCopy(pipeline.output("reader", 2))
        finally:
            pipeline.delete()  # and with it the planner's own trees of all obstacles
        self.obstacles = _by_id(self._surface)
        self._locator = None

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
        self.top_speed = pipeline.output("planner", 2).GetFieldData().GetArray("TopSpeed").GetComponent(0, 0)

    def name(self, row):
        return f"row {self.row[row]} target {self.target[row]}"

    def time(self, seconds):
        """As messages have it, in frames besides."""
        return f"{seconds:.2g} s ({np.ceil(seconds * self.rate):.0f} frames)"

    def height_below(self, place):
        """Height of the first surface straight below a place; its own where there is none."""
        if self._locator is None:
            self._locator = vtkStaticCellLocator()
            self._locator.SetDataSet(self._surface)
            self._locator.BuildLocator()
        share, hit, at, piece, cell = mutable(0.0), [0.0] * 3, [0.0] * 3, mutable(0), mutable(0)
        low = [place[0], place[1], self.bounds[4] - 1.0]
        return hit[2] if self._locator.IntersectWithLine(place, low, 0.0, share, hit, at, piece, cell) else place[2]


def check(scene, database=None):
    """(Looked, [Finding]) of a scene file; raises BadInput where it is malformed."""
    looked = Looked(scene, database)
    unmet = [Finding(f"row {row['Row']} target {row['Target']} (object {row['ObjectId']}, frame {row['Frame']}, {row['Kind']}): "
                     f"{row['Status']}: {row['Message']}", False, row["Status"])
             for row in looked.report if row["Status"] in _LOST]
    hard = [Finding.hard(text) for text in (*_haste(looked), *_falls(looked), *_gaps(looked), *_tight_marks(looked),
                                            *_near_marks(looked), *_crowd(looked))]
    return looked, unmet + [Finding(text) for text in looked.warnings] + hard


class _Obstacle:
    """One of the scene's obstacles: the points of its surface, the box around them, and distances to it."""

    def __init__(self, points, triangles):
        self._triangles = triangles
        used = np.unique(triangles)
        self._all = points
        self.points = points[used]
        self.low, self.high = self.points.min(axis=0), self.points.max(axis=0)
        self._distance = None

    def far(self, points):
        """Distances of points from the box around it."""
        return np.linalg.norm(np.maximum(np.maximum(self.low - points, points - self.high), 0.0), axis=1)

    def distances(self, points):
        """Signed distances of points from its surface."""
        if self._distance is None:
            self._distance = vtkImplicitPolyDataDistance()
            self._distance.SetInput(_surface(self._all, self._triangles))
        given, found = numpy_to_vtk(np.ascontiguousarray(points), deep=True), vtkDoubleArray()
        self._distance.FunctionValue(given, found)
        return vtk_to_numpy(found).ravel()


def _surface(points, triangles):
    used, triangles = np.unique(triangles, return_inverse=True)
    made, cells, surface = vtkPoints(), vtkCellArray(), vtkPolyData()
    made.SetData(numpy_to_vtk(np.ascontiguousarray(points[used]), deep=True))
    triangles = triangles.ravel().astype(np.int64)
    cells.SetData(numpy_to_vtkIdTypeArray(np.arange(0, len(triangles) + 1, 3), deep=True), numpy_to_vtkIdTypeArray(triangles, deep=True))
    surface.SetPoints(made)
    surface.SetPolys(cells)
    return surface


def _by_id(surface):
    """{ObstacleId: _Obstacle}"""
    array = surface.GetPointData().GetArray("ObstacleId")
    if array is None or surface.GetNumberOfPolys() == 0:
        return {}
    points = vtk_to_numpy(surface.GetPoints().GetData())
    triangles = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    owner = vtk_to_numpy(array)[triangles[:, 0]]
    order = np.argsort(owner, kind="stable")
    numbers, first = np.unique(owner[order], return_index=True)
    return {int(number): _Obstacle(points, own) for number, own in zip(numbers, np.split(triangles[order], first[1:]))}


def _legs(looked):
    """(object's index; place, frame and radius from; index of the row to) between an object's places in time order, those left
    out that cannot be met."""
    rows = np.flatnonzero(np.isin(looked.kind, POSITIONAL) & looked.can_be)
    rows = rows[np.argsort(looked.frame[rows], kind="stable")]
    of = collections.defaultdict(list)
    for row, number in zip(rows.tolist(), looked.object[rows].tolist()):
        of[number].append(row)
    frames, sources = looked.frame.tolist(), looked.row.tolist()
    for index, number in enumerate(looked.ids.tolist()):
        place, frame, room, before = looked.starts[index], 0, 0.0, -1
        for row in of.get(number, ()):
            if frames[row] > frame and sources[row] != before:  # within a given path any speed will do
                yield index, place, frame, room, row
            place, frame, room, before = looked.places[row], frames[row], looked.radius[row], sources[row]


def _haste(looked):
    """Places that are farther apart than air carries a body in the time."""
    for index, place, frame, room, row in _legs(looked):
        seconds = (looked.frame[row] - frame) / looked.rate
        distance = float(np.linalg.norm(looked.places[row] - place)) - room - looked.radius[row]
        if distance > _KEPT_UP * looked.top_speed * seconds:
            yield (f"too fast: {looked.name(row)}: object {looked.ids[index]} has {seconds:.3g} s for {distance:.3g} m to its mark at frame "
                   f"{looked.frame[row]}, {distance / seconds:.3g} m/s; the fastest of the database is {looked.top_speed:.2g} m/s, and "
                   f"half of that is kept up: give it {looked.time(distance / (_KEPT_UP * looked.top_speed))} or more")


def _falls(looked):
    """Rests that leave no time to come down by settling and the air together."""
    for index, place, frame, room, row in _legs(looked):
        seconds = (looked.frame[row] - frame) / looked.rate
        if looked.kind[row] != REST:
            continue
        height = float(place[2] - looked.height_below(looked.places[row])) - room
        fastest = float(looked.settling[index]) + _SINKING * looked.top_speed
        if height > fastest * seconds:
            yield (f"no time to fall: {looked.name(row)}: object {looked.ids[index]} falls {height:.3g} m in {seconds:.3g} s to its rest at "
                   f"frame {looked.frame[row]}; it settles at {looked.settling[index]:.2g} m/s: give it {looked.time(height / fastest)} or "
                   "more")


def _gaps(looked):
    """Obstacles, and obstacles and walls, between which no body passes, though there is room."""
    wide = 2.0 * float(looked.clearance.max(initial=0.0))
    numbers, obstacles = list(looked.obstacles), list(looked.obstacles.values())
    low, high = (np.array([getattr(one, side) for one in obstacles]).reshape(-1, 3) for side in ("low", "high"))
    for first, one in enumerate(obstacles):
        rest = slice(first + 1, None)
        apart = np.linalg.norm(np.maximum(np.maximum(low[rest] - one.high, one.low - high[rest]), 0.0), axis=1)
        for second in (first + 1 + np.flatnonzero(apart < wide)).tolist():
            gap = _between(one, obstacles[second], wide)
            if 1e-6 < gap < wide:
                yield (f"too narrow: obstacles {numbers[first]} and {numbers[second]} are {gap:.3g} m apart, the widest body needs "
                       f"{wide:.3g} m to pass")


_MOST_POINTS = 2000  # of a surface that are measured from


def _between(one, other, wide):
    """Smallest distance of a point of one surface from the other one, where that is less than `wide`; else infinite."""
    gap = np.inf
    for here, there in ((one, other), (other, one)):
        points = here.points[::max(1, len(here.points) // _MOST_POINTS)]
        points = points[there.far(points) < wide]
        if len(points) > 0:
            gap = min(gap, float(there.distances(points).min()))
    return gap


def _tight_marks(looked):
    """Marks nearer to an obstacle than their body is wide."""
    wide = 2.0 * float(looked.clearance.max(initial=0.0))
    clearance = dict(zip(looked.ids.tolist(), looked.clearance.tolist()))
    rows = np.flatnonzero(looked.kind == POSITION)
    places, radius = looked.places[rows], looked.radius[rows]
    own = np.array([clearance.get(number, 0.5 * wide) for number in looked.object[rows].tolist()])
    found = []
    for number, obstacle in looked.obstacles.items():
        near = np.flatnonzero(obstacle.far(places) + radius < own)
        if len(near) > 0:
            room = obstacle.distances(places[near]) + radius[near]
            found += [(rows[near[k]], number, room[k], own[near[k]]) for k in np.flatnonzero((0.0 <= room) & (room < own[near]))]
    for row, number, room, needed in sorted(found):
        yield (f"too narrow: {looked.name(row)} lies {room:.3g} m from obstacle {number}, the body's clearance radius is {needed:.3g} m: "
               f"move the mark of object {looked.object[row]} at frame {looked.frame[row]} away by {needed - room:.2g} m, or give it that "
               "radius")


_MOST_PAIRS = 10_000_000  # of marks at one frame that are looked at
_NAMED = 3  # pairs of them that are named, the nearest


def _near_marks(looked):
    """Frames at which objects are asked to be nearer to one another than they are wide, and which ones those are."""
    clearance = dict(zip(looked.ids.tolist(), looked.clearance.tolist()))
    rows = np.flatnonzero((looked.kind == POSITION) & looked.can_be & np.isin(looked.object, looked.ids))
    rows = rows[np.argsort(looked.frame[rows], kind="stable")]
    frames, first = np.unique(looked.frame[rows], return_index=True)
    for frame, own in zip(frames, np.split(rows, first[1:])):
        if len(own) < 2:
            continue
        owner = looked.object[own]
        room = np.array([clearance[number] for number in owner.tolist()])
        near, is_all, nearest = _near_pairs(looked.places[own], looked.radius[own], room, owner)
        if near:
            named = ", ".join(f"{apart:.3g} m (objects {min(pair)} and {max(pair)}{', at one place' if apart == 0.0 else ''})"
                              for apart, _, pair in nearest)
            yield (f"too near: {'' if is_all else 'at least '}{near} pairs of the {len(own)} marks at frame {frame} are nearer than bodies "
                   f"are wide ({nearest[0][1]:.3g} m), the nearest {named}: bodies will overlap there; take fewer, smaller ones, or a "
                   "wider figure, or ask for one of them at another frame")


def _near_pairs(places, radius, room, owner):
    """(number of pairs of marks of different owners that are nearer, radii added, than both have room, whether that is of all pairs,
    [(distance, wide, owners)] of the nearest of them). Along the axis of the largest extent only neighbours can be, of which so many
    are looked at that the time is bounded; those at one place stand side by side."""
    axis = np.ptp(places, axis=0).argmax()
    order = np.lexsort((places[:, axis - 2], places[:, axis - 1], places[:, axis]))
    places, radius, room, owner = places[order], radius[order], room[order], owner[order]
    after = np.arange(1, len(places) + 1)
    ends = np.searchsorted(places[:, axis], places[:, axis] + 2.0 * room.max())
    last = np.minimum(ends, after + max(1, _MOST_PAIRS // len(places)))
    count, found = 0, []
    for i, end in enumerate(last.tolist()):
        if end > i + 1:
            rest = slice(i + 1, end)
            apart = np.linalg.norm(places[rest] - places[i], axis=1) + radius[rest] + radius[i]
            near = np.flatnonzero((apart < room[rest] + room[i]) & (owner[rest] != owner[i]))
            count += len(near)
            if len(near) > 0:
                best = near[apart[near].argmin()]
                found.append((float(apart[best]), float(room[i] + room[i + 1 + best]), (int(owner[i]), int(owner[i + 1 + best]))))
    return count, bool(np.all(last == ends)), sorted(found)[:_NAMED]


def _crowd(looked):
    box = np.diff(looked.bounds.reshape(3, 2), axis=1).ravel()
    share = float(np.sum(4.0 / 3.0 * np.pi * looked.clearance ** 3) / np.prod(box))
    if share > _CROWDED:
        yield (f"too many: the balls of clearance of {len(looked.ids)} bodies take {100.0 * share:.0f} % of the volume, "
               f"{100.0 * _CROWDED:.0f} % is what flies well")
