# SPDX-License-Identifier: BSD-3-Clause
"""Scenes that are made in Blender from nothing, in different units, at different frame rates, with all that can take part."""
import math

import bpy


def empty_scene(first=1, last=48, rate=24, rate_base=1.0, unit=1.0):
    """The only scene of a new file."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = first, last
    scene.render.fps, scene.render.fps_base = rate, rate_base
    scene.unit_settings.scale_length = unit
    scene.frame_set(first)
    return scene


def link(name, data, **values):
    """A new object in the scene."""
    thing = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(thing)
    for key, value in values.items():
        setattr(thing, key, value)
    return thing


def mesh(name, points, faces):
    made = bpy.data.meshes.new(name)
    made.from_pydata(points, [], faces)
    made.update()
    return made


def leaf_mesh(size=0.1):
    """A bent sheet that is neither centred nor along its own axes."""
    points = [(x * size + 0.3 * size, y * size * (1.0 - 0.5 * x * x) + 0.2 * x * size, 0.15 * size * (x * x + y * y) + 0.1 * y * size)
              for x in (-0.5, -0.25, 0.0, 0.25, 0.5) for y in (-0.3, 0.0, 0.3)]
    return mesh("Leaf", points, [(3 * i + j, 3 * i + j + 1, 3 * i + j + 4, 3 * i + j + 3) for i in range(4) for j in range(2)])


def box_mesh(name, half):
    corners = [(x, y, z) for x in (-half, half) for y in (-half, half) for z in (-half, half)]
    return mesh(name, corners, [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])


def sheet_mesh(name, half):
    return mesh(name, [(-half, -half, 0), (half, -half, 0), (half, half, 0), (-half, half, 0)], [(0, 1, 2, 3)])


def flyer(name, data, preset="LEAF", **values):
    thing = link(name, data, **values)
    thing.waft.role = "FLYER"
    thing.waft.preset = preset
    return thing


def mark(name, place, frame, flyer=None, radius=0.0, **settings):
    thing = link(name, None, location=place)
    thing.waft.role = "MARK"
    for key, value in {"frame": frame, "flyer": flyer, "radius": radius, **settings}.items():
        setattr(thing.waft, key, value)
    return thing


def volume(place, half):
    thing = link("Volume", None, location=place, scale=half, empty_display_type="CUBE", empty_display_size=1.0)
    thing.waft.role = "VOLUME"
    return thing


def obstacle(name, data, **values):
    thing = link(name, data, **values)
    thing.waft.role = "OBSTACLE"
    return thing


def target(name, data, frame, **values):
    thing = link(name, data, **values)
    thing.waft.role = "TARGET"
    thing.waft.frame = frame
    return thing


def field(name, kind, strength, **values):
    thing = link(name, None, **values)
    bpy.context.view_layer.objects.active = thing
    bpy.ops.object.forcefield_toggle()
    thing.field.type = kind
    thing.field.strength = strength
    return thing


def instances_on(thing, seed):
    """Has a mesh show instances of another object on its points, and nothing else."""
    group = bpy.data.node_groups.new("Instances", "GeometryNodeTree")
    if hasattr(group, "interface"):
        for way in ("INPUT", "OUTPUT"):
            group.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    else:
        group.inputs.new("NodeSocketGeometry", "Geometry")
        group.outputs.new("NodeSocketGeometry", "Geometry")
    nodes, links = group.nodes, group.links
    source, sink, on, info = (nodes.new(kind) for kind in ("NodeGroupInput", "NodeGroupOutput", "GeometryNodeInstanceOnPoints",
                                                           "GeometryNodeObjectInfo"))
    info.inputs["Object"].default_value = seed
    links.new(source.outputs[0], on.inputs["Points"])
    links.new(info.outputs["Geometry"], on.inputs["Instance"])
    links.new(on.outputs[0], sink.inputs[0])
    thing.modifiers.new("Instances", "NODES").node_group = group


def leaves_and_marks():
    """Two leaves and a scaled one; a mark, one that hangs on its flyer, one with keys; Euler angles and quaternions."""
    empty_scene(first=1, last=48, rate=24)
    one = flyer("One", leaf_mesh(), location=(-0.4, 0.1, 2.0), rotation_euler=(0.4, -0.3, 2.0))
    other = flyer("Other", one.data, location=(0.4, 0.0, 2.1), rotation_mode="QUATERNION", rotation_quaternion=(0.6, 0.0, 0.8, 0.0))
    flyer("Mirrored", one.data, "FEATHER", location=(0.0, 0.6, 2.0), scale=(-1.3, 0.8, 1.0), rotation_euler=(0.0, 0.0, 0.7))
    place = mark("Place", (-0.2, 0.2, 1.6), 30, one, radius=0.02, is_facing=True, facing_tolerance=0.2)
    place.rotation_euler, place.scale = (math.pi / 2.0, 0.0, 0.0), (2.0, 3.0, 0.5)  # its z axis points along -y
    hung = mark("Hung", (0.1, 0.0, -0.4), 40)
    hung.parent = other
    keyed = mark("Keyed", (0.0, 0.0, 0.0), 1, bpy.data.objects["Mirrored"])
    for frame, place, radius in ((22, (0.1, 0.7, 1.8), 0.1), (44, (0.2, 0.5, 1.5), 0.0)):
        keyed.location, keyed.waft.radius = place, radius
        keyed.keyframe_insert("location", frame=frame)
        keyed.keyframe_insert("waft.radius", frame=frame)
    volume((0.0, 0.0, 1.5), (2.0, 2.0, 1.5))


def petals_in_centimetres():
    """Petals spread on a sheet form a word and rest on a box, in centimetres, from frame 11 at 29.97 frames a second; a ball goes by."""
    empty_scene(first=11, last=70, rate=30, rate_base=1.001, unit=0.01)
    petal = flyer("Petal", sheet_mesh("Petal", 3.0), "PETAL", location=(0.0, 0.0, 180.0))
    emitter = link("Emitter", sheet_mesh("Emitter", 60.0), location=(0.0, 0.0, 200.0))
    for thing in (petal, emitter):
        thing.select_set(True)
    bpy.context.view_layer.objects.active = petal
    bpy.context.view_layer.update()
    assert bpy.ops.waft.spread(count=11, seed=3) == {"FINISHED"}
    word = bpy.data.curves.new("Word", "FONT")
    word.body = "I"
    word.align_x = "CENTER"
    target("Word", word, 62, location=(0.0, 0.0, 120.0), rotation_euler=(math.pi / 2.0, 0.0, 0.0), scale=(60.0, 60.0, 60.0))
    ball = obstacle("Block", box_mesh("Block", 10.0), location=(-90.0, 120.0, 100.0), rotation_euler=(0.0, 0.0, 0.5))
    for frame, x in ((20, -90.0), (50, 90.0)):
        ball.location.x = x
        ball.keyframe_insert("location", frame=frame)
    volume((0.0, 0.0, 130.0), (180.0, 180.0, 130.0))


def paper_in_wind():
    """Sheets of paper, stood on edge in their mesh, with a modifier, in a wind and a vortex; a curve, a mesh, a rest on a table."""
    empty_scene(first=0, last=47, rate=25)
    page = mesh("Page", [(-0.1, 0, -0.07), (0.1, 0, -0.07), (0.1, 0, 0.07), (-0.1, 0, 0.07)], [(0, 1, 2, 3)])
    sheets = [flyer(f"Page {i}", page, "PAPER", location=(0.5 * i - 0.75, 0.0, 1.9), rotation_euler=(1.4, 0.1 * i, 0.3 * i))
              for i in range(4)]
    sheets[0].modifiers.new("Finer", "SUBSURF").levels = 1
    group = bpy.data.collections.new("Pair")
    bpy.context.scene.collection.children.link(group)
    for sheet in sheets[:2]:
        group.objects.link(sheet)
    arc = bpy.data.curves.new("Arc", "CURVE")
    arc.dimensions = "3D"
    points = arc.splines.new("POLY").points
    points.add(3)
    for point, place in zip(points, ((-0.9, 0.2, 1.5), (-0.6, 0.3, 1.5), (-0.3, 0.3, 1.5), (0.0, 0.2, 1.5))):
        point.co = (*place, 1.0)
    target("Arc", arc, 40).waft.group = group
    obstacle("Table", box_mesh("Table", 0.5), location=(0.4, 0.0, 1.0), scale=(1.0, 1.0, 0.2))
    mark("Landing", (0.5, 0.1, 1.4), 40, sheets[3], kind="REST")
    mark("Anyone", (0.4, 0.5, 1.6), 30, radius=0.1)
    field("Gust", "WIND", 0.8, location=(-1.0, 0.0, 1.5), rotation_euler=(0.0, math.pi / 2.0, 0.0))
    whirl = field("Whirl", "VORTEX", 0.3, location=(0.5, 0.5, 1.5))
    for frame, strength in ((0, 0.0), (20, 0.3), (40, 0.0)):
        whirl.field.strength = strength
        whirl.keyframe_insert("field.strength", frame=frame)
    volume((0.0, 0.0, 1.5), (2.0, 2.0, 1.5))


def small_scene():
    """A leaf, a mark, a volume: what bad inputs are tried on."""
    empty_scene(last=36)
    leaf = flyer("Leaf", leaf_mesh(), location=(0.0, 0.0, 2.0))
    mark("Mark", (0.1, 0.1, 1.7), 30, leaf)
    volume((0.0, 0.0, 1.5), (1.5, 1.5, 1.5))
    return leaf
