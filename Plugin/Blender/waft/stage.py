# SPDX-License-Identifier: BSD-3-Clause
"""A Blender scene as a scene file of Waft (Documentation/SceneFiles.md): everything that takes part, read at one go."""
import json
import math
import os

import bpy
import numpy as np

from . import marks
from .bodies import placements, pose_of
from .curves import is_animated, pace_of
from .flight import SCENE, row_of
from .flyers import add_flyers
from .obstacles import add_obstacles, add_volume
from .names import by_name
from .problems import Problems
from .sampling import frame_kept, go_to, sample
from .targets import add_targets
from .winds import add_fields, field_of

MINIMUM = (3, 4, 0)  # of Blender


def too_old(version):
    """What is said of a version of Blender that is too old; "" of others."""
    if tuple(version) >= MINIMUM:
        return ""
    return f"this is Blender {'.'.join(map(str, version))}: Waft needs {MINIMUM[0]}.{MINIMUM[1]} or later"


class Stage:
    """What of a scene takes part.

    scene: the scene file's content. files: {name: content} that it names. problems: what stands against a flight. sources:
    {"constraints", "obstacles", ...: the full name of the object of each entry}. flyers: [(object's full name, Body)] in the order
    of their ObjectId. frames: the frames of the scene, of which the first is frame 0 of the file. unit: metres of a Blender unit.
    rate: frames per second; pace: how far keys are played in a frame (curves.py). Full names of objects: instancers, of what shows
    instances of others; left_out, of what has a part, but takes none; known, of all of the scene; elsewhere, {that of one of another
    scene: that scene's name}; volume, that of the volume. manifest: of the files that were written.
    """

    def __init__(self, context):
        self.problems = Problems()
        self.scene = {"waft": 1}
        self.files = {}
        self.sources = {}
        self.flyers = []
        self.obstacles = {}  # {full name: (its number, places of its origin, by frame [m])}
        self.instancers = set()
        self.left_out = set()
        self.manifest = []
        settings = context.scene
        self.known = set(by_name(settings.objects))
        self.elsewhere = {name: scene.name for scene in bpy.data.scenes if scene != settings for name in by_name(scene.objects)}
        self.frames = range(settings.frame_start, settings.frame_end + 1)
        self.rate = settings.render.fps / settings.render.fps_base
        self.pace = pace_of(settings)
        self.unit = settings.unit_settings.scale_length
        self.low = self.high = None
        self._context = self.depsgraph = None  # while it is read
        self._places = {}
        old = too_old(bpy.app.version)
        if old:
            self.problems.error(old)
        elif len(self.frames) < 2:
            self.problems.error("the scene has one frame: expected two at least (Output properties, Frame Range)")
        else:
            self._read(context)

    # What the parts ask.

    def matrix(self, thing, frame):
        """Where an object is at a frame."""
        return self._places[frame][thing.name_full][0]

    def numbers(self, thing, frame):
        """What _numbers tells of an object at a frame."""
        return self._places[frame][thing.name_full][1]

    def go_to(self, frame):
        """Takes Blender to a frame: what is read of the file then, forms and settings, is as it is there."""
        go_to(self._context.scene, frame)
        self.depsgraph = self._context.evaluated_depsgraph_get()

    def start_of(self, thing, body):
        """Where the centre of mass of a flyer is at the first frame [Blender units]."""
        return pose_of(self.matrix(thing, self.frames[0]), body, self.unit)[0] / self.unit

    def is_inside(self, place):
        """Whether a place [Blender units] is in the volume."""
        place = np.asarray(place) * self.unit
        return self.low is None or bool(np.all(place >= self.low) and np.all(place <= self.high))

    def own_frame(self, thing, frame):
        """The scene file's number of a frame; None, and a problem, where it is none of the scene."""
        if frame in self.frames:
            return frame - self.frames[0]
        self.problems.error(f"is at frame {frame}: expected one of the scene's, {self.frames[0]} to {self.frames[-1]}", thing)
        return None

    def rest_of(self, thing):
        """The fields of a keyframe that rests; none of one that passes."""
        if thing.waft.kind != "REST":
            return {}
        until = self.own_frame(thing, thing.waft.until) if thing.waft.until else None
        return {"velocity": "rest"} if until is None else {"velocity": "rest", "until": until}

    def times_of(self, thing, frame):
        """The fields of a position or keyframe that say when, and what comes after; None, and a problem, where they say no frame. frame: of
        the scene."""
        settings, last = thing.waft, self.own_frame(thing, frame)
        times = {"frame": last}
        if last is not None and settings.first_frame:
            first = self.own_frame(thing, settings.first_frame)
            if first is None or first >= last:
                if first is not None:
                    self.problems.error(f"has a window from frame {settings.first_frame} to {frame}: expected an earlier First Frame", thing)
                return None
            times["frame"] = {"from": first, "to": last}
            if settings.order != "air":
                times["order"] = settings.order
        if settings.hold and settings.kind != "REST":
            times["hold"] = settings.hold
            if settings.drift:
                times["drift"] = True
        if last is None or not self._add_leave(thing, frame, times):
            return None
        return times

    def _add_leave(self, thing, frame, times):
        settings = thing.waft
        if settings.leave == "STAY":
            return True
        if settings.leave_frame < frame:
            self.problems.error(f"is left at frame {settings.leave_frame}: expected a Leave Frame not before frame {frame}, at which all have "
                                "come", thing)
            return False
        first, last = (self.own_frame(thing, one) for one in (settings.leave_frame, max(settings.last_leave, settings.leave_frame)))
        if first is None or last is None:
            return False
        times["leave"] = {"frame": first} if last == first else {"frame": {"from": first, "to": last}, "order": "left-to-right"}
        if settings.leave != "FADE":
            times["leave"]["side"] = settings.leave
        return True

    def on_of(self, thing, frame):
        """What goes along with an obstacle: the field that says so, and where the obstacle's origin is at a frame [m], which places are
        relative to; else none, and the world's."""
        carrier = thing.waft.on or thing.parent
        while carrier is not None and carrier.waft.role != "OBSTACLE":
            carrier = carrier.parent
        if carrier is None or carrier.name_full not in self.obstacles:
            if thing.waft.on is not None and carrier is None:
                self.problems.error(f"is on {thing.waft.on.name_full}, which is no obstacle of this scene", thing)
            return {}, np.zeros(3)
        number, places = self.obstacles[carrier.name_full]
        return {"on": number}, places[frame - self.frames[0]]

    def facing_of(self, thing, matrix, tolerance):
        """The field of a row that asks its flyers to face along the z axis of a matrix; none of one that asks no such thing."""
        if not thing.waft.is_facing or thing.waft.kind == "REST":
            return {}
        along = np.array(matrix, float)[:3, 2]
        return {"facing": {"direction": (along / np.linalg.norm(along)).tolist(), "tolerance": min(tolerance, math.pi)}}

    def add(self, group, thing, **entry):
        """Adds an entry to a list of the scene file."""
        self.scene.setdefault(group, []).append({"_object": thing.name_full, **entry})
        self.sources.setdefault(group, []).append(thing.name_full)

    def file(self, name, content):
        """Keeps a file beside the scene file; returns its name there."""
        stem, ending = os.path.splitext(name)
        own = f"{stem}-{len(self.files)}{ending}"
        self.files[own] = content
        return own

    def written(self):
        """Names of the files that `write` makes."""
        return [*self.files, SCENE]

    def write(self, folder):
        """Writes the scene file and what it names into an empty folder; returns its path. Their manifest (flight.py) is kept."""
        for name, content in self.files.items():
            with open(os.path.join(folder, name), "wb") as stream:
                stream.write(content if isinstance(content, bytes) else content.encode())
        path = os.path.join(folder, SCENE)
        with open(path, "w", encoding="utf-8") as stream:
            json.dump(self.scene, stream, indent=1, ensure_ascii=False)
        self.manifest = [row_of(folder, name) for name in self.written()]
        return path

    def placements(self, index, positions, orientations):
        """(locations, quaternions) of the object of the flyer of an ObjectId, from the poses of its body."""
        return placements(positions, orientations, self.flyers[index][1], self.unit)

    # Reading.

    def _read(self, context):
        parts = {role: [] for role in ("FLYER", "MARK", "TARGET", "OBSTACLE", "VOLUME")}
        fields = []
        context.view_layer.update()  # objects that a script has just made are in it then
        depsgraph = context.evaluated_depsgraph_get()
        layer = by_name(context.view_layer.objects)
        for name, thing in by_name(context.scene.objects).items():
            if thing.waft.role not in parts and field_of(thing) is None:
                held = thing.instance_collection if thing.instance_type == "COLLECTION" else None
                if held is not None and any(one.waft.role in parts for one in held.all_objects):
                    self.problems.warn("is an instance of a collection, and what has a part in that takes none: make its instances real "
                                       "(Object > Apply), or a library override", thing)
                continue
            if name not in layer:
                self._leave_out("is in a collection that the view layer excludes", thing)
            elif not thing.evaluated_get(depsgraph).is_evaluated:
                self._leave_out("is disabled in viewports, where Blender does not evaluate it", thing)
            elif thing.waft.role in parts:
                parts[thing.waft.role].append(thing)
            else:
                fields.append(thing)
        self.instancers = _instancers(depsgraph, sum(parts.values(), []))
        for thing in parts["MARK"]:
            if thing.type != "EMPTY":
                self.problems.error("is no empty: a mark is an empty", thing)
        self._context = context
        with frame_kept(context.scene, parts["FLYER"]):
            self._sample(context, parts, fields)
            self.go_to(self.frames[0])
            self._add(context.scene, parts, fields)
        self._context = self.depsgraph = None  # which an undo would take away

    def _leave_out(self, why, thing):
        self.problems.warn(f"{why}: it takes no part", thing)
        self.left_out.add(thing.name_full)

    def _add(self, scene, parts, fields):
        title = "".join(filter(str.isprintable, scene.name))  # no control characters go into files
        self.scene.update(title=title, seed=scene.waft.seed, time={"frames": len(self.frames), "framesPerSecond": self.rate})
        if scene.waft.loops:
            self.scene["time"]["loop"] = True
        has_volume = add_volume(self, parts["VOLUME"], scene.waft.has_ground)
        add_obstacles(self, parts["OBSTACLE"])
        ids, bodies = add_flyers(self, parts["FLYER"])
        marks.add_marks(self, [thing for thing in parts["MARK"] if thing.type == "EMPTY"], bodies, ids)
        add_targets(self, parts["TARGET"], ids)
        if has_volume:
            add_fields(self, fields)

    def _sample(self, context, parts, fields):
        moving = [*parts["OBSTACLE"], *fields]
        frames = {self.frames[0]}
        frames.update(frame for thing in parts["MARK"] for frame in marks.frames_of(thing, self.pace) if frame in self.frames)
        frames.update(thing.waft.frame for thing in parts["TARGET"] if thing.waft.frame in self.frames)
        if any(is_animated(thing) for thing in moving):
            frames.update(self.frames)
        self._places = sample(context, [*sum(parts.values(), []), *fields], frames, _numbers)
        for frame in self.frames:
            self._places.setdefault(frame, self._places[self.frames[0]])


def _numbers(thing):
    """What counts of an object as it is at a frame, beside its place: radius and tolerance of facing of a mark; strength, reach and size
    of a field."""
    if thing.waft.role == "MARK":
        return thing.waft.radius, thing.waft.facing_tolerance
    field = field_of(thing)
    return (field.strength, field.distance_max, thing.empty_display_size) if field else ()


def _instancers(depsgraph, things):
    """The full names of those of some things that show instances of others: by geometry nodes, particles, faces, as collections."""
    if not any(thing.instance_type != "NONE" or any(one.type in ("NODES", "PARTICLE_SYSTEM") for one in thing.modifiers)
               for thing in things):
        return set()
    return {one.parent.original.name_full for one in depsgraph.object_instances if one.is_instance and one.parent is not None}
