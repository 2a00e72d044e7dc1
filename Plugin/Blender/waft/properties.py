# SPDX-License-Identifier: BSD-3-Clause
"""What the add-on keeps in a file: the part of each object in a scene, and the takes."""
import bpy
from bpy.props import (BoolProperty, CollectionProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty,
                       PointerProperty, StringProperty)

from . import takes
from .bodies import PRESETS
from .sampling import POSE_SIZE

ROLES = (
    ("NONE", "None", "Takes no part"),
    ("FLYER", "Flyer", "A light body that flies, with its own mesh and materials"),
    ("MARK", "Mark", "An empty: a place that a flyer is at at a frame; where its location is keyed, each key is a mark"),
    ("TARGET", "Target", "A text, curve, mesh or image that flyers form at a frame"),
    ("OBSTACLE", "Obstacle", "A closed surface in the way; it may move"),
    ("VOLUME", "Volume", "An empty of the display type Cube: its sides are walls, its bottom is the ground"),
)
QUALITIES = (
    ("preview", "Preview", "A drift on a coarse grid, for a quick look"),
    ("assimilated", "Assimilated", "A drift in one drawn air"),
    ("full", "Full", "The drift, and the optimisation after it"),
)


def _take_preset(settings, _context):
    if settings.preset != "OWN":
        settings.settling_speed, settings.area_density, settings.thickness, settings.drag_coefficient = PRESETS[settings.preset]


class ObjectTake(bpy.types.PropertyGroup):
    """The action of an object in a take; `name` is the take's."""

    action: PointerProperty(type=bpy.types.Action)


class ObjectSettings(bpy.types.PropertyGroup):
    role: EnumProperty(name="Part", items=ROLES, default="NONE")
    # Flyers.
    preset: EnumProperty(name="Preset", default="LEAF", update=_take_preset, items=(
        *((name, name.capitalize(), f"Weights of a {name.lower()}") for name in PRESETS), ("OWN", "Own", "Values of your own")))
    settling_speed: FloatProperty(name="Settling Speed", default=0.8, min=0.001, soft_max=5.0, precision=3,
                                  description="Speed at which it falls in still air in the end, in m/s")
    area_density: FloatProperty(name="Area Density", default=0.1, min=0.0001, soft_max=2.0, precision=4,
                                description="Kilograms of a square metre of its surface")
    thickness: FloatProperty(name="Thickness", default=0.0004, min=1e-7, soft_max=0.01, precision=6, description="In metres")
    drag_coefficient: FloatProperty(name="Drag Coefficient", default=1.2, min=0.01, soft_max=3.0)
    # Marks and targets.
    kind: EnumProperty(name="Kind", default="PASS", items=(
        ("PASS", "Pass", "Is there at the frame"),
        ("REST", "Rest", "Lands by the frame on the first surface straight below, and lies still")))
    frame: IntProperty(name="Frame", default=1, description="Of the scene; keys on the location count instead")
    until: IntProperty(name="Until", default=0, description="Last frame of a rest; 0: the scene's last")
    radius: FloatProperty(name="Radius", default=0.0, min=0.0, subtype="DISTANCE", unit="LENGTH",
                          description="How far from it is near enough; 0: exactly there")
    flyer: PointerProperty(name="Flyer", type=bpy.types.Object, description="Whose mark it is; none: the flyer that it hangs on, "
                                                                            "else any",
                           poll=lambda _, thing: thing.waft.role == "FLYER")
    is_turned: BoolProperty(name="Turned Alike", description="The flyer's rotation there is that of the mark")
    group: PointerProperty(name="Flyers", type=bpy.types.Collection, description="The collection whose flyers form it; none: all")
    count: IntProperty(name="Count", default=0, min=0, description="Of places; 0: as many as flyers")
    # What an object was before its first take, and its takes.
    own_action: PointerProperty(type=bpy.types.Action)
    own_mode: StringProperty()
    own_pose: FloatVectorProperty(size=POSE_SIZE)
    takes: CollectionProperty(type=ObjectTake)


class Take(bpy.types.PropertyGroup):
    """A flight that came back; `name` is also that of its folder."""

    folder: StringProperty()
    quality: StringProperty()
    edited: StringProperty(description="The take that it is an edit of")
    is_stopped: BoolProperty(description="The best so far of a flight that was stopped")


class SceneSettings(bpy.types.PropertyGroup):
    quality: EnumProperty(name="Quality", items=QUALITIES, default="preview")
    seed: IntProperty(name="Seed", default=1, min=0, description="Another number is another flight to the same marks")
    has_ground: BoolProperty(name="Ground", default=True, description="The bottom of the volume is a ground to land on")
    takes: CollectionProperty(type=Take)
    shown: IntProperty(default=-1, update=lambda settings, _: takes.show(settings.id_data, settings.shown))


class Preferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    command: StringProperty(name="Waft", subtype="FILE_PATH", description="The program waft; empty: the one that the add-on was "
                                                                          "installed with, else that on the PATH")

    def draw(self, _context):
        self.layout.prop(self, "command")


CLASSES = (ObjectTake, ObjectSettings, Take, SceneSettings, Preferences)


def register():
    for one in CLASSES:
        bpy.utils.register_class(one)
    bpy.types.Object.waft = PointerProperty(type=ObjectSettings)
    bpy.types.Scene.waft = PointerProperty(type=SceneSettings)


def unregister():
    del bpy.types.Scene.waft
    del bpy.types.Object.waft
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
