#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the scenes that are too long to write by hand, with their pictures and winds, beside itself.

python3 Data/Scenes/make_scenes.py

The same files come out each time, to the byte.
"""
import json
import math
import pathlib
import struct
import zlib

HERE = pathlib.Path(__file__).resolve().parent
SKY, PETAL, HEART, STEM = (250, 250, 248), (244, 205, 70), (120, 70, 40), (70, 130, 70)


# Files


def write_scene(name, scene):
    """As JSON, a line for each field of the outermost level and each member of its lists."""
    lines = []
    for key, value in scene.items():
        if isinstance(value, list) and value:
            members = ",\n    ".join(json.dumps(member) for member in value)
            lines.append(f"  {json.dumps(key)}: [\n    {members}\n  ]")
        else:
            lines.append(f"  {json.dumps(key)}: {json.dumps(value)}")
    text = '{\n  "waft": 1,\n' + ",\n".join(lines) + "\n}\n"
    (HERE / f"{name}.waft.json").write_text(text, encoding="utf-8")


def write_png(name, size, color_at, height=None):
    """A picture of size by height pixels (square without a height); color_at(x, y) of places with x from -1 to 1 and
    y, upwards, in the same unit: (r, g, b) or (r, g, b, a)."""
    rows = []
    height = height or size
    for row in range(height):
        y = (height - 2.0 * row - 1.0) / size
        pixels = [color_at((2.0 * column + 1.0) / size - 1.0, y) for column in range(size)]
        rows.append(b"\0" + bytes(value for pixel in pixels for value in pixel))
    kind = 6 if len(pixels[0]) == 4 else 2

    def chunk(tag, data):
        return struct.pack(">I", len(data)) + tag + data + struct.pack(">I", zlib.crc32(tag + data))

    (HERE / name).write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", size, height, 8, kind, 0, 0, 0)) +
        chunk(b"IDAT", zlib.compress(b"".join(rows), 9)) + chunk(b"IEND", b""))


def write_wind(name, low, high, cells, times, velocity_at):
    """A time series of velocities [m/s] on a lattice, as VTK image files and their .pvd."""
    folder = HERE / name
    folder.mkdir(exist_ok=True)
    spacing = [(b - a) / n for a, b, n in zip(low, high, cells)]
    extent = f"0 {cells[0]} 0 {cells[1]} 0 {cells[2]}"
    sets = []
    for number, time in enumerate(times):
        values = []
        for k in range(cells[2] + 1):
            for j in range(cells[1] + 1):
                for i in range(cells[0] + 1):
                    place = (low[0] + i * spacing[0], low[1] + j * spacing[1], low[2] + k * spacing[2])
                    values.extend(f"{value:.3f}" for value in velocity_at(place, time))
        text = (
            '<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian">\n'
            f'<ImageData WholeExtent="{extent}" Origin="{low[0]} {low[1]} {low[2]}"'
            f' Spacing="{spacing[0]} {spacing[1]} {spacing[2]}">\n<Piece Extent="{extent}">\n'
            '<PointData Vectors="Velocity">\n'
            '<DataArray type="Float32" Name="Velocity" NumberOfComponents="3" format="ascii">\n'
            + " ".join(values) +
            "\n</DataArray>\n</PointData>\n</Piece>\n</ImageData>\n</VTKFile>\n")
        (folder / f"{number:02d}.vti").write_text(text, encoding="utf-8")
        sets.append(f'<DataSet timestep="{time:g}" file="{name}/{number:02d}.vti"/>')
    (HERE / f"{name}.pvd").write_text(
        '<VTKFile type="Collection" version="1.0">\n<Collection>\n' + "\n".join(sets) +
        "\n</Collection>\n</VTKFile>\n", encoding="utf-8")


def rounded(point):
    return [round(value, 4) for value in point]


# One feather: two marks, or a stretch of its way given; then a dart board (Fig. 4)


def feather(texture, size=0.25):
    return {"feather": {"builtin": "feather", "size": size, "settlingSpeed": 0.4, "texture": f"../Shapes/{texture}.png"}}


def board(center, side):
    """A round board, its face to the middle of the room; side: -1 left, 1 right."""
    x, y, z = center
    return {"kind": "cylinder", "base": [x + 0.02 * side, y, z], "top": [x + 0.06 * side, y, z], "radius": 0.3}


def feather_scenes():
    ways = {
        "a": ("feather-barred", [-1.5, 0.9, 3.2], [(100, [-0.5, -0.7, 2.6]), (200, [0.7, 0.6, 1.9])], [1.55, -0.2, 1.3], 1),
        "b": ("feather-white", [1.4, 1.2, 2.9], [(85, [0.2, 1.3, 2.2]), (185, [-0.7, -0.2, 2.6])], [-1.5, -0.9, 1.4], -1),
    }
    for name, (texture, start, marks, goal, side) in ways.items():
        rows = [{"kind": "position", "object": 0, "frame": frame, "value": value} for frame, value in marks]
        write_scene(f"feather-waypoints-{name}", {
            "title": "A feather past two marks to a dart board",
            "seed": 11, "shapes": feather(texture), "objects": [{"shape": "feather", "position": start}],
            "obstacles": [board([goal[0] + 0.15 * side, goal[1], goal[2]], side)],
            "constraints": rows + [{"kind": "position", "object": 0, "frame": 299, "value": goal}]})

    def spiral(first, last, turns, center, radius, top, fall):
        """Places of one turn after another about an upright line; radius: at its start and its end."""
        points = []
        for frame in range(first, last + 1):
            s = (frame - first) / (last - first)
            angle = 2.0 * math.pi * turns * s + math.pi
            r = radius[0] + (radius[1] - radius[0]) * s
            points.append(rounded((center[0] + r * math.cos(angle), center[1] + r * math.sin(angle), top - fall * s)))
        return {"kind": "path", "object": 0, "firstFrame": first, "points": points}

    spirals = {
        "a": ("feather-white", [-1.5, -0.6, 3.4], spiral(80, 200, 1.5, (-0.1, 0.1), (0.4, 0.4), 2.8, 0.9), [1.5, 0.5, 1.3]),
        "b": ("feather-barred", [-1.4, 0.9, 3.3], spiral(70, 220, 2.0, (0.0, 0.0), (0.55, 0.2), 2.9, 1.1), [1.5, -0.3, 1.1]),
    }
    for name, (texture, start, path, goal) in spirals.items():
        write_scene(f"feather-spiral-{name}", {
            "title": "A feather whose middle way is given, a spiral",
            "seed": 12, "shapes": feather(texture), "objects": [{"shape": "feather", "position": start}],
            "obstacles": [board([goal[0] + 0.15, goal[1], goal[2]], 1)],
            "constraints": [path, {"kind": "position", "object": 0, "frame": 299, "value": goal}]})


# Leaves that cover a word (as in Fig. 6): strokes as wide as a leaf, so that it can be seen how well they are covered

WORD_WIDTH, STROKE = 3.5, 0.16  # m


def word_strokes():
    """The middle lines of the letters, [((x, y), (x, y))] in metres about the word's middle."""
    letters = [  # width, lines in units of it and of the height
        (1.15, [[(0, 1), (0.27, 0), (0.5, 0.85), (0.73, 0), (1, 1)]]),
        (0.80, [[(0, 0), (0.5, 1), (1, 0)], [(0.2, 0.36), (0.8, 0.36)]]),
        (0.55, [[(0, 0), (0, 1), (1, 1)], [(0, 0.52), (0.85, 0.52)]]),
        (0.75, [[(0, 1), (1, 1)], [(0.5, 0), (0.5, 1)]])]
    height, gap = 0.62, 0.30
    unit = (WORD_WIDTH - 1.05 * STROKE) / (sum(width for width, _ in letters) + gap * (len(letters) - 1))
    left = -0.5 * (WORD_WIDTH - 1.05 * STROKE)
    strokes = []
    for width, lines in letters:
        for line in lines:
            places = [(left + x * width * unit, (y - 0.5) * height) for x, y in line]
            strokes += zip(places, places[1:])
        left += (width + gap) * unit
    return strokes


def distance_to_stroke(x, y, stroke):
    (ax, ay), (bx, by) = stroke
    dx, dy = bx - ax, by - ay
    s = max(0.0, min(1.0, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy)))
    return math.hypot(x - ax - s * dx, y - ay - s * dy)


def word_scenes():
    strokes = word_strokes()

    def ink(x, y):
        near = min(distance_to_stroke(0.5 * WORD_WIDTH * x, 0.5 * WORD_WIDTH * y, stroke) for stroke in strokes)
        return (60, 50, 40, 255 if near < 0.5 * STROKE else 0)

    write_png("waft.png", 560, ink, height=136)
    region = {"min": [-1.7, -1.5, 2.0], "max": [1.7, 1.5, 3.7]}
    write_scene("leaves-word", {
        "title": "Leaves that fall and cover the strokes of a word",
        "_story": "84 aspen leaves, aloft all over the volume, lie on the ground from frame 250 on and cover the"
                  " strokes of WAFT for who looks from above.",
        "seed": 7,
        "shapes": {name: {"builtin": "aspen", "size": 0.195, "settlingSpeed": 0.5, "texture": f"../Shapes/aspen-{name}.png"}
                   for name in ("gold", "red")},
        "objects": [{"shape": name, "count": 42, "region": region} for name in ("gold", "red")],
        "constraints": [{"kind": "keyframe", "frame": 250, "velocity": "rest",
                         "targets": {"image": "waft.png", "origin": [0, 0, 0.1], "u": [1, 0, 0], "v": [0, 1, 0],
                                     "width": WORD_WIDTH}}]})


# Leaves: shapes in the air (Fig. 7), on the ground and again (Fig. 8), in a user's wind

ALOFT = {"min": [-1.7, -1.6, 1.6], "max": [1.7, 1.6, 3.7]}


def leaves(size=0.17):
    return {
        "gold": {"builtin": "leaf", "size": size, "settlingSpeed": 0.5, "texture": "../Shapes/leaf-gold.png"},
        "maple": {"builtin": "maple", "size": size, "settlingSpeed": 0.5, "texture": "../Shapes/maple-red.png"},
        "oak": {"builtin": "oak", "size": size, "settlingSpeed": 0.5, "texture": "../Shapes/oak-brown.png"},
    }


def thirds(count, region):
    names = ("gold", "maple", "oak")
    return [{"shape": name, "count": (count + k) // 3, "region": region} for k, name in enumerate(names)]


def heart(x, y):
    x, y = 1.25 * x, 1.25 * y + 0.15
    inside = (x * x + y * y - 1.0) ** 3 - x * x * y ** 3 < 0.0
    return (200, 40, 40, 255) if inside else (0, 0, 0, 0)


def star(x, y):
    angle = math.atan2(x, y) % (2.0 * math.pi / 5.0)
    angle = min(angle, 2.0 * math.pi / 5.0 - angle)  # from a point of the star
    # The straight edge from a point to the notch beside it.
    point, notch = 0.95, 0.40
    bx, by = notch * math.cos(math.radians(36.0)) - point, notch * math.sin(math.radians(36.0))
    r = math.hypot(x, y)
    inside = bx * r * math.sin(angle) - by * (r * math.cos(angle) - point) > 0.0
    return (240, 200, 60, 255) if inside else (0, 0, 0, 0)


def leaf_scenes():
    write_png("heart.png", 160, heart)
    write_png("star.png", 160, star)
    upright = {"origin": [0, 0, 2.1], "u": [1, 0, 0], "v": [0, 0, 1], "width": 2.6}
    write_scene("leaves-shapes", {
        "title": "Leaves that form a heart in the air, then a star, and fly on",
        "seed": 21, "shapes": leaves(0.14), "objects": thirds(126, ALOFT),
        "constraints": [
            {"kind": "keyframe", "frame": 130, "targets": {"image": "heart.png", **upright}},
            {"kind": "keyframe", "frame": 240, "targets": {"image": "star.png", **upright}}]})

    flat = {"origin": [0, 0, 0.1], "u": [1, 0, 0], "v": [0, 1, 0]}
    write_scene("leaves-disturbed", {
        "title": "Leaves at rest, a gust, and a word where they lie down again",
        "seed": 22, "shapes": leaves(), "objects": thirds(48, {"min": [-1.5, -1.5, 0.5], "max": [1.5, 1.5, 1.5]}),
        "winds": [{"direction": [0.3, 0.2, 1.0], "strength": 1.2, "center": [0, 0, 0.4], "radius": 1.4,
                   "centerTime": 4.3, "duration": 0.5}],
        "constraints": [
            {"kind": "keyframe", "frame": 75, "until": 118, "velocity": "rest",
             "targets": {"image": "star.png", "width": 3.0, **flat}},
            {"kind": "keyframe", "frame": 270, "velocity": "rest",
             "targets": {"text": "AIR", "font": "sans", "width": 3.2, **flat}}]})

    def gusts(place, time):
        """One roll of air that fills the room and swings to and fro; nothing passes the walls."""
        x, z = math.pi * (place[0] + 2.0) / 4.0, math.pi * place[2] / 4.0
        speed = 0.9 * math.sin(2.0 * math.pi * time / 8.0)
        return (speed * math.sin(x) * math.cos(z), 0.0, -speed * math.cos(x) * math.sin(z))

    write_wind("gusts", (-2.0, -2.0, 0.0), (2.0, 2.0, 4.0), (8, 8, 8), [0.5 * k for k in range(21)], gusts)
    write_scene("leaves-in-wind", {
        "title": "Leaves in a measured wind, some with a mark to pass",
        "seed": 23, "shapes": leaves(), "objects": thirds(30, {"min": [-1.7, -1.4, 1.8], "max": [0.4, 1.4, 3.6]}),
        "winds": [{"file": "gusts.pvd"}],
        "constraints": [
            {"kind": "position", "object": k, "frame": 170 + 4 * k, "value": rounded((0.7 + 0.08 * k, -1.0 + 0.22 * k, 1.7)),
             "radius": 0.1} for k in range(10)]})


# Feathers that paint (Fig. 9), a thousand petals, bubbles down a stair


def unit(color):
    return [round(part / 255.0, 3) for part in color]


def sunflower(x, y):
    r, angle = math.hypot(x, y - 0.25), math.atan2(x, y - 0.25)
    if r < 0.24:
        return HEART
    if r < 0.52 + 0.10 * math.cos(9.0 * angle):
        return PETAL
    if y < -0.2 and abs(x - 0.08 * math.sin(4.0 * y)) < 0.07:
        return STEM
    leaf = math.hypot((x - 0.30) / 0.30, (y + 0.62 - 0.3 * (x - 0.3)) / 0.13)
    return STEM if leaf < 1.0 else SKY


def crowd_scenes():
    write_png("sunflower.png", 200, sunflower)
    colors = {"petal": (PETAL, 42), "heart": (HEART, 16), "stem": (STEM, 26)}
    write_scene("feathers-painting", {
        "title": "Feathers of three colours that paint a flower on the ground",
        "seed": 31,
        "shapes": {name: {"builtin": "feather", "size": 0.20, "settlingSpeed": 0.4, "class": name,
                          "texture": "../Shapes/feather-white.png", "color": unit(color)} for name, (color, _) in colors.items()},
        "objects": [{"shape": name, "count": count, "region": {"min": [-1.7, -1.7, 1.6], "max": [1.7, 1.7, 3.7]}}
                    for name, (_, count) in colors.items()],
        "constraints": [{"kind": "keyframe", "frame": 255, "velocity": "rest",
                         "targets": {"image": "sunflower.png", "origin": [0, 0, 0.1], "u": [1, 0, 0], "v": [0, 1, 0],
                                     "width": 3.6, "classes": {name: unit(color) for name, (color, _) in colors.items()}}}]})

    write_scene("petals-1000", {
        "title": "A thousand petals that come down as a heart",
        "seed": 32, "domain": {"min": [-3, -3, 0], "max": [3, 3, 5]},
        "shapes": {"petal": {"builtin": "petal", "size": 0.07, "settlingSpeed": 0.45, "texture": "../Shapes/petal-pink.png"}},
        "objects": [{"shape": "petal", "count": 1000, "region": {"min": [-2.6, -2.6, 2.0], "max": [2.6, 2.6, 4.7]}}],
        "constraints": [{"kind": "keyframe", "frame": 270, "velocity": "rest",
                         "targets": {"image": "heart.png", "origin": [0, 0, 0.1], "u": [1, 0, 0], "v": [0, 1, 0], "width": 4.6}}]})

    steps = 5
    stairs = [{"kind": "box", "min": [-2.0 + 0.6 * k, -2.0, 0.0], "max": [-1.4 + 0.6 * k, 2.0, round(1.5 - 0.3 * k, 2)]}
              for k in range(steps)]
    swing = [(0, 1.4, 1.7), (75, 0.0, 1.45), (150, -1.4, 1.7), (225, 0.0, 1.45), (299, 1.4, 1.7)]
    ball = {"kind": "sphere", "center": [0.1, 1.4, 1.7], "radius": 0.35,
            "motion": [{"frame": frame, "position": [0.1, y, z]} for frame, y, z in swing]}
    marks = [{"kind": "position", "object": k, "frame": 280, "value": rounded((1.0 + 0.12 * (k % 6), -1.2 + 0.48 * (k // 6), 0.5)),
              "radius": 0.08} for k in range(36)]
    write_scene("bubbles-stairs", {
        "title": "Bubbles down a stair, past a ball that swings",
        "seed": 33,
        "shapes": {"bubble": {"builtin": "bubble", "size": 0.08, "settlingSpeed": 0.08}},
        "objects": [{"shape": "bubble", "count": 36, "region": {"min": [-1.8, -1.4, 1.9], "max": [-0.9, 1.4, 3.2]}}],
        "obstacles": stairs + [ball], "constraints": marks})


# Scenes to try, not to tune by: other volumes, frame rates, obstacles and kinds of rows than those above


def turn(count, radius, first=0.0, arc=2.0 * math.pi):
    """Places on a circle's arc, [(along, up)]; a whole circle has each place once."""
    steps = count if arc >= 2.0 * math.pi else count - 1
    angles = [first + arc * k / steps for k in range(count)]
    return [(radius * math.cos(angle), radius * math.sin(angle)) for angle in angles]


def hall_and_shaft():
    colors = {"red": [0.85, 0.2, 0.2], "yellow": [0.95, 0.8, 0.2], "blue": [0.2, 0.4, 0.85]}
    ring = [rounded((x, y, 0.1)) for x, y in turn(60, 1.1)]
    write_scene("confetti-hall", {
        "title": "Confetti in a wide low hall that lands as a ring, colour after colour",
        "seed": 41, "time": {"frames": 200, "framesPerSecond": 24}, "domain": {"min": [-3, -1.5, 0], "max": [3, 1.5, 2]},
        "shapes": {name: {"builtin": "disc", "size": 0.06, "settlingSpeed": 0.4, "color": color}
                   for name, color in colors.items()},
        "objects": [{"shape": name, "count": 20, "region": {"min": [-2.4, -1.2, 1.2], "max": [2.4, 1.2, 1.85]}}
                    for name in colors],
        "constraints": [{"kind": "keyframe", "frame": 120 + 30 * k, "velocity": "rest",
                         "objects": list(range(20 * k, 20 * k + 20)), "targets": {"points": ring[k::3]}}
                        for k in range(len(colors))]})

    marks = [(90, [-0.2, 0.15, 2.1]), (180, [0.22, 0.1, 1.5]), (280, [-0.05, -0.2, 0.9])]
    write_scene("feather-shaft", {
        "title": "A feather down a narrow shaft, past three marks",
        "seed": 42, "time": {"frames": 300, "framesPerSecond": 60},
        "domain": {"min": [-0.5, -0.5, 0], "max": [0.5, 0.5, 3]},
        "shapes": feather("feather-white", 0.2), "objects": [{"shape": "feather", "position": [0.1, -0.2, 2.65]}],
        "constraints": [{"kind": "position", "object": 0, "frame": frame, "value": value} for frame, value in marks]})


def doorway_and_pillar():
    wall = [([-0.08, -2.0, 0.0], [0.08, -0.6, 3.0]), ([-0.08, 0.6, 0.0], [0.08, 2.0, 3.0]),
            ([-0.08, -0.6, 2.0], [0.08, 0.6, 3.0])]
    write_scene("scraps-doorway", {
        "title": "Round scraps of paper through a doorway, to a word on the floor behind it",
        "seed": 43, "time": {"frames": 250}, "domain": {"min": [-2.5, -2, 0], "max": [2.5, 2, 3]},
        "shapes": {"scrap": {"builtin": "disc", "size": 0.1, "areaDensity": 0.08, "settlingSpeed": 0.45,
                             "color": [0.93, 0.9, 0.82]}},
        "objects": [{"shape": "scrap", "count": 40, "region": {"min": [-2.2, -1.2, 1.0], "max": [-0.7, 1.2, 2.4]}}],
        "obstacles": [{"kind": "box", "min": low, "max": high} for low, high in wall],
        "constraints": [{"kind": "keyframe", "frame": 235, "velocity": "rest",
                         "targets": {"text": "OUT", "origin": [1.4, 0, 0.1], "u": [0, -1, 0], "v": [1, 0, 0], "width": 2.4}}]})

    leg = [0.1 * k for k in range(7)]
    arch = [(1.1, z) for z in leg] + [(y, 0.7 + z) for y, z in turn(36, 1.1, 0.0, math.pi)] + [(-1.1, z) for z in leg[::-1]]
    write_scene("leaves-pillar", {
        "title": "Leaves round a pillar that walks across the room, to an arch in the air",
        "seed": 44, "time": {"frames": 260, "framesPerSecond": 25}, "domain": {"min": [-2, -2, 0], "max": [2, 2, 3]},
        "shapes": leaves(0.1), "objects": thirds(50, {"min": [-1.8, -1.5, 1.0], "max": [-0.7, 1.5, 2.7]}),
        "obstacles": [{"kind": "cylinder", "base": [0, -1.2, 0], "top": [0, -1.2, 3], "radius": 0.25,
                       "motion": [{"frame": 30, "position": [0, -1.2, 0]}, {"frame": 200, "position": [0, 1.2, 0]}]}],
        "constraints": [{"kind": "keyframe", "frame": 225,
                         "targets": {"points": [rounded((1.3, y, 0.4 + z)) for y, z in arch]}}]})


def two_marks():
    ring = [rounded((x, y, 1.3)) for x, y in turn(30, 0.6)]
    wide, high = [1.2 * k / 8 - 0.6 for k in range(8)], [1.2 * k / 7 - 0.6 for k in range(7)]
    square = [(x, -0.6) for x in wide] + [(0.6, z) for z in high] + [(-x, 0.6) for x in wide] + [(-0.6, -z) for z in high]
    square = [rounded((x, 0.0, 1.0 + z)) for x, z in square]
    write_scene("bubbles-two-marks", {
        "title": "Bubbles that are a ring, and then a square",
        "seed": 45, "time": {"frames": 240}, "domain": {"min": [-1, -1, 0], "max": [1, 1, 2]},
        "shapes": {"bubble": {"builtin": "bubble", "size": 0.06, "settlingSpeed": 0.04}},
        "objects": [{"shape": "bubble", "count": 30, "region": {"min": [-0.8, -0.8, 0.5], "max": [0.8, 0.8, 1.8]}}],
        "constraints": [
            {"kind": "keyframe", "frame": 90, "targets": {"points": ring}, "radius": 0.04},
            {"kind": "keyframe", "frame": 190, "targets": {"points": square}, "radius": 0.04},
            {"kind": "velocity", "object": 4, "frame": 140, "value": [0.25, 0.0, 0.1]},
            {"kind": "acceleration", "object": 17, "frame": 140, "value": [0.0, 0.4, 0.1], "radius": 0.05}]})


if __name__ == "__main__":
    feather_scenes()
    word_scenes()
    leaf_scenes()
    crowd_scenes()
    hall_and_shaft()
    doorway_and_pillar()
    two_marks()
