# SPDX-License-Identifier: BSD-3-Clause
"""Takes: what flights brought, as actions of the user's own objects. A take is swapped for another by its actions."""
import bpy

from . import curves
from .sampling import pose_values, set_pose

_MOTION = ("location", "rotation_quaternion")


def add(scene, values, stage, positions, orientations):
    """Gives each flyer that is still there an action with its motion, and shows the take. values: of its properties. Returns the names of
    the flyers that are gone."""
    name = values["name"]
    gone = []
    for index, (flyer, _) in enumerate(stage.flyers):
        thing = scene.objects.get(flyer)
        if thing is None:
            gone.append(flyer)
            continue
        settings = thing.waft
        if not len(settings.takes):
            _keep_own(thing)
        # What else of the object the user has animated goes on beside the motion.
        action = settings.own_action.copy() if settings.own_action else bpy.data.actions.new("")
        action.name = f"{name} {flyer}"
        locations, turns = stage.placements(index, positions[index], orientations[index])
        curves.replace_curves(action, thing, dict(zip(_MOTION, (locations, turns))), stage.frames[0])
        entry = settings.takes.add()
        entry.name = name
        entry.action = action
    take = scene.waft.takes.add()
    for key, value in values.items():
        setattr(take, key, value)
    scene.waft.shown = len(scene.waft.takes) - 1
    return gone


def _keep_own(thing):
    settings = thing.waft
    settings.own_action = thing.animation_data.action if thing.animation_data else None
    settings.own_mode = thing.rotation_mode
    settings.own_pose = pose_values(thing)


def show(scene, index):
    """Lets the flyers of a take move as they do in it."""
    if not 0 <= index < len(scene.waft.takes):
        return
    name = scene.waft.takes[index].name
    for thing in scene.objects:
        entry = thing.waft.takes.get(name)
        if entry is not None:
            thing.rotation_mode = "QUATERNION"
            curves.play(thing, entry.action)
    scene.frame_set(scene.frame_current, subframe=scene.frame_subframe)


def remove(scene, index):
    """Takes a take away; without any left the flyers are as they were before the first."""
    name = scene.waft.takes[index].name
    for thing in scene.objects:
        settings = thing.waft
        at = settings.takes.find(name)
        if at < 0:
            continue
        action = settings.takes[at].action
        settings.takes.remove(at)
        if not len(settings.takes):
            _give_back(thing)
        if action is not None:
            bpy.data.actions.remove(action)
    scene.waft.takes.remove(index)
    scene.waft.shown = min(index, len(scene.waft.takes) - 1)


def _give_back(thing):
    settings = thing.waft
    curves.play(thing, settings.own_action)
    thing.rotation_mode = settings.own_mode
    set_pose(thing, list(settings.own_pose))
    for name in ("own_action", "own_mode", "own_pose"):
        settings.property_unset(name)
