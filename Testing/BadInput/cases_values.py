# SPDX-License-Identifier: BSD-3-Clause
"""Every value of every field of a scene: of another type, too great, too small."""
from case import LEAF, WIDE, places, scene_case, with_value, without

# Fields whose numbers have to be above nothing.
POSITIVE = ("/time/framesPerSecond", "/air/density", "/shapes/leaf/size", "/shapes/leaf/areaDensity",
            "/shapes/leaf/thickness", "/shapes/leaf/dragCoefficient", "/shapes/leaf/settlingSpeed", "/objects/0/mass",
            "/constraints/7/targets/width", "/obstacles/1/radius", "/obstacles/2/radius", "/winds/0/radius",
            "/winds/0/duration", "/vortices/0/duration", "/vortices/0/coreRadius")
NOT_NEGATIVE = ("/seed", "/objects/0/settlingSpeed", "/objects/0/clearanceRadius", "/objects/0/restHeight",
                "/constraints/0/radius", "/constraints/0/facing/tolerance", "/constraints/2/radius", "/constraints/3/radius", "/constraints/4/radius",
                "/constraints/5/radius", "/constraints/6/radius", "/objects/1/seed", "/obstacles/0/id", "/objects/0/id")
WHOLE = ("/seed", "/time/frames", "/objects/0/id", "/objects/1/count", "/constraints/0/object", "/constraints/0/frame",
         "/constraints/1/until", "/constraints/5/firstFrame", "/constraints/7/targets/count", "/obstacles/0/id",
         "/obstacles/1/motion/0/frame")
REQUIRED = ("/objects/0/shape", "/objects/0/position", "/objects/1/count", "/objects/1/region", "/objects/1/region/min",
            "/constraints/0/kind", "/constraints/0/object", "/constraints/0/frame", "/constraints/0/value", "/constraints/0/facing/direction",
            "/constraints/5/points", "/constraints/7/targets", "/constraints/7/targets/origin",
            "/constraints/7/targets/width", "/obstacles/0/kind", "/obstacles/0/min", "/obstacles/1/center",
            "/obstacles/1/radius", "/obstacles/2/top", "/obstacles/1/motion/0/frame", "/obstacles/1/motion/0/position",
            "/winds/0/direction", "/winds/0/strength", "/winds/0/radius", "/vortices/0/p1", "/vortices/0/strength",
            "/vortices/0/coreRadius")


def _is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _holder(pointer):
    return pointer.rpartition("/")[0]


def cases():
    group = "values"
    for pointer, value in places(WIDE):
        component = pointer.rpartition("/")[2]
        if component.isdigit() and _is_number(value):
            if component == "0":
                for huge in (1e308, -1e308, "0"):
                    yield scene_case(group, f"{pointer} = {huge}", with_value(WIDE, pointer, huge), _holder(pointer))
        elif _is_number(value):
            for wrong in (1e308, -1e308, "1", None):
                yield scene_case(group, f"{pointer} = {wrong}", with_value(WIDE, pointer, wrong), pointer)
        elif isinstance(value, bool):
            for wrong in (1, "true"):
                yield scene_case(group, f"{pointer} = {wrong}", with_value(WIDE, pointer, wrong), pointer)
        elif isinstance(value, str):
            yield scene_case(group, f"{pointer} = 1", with_value(WIDE, pointer, 1), pointer)
        elif isinstance(value, list) and value and _is_number(value[0]) and not pointer.endswith("/objects"):
            yield scene_case(group, f"{pointer} is short", with_value(WIDE, pointer, value[:-1]), pointer)
            yield scene_case(group, f"{pointer} is long", with_value(WIDE, pointer, value + [0]), pointer)
            yield scene_case(group, f"{pointer} = 1", with_value(WIDE, pointer, 1), pointer)
    for pointer in POSITIVE:
        for wrong in (0, -1, 1e-300):
            yield scene_case(group, f"{pointer} = {wrong}", with_value(WIDE, pointer, wrong), pointer)
    for pointer in NOT_NEGATIVE:
        yield scene_case(group, f"{pointer} = -1", with_value(WIDE, pointer, -1), pointer)
    for pointer in WHOLE:
        for wrong in (1.5, 2 ** 64):
            yield scene_case(group, f"{pointer} = {wrong}", with_value(WIDE, pointer, wrong), pointer)
    for pointer in REQUIRED:
        yield scene_case(group, f"without {pointer}", without(WIDE, pointer), _holder(pointer))
    for rate in (1e12, 1e-12, 1e-308):
        yield scene_case(group, f"{rate} frames a second", with_value(LEAF, "/time/framesPerSecond", rate),
                         "/time/framesPerSecond")
    for frames in (0, 1, -5, 10 ** 9):
        yield scene_case(group, f"{frames} frames", with_value(LEAF, "/time/frames", frames), "/time/frames")
    for name, low, high in (("turned over", [2, 2, 4], [-2, -2, 0]), ("flat", [-2, -2, 0], [2, 2, 0]),
                            ("flat to a hair", [-2, -2, 0], [2, 2, 1e-9]), ("a point", [1, 1, 1], [1, 1, 1]),
                            ("of 1e100 m", [-1e100, -1e100, 0], [1e100, 1e100, 1e100]),
                            ("of 1e-100 m", [0, 0, 0], [1e-100, 1e-100, 1e-100])):
        yield scene_case(group, f"a volume {name}", LEAF | {"domain": {"min": low, "max": high}}, "/domain")
    yield scene_case(group, "an orientation of length 0", with_value(WIDE, "/objects/0/orientation", [0, 0, 0, 0]),
                     "/objects/0/orientation")
    yield scene_case(group, "a wind without a direction", with_value(WIDE, "/winds/0/direction", [0, 0, 0]),
                     "/winds/0/direction")
    yield scene_case(group, "a vortex without length", with_value(WIDE, "/vortices/0/p2", [0.0, 0.0, 1.0]), "/vortices/0")
    yield scene_case(group, "a box turned over", with_value(WIDE, "/obstacles/0/min", [1.6, -0.9, 0.6]), "/obstacles/0")
    yield scene_case(group, "a cylinder without height", with_value(WIDE, "/obstacles/2/top", [-1.5, -1.5, 0.1]),
                     "/obstacles/2")
    yield scene_case(group, "u along v", with_value(WIDE, "/constraints/7/targets/v", [1.0, 0.0, 0.0]),
                     "/constraints/7/targets")
    yield scene_case(group, "a colour above 1", with_value(WIDE, "/shapes/leaf/color", [0.1, 2.0, 0.1]),
                     "/shapes/leaf/color")
    yield scene_case(group, "a seed of 2^53", with_value(WIDE, "/seed", 2 ** 53), "/seed")
    # Large forces are right: what a stage found is only asked to be finite.
    for size in (100, 3000):
        yield scene_case(group, f"a leaf of {size} m", with_value(LEAF, "/shapes/leaf/size", size), status=(0, 3))
    yield scene_case(group, "many objects", with_value(WIDE, "/objects/1/count", 10 ** 7), "/objects/1/count")
