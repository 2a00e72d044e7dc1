# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces of objects as arrays, and as files that Waft reads."""
import contextlib

import numpy as np


@contextlib.contextmanager
def _evaluated_mesh(thing, depsgraph):
    """The mesh of an object (a curve's, a text's, too) with its modifiers; None where it has none."""
    evaluated = thing.evaluated_get(depsgraph)
    try:
        mesh = evaluated.to_mesh() if thing.type != "EMPTY" else None
    except RuntimeError:  # another object without geometry
        mesh = None
    try:
        yield mesh
    finally:
        if mesh is not None:
            evaluated.to_mesh_clear()


def _array(collection, name, kind, width):
    values = np.empty(len(collection) * width, kind)
    collection.foreach_get(name, values)
    return values.reshape(-1, width)


def triangles_of(thing, depsgraph):
    """(points [n, 3], triangles [m, 3]) of an object in its own axes, modifiers applied."""
    with _evaluated_mesh(thing, depsgraph) as mesh:
        if mesh is None:
            return np.empty((0, 3)), np.empty((0, 3), np.int32)
        mesh.calc_loop_triangles()
        return (_array(mesh.vertices, "co", np.float32, 3).astype(float),
                _array(mesh.loop_triangles, "vertices", np.int32, 3))


def edges_of(thing, depsgraph):
    """(points [n, 3], edges [m, 2]) of an object in its own axes, modifiers applied."""
    with _evaluated_mesh(thing, depsgraph) as mesh:
        if mesh is None:
            return np.empty((0, 3)), np.empty((0, 2), np.int32)
        return (_array(mesh.vertices, "co", np.float32, 3).astype(float),
                _array(mesh.edges, "vertices", np.int32, 2))


def moved(points, matrix):
    """Points by a 4 x 4 matrix."""
    matrix = np.array(matrix, float)
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def open_edges(points, triangles):
    """How many edges do not belong to two triangles; points in one place are one point, as Waft takes them."""
    _, same = np.unique(points, axis=0, return_inverse=True)
    corners = same.reshape(-1)[triangles]
    corners = corners[(corners[:, 0] != corners[:, 1]) & (corners[:, 1] != corners[:, 2]) & (corners[:, 2] != corners[:, 0])]
    edges = np.sort(np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]]), axis=1)
    return int(np.sum(np.unique(edges, axis=0, return_counts=True)[1] != 2))


def even_places(points, edges, count):
    """`count` points at even distances along edges, in the order of the edges."""
    starts, ends = points[edges[:, 0]], points[edges[:, 1]]
    lengths = np.linalg.norm(ends - starts, axis=1)
    along = np.concatenate([[0.0], np.cumsum(lengths)])
    at = (np.arange(count) + 0.5) / count * along[-1]
    edge = np.clip(np.searchsorted(along, at, side="right") - 1, 0, len(edges) - 1)
    share = (at - along[edge]) / np.where(lengths[edge] > 0.0, lengths[edge], 1.0)
    return starts[edge] + share[:, None] * (ends[edge] - starts[edge])


def polydata(points, triangles):
    """The text of a .vtp file, whose numbers are those of the arrays to the bit."""
    def block(values):
        return " ".join(map(repr, values.reshape(-1).tolist()))

    offsets = np.arange(1, len(triangles) + 1) * 3
    return f"""<?xml version="1.0"?>
<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<PolyData><Piece NumberOfPoints="{len(points)}" NumberOfPolys="{len(triangles)}">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">{block(points)}</DataArray></Points>
<Polys>
<DataArray type="Int64" Name="connectivity" format="ascii">{block(triangles)}</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">{block(offsets)}</DataArray>
</Polys>
</Piece></PolyData>
</VTKFile>
"""
