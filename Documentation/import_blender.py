# SPDX-License-Identifier: BSD-3-Clause
"""Brings an animation of Waft into Blender (3.4 or later), lights it, and renders one frame of it.

blender --background --python Documentation/import_blender.py -- DIR/animation.glb PICTURE.png [FRAME] [WIDTHxHEIGHT]

In Blender's own window the same is File > Import > glTF 2.0, and 30 as the scene's frame rate: nodes are named
SHAPE-OBJECT, a mesh is shared by all objects of its shape, and animation frame k is Blender's frame k.
"""

import sys

import bpy
import numpy
from mathutils import Vector

if "bool" not in vars(numpy):
    numpy.bool = bool  # the importer of Blender 3.4 asks for this name, which NumPy 1.24 of Debian 12 has dropped

RATE = 30  # frames a second; must be set before the import, which turns seconds into frames


def scene_of(path):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.fps = RATE
    bpy.ops.import_scene.gltf(filepath=path)
    if "volume" in scene.objects:  # above all that is far from the origin: Blender's numbers, too, have 32 bits
        scene.objects["volume"].location = (0.0, 0.0, 0.0)
    flyers = [thing for thing in scene.objects if thing.animation_data]
    if not flyers:
        raise SystemExit(f"{path}: no animated object")
    scene.frame_start = 0
    scene.frame_end = int(round(max(thing.animation_data.action.frame_range[1] for thing in flyers)))
    return scene, flyers


def add_light_and_ground(scene):
    world = bpy.data.worlds.new("Sky")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.75, 0.85, 1.0, 1.0)
    world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.45
    scene.world = world
    sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
    sun.data.energy = 2.2
    sun.rotation_euler = (0.6, 0.2, 0.4)
    scene.collection.objects.link(sun)
    bpy.ops.mesh.primitive_plane_add(size=40.0, location=(0.0, 0.0, -0.001))
    ground = bpy.context.object
    ground.name = "Ground"
    clay = bpy.data.materials.new("Clay")
    clay.use_nodes = True
    clay.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0.42, 0.38, 0.32, 1.0)
    ground.data.materials.append(clay)


def look_at(scene, flyers):
    """A camera in front and above, far enough to see all of them."""
    places = [thing.matrix_world.translation for thing in flyers]
    middle = sum(places, Vector()) / len(places)
    reach = max(1.0, max((place - middle).length for place in places))
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.location = middle + Vector((-0.7, -2.1, 1.1)) * reach
    camera.rotation_euler = (middle - camera.location).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(camera)
    scene.camera = camera


def main(path, picture, frame=None, size="960x540"):
    scene, flyers = scene_of(path)
    add_light_and_ground(scene)
    scene.frame_set(scene.frame_end // 2 if frame is None else int(frame))
    look_at(scene, flyers)
    scene.render.resolution_x, scene.render.resolution_y = (int(part) for part in size.split("x"))
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = 24
    scene.cycles.use_denoising = False
    scene.render.filepath = picture
    bpy.ops.render.render(write_still=True)
    print(f"{len(flyers)} animated objects, frames {scene.frame_start} to {scene.frame_end}, "
          f"frame {scene.frame_current} in {picture}")


main(*sys.argv[sys.argv.index("--") + 1:])
