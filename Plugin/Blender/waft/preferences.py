# SPDX-License-Identifier: BSD-3-Clause
"""The add-on's page in Blender's preferences: which program waft it takes, and whether that is one."""
import os
import pathlib

import bpy
from bpy.props import StringProperty

from . import flying
from .command import Version, find_command

_asked = None  # the Version of the program that was asked last


def _redraw():
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "PREFERENCES":
                area.tag_redraw()


def version_of(command):
    """What a program tells of its version; "" until it has: it is asked beside Blender, once."""
    global _asked
    if _asked is None or _asked.command != command:
        _asked = Version(command, lambda: bpy.app.timers.register(_redraw))
    return _asked.text


def manual_of(program):
    """The page about the add-on that came with a program waft: installed, in a clone or in its build; None where there is none."""
    beside = pathlib.Path(program).resolve().parent
    for folder in (beside.parent / "share/doc/waft", beside, beside.parent.parent):
        page = folder / "Documentation" / "Blender.md"
        if page.is_file():
            return page
    return None


class Preferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    command: StringProperty(name="Waft", subtype="FILE_PATH", description="The program waft; empty: the one that the add-on was "
                                                                          "installed with, else that on the PATH")

    def draw(self, context):
        self.layout.prop(self, "command")
        found, lack = find_command(flying.chosen(context), os.path.dirname(os.path.abspath(__file__)))
        column = self.layout.column(align=True)
        if found is None:
            column.label(text=lack, icon="ERROR")
            return
        column.label(text=f"Found: {found}", icon="CHECKMARK")
        column.label(text=version_of(found) or "asking for its version", icon="BLANK1")
        page = manual_of(found)
        if page is not None:
            column.operator("wm.url_open", text="Manual", icon="HELP").url = page.as_uri()


CLASSES = (Preferences,)
