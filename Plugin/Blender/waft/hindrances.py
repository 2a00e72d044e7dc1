# SPDX-License-Identifier: BSD-3-Clause
"""What of Blender would move an object besides its own keys, or bend it, while Waft flies it as a rigid body."""
import bpy
from mathutils import Vector

from .curves import curves_of, has_motion, is_animated, is_simulated, nla_paths

_ONES = Vector((1.0, 1.0, 1.0))
_PLACE = ("location", "rotation_", "delta_")  # how the data paths begin that place an object
_BESIDE = ("delta_", "constraints[")  # of these, those that go on beside the keys of a take
_BENDING = ("ARMATURE", "BUILD", "CLOTH", "DYNAMIC_PAINT", "EXPLODE", "FLUID", "MESH_CACHE", "MESH_SEQUENCE_CACHE", "OCEAN",
            "SOFT_BODY", "WAVE")  # modifiers that change a mesh by themselves


def obstruction(thing):
    """What keeps an object from being placed by keys on its own location and rotation; "" for nothing."""
    if thing.library is not None:
        return "is linked from another file, which cannot keep its motion: make it local, or a library override of it (Object > " \
               "Library Override > Make)"
    if thing.override_library is not None and thing.override_library.reference is not None \
            and len(thing.override_library.reference.waft.takes):
        return "has takes in the file that it is linked from: remove them there"
    if thing.parent is not None:
        return "hangs on a parent: clear it and keep the transformation (Alt P)"
    if any(not constraint.mute for constraint in thing.constraints):
        return "has constraints: remove or mute them"
    if thing.delta_location.length or thing.delta_scale != _ONES or thing.delta_rotation_euler.to_quaternion().angle \
            or thing.delta_rotation_quaternion.angle:
        return "has delta transforms: clear them"
    driven = {driver.data_path for driver in _drivers(thing) if not driver.mute}
    if any(path.startswith(_PLACE) for path in driven):
        return "has a driver on its location or rotation, which would win over the motion: remove or mute it"
    if any(path.startswith(_BESIDE) for path in driven | nla_paths(thing) | {curve.data_path for curve in curves_of(thing)}):
        return "has keys on its delta transforms or constraints, which would move it besides: remove them"
    if is_simulated(thing):
        return "is an active rigid body, which the simulation would move: remove that, or tick Animated in Physics > Rigid Body"
    return _nla(thing) or ("" if min(map(abs, thing.scale)) > 0.0 else "has a scale of 0")


def _drivers(owner):
    data = getattr(owner, "animation_data", None)
    return data.drivers if data is not None else ()


def _nla(thing):
    """What of the NLA keeps an action from placing an object alone."""
    data = thing.animation_data
    if data is None or not data.use_nla:
        return ""
    if data.use_tweak_mode:
        return "is in tweak mode of the NLA: leave it (Tab in the Nonlinear Animation editor)"
    if any(track.is_solo for track in data.nla_tracks):
        return "has an NLA track that plays solo, which would win over the motion: unstar it"
    if len(data.nla_tracks) and (data.action_blend_type != "REPLACE" or data.action_influence < 1.0):
        return "blends its action with NLA tracks: set the action's blending to Replace with an influence of 1, or mute the tracks"
    return ""


def form_changes(thing):
    """What may change the form or the size of a mesh in the course of time; "" for nothing."""
    keys = getattr(thing.data, "shape_keys", None)
    if has_motion(thing.data) or has_motion(keys):
        return "keys on its mesh or its shape keys"
    for modifier in thing.modifiers:
        if modifier.show_viewport and (modifier.type in _BENDING or _follows(modifier)):
            return f"the modifier {modifier.name}"
    curves = (*curves_of(thing), *_drivers(thing))
    if any(curve.data_path.startswith("modifiers[") for curve in curves):
        return "keys on a modifier"
    return "keys on its scale" if any(curve.data_path == "scale" and _varies(curve) for curve in curves) else ""


def _varies(curve):
    """Whether a curve has more than one value: place, rotation and scale are often keyed together."""
    values = {round(key.co[1], 6) for key in curve.keyframe_points}
    return len(values) != 1 or len(curve.modifiers) > 0


def _follows(modifier):
    """Whether a modifier asks something that is animated: another object, or its own group of nodes."""
    for one in modifier.bl_rna.properties:
        value = getattr(modifier, one.identifier, None) if one.type == "POINTER" else None
        if isinstance(value, bpy.types.Object) and is_animated(value):
            return True
        if isinstance(value, bpy.types.NodeTree) and (has_motion(value) or any(node.type == "INPUT_SCENE_TIME" for node in value.nodes)):
            return True
    return False
