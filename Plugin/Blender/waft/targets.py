# SPDX-License-Identifier: BSD-3-Clause
"""Targets: texts, curves, meshes and images that a group of flyers forms at a frame."""
import os

import bpy
import numpy as np

from .surfaces import edges_of, even_places, moved, polydata, triangles_of

_PICTURES = (".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp")
_FONTS = (".ttf", ".otf", ".ttc", ".pfb")
_LINE = 1.4  # of a text's size: the most that a line of letters is high, accents included, and the least of two lines
_DEEP = 0.25  # of its height: what is less deep is upright


def add_targets(stage, things, ids):
    """Adds a keyframe for each target, as it is at its frame. ids: {full name of a flyer: its ObjectId}."""
    for thing in things:
        settings = thing.waft
        group = list(ids.values())
        if settings.group is not None:
            group = [ids[member.name_full] for member in settings.group.all_objects if member.name_full in ids]
            if not group:
                stage.problems.error(f"has the group {settings.group.name}, in which there is no flyer", thing)
                continue
        count = settings.count or len(group)
        if count > len(group):
            stage.problems.error(f"has {count} places for {len(group)} flyers: expected no more places than flyers", thing)
            continue
        times = stage.times_of(thing, settings.frame)
        if times is None:
            continue
        stage.go_to(settings.frame)
        shape = _shape(stage, thing, count)
        if not shape:
            continue
        on, origin = stage.on_of(thing, settings.frame)
        field = "points" if "points" in shape else "origin"
        shape[field] = (np.array(shape[field]) - origin).tolist()
        entry = {"kind": "keyframe", **times, **on, "targets": shape, "radius": settings.radius * stage.unit, **stage.rest_of(thing),
                 **stage.facing_of(thing, stage.matrix(thing, settings.frame), settings.facing_tolerance)}
        if settings.group is not None:
            entry["objects"] = sorted(group)
        if "velocity" in entry and _is_upright(stage, thing):
            stage.problems.warn("stands upright and is a rest: its flyers lie down on what is below it, one behind the other; lay it "
                                "flat, or let them pass", thing)
        stage.add("constraints", thing, **entry)


def _shape(stage, thing, count):
    """The targets of an object; None, and a problem, where there are none."""
    if thing.type == "EMPTY":
        return _image(stage, thing, count)
    matrix = np.array(stage.matrix(thing, thing.waft.frame), float)
    points, triangles = triangles_of(thing, stage.depsgraph)
    if not len(triangles):
        points, edges = edges_of(thing, stage.depsgraph)
        if not len(edges):
            stage.problems.error(_lack(stage, thing), thing)
            return None
        return {"points": (even_places(moved(points, matrix), edges, count) * stage.unit).tolist()}
    if _is_plain_text(thing, points):
        return {"text": thing.data.body.strip(), "font": _font(stage, thing), "count": count, **_frame_of(stage, points, matrix)}
    placed = moved(points, matrix) * stage.unit
    middle = 0.5 * (placed.min(axis=0) + placed.max(axis=0))
    return {"mesh": stage.file("target.vtp", polydata(placed, triangles)), "origin": middle.tolist(), "count": count}


def _lack(stage, thing):
    """Why an object has nothing to form."""
    if thing.type == "FONT":
        return "shows nothing: it is empty, or its font has none of its letters (Object Data > Font)"
    if thing.name_full in stage.instancers:
        return "shows only instances, which have no mesh of their own: make them real (Object > Apply)"
    return "has neither faces nor edges to form"


def _frame_of(stage, points, matrix):
    """Where a flat figure is: its middle, the directions of its width and height, and its width."""
    low, high = points.min(axis=0), points.max(axis=0)
    sizes = np.linalg.norm(matrix[:3, :2], axis=0)
    return {"origin": (moved(0.5 * (low + high)[None], matrix)[0] * stage.unit).tolist(),
            "u": (matrix[:3, 0] / sizes[0]).tolist(), "v": (matrix[:3, 1] / sizes[1]).tolist(),
            "width": float((high - low)[0] * sizes[0] * stage.unit)}


def _is_plain_text(thing, points):
    """Whether Waft's own setting of text, which keeps few places legible, says the same: one line, in one face, spaced as the font is,
    not bent or turned to a mesh."""
    if thing.type != "FONT":
        return False
    data = thing.data
    return ("\n" not in data.body.strip() and _is_one_line(data, points) and data.follow_curve is None and not thing.modifiers
            and data.offset == data.shear == 0.0 and data.space_character == data.space_word == 1.0
            and not any(letter.use_bold or letter.use_italic or letter.use_small_caps for letter in data.body_format))


def _is_one_line(data, points):
    """Whether a text without line ends is drawn in one line: a text box may break it."""
    boxes = data.text_boxes
    if not any(box.width for box in boxes):
        return True
    return (len(boxes) == 1 and data.overflow == "NONE" and data.space_line >= 1.0
            and float(np.ptp(points[:, 1])) <= _LINE * data.size)


def _is_upright(stage, thing):
    """Whether a figure is higher than it is deep, seen from above: what rests on a surface would be a line."""
    if thing.type == "EMPTY":
        placed = np.array([(x, y, 0.0) for x in (0.0, 1.0) for y in (0.0, 1.0)])
    else:
        placed = edges_of(thing, stage.depsgraph)[0]
    placed = moved(placed, stage.matrix(thing, thing.waft.frame))
    flat = placed[:, :2] - placed[:, :2].mean(axis=0)
    depth = np.ptp(flat @ np.linalg.svd(flat, full_matrices=False)[2][-1])
    return bool(depth < _DEEP * np.ptp(placed[:, 2]))


def _font(stage, thing):
    """The text's font file, copied to the scene; Blender's own is no file, Waft's sans is its like."""
    font = thing.data.font
    if font is None or font.filepath in ("", "<builtin>"):
        return "sans"
    path = bpy.path.abspath(font.filepath, library=font.library)
    content = bytes(font.packed_file.data) if font.packed_file else _read(path)
    ending = os.path.splitext(path)[1].lower()
    if content is None or ending not in _FONTS:
        stage.problems.warn(f"has the font {path}, which cannot be read: sans is taken", thing)
        return "sans"
    return stage.file(f"font{ending}", content)


def _image(stage, thing, count):
    image = thing.data if thing.empty_display_type == "IMAGE" else None
    if image is None or not min(image.size):
        stage.problems.error("is an empty without an image to form: expected an empty of the display type Image", thing)
        return None
    if image.source == "SEQUENCE":
        stage.problems.error("shows an image sequence, which is another picture at each frame: choose one picture", thing)
        return None
    path = bpy.path.abspath(image.filepath, library=image.library)
    ending = os.path.splitext(path)[1].lower()
    content = bytes(image.packed_file.data) if image.packed_file else _read(path)
    if content is None or ending not in _PICTURES or image.is_dirty:
        stage.problems.error(f"has an image that is no file of the kinds {', '.join(_PICTURES)}: save the image", thing)
        return None
    matrix = np.array(stage.matrix(thing, thing.waft.frame), float)
    width, height = np.array(image.size, float) / max(image.size) * thing.empty_display_size
    low = np.array([thing.empty_image_offset[0] * width, thing.empty_image_offset[1] * height, 0.0])
    corners = np.array([low, low + (width, height, 0.0)])
    return {"image": stage.file(f"image{ending}", content), "count": count, **_frame_of(stage, corners, matrix)}


def _read(path):
    try:
        with open(path, "rb") as stream:
            return stream.read()
    except OSError:
        return None
