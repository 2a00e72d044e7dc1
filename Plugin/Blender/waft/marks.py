# SPDX-License-Identifier: BSD-3-Clause
"""Marks: empties that say where a flyer is at a frame."""
import dataclasses

import numpy as np

from .bodies import pose_of
from .curves import key_frames, nla_paths

KEYED = ("location", "waft.radius")


@dataclasses.dataclass
class Mark:
    """One place at a frame. frame is the scene's; place and radius are in Blender units, the tolerance of its facing in radians."""

    thing: object
    flyer: object  # or None: any
    frame: int
    place: np.ndarray
    radius: float
    is_rest: bool
    tolerance: float = 0.0


def frames_of(thing, pace):
    """The frames at which an empty is a mark: those of its keys (pace: see curves.py), else its own."""
    return key_frames(thing, KEYED[:1], pace) or [thing.waft.frame]


def flyer_of(thing):
    """Whose mark it is: the one that it names, or hangs on; None for any."""
    if thing.waft.flyer is not None:
        return thing.waft.flyer
    return thing.parent if thing.parent is not None and thing.parent.waft.role == "FLYER" else None


def add_marks(stage, things, bodies, ids):
    """Adds the marks. bodies: {full name of a flyer: Body}; ids: {its full name: its ObjectId}."""
    found = []
    for thing in things:
        flyer = flyer_of(thing)
        if flyer is not None and flyer.name_full not in ids:
            if flyer.name_full in stage.left_out:
                stage.problems.error(f"is a mark of {flyer.name_full}, which takes no part", thing)
            elif flyer.waft.role != "FLYER" or flyer.name_full not in stage.known:
                stage.problems.error(f"is a mark of {flyer.name_full}, which is no flyer of this scene", thing)
            continue  # what stands against that flyer is said of it
        frames = frames_of(thing, stage.pace)
        if nla_paths(thing) & set(KEYED):
            stage.problems.warn("has keys in NLA strips, which are not read: bring them back into its action (Tab), or it is a mark at "
                                + " and ".join(f"frame {frame}" for frame in frames) + " alone", thing)
        for frame in frames:
            if stage.own_frame(thing, frame) is None:
                break
            radius, tolerance = stage.numbers(thing, frame)
            mark = Mark(thing, flyer, frame, _place(stage, thing, frame), radius, thing.waft.kind == "REST", tolerance)
            if not stage.is_inside(mark.place):
                stage.problems.error(f"lies outside of the volume at frame {frame}", thing)
            found.append(mark)
            _add(stage, mark, bodies, ids)
    _compare(stage, found, bodies)


def _place(stage, thing, frame):
    """Where a mark is. One that hangs on its flyer stays where it is as the flyer starts, wherever an earlier take moves that."""
    return np.array(_matrix(stage, thing, frame), float)[:3, 3]


def _matrix(stage, thing, frame):
    flyer = thing.parent
    matrix = stage.matrix(thing, frame)
    if flyer is None or flyer.waft.role != "FLYER":
        return matrix
    return stage.matrix(flyer, stage.frames[0]) @ stage.matrix(flyer, frame).inverted() @ matrix


def _add(stage, mark, bodies, ids):
    number = -1 if mark.flyer is None else ids[mark.flyer.name_full]
    frame = mark.frame - stage.frames[0]
    radius = mark.radius * stage.unit
    on, origin = stage.on_of(mark.thing, mark.frame)
    place = (mark.place * stage.unit - origin).tolist()
    if mark.is_rest:
        until = stage.rest_of(mark.thing)
        stage.add("constraints", mark.thing, kind="rest", object=number, frame=frame, value=place, **on,
                  **({"until": until["until"]} if "until" in until else {}))
    else:
        facing = {} if mark.thing.waft.is_turned else stage.facing_of(mark.thing, _matrix(stage, mark.thing, mark.frame), mark.tolerance)
        stage.add("constraints", mark.thing, kind="position", object=number, frame=frame, value=place, radius=radius, **on, **facing)
    if mark.thing.waft.is_turned:
        if mark.flyer is None:
            stage.problems.error("turns its flyer, but is a mark of any: name its flyer", mark.thing)
            return
        body = bodies[mark.flyer.name_full]
        turn = _matrix(stage, mark.thing, mark.frame).to_quaternion().to_matrix()
        scaled = np.eye(4)
        scaled[:3, :3] = np.array(turn, float) * body.scale
        stage.add("constraints", mark.thing, kind="orientation", object=number, frame=frame,
                  value=pose_of(scaled, body, stage.unit)[1].tolist())


def _compare(stage, marks, bodies):
    """Problems of marks that ask one flyer to be at two places at once."""
    starts = [Mark(flyer, flyer, stage.frames[0], stage.start_of(flyer, bodies[flyer.name_full]), 0.0, False)
              for flyer in {mark.flyer.name_full: mark.flyer for mark in marks if mark.flyer is not None}.values()]
    seen = {}
    for mark in starts + marks:
        if mark.flyer is None:
            continue
        for other in seen.setdefault((mark.flyer.name_full, mark.frame), []):
            apart = mark.place - other.place
            if mark.is_rest or other.is_rest:
                apart = apart[:2]  # the height of a rest is its surface's
            if np.linalg.norm(apart) > mark.radius + other.radius + 1e-5:
                what = f"the start of {mark.flyer.name_full}" if other.thing is mark.flyer else f"{other.thing.name_full}"
                stage.problems.error(f"disagrees with {what}: at frame {mark.frame} {mark.flyer.name_full} cannot be at both", mark.thing)
                break
        seen[mark.flyer.name_full, mark.frame].append(mark)
