# SPDX-License-Identifier: BSD-3-Clause
"""What a finished animation must satisfy, measured on the files of a run and its scene alone.

    motion_checks.py DIR... SCENE [DATABASE.vtm]  prints a table of figures, style and coherence among them;
                                                  exit status 1 when a hard limit is missed

Of several folders, runs of one scene with seeds of their own, each figure is the worst and style is pooled.
"""
import collections
import csv
import json
import math
import pathlib
import sys

import clearance_checks
import picture_checks
import result_files
import style_checks
from result_files import ACCELERATION, ORIENTATION, POSITION, REST, VELOCITY, distance, read_poses, volume

EMBEDDED = pathlib.Path(__file__).resolve().parents[2] / "Data/Database/embedded.vtm"


def row_errors(rows, scene):
    """Texts: where what the run took for the rows is not what the scene says."""
    errors = []
    by_place = collections.defaultdict(list)
    for row in rows:
        by_place[row.row].append(row)
    for number, entry in enumerate(scene.get("constraints", [])):
        found = by_place.pop(number, [])
        kinds = {"position": POSITION, "velocity": VELOCITY, "acceleration": ACCELERATION,
                 "orientation": ORIENTATION, "rest": REST, "path": POSITION, "keyframe": POSITION}
        place = f"constraint {number}"
        if entry["kind"] == "keyframe":
            wanted = _keyframe_targets(entry)
            first = [r for r in found if r.kind == (REST if entry.get("velocity") == "rest" else POSITION)]
            if not first or (wanted is not None and [r.value[:3] for r in first] != wanted):
                errors.append(f"{place}: its targets are others")
            if any(r.frame != entry["frame"] for r in first):
                errors.append(f"{place}: its frame is another")
            ids = [r.object for r in first]
            if len(set(ids)) != len(ids) or not set(ids) <= set(entry.get("objects", ids)):
                errors.append(f"{place}: two targets for one object, or an object that is not in its list")
            continue
        points = entry["points"] if entry["kind"] == "path" else [entry["value"]]
        frame = entry["firstFrame"] if entry["kind"] == "path" else entry["frame"]
        wanted = [(kinds[entry["kind"]], frame + k, tuple(map(float, p)), entry.get("radius", 0.0))
                  for k, p in enumerate(points)]
        width = len(points[0])
        seen = [(r.kind, r.frame, r.value[:width], r.radius) for r in found]
        # An orientation is made a unit quaternion.
        if entry["kind"] != "orientation" and seen != wanted:
            errors.append(f"{place}: taken as {seen}")
        if found and entry.get("object", -1) >= 0 and {r.object for r in found} != {entry["object"]}:
            errors.append(f"{place}: given to another object")
    return errors + [f"row {number}: not in the scene" for number in by_place]


def _keyframe_targets(entry):
    points = entry["targets"].get("points")
    return None if points is None else [tuple(map(float, p)) for p in points]


def residuals(tracks, rows, rate):
    """Largest miss beyond its radius of the rows that are said to be met, by kind: places [m], velocity [m/s],
    acceleration [m/s^2], orientation [rad]. A rest counts along the surface, and by how far the body stirs."""
    worst = collections.Counter({"place": 0.0, "velocity": 0.0, "acceleration": 0.0, "orientation": 0.0})
    for row in rows:
        if row.status != "met":
            continue
        track = tracks[row.object]
        pose = track[row.frame]
        if row.kind == POSITION:
            name, miss = "place", distance(pose.x, row.value[:3])
        elif row.kind == REST:
            name = "place"
            miss = max(distance(p.x[:2], row.value[:2]) + abs(p.x[2] - pose.x[2])
                       for p in track[row.frame:row.until + 1])
        elif row.kind == VELOCITY:
            name, miss = "velocity", distance(pose.v, row.value[:3])
        elif row.kind == ACCELERATION:
            name = "acceleration"
            a = [0.5 * rate * (n - p) for p, n in zip(track[row.frame - 1].v, track[row.frame + 1].v)]
            miss = distance(a, row.value[:3])
        else:
            name = "orientation"
            dot = min(1.0, abs(sum(a * b for a, b in zip(pose.q, row.value))))
            miss = 2.0 * math.atan2(math.sqrt(1.0 - dot * dot), dot)
        worst[name] = max(worst[name], miss - row.radius)
    return worst


def outside(tracks, scene):
    """Largest distance of a centre beyond the volume or below the ground [m]; 0 when all are inside."""
    low, high, ground, _ = volume(scene)
    floor = (low[0], low[1], low[2] if ground is None else max(low[2], ground))
    return max(max(max(floor[c] - p.x[c], p.x[c] - high[c], 0.0) for c in range(3))
               for track in tracks.values() for p in track)


def quaternion_error(tracks):
    """Largest deviation of a quaternion from unit length, and the number of sign flips."""
    worst = max(abs(math.sqrt(sum(c * c for c in p.q)) - 1.0) for track in tracks.values() for p in track)
    flips = sum(sum(a * b for a, b in zip(p.q, n.q)) < 0.0
                for track in tracks.values() for p, n in zip(track, track[1:]))
    return worst, flips


def top_speed(tracks, rate):
    """Fastest speed between two frames [m/s]."""
    return max(distance(p.x, n.x) * rate for track in tracks.values() for p, n in zip(track, track[1:]))


def velocity_error(tracks, rate):
    """Largest difference between the exported velocity and the central difference [m/s]."""
    return max(distance(track[k].v, tuple((b - a) * rate / 2.0 for a, b in zip(track[k - 1].x, track[k + 1].x)))
               for track in tracks.values() for k in range(1, len(track) - 1))


def measure(folder, scene_file):
    """The figures of a run that have a hard limit, and a few to look at, as a dictionary."""
    folder = pathlib.Path(folder)
    scene = json.loads(pathlib.Path(scene_file).read_text(encoding="utf-8"))
    tracks = read_poses(folder / "poses.csv")
    rows = result_files.read_rows(folder)
    rate = scene.get("time", {}).get("framesPerSecond", 30)
    width = volume(scene)[3]
    error, flips = quaternion_error(tracks)
    speed = top_speed(tracks, rate)
    missed = residuals(tracks, rows, rate)
    with open(folder / "convergence.csv", newline="", encoding="utf-8") as stream:
        convergence = list(csv.DictReader(stream))
    rises = 0
    for before, after in zip(convergence, convergence[1:]):
        same = (before["Pass"], before["Stage"]) == (after["Pass"], after["Stage"])
        rises += same and float(after["E"]) > float(before["E"])
    clear = clearance_checks.measure(folder, scene, tracks, rows, rate)
    covered = picture_checks.overlap(folder, scene_file, tracks)
    return {
        "objects": len(tracks),
        "frames": max(len(track) for track in tracks.values()),
        "rows": len(rows),
        "rows_unmet": sum(row.status != "met" for row in rows),
        "row_errors": len(row_errors(rows, scene)),
        "exact_residual": missed["place"] / width,
        "velocity_residual": missed["velocity"] / speed,
        "acceleration_residual": missed["acceleration"] / (speed * rate),
        "orientation_residual": missed["orientation"],
        "outside": outside(tracks, scene),
        "clearance_shortfall": clear.shortfall / width,
        "mesh_depth": clear.depth / width,
        "quaternion_error": error,
        "quaternion_flips": flips,
        "top_speed": speed,
        "velocity_error": velocity_error(tracks, rate),
        "energy_ratio": float(convergence[-1]["E"]) / float(convergence[0]["E"]),
        "energy_rises": rises,
        "first_stage": convergence[0]["Stage"],
        "last_stage": convergence[-1]["Stage"],
        **({} if covered is None else {"picture_overlap": covered}),
    }


# In the units of measure(): lengths over L, velocities over the top speed.
LIMITS = {
    "row_errors": 0,
    "exact_residual": 1e-9,
    "velocity_residual": 1e-6,
    "acceleration_residual": 1e-6,
    "orientation_residual": 1e-6,
    "outside": 0.0,
    "clearance_shortfall": 1e-3,
    "mesh_depth": 1e-3,
    "quaternion_error": 1e-9,
    "quaternion_flips": 0,
    "velocity_error": 1e-9,
    "energy_ratio": 0.1,
    "energy_rises": 0,
}

# Of a run that has it: how much of a picture is covered (picture_checks.py).
LEAST = {"picture_overlap": 0.9}


def worst(runs):
    """The worst of each figure in several runs' figures: the least of what has a lower limit, the largest of the rest."""
    return {name: (min if name in LEAST else max)(figures[name] for figures in runs) for name in runs[0]}


def violations(figures):
    return ([f"{name} is {figures[name]:.3g}, at most {limit:g} is allowed"
             for name, limit in LIMITS.items() if not figures[name] <= limit] +
            [f"{name} is {figures[name]:.3g}, at least {limit:g} is asked for"
             for name, limit in LEAST.items() if name in figures and not figures[name] >= limit])


def print_table(figures, style):
    for name, value in figures.items():
        text = f"{value:.4g}" if isinstance(value, float) else str(value)
        limit = f"   at most {LIMITS[name]:g}" if name in LIMITS else ""
        limit = f"   at least {LEAST[name]:g}" if name in LEAST else limit
        print(f"{name:22} {text:>12}{limit}")
    print()
    print(f"{'':22} " + "".join(f"{kind:>12}" for kind in style_checks.KINDS) + "   wanted")
    for name, line in style.items():
        cells = "".join(f"{line[kind]:12.3f}" if kind in line else " " * 12 for kind in style_checks.KINDS)
        print(f"{name:22} {cells}   {style_checks.WANTED.get(name, '')}")


def main(folders, scene_file, database=EMBEDDED):
    figures = worst([measure(folder, scene_file) for folder in folders])
    print_table(figures, style_checks.measure(folders, json.loads(pathlib.Path(scene_file).read_text(encoding="utf-8")),
                                              database))
    bad = violations(figures)
    if bad:
        print("\n" + "\n".join(bad))
    return 1 if bad else 0


if __name__ == "__main__":
    arguments = sys.argv[1:]
    database = [arguments.pop()] if arguments and arguments[-1].endswith(".vtm") else []
    if len(arguments) < 2:
        sys.exit(__doc__)
    sys.exit(main(arguments[:-1], arguments[-1], *database))
