# SPDX-License-Identifier: BSD-3-Clause
"""Constraints that are none, and constraints that cannot be met."""
from case import LEAF, WIDE, scene_case, with_value

POSITION = {"kind": "position", "object": 0, "frame": 30, "value": [0.0, 0.0, 1.6]}


def _constrained(*constraints, **more):
    return LEAF | {"constraints": list(constraints)} | more


def cases():
    group = "constraints"
    frames = ("/constraints/0/frame", "/constraints/1/frame", "/constraints/1/until", "/constraints/2/frame",
              "/constraints/3/frame", "/constraints/4/frame", "/constraints/5/firstFrame", "/constraints/6/frame",
              "/constraints/7/frame", "/obstacles/1/motion/1/frame")
    for pointer in frames:
        for frame in (31, -1, 2 ** 31):
            yield scene_case(group, f"{pointer} = {frame}", with_value(WIDE, pointer, frame), pointer)
    for place in (0, 1, 2, 3, 4, 5):
        for number in (99, -2, 2 ** 31):
            yield scene_case(group, f"/constraints/{place}/object = {number}",
                             with_value(WIDE, f"/constraints/{place}/object", number), f"/constraints/{place}/object")
    for place in (2, 3, 4, 5):
        yield scene_case(group, f"any object in row {place}", with_value(WIDE, f"/constraints/{place}/object", -1),
                         f"/constraints/{place}/object")
    for place in range(8):
        for kind in ("Position", "land", ""):
            yield scene_case(group, f"row {place} of kind '{kind}'", with_value(WIDE, f"/constraints/{place}/kind", kind),
                             f"/constraints/{place}/kind")
    yield scene_case(group, "until before frame", with_value(WIDE, "/constraints/1/until", 20), "/constraints/1/until")
    yield scene_case(group, "an orientation of length 0", with_value(WIDE, "/constraints/4/value", [0, 0, 0, 0]),
                     "/constraints/4/value")
    yield scene_case(group, "a path beyond the last frame", with_value(WIDE, "/constraints/5/firstFrame", 30), "/constraints/5")
    yield scene_case(group, "a path of no points", with_value(WIDE, "/constraints/5/points", []), "/constraints/5/points")
    keyframe = "/constraints/6"
    for name, value in (("no objects", []), ("an object twice", [0, 0]), ("an object that is not there", [99]),
                        ("-1 with optimal", [-1]), ("a text for an object", ["0"])):
        yield scene_case(group, f"a keyframe of {name}", with_value(WIDE, f"{keyframe}/objects", value), keyframe)
    for name, value in (("more points than objects", [[0.0, 0.0, 1.5], [0.5, 0.0, 1.5]]),
                        ("a point of two numbers", [[0.0, 1.5]]), ("a flat list", [0.0, 0.0, 1.5])):
        yield scene_case(group, f"a keyframe of {name}", with_value(WIDE, f"{keyframe}/targets/points", value), keyframe)
    for velocity in ("fast", [0, 0], 5, None):
        yield scene_case(group, f"a keyframe's velocity {velocity}", with_value(WIDE, f"{keyframe}/velocity", velocity),
                         f"{keyframe}/velocity")
    for assign in ("best", "", 1):
        yield scene_case(group, f"assign '{assign}'", with_value(WIDE, f"{keyframe}/assign", assign), f"{keyframe}/assign")
    for side in ("left", "", 1, None):
        yield scene_case(group, f"faceUp {side}", with_value(WIDE, "/constraints/1/faceUp", side), "/constraints/1/faceUp")
    yield scene_case(group, "faceUp without rest", with_value(WIDE, f"{keyframe}/faceUp", "up"), keyframe)
    yield scene_case(group, "facing nowhere", with_value(WIDE, "/constraints/0/facing/direction", [0.0, 0.0, 0.0]),
                     "/constraints/0/facing")
    yield scene_case(group, "until without rest", with_value(WIDE, f"{keyframe}/until", 30), keyframe)
    yield scene_case(group, "targets of two kinds", with_value(WIDE, f"{keyframe}/targets/text", "I"), keyframe)
    yield scene_case(group, "targets of no kind", with_value(WIDE, f"{keyframe}/targets", {}), keyframe)
    yield scene_case(group, "a class that nothing has",
                     with_value(WIDE, f"{keyframe}/targets/classes", ["blue"]), keyframe, status=(2, 3))
    yield scene_case(group, "classes of another number", with_value(WIDE, f"{keyframe}/targets/classes", ["green"] * 3),
                     keyframe)
    yield scene_case(group, "a word more often than objects", with_value(WIDE, "/constraints/7/targets/count", 3),
                     "/constraints/7")
    yield scene_case(group, "an id twice", with_value(WIDE, "/obstacles/1/id", 7), "/obstacles/1")
    yield scene_case(group, "an object's id twice", with_value(WIDE, "/objects/0/id", 1), "/objects")
    yield scene_case(group, "keys of motion in another order", with_value(WIDE, "/obstacles/1/motion/0/frame", 30),
                     "/obstacles/1/motion")
    yield scene_case(group, "a region outside the volume",
                     with_value(WIDE, "/objects/1/region", {"min": [5, 5, 5], "max": [6, 6, 6]}), "/objects/1/region")
    yield scene_case(group, "a region within an obstacle", with_value(WIDE, "/obstacles/1/radius", 5.2), "/objects/1/region")
    yield scene_case(group, "a region turned over",
                     with_value(WIDE, "/objects/1/region", {"min": [1, 1, 3], "max": [-1, -1, 2]}), "/objects/1/region")

    unmet = {
        "in an obstacle": _constrained(POSITION, obstacles=[{"kind": "sphere", "center": [0.0, 0.0, 1.5], "radius": 0.3}]),
        "outside the volume": _constrained(POSITION | {"value": [0.0, 0.0, 9.0]}),
        "two places at once": _constrained(POSITION, POSITION | {"value": [0.5, 0.0, 1.6]}),
        "too far in a frame": _constrained(POSITION | {"frame": 29}, POSITION | {"value": [1.9, 1.9, 3.9]}),
        "another start": _constrained(POSITION | {"frame": 0}),
    }
    for name, scene in unmet.items():
        yield scene_case(group, f"constraint that cannot be met: {name}", scene, "row 0" if "two" not in name else "row ",
                         status=(3,))
