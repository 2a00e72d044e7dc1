# SPDX-License-Identifier: BSD-3-Clause
"""What a finished animation must satisfy, measured on the files of a run alone.

    motion_checks.py DIR SCENE       prints a table of figures; exit status 1 when a hard limit is missed
"""
import collections
import csv
import json
import math
import pathlib
import sys

Pose = collections.namedtuple("Pose", "x q v w")


def read_poses(path):
    """{object: [Pose per frame]} of a poses.csv."""
    tracks = collections.defaultdict(list)
    with open(path, newline="", encoding="utf-8") as stream:
        for row in csv.DictReader(stream):
            values = {name: float(value) for name, value in row.items() if name not in ("object", "frame")}
            assert len(tracks[int(row["object"])]) == int(row["frame"]), "frames out of order"
            tracks[int(row["object"])].append(Pose(
                tuple(values[c] for c in ("x", "y", "z")),
                tuple(values[c] for c in ("qw", "qx", "qy", "qz")),
                tuple(values[c] for c in ("vx", "vy", "vz")),
                tuple(values[c] for c in ("wx", "wy", "wz"))))
    return dict(tracks)


def volume(scene):
    domain = scene.get("domain", {})
    low = domain.get("min", [-2.0, -2.0, 0.0])
    high = domain.get("max", [2.0, 2.0, 4.0])
    ground = scene.get("ground", {}).get("height", low[2])
    return low, high, ground, max(high[0] - low[0], high[1] - low[1])


def distance(a, b):
    return math.dist(a, b)


def exact_residual(tracks, scene):
    """Largest distance to an exact or ball position row beyond its radius, over L; rest rows along the surface."""
    width = volume(scene)[3]
    worst = 0.0
    for row in scene.get("constraints", []):
        if row["kind"] == "position" and row["object"] >= 0:
            x = tracks[row["object"]][row["frame"]].x
            worst = max(worst, distance(x, row["value"]) - row.get("radius", 0.0))
        elif row["kind"] == "rest" and row["object"] >= 0:
            x = tracks[row["object"]][row["frame"]].x
            worst = max(worst, distance(x[:2], row["value"][:2]))
        elif row["kind"] == "path":
            for k, point in enumerate(row["points"]):
                x = tracks[row["object"]][row["firstFrame"] + k].x
                worst = max(worst, distance(x, point) - row.get("radius", 0.0))
    return worst / width


def outside(tracks, scene):
    """Largest distance of a centre beyond the volume or below the ground [m]; 0 when all are inside."""
    low, high, ground, _ = volume(scene)
    floor = (low[0], low[1], max(low[2], ground))
    return max(max(max(floor[c] - p.x[c], p.x[c] - high[c], 0.0) for c in range(3))
               for track in tracks.values() for p in track)


def quaternion_error(tracks):
    """Largest deviation of a quaternion from unit length, and the number of sign flips."""
    worst = max(abs(math.sqrt(sum(c * c for c in p.q)) - 1.0) for track in tracks.values() for p in track)
    flips = sum(sum(a * b for a, b in zip(p.q, n.q)) < 0.0
                for track in tracks.values() for p, n in zip(track, track[1:]))
    return worst, flips


def longest_step(tracks, rate):
    """Fastest speed between two frames [m/s]."""
    return max(distance(p.x, n.x) * rate for track in tracks.values() for p, n in zip(track, track[1:]))


def velocity_error(tracks, rate):
    """Largest difference between the exported velocity and the central difference [m/s]."""
    return max(distance(track[k].v, tuple((b - a) * rate / 2.0 for a, b in zip(track[k - 1].x, track[k + 1].x)))
               for track in tracks.values() for k in range(1, len(track) - 1))


def coherence(tracks, radius, ground):
    """S(r): mean squared difference of velocities of pairs nearer than r over twice their variance, in the air."""
    numbers = sorted(tracks)
    near = pairs = 0.0
    velocities = []
    for frame in range(0, len(tracks[numbers[0]]), 5):
        poses = [tracks[n][frame] for n in numbers]
        poses = [p for p in poses if math.hypot(*p.v) > 1e-6]
        velocities += [p.v for p in poses]
        for i, a in enumerate(poses):
            for b in poses[:i]:
                if distance(a.x, b.x) < radius:
                    near += distance(a.v, b.v) ** 2
                    pairs += 1.0
    if not pairs:
        return float("nan")
    mean = [sum(v[c] for v in velocities) / len(velocities) for c in range(3)]
    variance = sum(distance(v, mean) ** 2 for v in velocities) / len(velocities)
    return near / pairs / (2.0 * variance)


def measure(folder, scene_file):
    """All figures of a run as a dictionary."""
    scene = json.loads(pathlib.Path(scene_file).read_text(encoding="utf-8"))
    tracks = read_poses(pathlib.Path(folder) / "poses.csv")
    rate = scene.get("time", {}).get("framesPerSecond", 30)
    low, high, ground, width = volume(scene)
    error, flips = quaternion_error(tracks)
    with open(pathlib.Path(folder) / "convergence.csv", newline="", encoding="utf-8") as stream:
        convergence = list(csv.DictReader(stream))
    rises = 0
    for before, after in zip(convergence, convergence[1:]):
        same = (before["Pass"], before["Stage"]) == (after["Pass"], after["Stage"])
        rises += same and float(after["E"]) > float(before["E"])
    return {
        "objects": len(tracks),
        "frames": {len(track) for track in tracks.values()},
        "exact_residual": exact_residual(tracks, scene),
        "outside": outside(tracks, scene),
        "quaternion_error": error,
        "quaternion_flips": flips,
        "top_speed": longest_step(tracks, rate),
        "velocity_error": velocity_error(tracks, rate),
        "coherence": coherence(tracks, 0.2 * width, ground),
        "energy_ratio": float(convergence[-1]["E"]) / float(convergence[0]["E"]),
        "energy_rises": rises,
        "first_stage": convergence[0]["Stage"],
        "last_stage": convergence[-1]["Stage"],
    }


LIMITS = {
    "exact_residual": 1e-9,
    "outside": 0.0,
    "quaternion_error": 1e-9,
    "quaternion_flips": 0,
    "velocity_error": 1e-9,
    "energy_ratio": 0.1,
    "energy_rises": 0,
}


def violations(figures):
    return [f"{name} is {figures[name]:.3g}, at most {limit:g} is allowed"
            for name, limit in LIMITS.items() if not figures[name] <= limit]


if __name__ == "__main__":
    found = measure(sys.argv[1], sys.argv[2])
    for name, value in found.items():
        print(f"{name:18} {value}")
    bad = violations(found)
    print("\n".join(bad))
    sys.exit(1 if bad else 0)
