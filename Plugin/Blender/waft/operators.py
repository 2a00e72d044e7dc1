# SPDX-License-Identifier: BSD-3-Clause
"""What the panel's buttons do."""
import time

import bpy
import numpy as np
from bpy.props import EnumProperty, IntProperty, StringProperty

from . import flying, spreading
from .names import by_name
from .properties import ROLES

_TICK = 0.2  # s


def _redraw(context):
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


def _show(context):
    """Shows what was found: folded where there is a line that says enough."""
    context.window_manager.waft.is_open = flying.found.is_fatal
    context.window_manager.waft.page = 0
    _redraw(context)


class _Watching:
    """An operator that watches a process of waft from a timer of the window, while Blender goes on."""

    def _watch(self, context):
        self._timer = context.window_manager.event_timer_add(_TICK, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def _leave(self, context):
        context.window_manager.event_timer_remove(self._timer)


class WAFT_OT_check(_Watching, bpy.types.Operator):
    """See whether the scene can fly, and what will be hard"""

    bl_idname = "waft.check"
    bl_label = "Check"

    @classmethod
    def poll(cls, _context):
        return flying.running is None and flying.looking is None

    def execute(self, context):
        """From a script: waits for the end."""
        flying.check(context)
        return self._end(context)

    def invoke(self, context, _event):
        flying.begin_look(context)
        if flying.looking is None:
            return self._end(context)
        self._look = flying.looking
        _redraw(context)
        return self._watch(context)

    def modal(self, context, event):
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        if flying.looking is not self._look:  # another file was opened, or a flight begun
            self._leave(context)
            return {"CANCELLED"}
        if not flying.end_look():
            return {"PASS_THROUGH"}
        self._leave(context)
        return self._end(context)

    def cancel(self, context):
        self._leave(context)
        flying.drop_look()

    def _end(self, context):
        _show(context)
        self.report({"INFO"}, f"Waft: {flying.found.title}")
        return {"FINISHED"}


class WAFT_OT_fly(_Watching, bpy.types.Operator):
    """Fly the scene in the background; the motion comes as a take of the flyers"""

    bl_idname = "waft.fly"
    bl_label = "Fly"
    bl_options = {"UNDO"}

    @classmethod
    def poll(cls, _context):
        return flying.running is None

    def execute(self, context):
        """From a script: waits for the end."""
        if not flying.begin(context):
            return self._refuse(context)
        while True:
            outcome = flying.running.flight.poll()
            if outcome is not None:
                return self._end(context, outcome)
            time.sleep(_TICK)

    def invoke(self, context, _event):
        if not flying.begin(context):
            return self._refuse(context)
        _show(context)
        return self._watch(context)

    def modal(self, context, event):
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        if flying.running is None:  # another file was opened
            self._leave(context)
            return {"CANCELLED"}
        outcome = flying.running.flight.poll()
        _redraw(context)
        if outcome is None:
            return {"PASS_THROUGH"}
        self._leave(context)
        return self._end(context, outcome)

    def cancel(self, context):
        self._leave(context)
        flying.drop()

    def _end(self, context, outcome):
        if not flying.end(context, outcome):
            return self._refuse(context)
        _show(context)
        return {"FINISHED"}

    def _refuse(self, context):
        _show(context)
        first = next((problem for problem in flying.found if problem.is_error), None)
        if first is not None:
            self.report({"WARNING"}, f"Waft: {first.object} {first.text}" if first.object else f"Waft: {first.text}")
        return {"CANCELLED"}


class WAFT_OT_stop(bpy.types.Operator):
    """Stop the flight and keep its best so far; once more: end it at once"""

    bl_idname = "waft.stop"
    bl_label = "Stop"

    @classmethod
    def poll(cls, _context):
        return flying.running is not None

    def execute(self, _context):
        flying.running.flight.stop()
        return {"FINISHED"}


class WAFT_OT_dismiss(bpy.types.Operator):
    """Take what was found out of the panel"""

    bl_idname = "waft.dismiss"
    bl_label = "Close"

    def execute(self, context):
        flying.found.put("")
        _redraw(context)
        return {"FINISHED"}


class WAFT_OT_turn(bpy.types.Operator):
    """Show others of what was found"""

    bl_idname = "waft.turn"
    bl_label = "Turn"

    page: IntProperty()

    def execute(self, context):
        context.window_manager.waft.page = self.page
        _redraw(context)
        return {"FINISHED"}


class WAFT_OT_select(bpy.types.Operator):
    """Select what the message is about"""

    bl_idname = "waft.select"
    bl_label = "Select"
    bl_options = {"UNDO"}

    name: StringProperty()
    others: StringProperty(description="More names, a line each")

    def execute(self, context):
        known = by_name(context.view_layer.objects)
        things = [known[name] for name in (self.name, *self.others.split("\n")) if name in known]
        if not things:
            self.report({"WARNING"}, f"{self.name} is no longer there")
            return {"CANCELLED"}
        for other in context.selected_objects:
            other.select_set(False)
        for thing in things:
            thing.select_set(True)
        context.view_layer.objects.active = things[0]
        return {"FINISHED"}


class WAFT_OT_role(bpy.types.Operator):
    """Give the selected objects this part in the scene"""

    bl_idname = "waft.role"
    bl_label = "Take Part As"
    bl_options = {"REGISTER", "UNDO"}

    role: EnumProperty(name="Part", items=ROLES)

    @classmethod
    def poll(cls, context):
        return bool(context.selected_objects)

    def execute(self, context):
        for thing in context.selected_objects:
            thing.waft.role = self.role
            if self.role in ("MARK", "TARGET"):
                thing.waft.frame = context.scene.frame_current
        return {"FINISHED"}


class WAFT_OT_add_mark(bpy.types.Operator):
    """Add a mark at the 3D cursor and the current frame, of the active object where that is a flyer"""

    bl_idname = "waft.add_mark"
    bl_label = "Add Mark"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        flyer = context.active_object
        mark = bpy.data.objects.new("Mark", None)
        context.collection.objects.link(mark)
        mark.empty_display_type = "SPHERE"
        mark.empty_display_size = 0.05 / context.scene.unit_settings.scale_length
        mark.location = context.scene.cursor.location
        mark.waft.role = "MARK"
        mark.waft.frame = context.scene.frame_current
        if flyer is not None and flyer.waft.role == "FLYER":
            mark.waft.flyer = flyer
        return {"FINISHED"}


class WAFT_OT_add_volume(bpy.types.Operator):
    """Add a volume around all that takes part"""

    bl_idname = "waft.add_volume"
    bl_label = "Add Volume"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return not any(thing.waft.role == "VOLUME" for thing in context.view_layer.objects)

    def execute(self, context):
        room = 1.0 / context.scene.unit_settings.scale_length
        corners = [thing.matrix_world @ type(thing.location)(corner) for thing in context.view_layer.objects
                   if thing.waft.role != "NONE" for corner in (thing.bound_box if thing.type != "EMPTY" else [(0.0, 0.0, 0.0)])]
        corners = np.array(corners or [(0.0, 0.0, 0.0)], float)
        low, high = corners.min(axis=0) - room, corners.max(axis=0) + room
        if corners[:, 2].min() >= 0.0:
            low[2] = 0.0  # what stands over the ground of Blender stands over that of the volume
        box = bpy.data.objects.new("Volume", None)
        context.collection.objects.link(box)
        box.empty_display_type = "CUBE"
        box.location = 0.5 * (low + high)
        box.scale = 0.5 * (high - low)
        box.waft.role = "VOLUME"
        return {"FINISHED"}


class WAFT_OT_spread(bpy.types.Operator):
    """Spread copies of the active flyer on the faces of the other selected mesh; the copies share its mesh"""

    bl_idname = "waft.spread"
    bl_label = "Spread"
    bl_options = {"REGISTER", "UNDO"}

    count: IntProperty(name="Count", default=30, min=1, max=100000)
    seed: IntProperty(name="Seed", default=1, min=0)

    @classmethod
    def poll(cls, context):
        flyer = context.active_object
        return flyer is not None and flyer.waft.role == "FLYER" and len(context.selected_objects) == 2

    def execute(self, context):
        flyer = context.active_object
        emitter = next(thing for thing in context.selected_objects if thing is not flyer)
        if not spreading.spread(context, flyer, emitter, self.count, self.seed):
            self.report({"WARNING"}, f"Waft: {emitter.name} has no faces to spread on")
            return {"CANCELLED"}
        return {"FINISHED"}


class WAFT_OT_remove_take(bpy.types.Operator):
    """Remove the take, its actions and what its flight wrote beside the file; without any take the flyers are as they were before"""

    bl_idname = "waft.remove_take"
    bl_label = "Remove Take"
    bl_options = {"UNDO"}

    @classmethod
    def poll(cls, context):
        return 0 <= context.scene.waft.shown < len(context.scene.waft.takes)

    def execute(self, context):
        freed = flying.remove(context.scene, context.scene.waft.shown)
        if freed:
            self.report({"INFO"}, f"Waft: {freed / 1e6:.0f} MB of disk are free again")
        return {"FINISHED"}


CLASSES = (WAFT_OT_check, WAFT_OT_fly, WAFT_OT_stop, WAFT_OT_dismiss, WAFT_OT_turn, WAFT_OT_select, WAFT_OT_role, WAFT_OT_add_mark,
           WAFT_OT_add_volume, WAFT_OT_spread, WAFT_OT_remove_take)
