# SPDX-License-Identifier: BSD-3-Clause
"""Where objects are, and what their properties are, over the frames of a scene."""
import contextlib

_POSE = (("location", 3), ("rotation_quaternion", 4), ("rotation_euler", 3), ("rotation_axis_angle", 4))
POSE_SIZE = sum(size for _, size in _POSE)


def pose_values(thing):
    """The numbers of an object's location and rotation, in all ways that it keeps them."""
    return [value for name, _ in _POSE for value in getattr(thing, name)]


def set_pose(thing, values):
    """Gives back what pose_values gave."""
    at = 0
    for name, size in _POSE:
        setattr(thing, name, values[at:at + size])
        at += size


@contextlib.contextmanager
def frame_kept(scene, things):
    """Afterwards the scene is at its frame again, and things that were moved without a key are where they were."""
    frame, part = scene.frame_current, scene.frame_subframe
    before = [(thing, pose_values(thing)) for thing in things]
    try:
        yield
    finally:
        scene.frame_set(frame, subframe=part)
        for thing, values in before:
            if pose_values(thing) != values:
                set_pose(thing, values)


def sample(context, things, frames, values):
    """{frame: {full name: (matrix in the world, values(thing))}} of things at frames, the scene's own frame first: what was moved there
    without a key is still where it was put. Leaves the scene at the last of the frames."""
    scene = context.scene
    found = {}
    for frame in sorted(frames, key=lambda frame: (frame != scene.frame_current, frame)):
        go_to(scene, frame)
        found[frame] = {thing.name_full: (thing.matrix_world.copy(), values(thing)) for thing in things}
    return found


def go_to(scene, frame):
    """Takes a scene to a frame, where it is not there."""
    if frame != scene.frame_current or scene.frame_subframe:
        scene.frame_set(frame)
