# SPDX-License-Identifier: BSD-3-Clause
"""What the add-on keeps in a file: the part of each object in a scene, and the takes."""
import math

import bpy
from bpy.props import (BoolProperty, BoolVectorProperty, CollectionProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty,
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
    ("air", "Air", "A drift in one sampled air"),
    ("full", "Full", "The drift, and the optimisation after it"),
)
_FORMER = {"assimilated": "air"}  # {what a quality was called before: its name}


def quality_of(word):
    """The quality that a word names, be it what it was called before: files and scripts of then have that."""
    return _FORMER.get(word, word)


ORDERS = (("air", "Air", "At the frames of least control"), ("left-to-right", "Left to Right", "Along the width of the target"),
          ("right-to-left", "Right to Left", ""), ("top-down", "Top Down", "Along its height"), ("bottom-up", "Bottom Up", ""),
          ("outward", "Outward", "From the middle"), ("inward", "Inward", ""), ("random", "Random", "By the seed"))
WAYS_OUT = (("STAY", "Stay", "They do not leave"), ("left", "Left", "Out by the open side at the lower end of x"),
            ("right", "Right", "At the upper end of x"), ("front", "Front", "At the lower end of y"),
            ("back", "Back", "At the upper end of y"), ("top", "Top", "By the top"), ("FADE", "Vanish", "Where they are"))

# Objects that are library overrides keep values of their own, and takes.
_OWN = {"LIBRARY_OVERRIDABLE"}


def _take_preset(settings, _context):
    if settings.preset != "OWN":
        settings.settling_speed, settings.area_density, settings.thickness, settings.drag_coefficient = PRESETS[settings.preset]


class ObjectTake(bpy.types.PropertyGroup):
    """The action of an object in a take, and its slot there; `name` is the take's."""

    action: PointerProperty(type=bpy.types.Action, override=_OWN)
    slot: StringProperty(override=_OWN)


class ObjectSettings(bpy.types.PropertyGroup):
    role: EnumProperty(override=_OWN, name="Part", items=ROLES, default="NONE")
    # Flyers.
    preset: EnumProperty(override=_OWN, name="Preset", default="LEAF", update=_take_preset, items=(
        *((name, name.capitalize(), f"Weights of a {name.lower()}") for name in PRESETS), ("OWN", "Own", "Values of your own")))
    settling_speed: FloatProperty(override=_OWN, name="Settling Speed", default=0.8, min=0.001, soft_max=5.0, precision=3,
                                  description="Speed at which it falls in still air in the end, in m/s")
    area_density: FloatProperty(override=_OWN, name="Area Density", default=0.1, min=0.0001, soft_max=2.0, precision=4,
                                description="Kilograms of a square metre of its surface")
    thickness: FloatProperty(override=_OWN, name="Thickness", default=0.0004, min=1e-7, soft_max=0.01, precision=6,
                             description="In metres")
    drag_coefficient: FloatProperty(override=_OWN, name="Drag Coefficient", default=1.2, min=0.01, soft_max=3.0)
    release: IntProperty(override=_OWN, name="Release", default=0, min=0,
                         description="Frame until which it hangs still at its start; 0: it flies from the first")
    last_release: IntProperty(override=_OWN, name="Last Release", default=0, min=0,
                              description="Flyers with the same two frames are let go one by one between them, by chance; 0: at Release")
    appears: BoolProperty(override=_OWN, name="Appears", description="It is hidden before its release, and begins in flight")
    # Marks and targets.
    kind: EnumProperty(override=_OWN, name="Kind", default="PASS", items=(
        ("PASS", "Pass", "Is there at the frame"),
        ("REST", "Rest", "Lands by the frame on the first surface straight below, and lies still")))
    frame: IntProperty(override=_OWN, name="Frame", default=1, description="Of the scene; keys on the location count instead")
    first_frame: IntProperty(override=_OWN, name="First Frame", default=0, min=0,
                             description="Of a window that ends at Frame, in which each flyer comes at a frame of its own; 0: all at Frame")
    order: EnumProperty(override=_OWN, name="Order", items=ORDERS, default="air")
    hold: IntProperty(override=_OWN, name="Hold", default=0, min=0, description="Frames for which flyers stay there, still, once all have come")
    drift: BoolProperty(override=_OWN, name="Drift", description="While it is held the form drifts as one, and each flyer stays near its place "
                                                                 "in it")
    on: PointerProperty(override=_OWN, name="On", type=bpy.types.Object, poll=lambda _, thing: thing.waft.role == "OBSTACLE",
                        description="The obstacle that it goes along with: a flyer until its release, a mark or target from its frame on; "
                                    "none: the one that a mark or target is a child of")
    leave: EnumProperty(override=_OWN, name="Leave", items=WAYS_OUT, default="STAY")
    leave_frame: IntProperty(override=_OWN, name="Leave Frame", default=0, min=0, description="At which they begin to go")
    last_leave: IntProperty(override=_OWN, name="Last Leave", default=0, min=0,
                            description="They go one by one up to this frame, from left to right; 0: all at Leave Frame")
    is_open: BoolVectorProperty(override=_OWN, name="Open Sides", size=3, description="Flyers and air pass both ends of x, of y, the top")
    breeze: FloatVectorProperty(override=_OWN, name="Breeze", size=2, default=(0.0, 0.0), precision=2,
                                description="Mean flow along x and y, in m/s, through sides that are open")
    is_front: BoolProperty(override=_OWN, name="Front", description="The wind has an edge that is at its origin at Frame, travels along its z "
                                                                    "axis and lifts what lies")
    front_speed: FloatProperty(override=_OWN, name="Speed", default=2.5, min=0.01, soft_max=20.0, description="Of the edge, in m/s")
    front_width: FloatProperty(override=_OWN, name="Width", default=8.0, min=0.01, subtype="DISTANCE", unit="LENGTH",
                               description="Over which it blows behind its edge")
    until: IntProperty(override=_OWN, name="Until", default=0, description="Last frame of a rest; 0: the scene's last")
    radius: FloatProperty(override=_OWN, name="Radius", default=0.0, min=0.0, subtype="DISTANCE", unit="LENGTH",
                          description="How far from it is near enough; 0: exactly there")
    flyer: PointerProperty(override=_OWN, name="Flyer", type=bpy.types.Object, poll=lambda _, thing: thing.waft.role == "FLYER",
                           description="Whose mark it is; none: the flyer that it hangs on, else any")
    is_turned: BoolProperty(override=_OWN, name="Turned Alike", description="The flyer's rotation there is that of the mark")
    is_facing: BoolProperty(override=_OWN, name="Facing",
                            description="The flyers' upper side faces there the way that the z axis of the mark or target points: those "
                                        "of a text its reader")
    facing_tolerance: FloatProperty(override=_OWN, name="Tolerance", default=0.35, min=0.0, max=math.pi, subtype="ANGLE", unit="ROTATION",
                                    description="How far from there is near enough")
    group: PointerProperty(override=_OWN, name="Flyers", type=bpy.types.Collection,
                           description="The collection whose flyers form it; none: all")
    count: IntProperty(override=_OWN, name="Count", default=0, min=0, description="Of places; 0: as many as flyers")
    copied_from: PointerProperty(type=bpy.types.Object, description="The flyer that Spread made it of", override=_OWN)
    # What an object was before its first take, and its takes.
    own_action: PointerProperty(type=bpy.types.Action, override=_OWN)
    own_slot: StringProperty(override=_OWN)
    own_mode: StringProperty(override=_OWN)
    own_pose: FloatVectorProperty(size=POSE_SIZE, override=_OWN)
    own_hiding: BoolVectorProperty(size=2, override=_OWN)
    takes: CollectionProperty(type=ObjectTake, override=_OWN | {"USE_INSERTION"})


class Take(bpy.types.PropertyGroup):
    """A flight that came back; `name` is also that of its folder."""

    folder: StringProperty()
    quality: StringProperty()
    edited: StringProperty(description="The take that it is an edit of")
    is_stopped: BoolProperty(description="The best so far of a flight that was stopped")
    written: StringProperty(description="The manifest of the scene's files in its folder, as JSON")


class SceneSettings(bpy.types.PropertyGroup):
    quality: EnumProperty(name="Quality", items=QUALITIES, default="preview")
    seed: IntProperty(name="Seed", default=1, min=0, description="Another number is another flight to the same marks")
    loops: BoolProperty(name="Loop", description="The last frame leads on to the first: who is there at the end goes on to where one "
                                                 "begins")
    has_ground: BoolProperty(name="Ground", default=True, description="The bottom of the volume is a ground to land on")
    takes: CollectionProperty(type=Take)
    shown: IntProperty(default=-1, update=lambda settings, _: takes.show(settings.id_data, settings.shown))

    def __setattr__(self, name, value):
        super().__setattr__(name, quality_of(value) if name == "quality" else value)


class Report(bpy.types.PropertyGroup):
    """How the panel shows what was found."""

    is_open: BoolProperty(name="Show", description="Show or hide what was found", options={"SKIP_SAVE"})
    page: IntProperty(options={"SKIP_SAVE"})


CLASSES = (ObjectTake, ObjectSettings, Take, SceneSettings, Report)


def register():
    for one in CLASSES:
        bpy.utils.register_class(one)
    bpy.types.Object.waft = PointerProperty(type=ObjectSettings, override=_OWN)
    bpy.types.Scene.waft = PointerProperty(type=SceneSettings)
    bpy.types.WindowManager.waft = PointerProperty(type=Report)


def unregister():
    del bpy.types.WindowManager.waft
    del bpy.types.Scene.waft
    del bpy.types.Object.waft
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
