# SPDX-License-Identifier: BSD-3-Clause
"""How clear objects keep of walls, ground and obstacles, from the poses and the scene: the swept centre at eight
places a frame, and every vertex of every body at every frame."""
import collections
import math

import result_files
from result_files import REST, distance

SAMPLES = 8  # a frame

# shortfall [m]: most that a centre lacks of its clearance radius, but for the surface landed on within a second of the
# rest; depth [m]: deepest vertex in the ground or an obstacle.
Clearance = collections.namedtuple("Clearance", "shortfall depth")


def measure(folder, scene, tracks, rows, rate):
    shapes = result_files.read_shapes(folder)
    surfaces = _surfaces(folder, scene)
    shortfall = depth = 0.0
    for number, track in tracks.items():
        body = shapes[number]
        radius = 0.5 * max(max(p[c] for p in body) - min(p[c] for p in body) for c in range(3))
        landings = _landings(number, track, rows, rate, surfaces)
        for sample in range(SAMPLES * (len(track) - 1) + 1):
            frame = sample / SAMPLES
            k = int(frame)
            x = tuple(a + (frame - k) * (b - a) for a, b in zip(track[k].x, track[min(k + 1, len(track) - 1)].x))
            for name, surface in surfaces.items():
                if not any(first <= frame <= last and name == landed for first, last, landed in landings):
                    shortfall = max(shortfall, radius - surface(x, frame, radius))
        depth = max(depth, _deepest(track, body, surfaces))
    return Clearance(shortfall, depth)


def _deepest(track, body, surfaces):
    """How far any vertex is in the ground or an obstacle at any frame [m]; 0 when none is."""
    solid = [surface for name, surface in surfaces.items() if name != "walls"]
    reach = max(math.hypot(*p) for p in body)
    depth = 0.0
    before = None
    for k, pose in enumerate(track):
        near = [surface for surface in solid if surface(pose.x, k, reach) < reach]
        if near and (len(solid) > 1 or before is None or (pose.x, pose.q) != (before.x, before.q)):
            vertices = [tuple(a + b for a, b in zip(pose.x, result_files.rotated(pose.q, p))) for p in body]
            depth = max(depth, *(-surface(x, k, reach) for surface in near for x in vertices))
        before = pose
    return depth


def _landings(number, track, rows, rate, surfaces):
    """[(first frame, last frame, surface)] in which the surface that a body lands on does not ask for its radius."""
    found = []
    for row in rows:
        if row.object == number and row.kind == REST and row.status == "met":
            place = track[row.frame].x
            landed = min(surfaces, key=lambda name: abs(surfaces[name](place, row.frame, math.inf)))
            found.append((row.frame - rate, row.until + rate, landed))
    return found


def _surfaces(folder, scene):
    """{name: signed distance of (point, frame, reach)}; beyond the reach a distance may come out too large."""
    low, high, height, _ = result_files.volume(scene)
    floor = low[2] if height is None else height
    surfaces = {"walls": lambda x, _frame, _reach: min(x[0] - low[0], high[0] - x[0], x[1] - low[1], high[1] - x[1],
                                                       high[2] - x[2]),
                "ground": lambda x, _frame, _reach: x[2] - floor}
    meshes = None
    for number, obstacle in enumerate(scene.get("obstacles", [])):
        kind = obstacle["kind"]
        if kind == "mesh" and meshes is None:
            meshes = result_files.read_obstacle_surfaces(folder)
        body = {"box": _box, "sphere": _sphere, "cylinder": _cylinder}.get(kind)
        still = (body(obstacle) if body else _mesh(meshes[obstacle.get("id", number)]))
        surfaces[f"obstacle {number}"] = _moved(still, _reference(obstacle), obstacle.get("motion", []))
    return surfaces


def _moved(still, reference, keys):
    def surface(x, frame, reach):
        offset = _offset(reference, keys, frame)
        return still(tuple(a - b for a, b in zip(x, offset)), reach)
    return surface


def _reference(obstacle):
    """The point that `motion` moves, where its surface is read or made."""
    if obstacle["kind"] == "box":
        return [0.5 * (a + b) for a, b in zip(obstacle["min"], obstacle["max"])]
    if obstacle["kind"] == "mesh":  # the results have it as it stands at frame 0
        return _place(obstacle["motion"], 0) if obstacle.get("motion") else None
    return obstacle["center" if obstacle["kind"] == "sphere" else "base"]


def _offset(reference, keys, frame):
    return tuple(p - q for p, q in zip(_place(keys, frame), reference)) if keys else (0.0, 0.0, 0.0)


def _place(keys, frame):
    """Straight between keys, still before the first and after the last."""
    for a, b in zip(keys, keys[1:]):
        if a["frame"] < frame <= b["frame"]:
            s = (frame - a["frame"]) / (b["frame"] - a["frame"])
            return [p + s * (q - p) for p, q in zip(a["position"], b["position"])]
    return keys[0]["position"] if frame <= keys[0]["frame"] else keys[-1]["position"]


def _box(obstacle):
    def surface(x, _reach):
        out = [max(a - p, p - b) for p, a, b in zip(x, obstacle["min"], obstacle["max"])]
        return math.hypot(*(max(0.0, d) for d in out)) + min(0.0, max(out))
    return surface


def _sphere(obstacle):
    return lambda x, _reach: distance(x, obstacle["center"]) - obstacle["radius"]


def _cylinder(obstacle):
    base, top, radius = obstacle["base"], obstacle["top"], obstacle["radius"]
    length = distance(base, top)
    axis = [(b - a) / length for a, b in zip(base, top)]

    def surface(x, _reach):
        d = [p - a for p, a in zip(x, base)]
        along = sum(a * b for a, b in zip(d, axis))
        out = (math.sqrt(max(0.0, sum(a * a for a in d) - along * along)) - radius, max(-along, along - length))
        return math.hypot(*(max(0.0, a) for a in out)) + min(0.0, max(out))
    return surface


def _mesh(triangles):
    boxes = [[(min(p[c] for p in t), max(p[c] for p in t)) for c in range(3)] for t in triangles]

    def surface(x, reach):
        nearest = reach if math.isfinite(reach) else distance(x, triangles[0][0])
        nearest += 1e-9
        for triangle, box in zip(triangles, boxes):
            if all(a - nearest <= p <= b + nearest for p, (a, b) in zip(x, box)):
                nearest = min(nearest, distance(x, _nearest_point(x, triangle)))
        return -nearest if _crossings(x, triangles, boxes) % 2 else nearest
    return surface


def _nearest_point(x, triangle):
    """The point of a triangle nearest to x (by the Voronoi regions of its corners and edges)."""
    a, b, c = triangle
    ab, ac = _minus(b, a), _minus(c, a)
    d1, d2 = _dot(ab, _minus(x, a)), _dot(ac, _minus(x, a))
    d3, d4 = _dot(ab, _minus(x, b)), _dot(ac, _minus(x, b))
    d5, d6 = _dot(ab, _minus(x, c)), _dot(ac, _minus(x, c))
    va, vb, vc = d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2
    if d1 <= 0.0 and d2 <= 0.0:
        return a
    if d3 >= 0.0 and d4 <= d3:
        return b
    if d6 >= 0.0 and d5 <= d6:
        return c
    if vc <= 0.0 <= d1 and d3 <= 0.0:
        return _along(a, ab, d1 / (d1 - d3))
    if vb <= 0.0 <= d2 and d6 <= 0.0:
        return _along(a, ac, d2 / (d2 - d6))
    if va <= 0.0 and d4 >= d3 and d5 >= d6:
        return _along(b, _minus(c, b), (d4 - d3) / ((d4 - d3) + (d5 - d6)))
    total = va + vb + vc
    return _along(_along(a, ab, vb / total), ac, vc / total)


def _crossings(x, triangles, boxes):
    """How often the line straight up from x crosses the surface; a hair aside, so that it meets no edge."""
    px, py = x[0] + 1.234e-9, x[1] + 2.345e-9
    count = 0
    for (a, b, c), box in zip(triangles, boxes):
        if not (box[0][0] <= px <= box[0][1] and box[1][0] <= py <= box[1][1] and x[2] <= box[2][1]):
            continue
        u = (b[0] - a[0]) * (py - a[1]) - (b[1] - a[1]) * (px - a[0])
        v = (c[0] - b[0]) * (py - b[1]) - (c[1] - b[1]) * (px - b[0])
        w = (a[0] - c[0]) * (py - c[1]) - (a[1] - c[1]) * (px - c[0])
        area = u + v + w
        if area != 0.0 and min(u, v, w) * max(u, v, w) >= 0.0:
            count += (u * c[2] + v * a[2] + w * b[2]) / area > x[2]
    return count


def _minus(a, b):
    return tuple(p - q for p, q in zip(a, b))


def _dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def _along(a, d, s):
    return tuple(p + s * q for p, q in zip(a, d))
