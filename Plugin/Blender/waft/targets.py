# SPDX-License-Identifier: BSD-3-Clause
"""Targets: texts, curves, meshes and images that a group of flyers forms at a frame."""
import os

import bpy
import numpy as np

from .surfaces import edges_of, even_places, moved, polydata, triangles_of

_PICTURES = (".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp")
_FONTS = (".ttf", ".otf", ".ttc", ".pfb")


def add_targets(stage, things, ids):
    """Adds a keyframe for each target. ids: {name of a flyer: its ObjectId}."""
    for thing in things:
        settings = thing.waft
        group = list(ids.values())
        if settings.group is not None:
            group = [ids[member.name] for member in settings.group.all_objects if member.name in ids]
            if not group:
                stage.problems.error(f"has the group {settings.group.name}, in which there is no flyer", thing)
                continue
        count = settings.count or len(group)
        if count > len(group):
            stage.problems.error(f"has {count} places for {len(group)} flyers: expected no more places than flyers", thing)
            continue
        frame = stage.own_frame(thing, settings.frame)
        shape = frame is not None and _shape(stage, thing, count)
        if not shape:
            continue
        entry = {"kind": "keyframe", "frame": frame, "targets": shape, "radius": settings.radius * stage.unit, **stage.rest_of(thing)}
        if settings.group is not None:
            entry["objects"] = sorted(group)
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
            stage.problems.error("has neither faces nor edges to form", thing)
            return None
        return {"points": (even_places(moved(points, matrix), edges, count) * stage.unit).tolist()}
    if _is_plain_text(thing):
        return {"text": thing.data.body.strip(), "font": _font(stage, thing), "count": count, **_frame_of(stage, points, matrix)}
    placed = moved(points, matrix) * stage.unit
    middle = 0.5 * (placed.min(axis=0) + placed.max(axis=0))
    return {"mesh": stage.file("target.vtp", polydata(placed, triangles)), "origin": middle.tolist(), "count": count}


def _frame_of(stage, points, matrix):
    """Where a flat figure is: its middle, the directions of its width and height, and its width."""
    low, high = points.min(axis=0), points.max(axis=0)
    sizes = np.linalg.norm(matrix[:3, :2], axis=0)
    return {"origin": (moved(0.5 * (low + high)[None], matrix)[0] * stage.unit).tolist(),
            "u": (matrix[:3, 0] / sizes[0]).tolist(), "v": (matrix[:3, 1] / sizes[1]).tolist(),
            "width": float((high - low)[0] * sizes[0] * stage.unit)}


def _is_plain_text(thing):
    """Whether Waft's own setting of text, which keeps few places legible, says the same: one line, not bent or turned to a mesh."""
    return (thing.type == "FONT" and "\n" not in thing.data.body.strip() and thing.data.follow_curve is None
            and not thing.modifiers and thing.data.offset == 0.0)


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
