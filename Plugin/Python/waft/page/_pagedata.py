# SPDX-License-Identifier: BSD-3-Clause
"""What a page shows of a folder of `waft synthesize`: plain data for its scripts, binary arrays as base64."""
import base64
import math
import os
import struct

import numpy as np

from waft.beneath import Folder
from waft.failures import InputError
from waft.page._thinning import interval, shown
from waft.reading import json_of, read_json
from waft.results import _folder
from waft.results._arrays import MOST_FRAMES, array_of, points_of, polylines
from waft.results._records import GLTF, MEASURED, REPORT, checked, record_of
from waft.results._tables import columns_of
from waft.run._chain import quality_of
from waft.scene._kinds import POSITIONAL
from waft.texts import line, warn

_MOST_ROWS = 1200  # of a plot; more cannot be told apart


def describe(path, measured=None):
    """(what there is to tell, the bytes of animation.glb); raises InputError that names the file and the lack.

    measured: see page.write_page."""
    folder = Folder(path)
    report = _report(folder)
    animation, ids, rate, frames, origin = animation_of(folder)
    every = interval(len(ids), frames)
    bounds = _folder.volume_of(folder)
    title = report.get("title") or report["scene"].removesuffix(".json").removesuffix(".waft")
    run = {"title": line(title), "scene": line(report["scene"]), "version": report["version"], "seed": report["seed"],
           "quality": quality_of(report.get("quality", "")), "stoppedEarly": report.get("stoppedEarly", False),
           "origin": origin, "rate": rate / every, "frames": math.ceil(frames / every), "every": every, "bounds": bounds,
           "marks": [_at_shown(mark, every, frames) for mark in marks_of(folder)], "plan": _plan(folder, ids, frames, every),
           "obstacles": _obstacles(folder, bounds, origin, rate, frames, every), "energy": _energy(folder), "rounds": _rounds(folder),
           "measured": _measured(folder, measured)}
    try:
        return run, shown(animation, frames, every)
    except (ValueError, LookupError, TypeError) as error:
        raise _not_ours(folder, f"its keys do not fit together: {error}") from error


def _not_ours(folder, why):
    return InputError(f"{folder.path / 'animation.glb'}: expected the animation that `waft synthesize` writes: {why}")


def _at_shown(mark, every, frames):
    """A mark with its places at the nearest frames that are shown; `frame` is the run's, `shown` the page's."""
    last = math.ceil(frames / every) - 1

    def shown(frame):
        return min(round(frame / every), last)
    return {**mark, "shown": shown(mark["frame"]), "places": [[shown(frame), *place] for frame, *place in mark["places"]]}


def _report(folder):
    _folder.needed(folder, "report.json")
    return record_of(folder, "report.json", REPORT)


def animation_of(folder):
    """Bytes of animation.glb of a Folder, and of it: ids of objects in order, frames a second, number of frames, and what its places are
    relative to [x, y, z]."""
    path = _folder.needed(folder, "animation.glb")
    content = folder.bytes("animation.glb")
    try:
        magic, _, length, size, kind = struct.unpack("<4sIII4s", content[:20])
        rest, binary = struct.unpack("<I4s", content[20 + size:28 + size])
        if (magic, kind, binary) != (b"glTF", b"JSON", b"BIN\0") or length != len(content) or 28 + size + rest != length:
            raise ValueError("it is cut, or something else")
        text = content[20:20 + size].decode("utf-8")
    except (struct.error, ValueError) as error:
        raise _not_ours(folder, str(error)) from error
    gltf = checked(json_of(text, path), GLTF, path)
    ids = [int(node["extras"]["ObjectId"]) for node in gltf["nodes"] if "extras" in node]
    above = [node for node in gltf["nodes"] if "extras" not in node]
    animation = gltf["animations"][0]
    frames = _keys(gltf, int(animation["samplers"][0]["input"]), rest)
    are_there = all(sampler["input"] < len(gltf["accessors"]) for sampler in animation["samplers"])
    keyed = [channel for channel in animation["channels"] if channel.get("target", {}).get("path") != "scale"]
    if len(keyed) != 2 * len(ids) or len(set(ids)) != len(ids) or len(above) > 1 or not frames or not are_there:
        raise _not_ours(folder, "each object once, with keys of translation and rotation")
    extras = gltf["asset"]["extras"]
    if "keys" in extras:
        frames = int(extras["keys"]["frames"])
    x, y, z = above[0].get("translation", (0.0, 0.0, 0.0)) if above else (0.0, 0.0, 0.0)
    return content, ids, float(extras["framesPerSecond"]), frames, [x, 0.0 - z, y]


def _keys(gltf, number, size):
    """How many numbers of four bytes an accessor has; 0 where they are not among so many bytes of the buffer."""
    accessors, views = gltf["accessors"], gltf["bufferViews"]
    accessor = accessors[number] if number < len(accessors) else {"count": 0, "bufferView": 0}
    view = int(accessor["bufferView"])
    if view >= len(views):
        return 0
    end = views[view].get("byteOffset", 0) + views[view]["byteLength"]
    count = int(accessor["count"])
    return count if end <= size and 4 * count <= views[view]["byteLength"] and count <= MOST_FRAMES else 0


def _rows(folder, name, columns, is_needed=True):
    """Rows of a CSV file with these columns."""
    if folder.found(name) is None and not is_needed:
        return []
    return columns_of(folder.rows(name, "a table that `waft synthesize` writes"), columns, name)


_MARK = {"Row": int, "Target": int, "ObjectId": int, "Frame": int, "Kind": str, "Status": str, "Residual": float, "Message": str}


def marks_of(folder):
    """One entry a line of constraints.csv, with the places of its rows in constraints.vtp: [frame, x, y, z, radius]."""
    name = "constraints.vtp"
    places = {}
    data = _folder.read_surface(folder, name)
    if data.GetNumberOfPoints():
        columns = data.GetPointData()
        whole = (array_of(columns, column, name, kind=int) for column in ("Row", "Target", "Kind", "Frame"))
        for point, radius, row, target, kind, frame in zip(points_of(data, name).tolist(), array_of(columns, "Radius", name).tolist(),
                                                           *(column.tolist() for column in whole)):
            if kind in POSITIONAL:
                places.setdefault((row, target), []).append([frame, *point, radius])
    return [{"row": mark["Row"], "target": mark["Target"], "object": mark["ObjectId"], "frame": mark["Frame"], "kind": mark["Kind"],
             "status": mark["Status"], "residual": mark["Residual"], "message": mark["Message"],
             "places": sorted(places.get((mark["Row"], mark["Target"]), []))}
            for mark in _rows(folder, "constraints.csv", _MARK)]


def _plan(folder, ids, frames, every):
    """Planned places of the objects in order, at every n-th frame, 16 bits a number within their box; None without a plan."""
    path = folder.found("planned.vtp")
    if path is None:
        return None
    tracks = _folder.read_surface(folder, "planned.vtp")
    own, order = polylines(tracks, "planned.vtp")
    points = points_of(tracks, "planned.vtp")[order]
    places = dict(zip(own.tolist(), points))
    if points.shape[1] != frames or not set(ids) <= places.keys():
        raise InputError(f"{path}: expected the paths of the objects of animation.glb, {frames} frames each")
    points = np.stack([places[number][::every] for number in ids])
    low, high = points.min(axis=(0, 1)), points.max(axis=(0, 1))
    steps = np.rint(65535.0 * (points - low) / np.maximum(high - low, 1e-12)).astype("<u2")
    return {"low": low.tolist(), "high": high.tolist(), "steps": _base64(steps)}


def _base64(values):
    return base64.b64encode(np.ascontiguousarray(values).tobytes()).decode()


def _obstacles(folder, bounds, origin, rate, frames, every):
    """Surfaces as they stand at frame 0, relative to the origin, and how far each is shifted at every n-th frame; of the ground its
    height alone."""
    return [{"ground": obstacle.ground, "points": _base64((obstacle.points - origin).astype("<f4")),
             "triangles": _base64(obstacle.triangles.astype("<u4")),
             "shifts": None if obstacle.shifts is None else _base64(obstacle.shifts[::every].astype("<f4"))}
            for obstacle in _folder.moving_obstacles(folder, bounds, rate, frames)]


def _energy(folder):
    """How E fell; None where no optimiser was at work."""
    names = ("E", "Ex", "Ev", "Ec")
    rows = _rows(folder, "convergence.csv", dict.fromkeys(names, float), is_needed=False)
    if not rows:
        return None
    kept = rows[::max(1, math.ceil(len(rows) / _MOST_ROWS))]
    if kept[-1] is not rows[-1]:
        kept.append(rows[-1])
    return {"columns": list(names), "rows": [list(row.values()) for row in kept]}


def _rounds(folder):
    return [{"stage": row["Stage"], "control": row["ControlRms"]}
            for row in _rows(folder, "rounds.csv", {"Stage": str, "ControlRms": float}, is_needed=False)]


def _measured(folder, measured):
    """The rows of `waft measure` for this folder; None when there are none."""
    if measured is True:
        from waft.measuring import measure

        return measure(folder.path)[0].as_json()
    if measured is None and folder.found("measure.json") is None:
        return None
    path = measured or folder.path / "measure.json"
    try:
        found = checked(read_json(path), MEASURED, path) if measured else record_of(folder, "measure.json", MEASURED)
        own = [entry for entry in found if os.path.realpath(entry["folder"]) == os.path.realpath(folder.path)] or found
        if len(own) != 1:
            raise InputError(f"{path}: expected what `waft measure --json` writes: none of its {len(found)} entries is about {folder.path}")
    except (InputError, ValueError) as error:
        if measured:
            raise InputError(str(error)) from error
        warn(f"{error}; left out")
        return None
    keys = ("row", "value", "wanted", "drifters", "met", "why")
    return {"folder": own[0]["folder"], "tracks": own[0]["tracks"], "notes": own[0]["notes"],
            "rows": [{key: row[key] for key in keys} for row in own[0]["rows"]]}
