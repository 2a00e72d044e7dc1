# SPDX-License-Identifier: BSD-3-Clause
"""The panel Waft in the sidebar of the 3D view."""
import textwrap

import bpy

from . import flying
from .properties import quality_of
from .winds import VORTEX_FACTOR, field_of

_LETTER = 7.0  # pixels, at least, of a letter of a message
_BUTTONS = 8  # letters that two buttons and an icon take of a line
_AT_ONCE = 3  # messages, so that what is below stays in sight


class _Panel:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Waft"


class WAFT_PT_fly(_Panel, bpy.types.Panel):
    bl_label = "Waft"

    def draw(self, context):
        layout = self.layout
        settings = context.scene.waft
        column = layout.column(align=True)
        column.prop(settings, "quality")
        column.prop(settings, "seed")
        row = layout.row(align=True)
        row.prop(settings, "has_ground")
        row.prop(settings, "loops")
        if flying.running is None:
            row = layout.row(align=True)
            row.operator("waft.check", icon="CHECKMARK")
            row.operator("waft.fly", icon="PLAY")
        else:
            flight = flying.running.flight
            box = layout.box()
            box.label(text=f"{flying.running.name}: {100.0 * flight.fraction:.0f} %", icon="TIME")
            _write(box, context, flight.text)
            box.operator("waft.stop", icon="CANCEL")
        if flying.looking is not None:
            layout.box().label(text="Checking", icon="TIME")
        elif flying.found.title:
            _report(layout.box(), context, flying.found)


def _report(box, context, found):
    """One line of what was found, which unfolds to some of it at a time."""
    shown = context.window_manager.waft
    row = box.row(align=True)
    if found:
        row.prop(shown, "is_open", text="", icon="TRIA_DOWN" if shown.is_open else "TRIA_RIGHT", emboss=False)
    row.label(text="", icon="ERROR" if found.is_fatal else "INFO" if found else "CHECKMARK")
    _write(row, context, found.title, beside=_BUTTONS)
    row.operator("waft.dismiss", text="", icon="X", emboss=False)
    if not shown.is_open:
        return
    for problem in found[shown.page * _AT_ONCE:][:_AT_ONCE]:
        _show(box, context, problem)
    pages = -(-len(found) // _AT_ONCE)
    if pages > 1:
        row = box.row(align=True)
        for step, icon in ((-1, "TRIA_LEFT"), (1, "TRIA_RIGHT")):
            turn = row.row()
            turn.enabled = 0 <= shown.page + step < pages
            turn.operator("waft.turn", text="", icon=icon).page = shown.page + step
            if step < 0:
                row.label(text=f"{shown.page + 1} of {pages}")


def _show(layout, context, problem):
    icon = "ERROR" if problem.is_error else "INFO"
    column = layout.column(align=True)
    if problem.object:
        more = f" and {len(problem.others)} others" if problem.others else ""
        select = column.operator("waft.select", text=problem.object + more, icon=icon)
        select.name, select.others = problem.object, "\n".join(problem.others)
    _write(column, context, problem.text, "NONE" if problem.object else icon)


def _write(layout, context, text, icon="NONE", beside=0):
    """A text over as many lines as the sidebar's width asks for. beside: letters that others take of it."""
    width = max(14, int(context.region.width / (_LETTER * context.preferences.system.ui_scale)) - 6 - beside)
    column = layout.column(align=True)
    column.scale_y = 0.8
    for number, line in enumerate(textwrap.wrap(text, width)):
        column.label(text=line, icon=icon if number == 0 else "NONE")


class WAFT_PT_object(_Panel, bpy.types.Panel):
    bl_label = "Scene"

    def draw(self, context):
        layout = self.layout
        grid = layout.grid_flow(row_major=True, columns=2, align=True)
        for role, icon in (("FLYER", "OUTLINER_OB_FORCE_FIELD"), ("MARK", "EMPTY_AXIS"), ("TARGET", "FONT_DATA"),
                           ("OBSTACLE", "MESH_CUBE"), ("VOLUME", "CUBE"), ("NONE", "X")):
            grid.operator("waft.role", text=role.capitalize(), icon=icon).role = role
        row = layout.row(align=True)
        row.operator("waft.add_mark", icon="ADD")
        row.operator("waft.add_volume", icon="ADD")
        layout.operator("waft.spread", icon="STICKY_UVS_DISABLE")
        thing = context.active_object
        if thing is None:
            return
        box = layout.box()
        box.label(text=thing.name, icon="OBJECT_DATA")
        field = field_of(thing)
        if thing.waft.role == "NONE" and field is not None:
            _draw_field(box, field, thing.waft)
            return
        box.prop(thing.waft, "role")
        draw = {"FLYER": _draw_flyer, "MARK": _draw_mark, "TARGET": _draw_target, "VOLUME": _draw_volume}.get(thing.waft.role)
        if draw:
            draw(box.column(align=True), thing.waft)


def _draw_flyer(layout, settings):
    for name in ("preset", "settling_speed", "area_density", "thickness", "drag_coefficient", "release",
                 *(("last_release", "appears", "on") if settings.release else ())):
        layout.prop(settings, name)


def _draw_mark(layout, settings):
    for name in ("flyer", "frame", "on", "radius", "kind", *_of_kind(settings, settings.is_turned), "is_turned"):
        layout.prop(settings, name)


def _draw_target(layout, settings):
    for name in ("group", "frame", "first_frame", *(("order",) if settings.first_frame else ()), "on", "radius", "kind", *_of_kind(settings),
                 *(("hold", *(("drift",) if settings.hold else ())) if settings.kind != "REST" else ()), "leave",
                 *(("leave_frame", "last_leave") if settings.leave != "STAY" else ()), "count"):
        layout.prop(settings, name)


def _draw_volume(layout, settings):
    row = layout.row(align=True)
    row.label(text="Open")
    for index, name in enumerate(("x", "y", "top")):
        row.prop(settings, "is_open", index=index, text=name, toggle=True)
    if any(settings.is_open[:2]):
        layout.prop(settings, "breeze")


def _of_kind(settings, is_turned=False):
    """What a mark or target has beside others by its kind. is_turned: a rotation is asked for, which says all."""
    if settings.kind == "REST":
        return ("until",)
    return () if is_turned else ("is_facing", *(("facing_tolerance",) if settings.is_facing else ()))


def _draw_field(layout, field, settings):
    layout.prop(field, "strength")
    if field.type == "WIND":
        layout.label(text=f"{field.strength:.3g} m/s² along its z axis")
        for name in ("is_front", *(("frame", "front_speed", "front_width") if settings.is_front else ())):
            layout.prop(settings, name)
    else:
        layout.label(text=f"{VORTEX_FACTOR * field.strength:.3g} m²/s² about its z axis")


class WAFT_UL_takes(bpy.types.UIList):
    def draw_item(self, _context, layout, _data, item, _icon, _active, _property):
        parts = [item.name, quality_of(item.quality), item.edited and f"edit of {item.edited}", item.is_stopped and "stopped early"]
        layout.label(text=", ".join(part for part in parts if part), icon="ACTION")


class WAFT_PT_takes(_Panel, bpy.types.Panel):
    bl_label = "Takes"

    @classmethod
    def poll(cls, context):
        return len(context.scene.waft.takes) > 0

    def draw(self, context):
        row = self.layout.row()
        row.template_list("WAFT_UL_takes", "", context.scene.waft, "takes", context.scene.waft, "shown", rows=3)
        row.operator("waft.remove_take", text="", icon="REMOVE")


CLASSES = (WAFT_UL_takes, WAFT_PT_fly, WAFT_PT_takes, WAFT_PT_object)
