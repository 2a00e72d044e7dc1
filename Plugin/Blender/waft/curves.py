# SPDX-License-Identifier: BSD-3-Clause
"""Animation curves of objects, read and written whole. Blender 4.4 keeps them in slots of an action, earlier ones in the action."""
import numpy as np

_LINEAR = 1  # of Keyframe.interpolation


def curves_of(thing):
    """The curves that animate an object, from its action."""
    data = thing.animation_data
    if data is None or data.action is None:
        return []
    if not hasattr(data, "action_slot"):
        return list(data.action.fcurves)
    return list(_bag(data.action, data.action_slot).fcurves) if data.action_slot else []


def _bag(action, slot):
    layer = action.layers[0] if action.layers else action.layers.new("Layer")
    strip = layer.strips[0] if layer.strips else layer.strips.new(type="KEYFRAME")
    return strip.channelbag(slot, ensure=True)


def replace_curves(action, thing, values, first_frame):
    """Gives an action that is an object's alone keys at each frame from first_frame on, linear between, for values
    {data path: array [frames, components]}, in the place of what it had there."""
    if hasattr(action, "slots"):
        slot = action.slots[0] if action.slots else action.slots.new(id_type="OBJECT", name=thing.name)
        curves = _bag(action, slot).fcurves
    else:
        curves = action.fcurves
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


def play(thing, action):
    """Lets an action animate an object; None: none does."""
    data = thing.animation_data or (action and thing.animation_data_create())
    if data:
        data.action = action
        if action and hasattr(data, "action_slot") and data.action_slot is None and action.slots:
            data.action_slot = action.slots[0]


def key_frames(thing, paths):
    """The whole frames at which an object has keys on any of some data paths, rising."""
    return sorted({round(key.co[0]) for curve in curves_of(thing) if curve.data_path in paths for key in curve.keyframe_points})


def is_animated(thing):
    """Whether anything may move an object or what it hangs on: keys, drivers, constraints."""
    while thing is not None:
        for owner in (thing, thing.data):
            data = getattr(owner, "animation_data", None)
            if data is not None and (data.action or len(data.drivers) or len(data.nla_tracks)):
                return True
        if len(thing.constraints):
            return True
        thing = thing.parent
    return False
