# SPDX-License-Identifier: BSD-3-Clause
"""Waft in Blender: leaves, feathers, petals, paper and bubbles that fly to marks. Documentation/Blender.md says how."""
import bpy

from . import flying, operators, panel, properties

bl_info = {
    "name": "Waft",
    "author": "The authors of Waft",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > Waft",
    "description": "Light things in air that fly to your marks",
    "category": "Animation",
}


@bpy.app.handlers.persistent
def _leave_file(*_):
    flying.drop()
    flying.found.clear()


def register():
    properties.register()
    for one in (*operators.CLASSES, *panel.CLASSES):
        bpy.utils.register_class(one)
    bpy.app.handlers.load_pre.append(_leave_file)


def unregister():
    bpy.app.handlers.load_pre.remove(_leave_file)
    flying.drop()
    for one in reversed((*operators.CLASSES, *panel.CLASSES)):
        bpy.utils.unregister_class(one)
    properties.unregister()
