# SPDX-License-Identifier: BSD-3-Clause
"""Animation curves of objects, read and written whole. Blender 4.4 keeps them in slots of an action, which animates several objects or
data, each by a slot of its own; earlier ones in the action. A slot is told by its identifier, which is "" before 4.4."""
import bpy
import numpy as np

_HAS_SLOTS = bpy.app.version >= (4, 4, 0)  # 4.3 has some of the names, but actions without slots
_NO_SLOT = "-"  # in the place of an identifier: the action of an object that none of its slots animates
_CONSTANT, _LINEAR = 0, 1  # of Keyframe.interpolation


def curves_of(owner):
    """The curves that animate an object, or another block of data, from its action. Only reads."""
    return _curves_by(getattr(owner, "animation_data", None))


def _curves_by(user):
    """The curves that animation data, or a strip of the NLA, take from their action."""
    if user is None or user.action is None:
        return []
    if not _HAS_SLOTS:
        return list(user.action.fcurves)
    if user.action_slot is None:
        return []
    bags = (strip.channelbag(user.action_slot) for layer in user.action.layers for strip in layer.strips)
    return [curve for bag in bags if bag is not None for curve in bag.fcurves]


def slot_of(thing):
    """What tells the slot by which the action of an object animates it; "" without an action."""
    data = thing.animation_data
    if not _HAS_SLOTS or data is None or data.action is None:
        return ""
    return data.action_slot.identifier if data.action_slot is not None else _NO_SLOT


def _slot(action, identifier):
    """The slot of an identifier, else the only one for objects: Blender makes one of what an earlier one has saved, and a user may rename
    it. None where there is none."""
    suited = [slot for slot in action.slots if slot.target_id_type in ("OBJECT", "UNSPECIFIED")]
    named = [slot for slot in suited if slot.identifier == identifier]
    if named or (len(suited) == 1 and identifier != _NO_SLOT):
        return (named or suited)[0]
    return None


def _curves_to_write(action, thing, identifier):
    """(the curves of an object in an action, to add to and to remove from; identifier of its slot). Slot, layer and strip are made where
    there are none."""
    if not _HAS_SLOTS:
        return action.fcurves, ""
    slot = _slot(action, identifier) or action.slots.new(id_type="OBJECT", name=thing.name)
    if slot.target_id_type == "UNSPECIFIED":
        slot.target_id_type = "OBJECT"  # its first object would set it, and change the identifier
    layer = action.layers[0] if len(action.layers) else action.layers.new("Layer")
    strip = layer.strips[0] if len(layer.strips) else layer.strips.new(type="KEYFRAME")
    return strip.channelbag(slot, ensure=True).fcurves, slot.identifier


def replace_curves(action, thing, values, first_frame, identifier="", pace=1.0):
    """Gives an action keys of an object at each frame from first_frame on, linear between, for values {data path: array [frames,
    components]}, in the place of what it had there. identifier: what slot_of tells of the object's slot in it; pace: see pace_of.
    Returns that of the slot that they are in."""
    curves, identifier = _emptied(action, thing, values, identifier)
    for path, table in values.items():
        times = pace * (first_frame + np.arange(len(table)))
        for component in range(table.shape[1]):
            _add_keys(curves.new(path, index=component), times, table[:, component], _LINEAR)
    return identifier


def replace_steps(action, thing, paths, values, first_frame, identifier="", pace=1.0):
    """Gives an action keys of an object where values [frames] change, on all of some data paths, constant between. The rest as in
    replace_curves."""
    curves, _ = _emptied(action, thing, paths, identifier)
    changes = np.flatnonzero(np.diff(values, prepend=~values[:1]))
    for path in paths:
        _add_keys(curves.new(path), pace * (first_frame + changes), values[changes], _CONSTANT)


def _emptied(action, thing, paths, identifier):
    """_curves_to_write, without those of some data paths."""
    curves, identifier = _curves_to_write(action, thing, identifier)
    for curve in list(curves):
        if curve.data_path in paths:
            curves.remove(curve)
    return curves, identifier


def _add_keys(curve, times, values, interpolation):
    curve.keyframe_points.add(len(times))
    curve.keyframe_points.foreach_set("co", np.column_stack([times, values]).astype(np.float32).ravel())
    curve.keyframe_points.foreach_set("interpolation", np.full(len(times), interpolation, np.int32))
    curve.update()


def play(thing, action, identifier=""):
    """Lets the slot of an identifier of an action animate an object; no action: none does."""
    data = thing.animation_data or (action and thing.animation_data_create())
    if data:
        data.action = action
        if action and _HAS_SLOTS:
            data.action_slot = _slot(action, identifier)


def pace_of(scene):
    """How far keys are played in a frame of a scene: 1, or what its Time Remapping makes of it."""
    return scene.render.frame_map_old / scene.render.frame_map_new


def key_frames(thing, paths, pace=1.0):
    """The whole frames of the scene next to those at which keys of an object on any of some data paths are played, rising."""
    return sorted({round(key.co[0] / pace) for curve in curves_of(thing) if curve.data_path in paths for key in curve.keyframe_points})


def nla_paths(thing):
    """The data paths that NLA strips of an object that play have keys on."""
    data = thing.animation_data
    if data is None or not data.use_nla:
        return set()
    strips = [strip for track in data.nla_tracks if not track.mute for strip in track.strips if not strip.mute]
    return {curve.data_path for strip in strips for curve in _curves_by(strip)}


def has_motion(owner):
    """Whether a block of data has keys, drivers or NLA tracks; None has none."""
    data = getattr(owner, "animation_data", None)
    return data is not None and bool(curves_of(owner) or len(data.drivers) or len(data.nla_tracks))


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
