# SPDX-License-Identifier: BSD-3-Clause
"""Where objects are, and what their properties are, over the frames of a scene."""
import contextlib


@contextlib.contextmanager
def frame_kept(scene, things):
    """Afterwards the scene is at its frame again, and things that were moved without a key are where they were."""
    frame, part = scene.frame_current, scene.frame_subframe
    before = [(thing, thing.matrix_basis.copy()) for thing in things]
    try:
        yield
    finally:
        scene.frame_set(frame, subframe=part)
        for thing, matrix in before:
            if thing.matrix_basis != matrix:
                thing.matrix_basis = matrix


def sample(context, things, frames, values):
    """{frame: {name: (matrix in the world, values(thing))}} of things at frames, the scene's own frame first: what was moved there
    without a key is still where it was put. Leaves the scene at the last of the frames."""
    scene = context.scene
    context.view_layer.update()
    found = {}
    for frame in sorted(frames, key=lambda frame: (frame != scene.frame_current, frame)):
        go_to(scene, frame)
        found[frame] = {thing.name: (thing.matrix_world.copy(), values(thing)) for thing in things}
    return found


def go_to(scene, frame):
    """Takes a scene to a frame, where it is not there."""
    if frame != scene.frame_current or scene.frame_subframe:
        scene.frame_set(frame)
