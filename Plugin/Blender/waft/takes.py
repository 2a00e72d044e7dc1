# SPDX-License-Identifier: BSD-3-Clause
"""Takes: what flights brought, as actions of the user's own objects. A take is swapped for another by its actions."""
import bpy
import numpy as np

from . import curves
from .names import by_name
from .sampling import frame_kept, pose_values, set_pose

_MOTION = ("location", "rotation_quaternion")
_HIDING = ("hide_viewport", "hide_render")
_OFF = 1e-4  # of its distance from the origin, and of 1: an object that is farther from its place is moved by something else


def add(scene, values, stage, positions, orientations, present):
    """Gives each flyer that is still there an action with its motion, and shows the take. values: of its properties; present: where flyers
    are not, they are hidden. Returns the names of
    the flyers that are gone, and (name, metres) of those that something else moves."""
    name = values["name"]
    gone, placed = [], []
    known = by_name(scene.objects)
    for index, (flyer, _) in enumerate(stage.flyers):
        thing = known.get(flyer)
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
        slot = curves.replace_curves(action, thing, dict(zip(_MOTION, (locations, turns))), stage.frames[0], settings.own_slot, stage.pace)
        if not present[index].all():
            curves.replace_steps(action, thing, _HIDING, ~present[index], stage.frames[0], slot, stage.pace)
        entry = settings.takes.add()
        entry.name = name
        entry.action = action
        entry.slot = slot
        placed.append((thing, locations))
    take = scene.waft.takes.add()
    for key, value in values.items():
        setattr(take, key, value)
    scene.waft.shown = len(scene.waft.takes) - 1
    return gone, _strays(scene, placed, stage)


def _strays(scene, placed, stage):
    """(full name, metres) of objects that are not where their keys put them, half way and in the end."""
    apart = np.zeros(len(placed))
    with frame_kept(scene, []):
        for frame in (len(stage.frames) // 2, len(stage.frames) - 1):
            scene.frame_set(stage.frames[frame])
            for number, (thing, locations) in enumerate(placed):
                if thing.hide_viewport:  # Blender does not place it
                    continue
                off = float(np.linalg.norm(np.array(thing.matrix_world.translation) - locations[frame]))
                if off > _OFF * (1.0 + float(np.linalg.norm(locations[frame]))):
                    apart[number] = max(apart[number], off)
    return [(thing.name_full, off * stage.unit) for (thing, _), off in zip(placed, apart.tolist()) if off]


def _keep_own(thing):
    settings = thing.waft
    settings.own_action = thing.animation_data.action if thing.animation_data else None
    settings.own_slot = curves.slot_of(thing)
    settings.own_mode = thing.rotation_mode
    settings.own_pose = pose_values(thing)
    settings.own_hiding = [getattr(thing, name) for name in _HIDING]


def show(scene, index):
    """Lets the flyers of a take move as they do in it."""
    if not 0 <= index < len(scene.waft.takes):
        return
    name = scene.waft.takes[index].name
    for thing in scene.objects:
        entry = thing.waft.takes.get(name)
        if entry is not None and thing.library is None:
            thing.rotation_mode = "QUATERNION"
            _set_hiding(thing)
            curves.play(thing, entry.action, entry.slot)
    scene.frame_set(scene.frame_current, subframe=scene.frame_subframe)


def _set_hiding(thing):
    """As it was hidden before its first take."""
    for name, value in zip(_HIDING, thing.waft.own_hiding):
        setattr(thing, name, value)


def remove(scene, index):
    """Takes a take away; without any left the flyers are as they were before the first."""
    name = scene.waft.takes[index].name
    for thing in scene.objects:
        settings = thing.waft
        at = settings.takes.find(name)
        if at < 0 or thing.library is not None:
            continue
        action = settings.takes[at].action
        settings.takes.remove(at)
        if not len(settings.takes):
            _give_back(thing)
        if action is not None:
            bpy.data.actions.remove(action)
    scene.waft.takes.remove(index)
    scene.waft.shown = min(index, len(scene.waft.takes) - 1)


def forget_lost(scene):
    """Takes those takes off the list of which no object has an action any more: nothing is left of them to show."""
    for thing in scene.objects:
        if thing.library is None:
            for at in reversed([at for at, entry in enumerate(thing.waft.takes) if entry.action is None]):
                thing.waft.takes.remove(at)
    kept = {entry.name for thing in scene.objects for entry in thing.waft.takes}
    lost = [at for at, take in enumerate(scene.waft.takes) if take.name not in kept]
    for at in reversed(lost):
        scene.waft.takes.remove(at)
    if lost and scene.waft.shown >= len(scene.waft.takes):
        scene.waft.shown = len(scene.waft.takes) - 1


def _give_back(thing):
    settings = thing.waft
    curves.play(thing, settings.own_action, settings.own_slot)
    thing.rotation_mode = settings.own_mode
    set_pose(thing, list(settings.own_pose))
    _set_hiding(thing)
    for name in ("own_action", "own_slot", "own_mode", "own_pose", "own_hiding"):
        settings.property_unset(name)
