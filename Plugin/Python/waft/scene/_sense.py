# SPDX-License-Identifier: BSD-3-Clause
"""What the schema of scenes cannot say: how fields of one entry go together. The reader of scenes has the same rules."""
import itertools
import math
import os
import unicodedata

from waft.scene import _schema

_ACROSS, _UP = [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]  # u and v of targets
_CORNERS = {"min": [-2.0, -2.0, 0.0], "max": [2.0, 2.0, 4.0]}  # of the volume
_SMALLEST = 1e-12  # of a direction, and of a quaternion
_SHORTEST, _SLENDER = 1e-3, 1000.0  # side of the volume [m], and how many times as long another may be
_SURFACES = (".vtp", ".obj", ".ply", ".stl", ".glb")
_PICTURES = (".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp")
# Endings that the files of an entry have: {(definition, field): endings}
_ENDINGS = {("shape", "mesh"): _SURFACES + _PICTURES, ("shape", "texture"): _PICTURES, ("meshObstacle", "file"): _SURFACES,
            ("meshTargets", "mesh"): _SURFACES, ("imageTargets", "image"): _PICTURES}
_APART = 1e-3  # sine of the angle between two directions


def nonsense(entry, definition):
    """(field, what was expected, what was found) of the first thing that makes no sense in an entry that is right by the schema; None
    when there is none."""
    for field, expected, is_wrong in _rules(entry, definition):
        if is_wrong:
            return field, expected, _schema.shown(entry[field])
    return None


def _rules(entry, definition):
    """(field, what is expected, whether it is otherwise)"""
    if definition == "boxObstacle":
        yield "max", "a corner above min along each axis", any(a >= b for a, b in zip(entry["min"], entry["max"]))
    if definition == "cylinderObstacle":
        yield "top", "a point apart from base", entry["base"] == entry["top"]
    if definition == "vortex":
        yield "p2", "a pole apart from p1", entry["p1"] == entry["p2"]
    if definition in ("analyticWind", "windFront"):
        yield "direction", "a direction that is not zero", not math.hypot(*entry["direction"]) > _SMALLEST
    if definition == "domain":
        corners = {**_CORNERS, **entry}
        sides = [b - a for a, b in zip(corners["min"], corners["max"])]
        field = "max" if "max" in entry else "min"
        yield field, "a volume whose max is above its min along each axis", min(sides) <= 0.0
        yield (field, f"a volume of sides from {_SHORTEST:g} m on, the longest at most {_SLENDER:g} times the shortest",
               min(sides) < _SHORTEST or max(sides) > _SLENDER * min(sides))
    if "region" in entry and {"min", "max"} <= entry["region"].keys():
        region = entry["region"]
        yield "region", "a region whose max is not below its min", any(a > b for a, b in zip(region["min"], region["max"]))
    if definition.endswith("Targets"):
        for field in ("u", "v"):
            yield field, "a direction that is not zero", not math.hypot(*entry.get(field, _ACROSS)) > _SMALLEST
        yield ("v" if "v" in entry else "u", "directions u and v that are not parallel",
               _sine(entry.get("u", _ACROSS), entry.get("v", _UP)) < _APART)
    for field in ("orientation", "value") if definition == "orientationConstraint" else ("orientation",):
        yield field, "a quaternion [w, x, y, z] that is not zero", field in entry and not math.hypot(*entry[field]) > _SMALLEST
    for (kind, field), endings in _ENDINGS.items():
        yield (field, f"a file that ends with {', '.join(endings)}",
               kind == definition and field in entry and os.path.splitext(entry[field])[1].lower() not in endings)
    if definition == "shape":
        yield "size", "no size of a mesh that is taken as it is (align)", "size" in entry and entry.get("align") is False
    if definition == "textTargets":
        yield "text", "a text with something to draw", not entry["text"].strip()
        yield ("text", "letters that stand one after the other from left to right",
               any(unicodedata.bidirectional(letter) in ("R", "AL") for letter in entry["text"]))
    if definition == "pointTargets" and "classes" in entry:
        yield "classes", f"{len(entry['points'])} classes, one a point", len(entry["classes"]) != len(entry["points"])
    if "facing" in entry:
        yield "facing", "a direction that is not zero", not math.hypot(*entry["facing"]["direction"]) > _SMALLEST
    if "until" in entry:
        first = latest(entry["frame"])
        yield "until", f"a frame from {first} on, where it begins", entry["until"] < first
    if isinstance(entry.get("frame"), dict):
        yield "frame", "a window whose `to` is not before its `from`", entry["frame"]["to"] < entry["frame"]["from"]
    if definition == "keyframeConstraint" and "objects" in entry:
        named = [number for number in entry["objects"] if number != -1]
        yield "objects", "each object once", len(set(named)) < len(named)
        yield "objects", "ids of objects; -1 (any other) only with assign inOrder", (
            len(named) < len(entry["objects"]) and entry.get("assign", "optimal") != "inOrder")
        wanted = targets_of(entry)
        yield "objects", f"{wanted} or more, as there are targets", len(entry["objects"]) < wanted
    frames = [step["frame"] for step in entry.get("motion", ())]
    yield "motion", "frames that grow", any(after <= before for before, after in zip(frames, frames[1:]))


def targets_of(row):
    """How many targets a keyframe has by itself; 0 where it has one an object."""
    targets = row["targets"]
    return len(targets["points"]) if "points" in targets else int(targets.get("count", 0))


def last_frames(data):
    """(what has it, the last frame that it names) of each row and each obstacle of a scene."""
    for number, row in enumerate(data.get("constraints", ())):
        yield f"constraint {number}", last_frame(row)
    for number, obstacle in enumerate(data.get("obstacles", ())):
        yield f"obstacle {number}", max((step["frame"] for step in obstacle.get("motion", ())), default=0)


def latest(frame):
    """Of a frame, or of a window of frames."""
    return frame["to"] if isinstance(frame, dict) else frame


def last_frame(row):
    """Of a row."""
    return max(latest(row.get("frame", 0)), row.get("until", 0), row.get("firstFrame", 0) + len(row.get("points", (0,))) - 1)


def classes_of(data):
    """Names of classes that shapes and objects have."""
    entries = itertools.chain((shape for name, shape in data.get("shapes", {}).items() if not name.startswith("_")), data.get("objects", ()))
    return {entry["class"] for entry in entries if entry.get("class")}


def _sine(u, v):
    """Of the angle between two directions that are not zero."""
    (a, b, c), (x, y, z) = ([part / math.hypot(*way) for part in way] for way in (u, v))
    return math.hypot(b * z - c * y, c * x - a * z, a * y - b * x)
