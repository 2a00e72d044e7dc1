# SPDX-License-Identifier: BSD-3-Clause
"""Leaves that form a word upright in the air of a room, made in Blender from nothing and flown by the add-on.

blender -b --python Documentation/blender_word.py -- FILE.blend [PICTURE.png [FRAME]]

FILE.blend is written, and the folder FILE-waft beside it; what is there is never overwritten. The add-on is that of an installed Waft
(Documentation/Blender.md). In Blender's own window: blender FILE.blend.
"""
import math
import os
import sys

import addon_utils
import bpy

WORD, COUNT, SIZE = "AIR", 120, 0.15
KEY, LAST = 140, 200  # the frame of the word, and the last one
COLORS = ((0.62, 0.16, 0.04), (0.75, 0.36, 0.05), (0.42, 0.09, 0.03), (0.55, 0.42, 0.06))


def link(name, data, **values):
    thing = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(thing)
    for key, value in values.items():
        setattr(thing, key, value)
    return thing


def material(name, color, translucency=0.0, roughness=0.6):
    made = bpy.data.materials.new(name)
    made.diffuse_color = (*color, 1.0)
    made.use_nodes = True
    nodes, links = made.node_tree.nodes, made.node_tree.links
    shader = nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*color, 1.0)
    shader.inputs["Roughness"].default_value = roughness
    if translucency:
        through, mix = nodes.new("ShaderNodeBsdfTranslucent"), nodes.new("ShaderNodeMixShader")
        through.inputs["Color"].default_value = (*color, 1.0)
        mix.inputs["Fac"].default_value = translucency
        links.new(shader.outputs[0], mix.inputs[1])
        links.new(through.outputs[0], mix.inputs[2])
        links.new(mix.outputs[0], nodes["Material Output"].inputs["Surface"])
    return made


def leaf_mesh(name, skin):
    """A pointed sheet, its edges curled up, its ends raised."""
    rows, columns = 12, 6
    points, faces = [], []
    for i in range(rows + 1):
        s = i / rows
        half = 0.62 * s ** 0.55 * (1.0 - s) ** 0.85 + 0.008
        for j in range(columns + 1):
            t = 2.0 * j / columns - 1.0
            points.append((SIZE * (s - 0.5), SIZE * half * t, SIZE * (0.35 * half * t * t + 0.5 * (s - 0.5) ** 2)))
    for i in range(rows):
        for j in range(columns):
            corner = i * (columns + 1) + j
            faces.append((corner, corner + columns + 1, corner + columns + 2, corner + 1))
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, [], faces)
    mesh.polygons.foreach_set("use_smooth", [True] * len(faces))
    mesh.materials.append(skin)
    return mesh


def sheet_mesh(name, half):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([(-half, -half, 0), (half, -half, 0), (half, half, 0), (-half, half, 0)], [], [(0, 1, 2, 3)])
    return mesh


def make_flyers(scene):
    """Leaves of four colours, spread in two layers over the room."""
    for number, color in enumerate(COLORS):
        leaf = link(f"Leaf {number}", leaf_mesh(f"Leaf {number}", material(f"Leaf {number}", color, 0.35)),
                    location=(-1.2 + 0.8 * number, 0.0, 3.3))
        leaf.waft.role = "FLYER"
        leaf.waft.preset = "LEAF"
        emitter = link("Emitter", sheet_mesh("Emitter", 1.5), location=(0.0, 0.0, 2.75 + 0.2 * number))
        for thing in scene.objects:
            thing.select_set(thing in (leaf, emitter))
        bpy.context.view_layer.objects.active = leaf
        bpy.context.view_layer.update()
        bpy.ops.waft.spread(count=COUNT // len(COLORS), seed=number + 1)
        bpy.data.objects.remove(emitter)


def make_marks():
    word = bpy.data.curves.new("Word", "FONT")
    word.body, word.align_x, word.align_y = WORD, "CENTER", "CENTER"
    text = link("Word", word, location=(0.0, 0.0, 1.5), rotation_euler=(math.pi / 2.0, 0.0, 0.0), scale=(1.65, 1.65, 1.65))
    text.hide_render = True
    text.waft.role = "TARGET"
    text.waft.frame = KEY
    text.waft.radius = 0.02
    text.waft.is_facing = True
    volume = link("Volume", None, location=(0.0, 0.0, 2.0), scale=(2.0, 2.0, 2.0), empty_display_type="CUBE")
    volume.waft.role = "VOLUME"


def make_room(scene):
    """A floor, a wall behind, a warm lamp in front and a cool one from behind, a camera that is low and near."""
    link("Floor", sheet_mesh("Floor", 12.0)).data.materials.append(material("Floor", (0.030, 0.026, 0.024), roughness=0.3))
    wall = link("Wall", sheet_mesh("Wall", 12.0), location=(0.0, 4.5, 0.0), rotation_euler=(math.pi / 2.0, 0.0, 0.0))
    wall.data.materials.append(material("Wall", (0.035, 0.065, 0.075), roughness=0.9))
    scene.world = bpy.data.worlds.new("Dusk")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.01, 0.013, 0.018, 1.0)
    lamps = (("Key", (-2.6, -3.0, 3.4), (0.0, 0.0, 1.5), 420.0, 1.2, (1.0, 0.86, 0.68)),
             ("Behind", (2.2, 2.6, 3.4), (0.0, 0.0, 1.4), 420.0, 1.0, (0.75, 0.88, 1.0)),
             ("Wall", (0.0, 1.2, 0.2), (0.0, 4.5, 1.2), 170.0, 1.0, (1.0, 0.8, 0.6)))
    for name, place, aim, energy, size, color in lamps:
        lamp = bpy.data.lights.new(name, "AREA")
        lamp.energy, lamp.size, lamp.color = energy, size, color
        lit = link(f"{name} Lamp", lamp, location=place)
        lit.rotation_euler = (lit.location - type(lit.location)(aim)).to_track_quat("Z", "Y").to_euler()
    camera = link("Camera", bpy.data.cameras.new("Camera"), location=(-0.75, -3.9, 1.0))
    camera.rotation_euler = (type(camera.location)((0.0, 0.0, 1.38)) - camera.location).to_track_quat("-Z", "Y").to_euler()
    camera.data.lens = 38.0
    camera.data.dof.use_dof = True
    camera.data.dof.focus_distance, camera.data.dof.aperture_fstop = 3.95, 1.4
    scene.camera = camera


def render(scene, picture, frame):
    scene.frame_set(frame)
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = 64
    scene.cycles.use_denoising = False
    scene.render.use_motion_blur = True
    scene.render.resolution_x, scene.render.resolution_y = 960, 540
    scene.render.filepath = os.path.abspath(picture)
    bpy.ops.render.render(write_still=True)


def main(file, picture=None, frame=KEY):
    if os.path.lexists(file):
        raise SystemExit(f"{file}: it is there, and stays as it is")
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    addon_utils.enable("waft_addon", default_set=True)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end, scene.render.fps = 0, LAST, 30
    make_flyers(scene)
    make_marks()
    make_room(scene)
    scene.waft.quality = "air"
    bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(file))
    if bpy.ops.waft.fly() != {"FINISHED"}:
        raise SystemExit("it did not fly")
    bpy.ops.wm.save_mainfile()
    if picture:
        render(scene, picture, int(frame))


main(*sys.argv[sys.argv.index("--") + 1:])
