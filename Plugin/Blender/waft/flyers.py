# SPDX-License-Identifier: BSD-3-Clause
"""Flyers: their shapes and starts, and what is odd about them."""
import re

import numpy as np
from mathutils.kdtree import KDTree

from .bodies import body_of, pose_of
from .hindrances import form_changes, obstruction
from .surfaces import open_edges, polydata

_LARGE = 1.0  # m: nothing light is wider
_TOGETHER = 0.1  # of a flyer's extent: as near as that two stand in one place
_NO_NAME = re.compile(r"[^\w .()+-]")  # what stays out of names of shapes, which go into files


def add_flyers(stage, things):
    """Adds shapes and objects; returns {full name: ObjectId} and {full name: Body}."""
    if not things:
        stage.problems.error("nothing flies: select meshes and make them flyers")
    ids, bodies, shapes, made = {}, {}, {}, {}
    releases = _releases(stage, things)
    for thing in things:
        problem = obstruction(thing) if thing.type == "MESH" else _no_mesh(thing)
        if problem:
            stage.problems.error(problem, thing)
            continue
        own = (thing.data.name_full, *thing.scale) if not thing.modifiers and thing.data.shape_keys is None else (thing.name_full, "")
        if own not in made:
            made[own] = body_of(thing, stage.depsgraph, stage.unit)
            _remark(stage, thing, made[own])
        body = made[own]
        if body is None:
            stage.problems.error("shows only instances, which have no mesh of their own: put Realize Instances at the end of its geometry "
                                 "nodes" if thing.name_full in stage.instancers else "has no faces: expected a mesh with an area", thing)
            continue
        weights = _weights(thing)
        name = shapes.setdefault((own, *weights.items()), f"{_NO_NAME.sub('_', thing.data.name)}-{len(shapes)}")
        if name not in stage.scene.setdefault("shapes", {}):
            mesh = stage.file("flyer.vtp", polydata(body.points, body.triangles))
            stage.scene["shapes"][name] = {"_object": thing.name_full, "mesh": mesh, "align": False, **weights}
        position, orientation = pose_of(stage.matrix(thing, stage.frames[0]), body, stage.unit)
        if not stage.is_inside(position / stage.unit):
            stage.problems.error("starts outside of the volume", thing)
        ids[thing.name_full] = len(stage.flyers)
        bodies[thing.name_full] = body
        stage.flyers.append((thing.name_full, body))
        on, origin = stage.on_of(thing, stage.frames[0]) if thing.waft.release else ({}, 0.0)
        turned = {} if thing.waft.appears else {"orientation": orientation.tolist()}  # else as in flight
        stage.add("objects", thing, shape=name, position=(position - origin).tolist(), **turned, **on,
                  **releases.get(thing.name_full, {}))
    things = [thing for thing in things if thing.name_full in ids]
    for thing in things:
        _remark_on_use(stage, thing)
    _compare_starts(stage, things, bodies)
    _name_templates(stage, things)
    return ids, bodies


def _releases(stage, things):
    """{full name: fields of when it is let go}. Those with the same two frames go one by one between them."""
    together = {}
    for thing in things:
        if thing.waft.release:
            together.setdefault((thing.waft.release, max(thing.waft.last_release, thing.waft.release)), []).append(thing)
    found = {}
    for (first, last), members in sorted(together.items()):
        ranks = np.random.default_rng([stage.scene["seed"], first, last]).permutation(len(members))
        for thing, rank in zip(members, ranks.tolist()):
            frame = stage.own_frame(thing, first + round((last - first) * rank / max(len(members) - 1, 1)))
            if frame is not None:
                found[thing.name_full] = {"release": frame, **({"appears": True} if thing.waft.appears else {})}
    return found


def _no_mesh(thing):
    if thing.type == "EMPTY" and thing.instance_type == "COLLECTION":
        return "is an instance of a collection: a flyer is one mesh: make its instances real (Object > Apply) and join them"
    return "is no mesh: a flyer is a mesh"


def _weights(thing):
    settings = thing.waft
    weights = {"settlingSpeed": settings.settling_speed, "areaDensity": settings.area_density, "thickness": settings.thickness,
               "dragCoefficient": settings.drag_coefficient}
    material = thing.active_material
    if material is not None:
        weights["color"] = tuple(material.diffuse_color[:3])
    return weights


def _remark(stage, thing, body):
    """What is odd about a body, said of the first flyer that has it."""
    if body is None:
        return
    extent = float(np.ptp(body.points, axis=0).max())
    if extent > _LARGE:
        stage.problems.warn(f"is {extent:.2g} m large; light things are centimetres: scale it down, or the scene's Unit Scale", thing)
    if thing.waft.preset != "BUBBLE" and not open_edges(body.points, body.triangles):
        stage.problems.warn("is closed, so that its front and its back both weigh and brake: a flyer is one sheet without thickness "
                            "(only a bubble is closed)", thing)


def _remark_on_use(stage, thing):
    """What of Blender an object shows or does that its flight leaves out."""
    bending = form_changes(thing)
    if bending:
        stage.problems.warn(f"may change its form ({bending}): it flies as it is at the first frame", thing)
    if thing.name_full in stage.instancers:
        stage.problems.warn("shows instances beside its mesh: they go along, but do not weigh", thing)
    if thing.name_full in stage.elsewhere:
        stage.problems.warn(f"is in the scene {stage.elsewhere[thing.name_full]}, too: it moves there as it does here", thing)


def _compare_starts(stage, things, bodies):
    """Says which flyers start in one place, as copies do that nobody has moved."""
    starts = [stage.start_of(thing, bodies[thing.name_full]) for thing in things]
    tree = KDTree(len(starts))
    for number, start in enumerate(starts):
        tree.insert(start, number)
    tree.balance()
    for number, thing in enumerate(things):
        near = _TOGETHER * float(np.ptp(bodies[thing.name_full].points, axis=0).max()) / stage.unit
        first = min(other for _, other, _ in tree.find_range(starts[number], near))
        if first < number and not (thing.waft.appears and thing.waft.release):
            stage.problems.warn(f"starts in the same place as {things[first].name_full}: move one of them", thing)


def _name_templates(stage, things):
    """Says which flyers are those that Spread has copied: it is easily overlooked that they fly as well."""
    copied = {thing.waft.copied_from.name_full for thing in things if thing.waft.copied_from is not None}
    for thing in things:
        if thing.name_full in copied:
            stage.problems.warn("is the one that Spread copied, and flies as well, from where it is: to keep it as a template give it the "
                                "part None", thing)
