#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the scenes of Documentation/Examples by waft.Scene, beside itself.

PYTHONPATH=build/lib/python3/dist-packages python3 Data/Scenes/examples/make_examples.py

The same files come out each time, to the byte. Their surfaces are made by make_hand.py and, being a few lines long, here.
"""
import math
import pathlib
import random
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from make_scenes import write_png  # noqa: E402
from waft import Scene  # noqa: E402

SKINS = HERE.parent.parent / "Shapes"
GOLDEN = math.pi * (3.0 - math.sqrt(5.0))


def main():
    for make in (petals_logo, leaves_gate, paper_desk, feather_hand, snow_name, bubbles_curve):
        make().save(HERE / f"{make.__name__.replace('_', '-')}.waft.json")


def ease(x):
    """From 0 to 1, at rest at both ends."""
    x = min(max(x, 0.0), 1.0)
    return x * x * (3.0 - 2.0 * x)


def rounded(point):
    return [round(value, 4) for value in point]


def write_obj(name, points, faces, places=None):
    """A surface as an .obj file; faces are indices from 0; `places`: texture coordinates, one a point."""
    lines = [f"v {x:.4f} {y:.4f} {z:.4f}" for x, y, z in points]
    lines += [f"vt {u:.4f} {v:.4f}" for u, v in places or ()]
    for face in faces:
        lines.append("f " + " ".join(f"{corner + 1}/{corner + 1}" if places else str(corner + 1) for corner in face))
    (HERE / name).write_text("\n".join(lines) + "\n", encoding="utf-8")
    return HERE / name


def write_skin(name, color):
    """A plain skin with a soft grain, for what has no painted one."""
    def color_at(x, y):
        shade = 1.0 + 0.02 * math.sin(9.0 * x + 3.0 * math.sin(5.0 * y))
        return tuple(min(int(value * shade), 255) for value in color)

    write_png_here(name, 64, color_at)


def write_png_here(name, size, color_at, height=None):
    write_png(f"examples/{name}", size, color_at, height)
    return HERE / name


# A logo of petals on water: a blossom in a ring


def petals_logo():
    def color_at(x, y):
        radius, angle = math.hypot(x, y), math.atan2(y, x)
        if 0.80 < radius < 0.97:
            return (70, 110, 200)
        edge = 0.13 + 0.52 * abs(math.cos(2.5 * (angle - 0.5 * math.pi)))
        return (225, 120, 150) if 0.10 < radius < edge else (255, 255, 255)

    logo = write_png_here("blossom.png", 200, color_at)
    scene = Scene("A logo of petals on still water", seed=5,
                  comment="Made by make_examples.py. The water is the ground: what comes to lie on it stays.")
    scene.set_time(270, 30)
    scene.set_domain((-1.5, -1.5, 0), (1.5, 1.5, 2.4))
    for name, color in (("pink", (1.0, 0.78, 0.84)), ("white", (0.93, 0.95, 1.0))):
        scene.add_shape(name, "petal", size=0.075, settling_speed=0.55, color=color, class_=name)
    scene.add_objects("pink", count=52, region={"min": (-0.9, -0.9, 1.1), "max": (0.9, 0.9, 2.2)})
    scene.add_objects("white", count=56, region={"min": (-1.1, -1.1, 1.1), "max": (1.1, 1.1, 2.2)}, seed=6)
    scene.add_keyframe(225, image=logo, origin=(0, 0, 0.3), u=(1, 0, 0), v=(0, 1, 0), width=2.0, count=108,
                       classes={"pink": (225 / 255, 120 / 255, 150 / 255), "white": (70 / 255, 110 / 255, 200 / 255)},
                       velocity="rest")
    return scene


# Leaves through a gate onto a pile


def leaves_gate():
    rings, around = 9, 28
    points, faces = [(0.0, 0.0, 0.26)], []
    for ring in range(1, rings + 1):
        radius = 0.8 * ring / rings
        height = max(0.13 * (1.0 + math.cos(math.pi * radius / 0.8)), 0.0)
        for turn in range(around):
            angle = 2.0 * math.pi * turn / around
            bumps = 0.02 * math.sin(3.0 * angle + 5.0 * radius) * math.sin(math.pi * ring / rings)
            points.append((radius * math.cos(angle), radius * math.sin(angle), height + bumps))
    rim = len(points)
    points += [(x, y, -0.05) for x, y, _ in points[-around:]] + [(0.0, 0.0, -0.05)]
    for turn in range(around):
        after = (turn + 1) % around
        faces.append((0, 1 + turn, 1 + after))
        for ring in range(rings - 1):
            a, b = 1 + ring * around + turn, 1 + ring * around + after
            faces += [(a, a + around, b + around), (a, b + around, b)]
        a, b = rim - around + turn, rim - around + after
        faces += [(a, rim + turn, rim + after), (a, rim + after, b), (len(points) - 1, rim + after, rim + turn)]
    heap = write_obj("heap.obj", points, faces)

    scene = Scene("Autumn leaves through a gate onto a pile", seed=3, comment="Made by make_examples.py.")
    scene.set_time(300, 30)
    scene.add_box((-0.12, -0.95, 0.0), (0.12, -0.75, 2.0), comment="the gate: two posts and a lintel")
    scene.add_box((-0.12, 0.75, 0.0), (0.12, 0.95, 2.0))
    scene.add_box((-0.12, -1.05, 2.0), (0.12, 1.05, 2.16))
    scene.add_mesh(heap, position=(1.15, 0, 0), up="z", comment="bodies do not heap up by themselves: the pile has a core")
    kinds = (("maple", "maple-red", 0.15, 14), ("oak", "oak-brown", 0.14, 12), ("aspen", "aspen-gold", 0.09, 10))
    leaves = []
    for number, (kind, skin, size, count) in enumerate(kinds):
        scene.add_shape(kind, kind, size=size, texture=SKINS / f"{skin}.png")
        leaves += scene.add_objects(kind, count=count, seed=20 + number,
                                    region={"min": (-1.8, -0.9, 1.3), "max": (-0.7, 0.9, 3.0)})
    shuffled = random.Random(4)
    shuffled.shuffle(leaves)
    scene.add_wind((1, 0, 0), 0.7, (-0.6, 0, 1.4), 1.4, 2.0, 1.6, comment="the gust that takes them through")
    batches = [leaves[first:first + 4] for first in range(0, len(leaves), 4)]
    spots = [(0.62 * math.sqrt((place + 0.4) / len(leaves)), GOLDEN * place) for place in range(len(leaves))]
    for number, batch in enumerate(batches):
        gaps = [rounded((0.0, -0.48 + 0.32 * place + 0.06 * (-1) ** number, 1.15 + 0.3 * ((place + number) % 3)))
                for place in range(len(batch))]
        scene.add_keyframe(75 + 10 * number, points=gaps, objects=batch, radius=0.08,
                           comment="four at a time between the posts" if number == 0 else None)
        mine = spots[number::len(batches)][:len(batch)]
        rest = [rounded((1.15 + radius * math.cos(angle), radius * math.sin(angle), 0.6)) for radius, angle in mine]
        scene.add_keyframe(175 + 11 * number, points=rest, objects=batch, velocity="rest")
    return scene


# Sheets of paper off a desk


def paper_desk():
    columns, rows, length, width = 12, 6, 0.297, 0.21
    points, places, faces = [], [], []
    for row in range(rows + 1):
        for column in range(columns + 1):
            u, v = column / columns, row / rows
            bend = 0.03 * (2.0 * u - 1.0) ** 2 + 0.006 * math.sin(2.0 * math.pi * v) * (2.0 * u - 1.0)
            points.append(((u - 0.5) * length, (v - 0.5) * width, bend - 0.01))
            places.append((u, v))
    for row in range(rows):
        for column in range(columns):
            a = row * (columns + 1) + column
            b = a + columns + 1
            faces += [(a, a + 1, b + 1), (a, b + 1, b)]
    sheet = write_obj("sheet.obj", points, faces, places)

    def letter(x, y):
        line = (y / 0.7 + 1.0) * 11.0
        text = abs(x) < 0.75 and 0.35 < line % 1.0 < 0.62 and 1.5 < line < 19.0
        end = -0.2 + 0.9 * abs(math.sin(17.0 * math.floor(line)))
        return (120, 122, 130) if text and x < end else (250, 248, 242)

    skin = write_png_here("letter.png", 180, letter, 128)
    scene = Scene("A gust takes sheets of paper off a desk", seed=8, comment="Made by make_examples.py.")
    scene.set_time(270, 30)
    scene.set_domain((-2, -1.6, 0), (2, 1.6, 2.4))
    scene.add_shape("sheet", mesh=sheet, align=False, texture=skin, area_density=0.08, settling_speed=0.75,
                    color=(1, 1, 1), comment="A4, 80 g/m^2, a little bent from the printer")
    scene.add_box((-1.75, -0.6, 0.72), (-0.25, 0.6, 0.76), comment="the desk and its legs")
    for x in (-1.7, -0.36):
        for y in (-0.55, 0.49):
            scene.add_box((x, y, 0.0), (x + 0.06, y + 0.06, 0.72))
    scene.add_wind((0.95, 0.0, 0.55), 3.0, (-0.9, 0, 0.9), 0.9, 1.3, 0.45, comment="the gust: forwards and up")
    ends = [(0.15, -0.95), (0.35, 0.75), (0.75, -0.35), (0.95, 0.95), (1.25, -1.05), (1.35, 0.15), (1.7, 0.8), (1.7, -0.5)]
    for number, (x, y) in enumerate(ends):
        column, row = divmod(number, 2)
        place = (-0.5 - 0.34 * column, -0.25 + 0.5 * row, 0.77)
        sheet = scene.add_object("sheet", rounded(place), velocity=(0, 0, 0))
        leave = 20 + 5 * column + 2 * row
        scene.add_rest(sheet, 0, rounded((place[0], place[1], 0.95)), until=leave,
                       comment="on the desk until the gust comes" if number == 0 else None)
        scene.add_rest(sheet, 170 + 9 * ((5 * number) % 8), (x, y, 0.3))
    return scene


# A feather into a hand that comes to meet it


def feather_hand():
    scene = Scene("A feather into a hand", seed=9, comment="Made by make_examples.py; the hand by make_hand.py.")
    scene.set_time(270, 30)
    scene.set_domain((-1.0, -1.0, 0), (1.0, 1.0, 2.0))
    scene.add_shape("feather", "feather", size=0.17, settling_speed=0.35, texture=SKINS / "feather-white.png")
    feather = scene.add_object("feather", (-0.55, 0.25, 1.75))
    motion = []
    for frame in range(60, 267, 6):  # towards the feather, giving way as it comes down, then up to the eyes
        near, up = (ease((frame - begin) / length) for begin, length in ((60, 130), (196, 70)))
        give = 0.08 * math.sin(math.pi * min(max((frame - 150) / 60.0, 0.0), 1.0))
        motion.append({"frame": frame, "position": rounded((0.62 - 0.5 * near - 0.25 * up, -0.15 * up, 0.42 + 0.16 * near - give + 0.35 * up))})
    hand = scene.add_mesh(HERE / "hand.obj", up="z", position=motion[0]["position"], motion=motion,
                          comment="palm up; its origin is the middle of the palm. It never stands still while it has the feather")
    scene.add_position(feather, 110, (-0.15, -0.2, 1.3), radius=0.08, comment="a bow on the way")
    scene.add_rest(feather, 205, (-0.02, 0.0, 0.3), on=hand, comment="on the palm, straight below this place of the hand")
    return scene


# Snow that writes a name


def snow_name():
    points, faces = [(0.0, 0.0, 0.0)], []
    for arm in range(6):
        for turn, radius in ((-0.5, 0.012), (-0.07, 0.0375), (0.07, 0.0375)):
            angle = (arm + turn) * math.pi / 3.0
            points.append((radius * math.cos(angle), radius * math.sin(angle), 0.06 * radius))
    for arm in range(6):
        a, after = 1 + 3 * arm, 1 + 3 * ((arm + 1) % 6)
        faces += [(0, a, a + 1), (0, a + 1, a + 2), (0, a + 2, after)]
    flake = write_obj("flake.obj", points, faces)
    scene = Scene("Snow that writes a name", seed=12, comment="Made by make_examples.py.")
    scene.set_time(300, 30)
    scene.add_shape("flake", mesh=flake, align=False, area_density=0.03, thickness=0.003, settling_speed=0.45,
                    color=(0.96, 0.97, 1.0), comment="a flat star of six arms; the size is the eye's, not the sky's")
    scene.add_objects("flake", count=130, region={"min": (-1.7, -1.4, 1.0), "max": (1.7, 1.4, 3.8)})
    scene.add_keyframe(265, text="Emma", origin=(0, 0, 0.3), u=(1, 0, 0), v=(0, 1, 0), width=3.0, count=130,
                       velocity="rest")
    return scene


# Bubbles along a curve


def bubbles_curve():
    rate, speed = 30.0, 0.45

    def curve(t):
        """Up in a spiral that opens, in metres, t from 0 to 1."""
        angle, radius = 4.5 * math.pi * t, 0.30 + 0.75 * t
        return (radius * math.cos(angle), radius * math.sin(angle), 0.6 + 2.6 * t)

    fine = [curve(step / 4000.0) for step in range(4001)]
    along = [0.0]
    for a, b in zip(fine, fine[1:]):
        along.append(along[-1] + math.dist(a, b))

    def at(length):
        low, high = 0, len(along) - 1
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (middle, high) if along[middle] <= length else (low, middle)
        return fine[low]

    scene = Scene("Bubbles along a curve", seed=14, comment="Made by make_examples.py.")
    scene.set_time(300, 30)
    scene.add_shape("bubble", "bubble", size=0.09, settling_speed=0.03)
    bubbles = 14
    starts = scene.add_objects("bubble", count=bubbles, region={"min": (-0.8, -0.8, 0.15), "max": (0.8, 0.8, 0.45)})
    for number, bubble in enumerate(starts):
        first = 45 + 9 * number
        points = [rounded(at(speed * (frame - first) / rate)) for frame in range(first, 286)]
        scene.add_path(bubble, first, points, radius=0.05,
                       comment=f"they join the curve one after the other, {speed} m/s along it" if number == 0 else None)
    return scene


if __name__ == "__main__":
    main()
