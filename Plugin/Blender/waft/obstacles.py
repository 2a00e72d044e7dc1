# SPDX-License-Identifier: BSD-3-Clause
"""Obstacles and the volume."""
import numpy as np

from .hindrances import form_changes
from .surfaces import moved, open_edges, polydata, triangles_of

_STILL = 1e-6  # Blender units, and radians, that count as no motion


def add_obstacles(stage, things):
    """Adds obstacles, as they are at the first frame, with the places of their origins at all frames."""
    first = stage.frames[0]
    for thing in things:
        points, triangles = triangles_of(thing, stage.depsgraph)
        if not len(triangles):
            stage.problems.error("shows only instances, which have no mesh of their own: make them real (Object > Apply)"
                                 if thing.name_full in stage.instancers else "has no faces: an obstacle is a closed surface", thing)
            continue
        holes = open_edges(points, triangles)
        if holes:
            stage.problems.error(f"is not closed: {holes} edges do not belong to two faces (Select > All by Trait > Non Manifold); an "
                                 "obstacle is a closed surface", thing)
            continue
        matrices = np.array([np.array(stage.matrix(thing, frame), float) for frame in stage.frames])
        if np.abs(matrices[:, :3, :3] - matrices[0, :3, :3]).max() > _STILL:
            stage.problems.warn("turns or is scaled; obstacles of Waft only move: it stays as it is at the first frame", thing)
        elif bending := form_changes(thing):
            stage.problems.warn(f"may change its form ({bending}); obstacles of Waft only move: it stays as it is at the first frame",
                                thing)
        origin = matrices[:, :3, 3] * stage.unit
        turned = np.array(stage.matrix(thing, first), float)
        turned[:3, 3] = 0.0
        entry = {"kind": "mesh", "file": stage.file("obstacle.vtp", polydata(moved(points, turned) * stage.unit, triangles)),
                 "position": origin[0].tolist()}
        keys = _corners(origin)
        if len(keys) > 1:
            entry["motion"] = [{"frame": int(frame), "position": origin[frame].tolist()} for frame in keys]
        stage.obstacles[thing.name_full] = (len(stage.obstacles), origin)
        stage.add("obstacles", thing, **entry)


def _corners(places):
    """The frames between which places lie on straight lines at even speed: the first, the last and those where it bends."""
    if np.abs(places - places[0]).max() <= _STILL:
        return [0]
    bends = np.abs(np.diff(places, 2, axis=0)).max(axis=1) > _STILL
    return [0, *(np.flatnonzero(bends) + 1), len(places) - 1]


def add_volume(stage, things, has_ground):
    """Sets the volume; returns whether there is one."""
    if len(things) != 1:
        stage.problems.error("there is no volume: Add Volume makes one around all that takes part" if not things else
                             "is a second volume: expected one", things[1] if things else None)
        return False
    thing = things[0]
    matrix = np.array(stage.matrix(thing, stage.frames[0]), float)
    if thing.type != "EMPTY":
        stage.problems.error("is no empty: the volume is an empty of the display type Cube", thing)
        return False
    if np.sum(np.abs(matrix[:3, :3]) > 1e-5 * np.abs(matrix[:3, :3]).max()) != 3:
        stage.problems.error("is turned: the sides of the volume are along x, y and z (clear its rotation, Alt R)", thing)
        return False
    half = np.abs(matrix[:3, :3]).sum(axis=1) * thing.empty_display_size * stage.unit
    middle = matrix[:3, 3] * stage.unit
    low, high = middle - half, middle + half
    stage.scene["domain"] = {"min": low.tolist(), "max": high.tolist()}
    sides = [side for side, is_open in zip(("x", "y", "top"), thing.waft.is_open) if is_open]
    if sides:
        stage.scene["domain"]["open"] = sides
        breeze = [float(speed) if is_open else 0.0 for speed, is_open in zip(thing.waft.breeze, thing.waft.is_open)]
        if any(breeze):
            stage.scene["air"] = {"breeze": [*breeze, 0.0]}
    stage.scene["ground"] = {"enabled": has_ground, "height": float(low[2])}
    stage.low, stage.high = low, high
    stage.widest = float((high - low).max())
    return True
