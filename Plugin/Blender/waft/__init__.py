# SPDX-License-Identifier: BSD-3-Clause
"""Waft in Blender: leaves, feathers, petals, paper and bubbles that fly to marks. Documentation/Blender.md says how."""
import os

import bpy

from . import flying, operators, panel, preferences, properties, takes

bl_info = {
    "name": "Waft",
    "author": "The authors of Waft",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > Waft",
    "description": "Light things in air that fly to your marks",
    "category": "Animation",
}
_CLASSES = (*preferences.CLASSES, *operators.CLASSES, *panel.CLASSES)


@bpy.app.handlers.persistent
def _leave_file(*_):
    flying.drop()
    flying.found.put("")


@bpy.app.handlers.persistent
def _look_over_takes(*_):
    if not all(os.path.exists(bpy.path.abspath(library.filepath, library=library.parent)) for library in bpy.data.libraries):
        return  # what is missing may come again, with its takes
    for scene in bpy.data.scenes:
        if scene.library is None:
            takes.forget_lost(scene)


def register():
    properties.register()
    for one in _CLASSES:
        bpy.utils.register_class(one)
    bpy.app.handlers.load_pre.append(_leave_file)
    bpy.app.handlers.load_post.append(_look_over_takes)


def unregister():
    bpy.app.handlers.load_post.remove(_look_over_takes)
    bpy.app.handlers.load_pre.remove(_leave_file)
    flying.drop()
    for one in reversed(_CLASSES):
        bpy.utils.unregister_class(one)
    properties.unregister()
