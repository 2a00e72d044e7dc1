# SPDX-License-Identifier: BSD-3-Clause
"""Animation curves of objects, read and written whole. Blender 4.4 keeps them in slots of an action, which may be an object's and its
data's at once; earlier ones in the action. A slot is told by its identifier, "" before 4.4."""
import numpy as np

_LINEAR = 1  # of Keyframe.interpolation


def curves_of(thing):
    """The curves that animate an object, from its action. Only reads."""
    data = thing.animation_data
    if data is None or data.action is None:
        return []
    if not hasattr(data, "action_slot"):
        return list(data.action.fcurves)
    if data.action_slot is None:
        return []
    bags = (strip.channelbag(data.action_slot) for layer in data.action.layers for strip in layer.strips)
    return [curve for bag in bags if bag is not None for curve in bag.fcurves]


def slot_of(thing):
    """The identifier of the slot by which an object is animated; "" for none."""
    slot = getattr(thing.animation_data, "action_slot", None)
    return slot.identifier if slot is not None else ""


def _slot(action, identifier):
    return next((slot for slot in action.slots if slot.identifier == identifier), None)


def _made_curves(action, thing, identifier):
    """(the curves of an object in an action, to add to; identifier of its slot). Slot, layer and strip are made where there are none."""
    if not hasattr(action, "slots"):
        return action.fcurves, ""
    slot = _slot(action, identifier) or _slot(action, f"OB{thing.name}") or action.slots.new(id_type="OBJECT", name=thing.name)
    layer = action.layers[0] if len(action.layers) else action.layers.new("Layer")
    strip = layer.strips[0] if len(layer.strips) else layer.strips.new(type="KEYFRAME")
    return strip.channelbag(slot, ensure=True).fcurves, slot.identifier


def replace_curves(action, thing, values, first_frame, identifier=""):
    """Gives an action keys of an object at each frame from first_frame on, linear between, for values {data path: array [frames,
    components]}, in the place of what it had there. identifier: of the object's slot in it, if it has one. Returns that of the slot that
    they are in."""
    curves, identifier = _made_curves(action, thing, identifier)
    for curve in list(curves):
        if curve.data_path in values:
            curves.remove(curve)
    for path, table in values.items():
        for component in range(table.shape[1]):
            curve = curves.new(path, index=component)
            count = len(table)
            keys = np.column_stack([first_frame + np.arange(count), table[:, component]])
            curve.keyframe_points.add(count)
            curve.keyframe_points.foreach_set("co", keys.astype(np.float32).ravel())
            curve.keyframe_points.foreach_set("interpolation", np.full(count, _LINEAR, np.int32))
            curve.update()
    return identifier


def play(thing, action, identifier=""):
    """Lets the slot of an identifier of an action animate an object; no action: none does."""
    data = thing.animation_data or (action and thing.animation_data_create())
    if data:
        data.action = action
        if action and hasattr(action, "slots"):
            data.action_slot = _slot(action, identifier)


def key_frames(thing, paths):
    """The whole frames at which an object has keys on any of some data paths, rising."""
    return sorted({round(key.co[0]) for curve in curves_of(thing) if curve.data_path in paths for key in curve.keyframe_points})


def nla_paths(thing):
    """The data paths that NLA strips of an object that play have keys on."""
    data = thing.animation_data
    if data is None or not data.use_nla:
        return set()
    strips = [strip for track in data.nla_tracks if not track.mute for strip in track.strips if not strip.mute and strip.action]
    return {curve.data_path for strip in strips for curve in _all_curves(strip.action)}


def _all_curves(action):
    """The curves of an action, of all its slots."""
    if not hasattr(action, "slots"):
        return list(action.fcurves)
    return [curve for layer in action.layers for strip in layer.strips for bag in strip.channelbags for curve in bag.fcurves]


def has_motion(owner):
    """Whether a block of data has keys, drivers or NLA tracks; None has none."""
    data = getattr(owner, "animation_data", None)
    return data is not None and bool(data.action or len(data.drivers) or len(data.nla_tracks))


def is_animated(thing):
    """Whether anything may move an object or what it hangs on: keys, drivers, constraints, a simulation of rigid bodies."""
    while thing is not None:
        if has_motion(thing) or has_motion(thing.data) or len(thing.constraints) or is_simulated(thing):
            return True
        thing = thing.parent
    return False


def is_simulated(thing):
    """Whether an object goes where the simulation of rigid bodies takes it."""
    return thing.rigid_body is not None and thing.rigid_body.type == "ACTIVE" and not thing.rigid_body.kinematic
