# SPDX-License-Identifier: BSD-3-Clause
"""How well bodies that lie at rest cover the picture that a scene gives them as their targets, from poses, meshes
and the picture's file."""
import json
import math
import pathlib
import struct
import zlib

import result_files


def overlap(folder, scene_file, tracks):
    """Intersection over union of two rasters at the last frame, seen against the picture: its own opaque pixels, and
    the pixels whose centre lies under a triangle of a body. Of the last keyframe that rests until the end on a
    picture with transparency and without classes; None when there is none, or when all bodies side by side are
    smaller than the picture, so that they cannot cover it."""
    scene_file = pathlib.Path(scene_file)
    scene = json.loads(scene_file.read_text(encoding="utf-8"))
    last = scene.get("time", {}).get("frames", 300) - 1
    sought = [entry["targets"] for entry in scene.get("constraints", [])
              if entry["kind"] == "keyframe" and entry.get("velocity") == "rest" and entry.get("until", last) == last]
    if not sought or "image" not in sought[-1] or "classes" in sought[-1]:
        return None
    wanted = read_opaque(scene_file.parent / sought[-1]["image"])
    if wanted is None:
        return None
    bodies = result_files.read_shape_meshes(folder)
    pixel = sought[-1]["width"] / len(wanted[0])
    total = sum(map(sum, wanted))
    if sum(plan_area(*bodies[number]) for number in tracks) < total * pixel * pixel:
        return None
    seen = [bytearray(len(wanted[0])) for _ in wanted]
    for number, track in tracks.items():
        points, polys = bodies[number]
        pose = track[-1]
        places = [_on_picture([a + b for a, b in zip(pose.x, result_files.rotated(pose.q, p))], sought[-1], wanted)
                  for p in points]
        for corners in polys:
            fill(seen, [places[i] for i in corners])
    both = sum(a and b for rows in zip(wanted, seen) for a, b in zip(*rows))
    return both / (total + sum(map(sum, seen)) - both)


def _on_picture(point, targets, wanted):
    """Column and row, in pixels, from the upper left corner."""
    scale = len(wanted[0]) / targets["width"]
    d = [a - b for a, b in zip(point, targets["origin"])]
    along, up = (sum(a * b for a, b in zip(d, targets.get(name, axis))) * scale
                 for name, axis in (("u", (1, 0, 0)), ("v", (0, 1, 0))))
    return 0.5 * len(wanted[0]) + along, 0.5 * len(wanted) - up


def plan_area(points, polys):
    """Of a sheet, seen along its z axis [m^2]."""
    area = 0.0
    for corners in polys:
        ring = [points[i] for i in corners]
        area += 0.5 * abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:] + ring[:1])))
    return area


def fill(raster, triangle):
    """Sets the pixels whose centre lies in a triangle (column, row), its edges included."""
    (ax, ay), (bx, by), (cx, cy) = triangle
    for row in range(max(0, math.ceil(min(ay, by, cy) - 0.5)), min(len(raster) - 1, int(max(ay, by, cy) - 0.5)) + 1):
        y = row + 0.5
        left, right = math.inf, -math.inf
        for px, py, qx, qy in ((ax, ay, bx, by), (bx, by, cx, cy), (cx, cy, ax, ay)):
            if min(py, qy) <= y <= max(py, qy):
                ends = (px, qx) if py == qy else (px + (y - py) / (qy - py) * (qx - px),) * 2
                left, right = min(left, *ends), max(right, *ends)
        if left > right:
            continue
        for column in range(max(0, math.ceil(left - 0.5)), min(len(raster[row]) - 1, math.floor(right - 0.5)) + 1):
            raster[row][column] = 1


def read_opaque(path):
    """Rows from the top of 1 where a PNG file of 8 bits with alpha is more than half opaque, else 0; None for other
    pictures."""
    data = pathlib.Path(path).read_bytes()
    place, packed, width, height = 8, b"", 0, 0
    while place < len(data):
        length, tag = struct.unpack(">I4s", data[place:place + 8])
        body = data[place + 8:place + 8 + length]
        if tag == b"IHDR":
            width, height, depth, kind, _, _, interlace = struct.unpack(">IIBBBBB", body)
            if (depth, kind, interlace) != (8, 6, 0):
                return None
        elif tag == b"IDAT":
            packed += body
        place += 12 + length
    raw = zlib.decompress(packed)
    rows, above = [], bytearray(4 * width)
    for number in range(height):
        start = number * (4 * width + 1)
        above = _unfiltered(raw[start], bytearray(raw[start + 1:start + 4 * width + 1]), above)
        rows.append(bytearray(alpha > 127 for alpha in above[3::4]))
    return rows


def _unfiltered(kind, line, above):
    """A line of a PNG picture of 4 bytes a pixel, from its filter (PNG specification, 9.2)."""
    for i, value in enumerate(line):
        a = line[i - 4] if i >= 4 else 0
        b, c = above[i], above[i - 4] if i >= 4 else 0
        if kind == 4:
            to = a + b - c
            guess = min((abs(to - a), 0, a), (abs(to - b), 1, b), (abs(to - c), 2, c))[2]
        else:
            guess = (0, a, b, (a + b) // 2)[kind]
        line[i] = (value + guess) & 255
    return line
