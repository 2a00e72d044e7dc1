# SPDX-License-Identifier: BSD-3-Clause
"""What `waft synthesize` wrote in a folder, as arrays and VTK data ready to be drawn."""

from dataclasses import dataclass, field

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPolyData

from waft import reading
from waft.beneath import Folder
from waft.failures import InputError
from waft.results._arrays import (array_of, bounds_of, check_steps, check_surface, field_of, object_ids, orientations_of, points_of,
                                  polylines, present_of, rate_of, text_of, triangles_of)
from waft.scene._kinds import POSITION, REST


@dataclass
class Body:
    """One shape: its surface in body axes, its look, and its largest extent in metres."""

    name: str
    surface: vtkPolyData
    color: tuple = (1.0, 1.0, 1.0)  # without a texture
    tint: tuple = (1.0, 1.0, 1.0)  # times the texture's colours
    texture: str = ""
    opacity: float = 1.0

    @property
    def extent(self):
        bounds = np.reshape(self.surface.GetBounds(), (3, 2))
        return float(np.max(bounds[:, 1] - bounds[:, 0]))


@dataclass
class Marks:
    """Places that the scene asks for: single points (with a radius) and partial trajectories."""

    flying: list = field(default_factory=list)  # (point, radius)
    resting: list = field(default_factory=list)  # point
    paths: list = field(default_factory=list)  # points, one a frame


@dataclass
class Motion:
    """All objects' motion: positions [object, frame, 3] in metres, orientations (w, x, y, z)."""

    folder: str
    bounds: np.ndarray
    frames_per_second: float
    object_ids: np.ndarray
    positions: np.ndarray
    orientations: np.ndarray
    shapes: np.ndarray
    bodies: list
    marks: Marks
    obstacles: list  # (time in seconds, vtkPolyData), growing time
    poses: vtkPolyData  # positions and orientations as they were read
    present: np.ndarray  # whether an object is in the shot [object, frame]
    goes_on: np.ndarray  # of a scene that loops: as whom each object begins anew, by index, -1 as nobody; else empty

    @property
    def loops(self):
        """Whether the last frame leads on to the first."""
        return len(self.goes_on) > 0

    @property
    def number_of_frames(self):
        return self.positions.shape[1]

    def pose(self, index, time):
        """Position and orientation of an object, by its index, at a time in frames: straight between frames."""
        first = int(time)
        after = time - first
        if after == 0.0:
            return self.positions[index, first], self.orientations[index, first]
        weights = np.array([1.0 - after, after])
        before, then = self.orientations[index, first:first + 2]
        turn = weights @ [before, np.copysign(1.0, before @ then) * then]
        return weights @ self.positions[index, first:first + 2], turn / np.linalg.norm(turn)

    def is_present(self, index, time):
        """Whether an object, by its index, is in the shot at a time in frames."""
        return bool(self.present[index, int(time)])

    def obstacles_at(self, frame):
        """The obstacles of a frame: the last of the series that is not later."""
        time = frame / self.frames_per_second + 1e-9
        past = [surface for when, surface in self.obstacles if when <= time]
        return past[-1] if past else (self.obstacles[0][1] if self.obstacles else None)


def load(path):
    """Reads a folder; raises InputError that names the file and the lack."""
    folder = Folder(path)
    poses = read_surface(folder, "poses.vtp")
    ids, positions, orientations, present = _poses(poses)
    columns = read_surface(folder, "objects.vtp").GetPointData()
    shape_of = dict(zip(object_ids(columns, "objects.vtp").tolist(), array_of(columns, "ShapeId", "objects.vtp", kind=int).tolist()))
    bodies = _bodies(folder)
    shapes = []
    for number in ids.tolist():
        if not 0 <= shape_of.get(number, -1) < len(bodies):
            raise InputError(f"objects.vtp: object {number} has no shape in shapes.vtm")
        shapes.append(shape_of[number])
    return Motion(
        folder=path,
        bounds=bounds_of(poses, "poses.vtp"),
        frames_per_second=rate_of(poses, "poses.vtp"),
        object_ids=ids,
        positions=positions,
        orientations=orientations,
        shapes=np.array(shapes, dtype=int),
        bodies=bodies,
        marks=_marks(folder),
        obstacles=obstacles_of(folder),
        poses=poses,
        present=present,
        goes_on=_goes_on(poses, ids),
    )


def read_surface(folder, name):
    """A .vtp of a beneath.Folder."""
    return reading.read_surface(needed(folder, name))


def needed(folder, name):
    """The path of a file of a Folder."""
    path = folder.found(name)
    if path is None:
        raise InputError(f"{folder.path / name}: missing; `waft synthesize` writes it")
    return path


def _poses(poses):
    ids, order = polylines(poses, "poses.vtp")
    points = points_of(poses, "poses.vtp")
    return ids, points[order], orientations_of(poses.GetPointData(), "poses.vtp")[order], present_of(poses.GetPointData(), "poses.vtp", order)


def _goes_on(poses, ids):
    if not poses.GetFieldData().HasArray("Loops"):
        return np.empty(0, dtype=int)
    index = {number: place for place, number in enumerate(ids.tolist())}
    return np.array([index.get(number, -1) for number in array_of(poses.GetCellData(), "LoopTo", "poses.vtp", kind=int).tolist()])


def _bodies(folder):
    path = needed(folder, "shapes.vtm")
    folder.check_blocks("shapes.vtm")
    blocks = reading.read_blocks(path)
    bodies = []
    for index in range(blocks.GetNumberOfBlocks()):
        surface = blocks.GetBlock(index)
        if not isinstance(surface, vtkPolyData) or surface.GetNumberOfPoints() == 0:
            raise InputError(f"shapes.vtm: block {index} is no surface")
        name = ""
        if blocks.HasMetaData(index):
            name = blocks.GetMetaData(index).Get(blocks.NAME()) or ""
        place = f"shapes.vtm: block {index}"
        check_surface(surface, place)
        body = Body(name, surface)
        if not body.extent > 0.0:
            raise InputError(f"{place}: expected a surface, found points at one place")
        body.color, body.tint = _color(surface, "Color", place), _color(surface, "Tint", place)
        if surface.GetFieldData().HasArray("Opacity"):
            body.opacity = float(field_of(surface, "Opacity", place, 1, low=0.0, high=1.0)[0])
        texture = text_of(surface, "Texture", place)
        if texture:
            body.texture = _find_texture(folder, texture, index)
        bodies.append(body)
    return bodies


def _color(surface, name, place):
    if not surface.GetFieldData().HasArray(name):
        return (1.0, 1.0, 1.0)
    return tuple(field_of(surface, name, place, 3, low=0.0, high=1.0).tolist())


def _find_texture(folder, name, block):
    """The path of a picture of the folder, be it there or not."""
    try:
        return folder.found(name) or str(folder.path / name)
    except InputError as error:
        raise InputError(f"{folder.path / 'shapes.vtm'}: block {block}: Texture: {error}") from error


def _marks(folder):
    marks = Marks()
    if folder.found("constraints.vtp") is None:
        return marks
    data = read_surface(folder, "constraints.vtp")
    if data.GetNumberOfPoints() == 0:
        return marks
    points = points_of(data, "constraints.vtp")
    columns = data.GetPointData()
    kind, frame, row, target = (array_of(columns, name, "constraints.vtp", kind=int) for name in ("Kind", "Frame", "Row", "Target"))
    radius = array_of(columns, "Radius", "constraints.vtp", low=0.0)
    marks.resting = [points[i] for i in np.flatnonzero((kind == REST) & (target >= 0))]  # those that are asked for
    groups = {}
    for i in np.flatnonzero(kind == POSITION):
        groups.setdefault((row[i], target[i]), []).append(i)
    for members in groups.values():
        if len(members) > 1:
            members.sort(key=lambda i: frame[i])
            marks.paths.append(points[members])
        else:
            marks.flying.append((points[members[0]], float(radius[members[0]])))
    return marks


def ground_height(points, bounds):
    """Height of the ground's top where an obstacle's points are the ground's: a flat slab that reaches past the whole floor
    of the volume; else None."""
    low, high = points.min(axis=0), points.max(axis=0)
    covers = low[0] <= bounds[0] and low[1] <= bounds[2] and high[0] >= bounds[1] and high[1] >= bounds[3]
    is_flat = len(np.unique(points[:, 2])) == 2
    return float(high[2]) if covers and is_flat and high[2] < bounds[5] else None


def obstacles_of(folder):
    """(time in seconds, surface of all obstacles) of a Folder, growing time; one where none moves, none where there are none."""
    if folder.found("obstacles.pvd"):
        steps = folder.steps("obstacles.pvd")
        check_steps(steps, folder.path / "obstacles.pvd")
        return [(time, _obstacles(folder, name)) for time, name in steps]
    return [(0.0, _obstacles(folder, "obstacles.vtp"))] if folder.found("obstacles.vtp") else []


def _obstacles(folder, name):
    """A surface of obstacles that tells of each point whose it is."""
    surface = read_surface(folder, name)
    check_surface(surface, name)
    if surface.GetNumberOfPoints():
        array_of(surface.GetPointData(), "ObstacleId", name, kind=int)
    return surface


@dataclass
class Obstacle:
    """A surface as it stands at frame 0 and how far it is shifted at every frame [frame, 3]; None where it stands still. ground: its
    height, of one that is the ground."""

    number: int
    points: np.ndarray
    triangles: np.ndarray
    shifts: np.ndarray
    ground: float


def moving_obstacles(folder, bounds, rate, frames):
    """Each Obstacle of a Folder, in the order of their ids."""
    steps = obstacles_of(folder)
    if not steps or not steps[0][1].GetNumberOfPolys():
        return []
    surface = steps[0][1]
    numbers = array_of(surface.GetPointData(), "ObstacleId", "obstacles", kind=int)
    points = points_of(surface, "obstacles")
    moved = [points_of(step, "obstacles") for _, step in steps]
    if any(step.shape != points.shape for step in moved):
        raise InputError("obstacles.pvd: expected the same surfaces at every step")
    triangles = triangles_of(surface, "obstacles")
    found = []
    for number in np.unique(numbers):
        own = np.flatnonzero(numbers == number)
        shifts = np.array([(step[own] - points[own]).mean(axis=0) for step in moved])
        if any(np.abs(step[own] - points[own] - shift).max() > 1e-5 for step, shift in zip(moved, shifts)):
            raise InputError(f"obstacles.pvd: obstacle {number}: expected it to move without turning or bending")
        is_moving = len(moved) > 1 and np.abs(shifts).max() > 1e-9
        places = np.full(len(points), -1)
        places[own] = np.arange(len(own))
        found.append(Obstacle(
            int(number), points[own], places[triangles[np.isin(triangles[:, 0], own)]],
            _at_frames([time for time, _ in steps], shifts, rate, frames) if is_moving else None,
            None if is_moving else ground_height(points[own], bounds)))
    return found


def _at_frames(times, shifts, rate, frames):
    now = np.arange(frames) / rate
    return np.stack([np.interp(now, times, shifts[:, axis]) for axis in range(3)], axis=1)


def volume_of(folder):
    """The volume of a run in a Folder, as six numbers."""
    return bounds_of(read_surface(folder, "poses.vtp"), "poses.vtp").tolist()
