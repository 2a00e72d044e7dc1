# SPDX-License-Identifier: BSD-3-Clause
"""Run by Blender: an animation as .abc or .usd, read back and compared.

blender -b --python _inblender.py -- SCENE.glb FILE.abc|FILE.usd FRAMES_A_SECOND FRAMES
"""
import re
import sys

import bpy
import numpy

LACKING = 4  # Blender was built without the format
NEAR = 1e-4  # m, and share of a turn, that what is read back agrees to
WRITE = {"abc": lambda path, last: bpy.ops.wm.alembic_export(filepath=path, start=0, end=last, as_background_job=False),
         "usd": lambda path, last: bpy.ops.wm.usd_export(filepath=path, export_animation=True)}
READ = {"abc": lambda path: bpy.ops.wm.alembic_import(filepath=path, as_background_job=False),
        "usd": lambda path: bpy.ops.wm.usd_import(filepath=path)}
BUILT = {"abc": "alembic", "usd": "usd"}


def places(last):
    """{name, as these formats write it: matrices at the first, the middle and the last frame} of what has a mesh."""
    found = {}
    for frame in (0, last // 2, last):
        bpy.context.scene.frame_set(frame)
        for thing in bpy.context.scene.objects:
            if thing.type == "MESH":
                found.setdefault(re.sub(r"\W", "_", thing.name), []).append(numpy.array(thing.matrix_world))
    return found


def empty_scene(rate, last):
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    scene = bpy.context.scene
    scene.render.fps = max(1, round(rate))
    scene.render.fps_base = scene.render.fps / rate
    scene.frame_start, scene.frame_end = 0, last


def import_animation(source, rate):
    """Imports a .glb so that its keys are on whole frames. What the importer makes of the base of a rate depends on Blender."""
    render = bpy.context.scene.render
    base, render.fps_base = render.fps_base, 1.0
    bpy.ops.import_scene.gltf(filepath=source)
    render.fps_base = base
    factor = rate / render.fps
    for curve in [curve for action in bpy.data.actions for curve in curves_of(action)] if factor != 1.0 else ():
        for key in curve.keyframe_points:
            key.co.x = round(key.co.x * factor)
        curve.update()


def curves_of(action):
    """All curves of an action, which are in bags from Blender 4.4 on."""
    if bpy.app.version < (4, 4, 0):
        return list(action.fcurves)
    return [curve for layer in action.layers for strip in layer.strips for bag in strip.channelbags for curve in bag.fcurves]


def main(source, target, rate, frames):
    kind, last = target.rsplit(".", 1)[1], int(frames) - 1
    if not getattr(bpy.app.build_options, BUILT[kind]):
        sys.exit(LACKING)
    if "bool" not in vars(numpy):
        numpy.bool = bool  # the importer of Blender 3.4 asks for this name, which NumPy 1.24 has dropped
    empty_scene(float(rate), last)
    import_animation(source, float(rate))
    before = places(last)
    WRITE[kind](target, last)
    empty_scene(float(rate), last)
    READ[kind](target)
    after = places(last)
    for name, matrices in before.items():
        if name not in after or numpy.abs(numpy.array(after[name]) - matrices).max() > NEAR:
            raise SystemExit(f"{name}: it is not read back as it was written")


main(*sys.argv[sys.argv.index("--") + 1:])
