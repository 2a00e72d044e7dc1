# SPDX-License-Identifier: BSD-3-Clause
"""Copies of a flyer spread on a mesh."""
import numpy as np

from .surfaces import moved, triangles_of

_CANDIDATES = 10  # for each place, of which the one farthest from all others is taken (Mitchell 1991)


def spread(context, flyer, emitter, count, seed):
    """Links `count` copies of a flyer to its collection, upon the faces of an emitter and turned about the vertical; returns them, none
    where the emitter has no faces."""
    points, triangles = triangles_of(emitter, context.evaluated_depsgraph_get())
    if not len(triangles):
        return []
    chance = np.random.default_rng(seed)
    collection = flyer.users_collection[0]
    copies = []
    for place in _places(moved(points, emitter.matrix_world)[triangles], count, chance):
        copy = flyer.copy()  # shares the mesh
        copy.animation_data_clear()
        copy.waft.takes.clear()
        copy.waft.own_action = None
        copy.waft.copied_from = flyer.waft.copied_from or flyer
        collection.objects.link(copy)
        copy.select_set(False)
        copy.rotation_mode = "XYZ"
        copy.rotation_euler = (0.0, 0.0, float(chance.uniform(0.0, 2.0 * np.pi)))
        copy.location = place
        copies.append(copy)
    return copies


def _places(corners, count, chance):
    """Well spread places on triangles [n, 3, 3]."""
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    places = np.empty((0, 3))
    for _ in range(count):
        drawn = _draw(corners, areas / areas.sum(), _CANDIDATES, chance)
        if len(places):
            nearest = np.linalg.norm(drawn[:, None] - places[None], axis=2).min(axis=1)
            drawn = drawn[[np.argmax(nearest)]]
        places = np.concatenate([places, drawn[:1]])
    return places.tolist()


def _draw(corners, shares, count, chance):
    chosen = corners[chance.choice(len(corners), count, p=shares)]
    a, b = chance.random((2, count, 1))
    a, b = np.where(a + b > 1.0, 1.0 - a, a), np.where(a + b > 1.0, 1.0 - b, b)
    return chosen[:, 0] + a * (chosen[:, 1] - chosen[:, 0]) + b * (chosen[:, 2] - chosen[:, 0])
