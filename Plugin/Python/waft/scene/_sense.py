# SPDX-License-Identifier: BSD-3-Clause
"""What the schema of scenes cannot say: how fields of one entry go together. The reader of scenes has the same rules."""
import math

from waft.scene import _schema

_ACROSS, _UP = [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]  # u and v of targets
_CORNERS = {"min": [-2.0, -2.0, 0.0], "max": [2.0, 2.0, 4.0]}  # of the volume
_SMALLEST = 1e-12  # of a direction
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
    if definition == "analyticWind":
        yield "direction", "a direction that is not zero", not math.hypot(*entry["direction"]) > _SMALLEST
    if definition == "domain":
        corners = {**_CORNERS, **entry}
        yield ("max" if "max" in entry else "min", "a volume whose max is above its min along each axis",
               any(a >= b for a, b in zip(corners["min"], corners["max"])))
    if "region" in entry and {"min", "max"} <= entry["region"].keys():
        region = entry["region"]
        yield "region", "a region whose max is not below its min", any(a > b for a, b in zip(region["min"], region["max"]))
    if definition.endswith("Targets"):
        for field in ("u", "v"):
            yield field, "a direction that is not zero", not math.hypot(*entry.get(field, _ACROSS)) > _SMALLEST
        yield ("v" if "v" in entry else "u", "directions u and v that are not parallel",
               _sine(entry.get("u", _ACROSS), entry.get("v", _UP)) < _APART)
    for field in ("orientation", "value") if definition == "orientationConstraint" else ("orientation",):
        yield field, "a quaternion [w, x, y, z] that is not zero", field in entry and not math.hypot(*entry[field]) > 0.0
    frames = [step["frame"] for step in entry.get("motion", ())]
    yield "motion", "frames that grow", any(after <= before for before, after in zip(frames, frames[1:]))


def _sine(u, v):
    """Of the angle between two directions that are not zero."""
    (a, b, c), (x, y, z) = ([part / math.hypot(*way) for part in way] for way in (u, v))
    return math.hypot(b * z - c * y, c * x - a * z, a * y - b * x)
