# SPDX-License-Identifier: BSD-3-Clause
"""What a page shows of a folder of `waft synthesize`: plain data for its scripts, binary arrays as base64."""
import base64
import json
import math
import os
import struct

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from waft import _folder
from waft._kinds import POSITIONAL
from waft.beneath import Folder
from waft.failures import BadInput
from waft.reading import read_json
from waft.texts import warn

_MOST_ROWS = 1200  # of a plot; more cannot be told apart


def describe(path, measured=None):
    """(what there is to tell, the bytes of animation.glb); raises BadInput that names the file and the lack.

    measured: see page.write_page."""
    folder = Folder(path)
    report = _report(folder)
    animation, ids, rate, frames = animation_of(folder)
    bounds = _folder.bounds_of(folder)
    title = report.get("title") or report["scene"].removesuffix(".json").removesuffix(".waft")
    run = {"title": title, "scene": report["scene"], "version": report["version"], "seed": report["seed"],
           "quality": report.get("quality", ""), "stoppedEarly": report.get("stoppedEarly", False),
           "rate": rate, "frames": frames, "bounds": bounds, "marks": marks_of(folder), "plan": _plan(folder, ids, frames),
           "obstacles": _obstacles(folder, bounds, rate, frames), "energy": _energy(folder), "rounds": _rounds(folder),
           "measured": _measured(folder, measured)}
    return run, animation


def _report(folder):
    path = _folder.needed(folder, "report.json")
    report = folder.json("report.json")
    if not isinstance(report, dict) or not {"version", "scene", "seed"} <= report.keys():
        raise BadInput(f"{path}: expected the report of `waft synthesize`, with version, scene and seed")
    return report


def animation_of(folder):
    """Bytes of animation.glb of a Folder, and of it: ids of objects in order, frames a second, number of frames."""
    path = _folder.needed(folder, "animation.glb")
    content = folder.bytes("animation.glb")
    try:
        magic, _, length, size, kind = struct.unpack("<4sIII4s", content[:20])
        if magic != b"glTF" or kind != b"JSON" or length != len(content):
            raise ValueError("it is cut, or something else")
        gltf = json.loads(content[20:20 + size])
        ids = [int(node["extras"]["ObjectId"]) for node in gltf["nodes"]]
        rate = float(gltf["asset"]["extras"]["framesPerSecond"])
        animation = gltf["animations"][0]
        if len(animation["channels"]) != 2 * len(ids):
            raise ValueError("not every object has keys of translation and rotation")
        frames = int(gltf["accessors"][animation["samplers"][0]["input"]]["count"])
    except (struct.error, ValueError, KeyError, IndexError, TypeError) as error:
        raise BadInput(f"{path}: expected the animation that `waft synthesize` writes: {error}") from error
    return content, ids, rate, frames


def _rows(folder, name, is_needed=True):
    """Rows of a CSV file as dictionaries."""
    if folder.found(name) is None and not is_needed:
        return []
    return folder.rows(name, "a table that `waft synthesize` writes")


def _number(row, name, path):
    """A number of a table's row, None where it is not finite."""
    try:
        value = float(row[name])
    except (KeyError, TypeError, ValueError) as error:
        raise BadInput(f"{path}: column {name}: expected numbers, found '{row.get(name)}'") from error
    return value if math.isfinite(value) else None


def marks_of(folder):
    """One entry a line of constraints.csv, with the places of its rows in constraints.vtp: [frame, x, y, z, radius]."""
    name = "constraints.vtp"
    places = {}
    data = _folder.read_surface(folder, name)
    if data.GetNumberOfPoints():
        points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
        columns = [_folder.array_of(data.GetPointData(), column, name) for column in ("Row", "Target", "Kind", "Frame", "Radius")]
        for point, row, target, kind, frame, radius in zip(points, *columns):
            if kind in POSITIONAL:
                places.setdefault((int(row), int(target)), []).append([int(frame), *point.tolist(), float(radius)])
    marks = []
    for line in _rows(folder, "constraints.csv"):
        row, target, owner, frame, residual = (_number(line, column, "constraints.csv")
                                               for column in ("Row", "Target", "ObjectId", "Frame", "Residual"))
        marks.append({"row": row, "target": target, "object": owner, "frame": frame, "kind": line["Kind"],
                      "status": line["Status"], "residual": residual, "message": line["Message"],
                      "places": sorted(places.get((row, target), []))})
    return marks


def _plan(folder, ids, frames):
    """Planned places of the objects in order, 16 bits a number within their box; None without a plan."""
    path = folder.found("planned.vtp")
    if path is None:
        return None
    tracks = _folder.read_surface(folder, "planned.vtp")
    own, order = _folder.polylines(tracks, "planned.vtp")
    points = vtk_to_numpy(tracks.GetPoints().GetData()).astype(float)[order]
    places = dict(zip(own.tolist(), points))
    if points.shape[1] != frames or not set(ids) <= places.keys():
        raise BadInput(f"{path}: expected the paths of the objects of animation.glb, {frames} frames each")
    points = np.stack([places[number] for number in ids])
    low, high = points.min(axis=(0, 1)), points.max(axis=(0, 1))
    steps = np.rint(65535.0 * (points - low) / np.maximum(high - low, 1e-12)).astype("<u2")
    return {"low": low.tolist(), "high": high.tolist(), "steps": _base64(steps)}


def _base64(values):
    return base64.b64encode(np.ascontiguousarray(values).tobytes()).decode()


def _obstacles(folder, bounds, rate, frames):
    """Surfaces as they stand at frame 0, and how far each is shifted at every frame; of the ground its height alone."""
    return [{"ground": obstacle.ground, "points": _base64(obstacle.points.astype("<f4")),
             "triangles": _base64(obstacle.triangles.astype("<u4")),
             "shifts": None if obstacle.shifts is None else _base64(obstacle.shifts.astype("<f4"))}
            for obstacle in _folder.moving_obstacles(folder, bounds, rate, frames)]


def _energy(folder):
    """How E fell; None where no optimiser was at work."""
    rows = _rows(folder, "convergence.csv", is_needed=False)
    if not rows:
        return None
    columns = [name for name in ("E", "Ex", "Ev", "Ec") if name in rows[0]]
    kept = rows[::max(1, math.ceil(len(rows) / _MOST_ROWS))]
    if kept[-1] is not rows[-1]:
        kept.append(rows[-1])
    return {"columns": columns, "rows": [[_number(row, name, "convergence.csv") for name in columns] for row in kept]}


def _rounds(folder):
    return [{"stage": row.get("Stage", ""), "control": _number(row, "ControlRms", "rounds.csv")}
            for row in _rows(folder, "rounds.csv", is_needed=False)]


def _measured(folder, measured):
    """The rows of `waft measure` for this folder; None when there are none."""
    if measured is True:
        from waft.measuring import measure

        return measure(folder.path)[0].as_json()
    if measured is None and folder.found("measure.json") is None:
        return None
    path = measured or folder.path / "measure.json"
    try:
        found = read_json(path) if measured else folder.json("measure.json")
        own = [entry for entry in found if os.path.realpath(entry["folder"]) == os.path.realpath(folder.path)] or found
        if len(own) != 1:
            raise ValueError(f"none of its {len(found)} entries is about {folder.path}")
        keys = ("row", "value", "wanted", "drifters", "met", "why")
        return {"folder": own[0]["folder"], "tracks": own[0]["tracks"], "notes": list(own[0]["notes"]),
                "rows": [{key: row[key] for key in keys} for row in own[0]["rows"]]}
    except (BadInput, TypeError, KeyError, ValueError) as error:
        lack = f"{path}: expected what `waft measure --json` writes: {error}"
        if measured:
            raise BadInput(lack) from error
        warn(f"{lack}; left out")
        return None
