# SPDX-License-Identifier: BSD-3-Clause
"""Flyers: an object of Blender as a body of Waft, whose origin is its centre of mass and whose axes are its own."""
import dataclasses

import numpy as np
from mathutils import Matrix

from .surfaces import triangles_of

PRESETS = {  # settling speed [m/s], area density [kg/m^2], thickness [m], drag coefficient
    "LEAF": (0.8, 0.1, 0.0004, 1.2),
    "FEATHER": (0.4, 0.04, 0.0005, 1.2),
    "PETAL": (0.6, 0.06, 0.0003, 1.2),
    "PAPER": (0.9, 0.08, 0.0001, 1.2),
    "BUBBLE": (0.05, 0.002, 0.000002, 0.47),
}
_ALONG = 1e-3  # mixed moments below this share of their sum: the mesh stands on its own axes


@dataclasses.dataclass
class Body:
    """points [m] and triangles about the centre of mass, on the body's axes; center [Blender units] and axes (columns) say where
    these stand in the object's own axes, its scale applied."""

    points: np.ndarray
    triangles: np.ndarray
    scale: np.ndarray
    center: np.ndarray
    axes: np.ndarray


def body_of(thing, depsgraph, unit):
    """The Body of an object; None where it has no faces. unit: metres of a Blender unit."""
    scale = np.array(thing.scale, float)
    points, triangles = triangles_of(thing, depsgraph)
    points = points * scale
    corners = points[triangles]
    areas = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    if not areas.sum() > 0.0:
        return None
    center = np.average(corners.mean(axis=1), axis=0, weights=areas)
    axes = _axes(corners - center, areas)
    return Body((points - center) @ axes * unit, triangles, scale, center, axes)


def pose_of(matrix, body, unit):
    """(position [m], quaternion w, x, y, z) of the body of an object that stands at matrix."""
    matrix = np.array(matrix, float)
    rotation = matrix[:3, :3] / body.scale
    position = (matrix[:3, 3] + rotation @ body.center) * unit
    return position, multiply(quaternion(rotation), quaternion(body.axes))


def placements(positions, orientations, body, unit):
    """(locations [n, 3], quaternions [n, 4]) of an object whose body has these positions [m] and orientations."""
    turns = multiply(orientations, quaternion(body.axes) * (1.0, -1.0, -1.0, -1.0))
    return positions / unit - rotate(turns, body.center), turns


def _axes(corners, areas):
    """Columns x (largest spread of the shell), y, z (least), each on the side of the object's own axis next to it. A mesh that
    stands on its own axes keeps them, in the order of their spread."""
    sums = corners.sum(axis=1)
    moments = (np.einsum("t,tci,tcj->ij", areas, corners, corners) + np.einsum("t,ti,tj->ij", areas, sums, sums)) / 12.0
    mixed = np.abs(moments - np.diag(np.diag(moments))).max()
    if mixed <= _ALONG * np.trace(moments):
        columns = np.eye(3)[:, np.argsort(-np.round(np.diag(moments) / np.trace(moments), 6), kind="stable")]
    else:
        columns = np.linalg.eigh(moments)[1][:, ::-1]
    x, z = (column * np.sign(column[np.argmax(np.abs(column))]) for column in (columns[:, 0], columns[:, 2]))
    return np.column_stack([x, np.cross(z, x), z])


def quaternion(rotation):
    """w, x, y, z of a rotation matrix."""
    return np.array(Matrix(rotation.tolist()).to_quaternion(), float)


def multiply(a, b):
    """Products of quaternions (w, x, y, z), each one or many."""
    w, x, y, z = np.moveaxis(np.asarray(a, float), -1, 0)
    p, q, r, s = np.moveaxis(np.asarray(b, float), -1, 0)
    return np.stack([w * p - x * q - y * r - z * s, w * q + x * p + y * s - z * r,
                     w * r - x * s + y * p + z * q, w * s + x * r - y * q + z * p], axis=-1)


def rotate(turns, vector):
    """A vector turned by many quaternions."""
    w, axis = turns[:, :1], turns[:, 1:]
    twice = 2.0 * np.cross(axis, vector)
    return vector + w * twice + np.cross(axis, twice)
