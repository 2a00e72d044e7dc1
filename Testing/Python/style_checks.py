# SPDX-License-Identifier: BSD-3-Clause
"""Whether objects move like the database, and like things in one body of air.

Style: distributions of log-curvature, |a| and speed, pooled over objects and runs, in free flight alone (no partial
trajectories, no landings), against the segments of the database by the Kolmogorov-Smirnov distance. Coherence:
S(0.2 L), below.
"""
import math
import pathlib
import xml.etree.ElementTree as ElementTree

import result_files
from result_files import POSITION, REST, distance

KINDS = ("planned", "optimized", "spline", "straight")
WANTED = {
    "KS log-curvature": "<= 0.20 and half of the spline's, from 8 paths on",
    "KS |a|": "<= 0.35 and half of the spline's, from 8 paths on",
    "S(0.2 L)": "<= 0.65 or 0.7 of the planned, and <= 0.8 of the straight, from 20 objects on",
}
LEAST_SPEED = 1e-3  # slower samples have no direction worth speaking of [m/s]
LEAST_CURVATURE = 1e-6  # 1/m


class Run:
    """The paths of a folder, by kind, and when its objects are free and in the air."""

    def __init__(self, folder, rate):
        folder = pathlib.Path(folder)
        self.paths = {"planned": result_files.read_tracks(folder / "planned.vtp"),
                      "optimized": result_files.read_tracks(folder / "optimized.vtp")}
        tracks = self.paths["optimized"]
        rows = [row for row in result_files.read_rows(folder) if row.status == "met"]
        marks = {number: marks_of(number, track, rows) for number, track in tracks.items()}
        frames = max(len(track) for track in tracks.values())
        self.paths["spline"] = {number: spline(marks[number]) for number in marks}
        self.paths["straight"] = {number: straight(marks[number]) for number in marks}
        self.free = {number: free_frames(number, frames, rows, rate) for number in marks}
        self.flying = {number: airborne_frames(number, frames, rows) for number in marks}


def measure(folders, scene, database):
    """{measure: {kind of path: figure}} of one scene, pooled over the folders; the kinds are KINDS. S(0.2 L) is that
    of the first: runs do not share their air."""
    rate = scene.get("time", {}).get("framesPerSecond", 30)
    runs = [Run(folder, rate) for folder in folders]
    reference = database_style(database)
    table = {name: {} for name in ("KS log-curvature", "KS |a|", "KS speed", "S(0.2 L)", "samples")}
    for kind in ("planned", "optimized", "spline"):
        samples = Style()
        for run in runs:
            for number, track in run.paths[kind].items():
                samples.add(track, rate, run.free[number])
        table["KS log-curvature"][kind] = kolmogorov_smirnov(samples.log_curvature, reference.log_curvature)
        table["KS |a|"][kind] = kolmogorov_smirnov(samples.acceleration, reference.acceleration)
        table["KS speed"][kind] = kolmogorov_smirnov(samples.speed, reference.speed)
        table["samples"][kind] = float(len(samples.speed))
    radius = 0.2 * result_files.volume(scene)[3]
    for kind in ("planned", "optimized", "straight"):
        table["S(0.2 L)"][kind] = coherence(runs[0].paths[kind], runs[0].flying, radius, rate)
    return table


def marks_of(number, track, rows):
    """[(frame, place, is at rest until)] of an object in order of time: its start, positions and rests; at a rest
    the place is the resting body's own. Of balls the centre counts."""
    marks = {0: (track[0], None)}
    for row in rows:
        if row.object == number and row.kind == POSITION:
            marks[row.frame] = (row.value[:3], None)
        elif row.object == number and row.kind == REST:
            marks[row.frame] = (track[row.frame], row.until)
    return [(frame, *marks[frame]) for frame in sorted(marks)]


def free_frames(number, frames, rows, rate):
    """Frames of free flight whose neighbours are free, too: not at rest, nor a second before or after it, nor along
    a partial trajectory."""
    held = set()
    bound = {-1, frames}
    for row in rows:
        if row.object == number and row.kind == POSITION:
            held.add(row.frame)
        elif row.object == number and row.kind == REST:
            bound.update(range(row.frame - math.ceil(rate), row.until + math.ceil(rate) + 1))
    return [k for k in range(1, frames - 1)
            if not bound & {k - 1, k, k + 1} and len(held & {k - 1, k, k + 1}) < 2]


def airborne_frames(number, frames, rows):
    """All frames at which the object does not lie still."""
    still = set()
    for row in rows:
        if row.object == number and row.kind == REST:
            still.update(range(row.frame, row.until + 1))
    return [k for k in range(frames) if k not in still]


class Style:
    """Pooled samples of any number of paths, by central differences."""

    def __init__(self):
        self.log_curvature, self.acceleration, self.speed = [], [], []

    def add(self, track, rate, frames):
        for k in frames:
            if k + 1 >= len(track):
                break
            before, here, after = track[k - 1], track[k], track[k + 1]
            v = [0.5 * rate * (c - a) for a, c in zip(before, after)]
            a = [rate * rate * (c - 2.0 * b + a) for a, b, c in zip(before, here, after)]
            speed = math.hypot(*v)
            self.speed.append(speed)
            self.acceleration.append(math.hypot(*a))
            if speed >= LEAST_SPEED:
                bend = math.hypot(v[1] * a[2] - v[2] * a[1], v[2] * a[0] - v[0] * a[2], v[0] * a[1] - v[1] * a[0])
                self.log_curvature.append(math.log(max(bend / speed ** 3, LEAST_CURVATURE)))


def database_style(path):
    """The style of every segment of a motion database."""
    path = pathlib.Path(path)
    entry = next(e for e in ElementTree.parse(path).iter("DataSet") if e.get("name") == "Segments")
    data = result_files.PolyData(path.parent / entry.get("file"))
    rate = data.field["FramesPerSecond"][0]
    style = Style()
    for line in data.lines:
        style.add([data.points[i] for i in line], rate, range(1, len(line) - 1))
    return style


def kolmogorov_smirnov(a, b):
    """The largest distance between two empirical distribution functions; 1 when either is empty."""
    if not a or not b:
        return 1.0
    a, b = sorted(a), sorted(b)
    i = j = 0
    worst = 0.0
    while i < len(a) and j < len(b):
        value = min(a[i], b[j])
        while i < len(a) and a[i] == value:
            i += 1
        while j < len(b) and b[j] == value:
            j += 1
        worst = max(worst, abs(i / len(a) - j / len(b)))
    return worst


def straight(marks):
    """Places at the frames from the first to the last mark, on straight lines at an even speed."""
    return _drawn(marks, _lines)


def spline(marks):
    """The same on a cubic spline through the marks: natural ends, without speed at a rest."""
    return _drawn(marks, _cubic)


def _drawn(marks, draw):
    """Each flight from one rest to the next by draw(knots, starts still, ends still), and the rests between."""
    path, knots = [], []
    starts_still = False
    for frame, place, until in marks:
        knots.append((frame, place))
        lands = until is not None
        if not lands and frame != marks[-1][0]:
            continue
        path += draw(knots, starts_still, lands)
        path += [place] * (until - frame if lands else 1)
        knots, starts_still = [(until, place)], lands
    return path


def _lines(knots, _starts_still, _ends_still):
    return [_between(a, b, frame) for a, b in zip(knots, knots[1:]) for frame in range(a[0], b[0])]


def _between(a, b, frame):
    s = (frame - a[0]) / (b[0] - a[0])
    return tuple(p + s * (q - p) for p, q in zip(a[1], b[1]))


def _cubic(knots, starts_still, ends_still):
    """Places at the frames from the first knot up to the last, which is left out."""
    if len(knots) < 2:
        return []
    columns = [_slopes(knots, [place[c] for _, place in knots], starts_still, ends_still) for c in range(3)]
    path = []
    for k, (a, b) in enumerate(zip(knots, knots[1:])):
        step = b[0] - a[0]
        for frame in range(a[0], b[0]):
            t = (frame - a[0]) / step
            h = t * t * (3.0 - 2.0 * t)
            before, after = step * t * (1.0 - t) ** 2, step * t * t * (1.0 - t)
            path.append(tuple((1.0 - h) * a[1][c] + h * b[1][c] + before * s[k] - after * s[k + 1]
                              for c, s in enumerate(columns)))
    return path


def _slopes(knots, values, starts_still, ends_still):
    """Slopes at the knots of the cubic spline with continuous second derivative (Thomas' algorithm)."""
    n = len(knots)
    steps = [b[0] - a[0] for a, b in zip(knots, knots[1:])]
    rises = [(b - a) / s for a, b, s in zip(values, values[1:], steps)]
    lower, middle, upper, right = [0.0] * n, [0.0] * n, [0.0] * n, [0.0] * n
    middle[0], upper[0], right[0] = (1.0, 0.0, 0.0) if starts_still else (2.0, 1.0, 3.0 * rises[0])
    middle[-1], lower[-1], right[-1] = (1.0, 0.0, 0.0) if ends_still else (2.0, 1.0, 3.0 * rises[-1])
    for k in range(1, n - 1):
        lower[k], middle[k], upper[k] = 1.0 / steps[k - 1], 2.0 / steps[k - 1] + 2.0 / steps[k], 1.0 / steps[k]
        right[k] = 3.0 * (rises[k - 1] / steps[k - 1] + rises[k] / steps[k])
    for k in range(1, n):
        factor = lower[k] / middle[k - 1]
        middle[k] -= factor * upper[k - 1]
        right[k] -= factor * right[k - 1]
    slopes = [0.0] * n
    slopes[-1] = right[-1] / middle[-1]
    for k in range(n - 2, -1, -1):
        slopes[k] = (right[k] - upper[k] * slopes[k + 1]) / middle[k]
    return slopes


def coherence(tracks, flying, radius, rate, every=5):
    """S(r): mean squared difference of the velocities of pairs nearer than r over twice the variance of all, while
    both fly. Independent motions give 1, one that is the same all over 0."""
    near = pairs = 0.0
    velocities = []
    at = {}
    for number, track in tracks.items():
        for k in flying[number]:
            if k % every == 0 and 0 < k < len(track) - 1:
                v = tuple(0.5 * rate * (c - a) for a, c in zip(track[k - 1], track[k + 1]))
                at.setdefault(k, []).append((track[k], v))
                velocities.append(v)
    for present in at.values():
        for i, (x, v) in enumerate(present):
            for y, w in present[:i]:
                if distance(x, y) < radius:
                    near += distance(v, w) ** 2
                    pairs += 1.0
    if not pairs:
        return float("nan")
    mean = [sum(v[c] for v in velocities) / len(velocities) for c in range(3)]
    variance = sum(distance(v, mean) ** 2 for v in velocities) / len(velocities)
    return near / pairs / (2.0 * variance) if variance > 0.0 else 0.0
