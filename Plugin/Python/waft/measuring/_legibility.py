# SPDX-License-Identifier: BSD-3-Clause
"""How well texts and pictures are to be read of the bodies that form them (Documentation/Measure.md)."""
import os

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkMath
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet

from waft import reading
from waft.failures import InputError
from waft.results._arrays import array_of, object_ids, orientations_of, points_of, polylines, triangles_of
from waft.results._folder import needed, read_surface
from waft.results.writing import settled
from waft.scene._kinds import POSITION, REST

FILES = ("poses.vtp", "objects.vtp", "shapes.vtm", "constraints.vtp")
FLOWN = (2.0, 1.75, 1.5, 1.25, 1.0)  # seconds before its frame at which bodies turn as they fly: nothing turns them to a mark yet
EDGE_ON = 0.1  # cosine between the way it is looked along and the drawing's normal, below which there is nothing to be read


def read_drawings(scene):
    """The texts and pictures that the keyframes of a scene file draw: [vtkImageData], as vtkSceneDrawings has them."""
    from waft.vtkWaftSources import vtkSceneDrawings

    blocks = vtkMultiBlockDataSet()
    lack = vtkSceneDrawings.Read(os.fsencode(scene), blocks)
    if lack:
        raise InputError(lack)
    return [blocks.GetBlock(number) for number in range(blocks.GetNumberOfBlocks())]


def legibility(run, drawings):
    """(whether it asks where bodies face, correlation of the silhouette with the drawing, that of the same bodies turned as they
    flew before, that of all facing the reader) of each drawing; None where a file of FILES is missing."""
    folder = settled(run.folder)
    if any(folder.found(name) is None for name in FILES):
        return None
    bodies = _Bodies(run.folder, folder)
    found = [_legibility(bodies, run.flights.rate, drawing) for drawing in drawings]
    return [figures for figures in found if figures is not None]


class _Bodies:
    """The bodies of a folder: their paths and poses, their meshes, their rows."""

    def __init__(self, name, folder):
        self.name = name
        poses, objects, rows = (read_surface(folder, FILES[k]) for k in (0, 1, 3))
        place = folder.path / FILES[0]
        ids, order = polylines(poses, place)
        self.index = {number: index for index, number in enumerate(ids.tolist())}
        self.positions = points_of(poses, place)[order]
        self.orientations = orientations_of(poses.GetPointData(), place)[order]
        columns, place = rows.GetPointData(), folder.path / FILES[3]
        self.rows = {key: array_of(columns, key, place, kind=int, low=-1) for key in ("Row", "ObjectId", "Frame", "Kind")}
        self.facing = array_of(columns, "Facing", place, 3) if columns.HasArray("Facing") else np.zeros((len(self.rows["Row"]), 3))
        folder.check_blocks(FILES[2])
        blocks, place = reading.read_blocks(needed(folder, FILES[2])), folder.path / FILES[2]
        shapes = [blocks.GetBlock(number) for number in range(blocks.GetNumberOfBlocks())]
        meshes = [(points_of(shape, place), triangles_of(shape, place)) for shape in shapes]
        columns, place = objects.GetPointData(), folder.path / FILES[1]
        shape_of = array_of(columns, "ShapeId", place, kind=int, low=0, high=len(meshes) - 1)
        self.meshes = {number: meshes[shape] for number, shape in zip(object_ids(columns, place).tolist(), shape_of)}


def _legibility(bodies, rate, drawing):
    row, *axes = (vtk_to_numpy(drawing.GetFieldData().GetArray(name)).ravel() for name in ("Row", "U", "V", "Origin"))
    own = np.flatnonzero((bodies.rows["Row"] == row[0]) & np.isin(bodies.rows["Kind"], (POSITION, REST)))
    own = [k for k in own if bodies.rows["ObjectId"][k] in bodies.index]
    if not own:
        raise InputError(f"{bodies.name}: expected a motion of the scene, found no object at a target of /constraints/{row[0]}")
    u, v, origin = axes
    asked = bodies.facing[own[0]]
    normal = np.cross(u, v) / np.linalg.norm(np.cross(u, v))
    along = asked / np.linalg.norm(asked) if asked.any() else normal
    if abs(along @ normal) < EDGE_ON:
        return None
    ids = [int(bodies.rows["ObjectId"][k]) for k in own]
    index, frame = [bodies.index[number] for number in ids], int(bodies.rows["Frame"][own[0]])
    page = _Page(drawing, np.linalg.inv(np.stack([u, v, along], axis=1)), origin)
    meshes, places = [bodies.meshes[number] for number in ids], bodies.positions[index, frame]

    def read_as(at, turned=lambda turns: turns):
        return page.correlation(meshes, places, turned(_matrices(bodies.orientations[index, at])))

    before = [frame - int(round(seconds * rate)) for seconds in FLOWN]
    flown = float(np.mean([read_as(at) for at in before])) if before[0] >= 0 else float("nan")
    return bool(asked.any()), read_as(frame), flown, read_as(frame, lambda turns: _facing(turns, along))


def _matrices(orientations):
    """[body, 3, 3], body to world."""
    turns = np.empty((len(orientations), 3, 3))
    for orientation, turn in zip(orientations, turns):
        vtkMath.QuaternionToMatrix3x3(orientation, turn)
    return turns


def _facing(turns, along):
    """The poses turned by the least that brings their normals into a line."""
    normals = turns[..., 2]
    side = np.where(normals @ along < 0.0, -1.0, 1.0)[:, None] * along
    axis = np.cross(normals, side)
    cross = np.zeros_like(turns)
    for k in range(3):
        cross[:, (k + 2) % 3, (k + 1) % 3], cross[:, (k + 1) % 3, (k + 2) % 3] = axis[:, k], -axis[:, k]
    cosine = np.sum(normals * side, axis=1)[:, None, None]
    return (np.eye(3) + cross + cross @ cross / (1.0 + cosine)) @ turns


class _Page:
    """A drawing and a margin around it in which bodies stick out, seen along a direction."""

    def __init__(self, drawing, to_page, origin):
        self._to_page, self._origin = to_page, origin
        width, height, _ = drawing.GetDimensions()
        self._pixel, self._low = drawing.GetSpacing()[0], np.array(drawing.GetOrigin()[:2])
        self._mask = vtk_to_numpy(drawing.GetPointData().GetArray("Weight")).reshape(height, width).astype(float)

    def correlation(self, meshes, places, turns):
        """Of the bodies' silhouette with the drawing, over its pixels and as much around it as the largest body reaches."""
        reach = max(np.linalg.norm(points, axis=1).max() for points, _ in meshes)
        margin = int(np.ceil(reach / self._pixel))
        corners = []
        for (points, triangles), place, turn in zip(meshes, places, turns):
            flat = (self._to_page @ (points @ turn.T + place - self._origin).T)[:2].T
            corners.append(((flat - self._low) / self._pixel + margin)[triangles])
        mask = np.pad(self._mask, margin)
        seen = covered(np.concatenate(corners), mask.shape)
        if seen.all() or not seen.any():
            return 0.0
        return float(np.corrcoef(mask.ravel(), seen.ravel())[0, 1])


def covered(corners, shape):
    """Whether the middle of a pixel, at whole numbers (x, y), is in any of some triangles [triangle, corner, (x, y)]: [row, column]."""
    seen = np.zeros(shape, bool)
    first = np.maximum(np.ceil(corners.min(axis=1)), 0).astype(int)
    last = np.minimum(np.floor(corners.max(axis=1)), [shape[1] - 1, shape[0] - 1]).astype(int)
    edges = np.roll(corners, -1, axis=1) - corners
    inside = np.all(first <= last, axis=1)
    for dy in range(int((last - first)[inside, 1].max(initial=-1)) + 1):
        rows = np.flatnonzero(inside & (first[:, 1] + dy <= last[:, 1]))
        for dx in range(int((last - first)[rows, 0].max(initial=-1)) + 1):
            own = rows[first[rows, 0] + dx <= last[rows, 0]]
            pixel = first[own] + [dx, dy]
            away = pixel[:, None] - corners[own]
            turn = edges[own, :, 0] * away[..., 1] - edges[own, :, 1] * away[..., 0]
            hit = pixel[np.all(turn >= 0.0, axis=1) | np.all(turn <= 0.0, axis=1)]
            seen[hit[:, 1], hit[:, 0]] = True
    return seen
