# SPDX-License-Identifier: BSD-3-Clause
"""Wind files that are damaged, or on no lattice that a wind can be on."""
import pathlib
import random

import good_files as good
from case import LEAF, scene_case

FIXTURE = pathlib.Path(__file__).resolve().parent.parent / "Pipeline" / "Fixtures" / "wind_0000.vdb"


def _wind(file):
    return LEAF | {"winds": [{"file": file}]}


def _fields(**fields):
    return LEAF | {"winds": [{"file": "w.vti"} | fields]}


def vtis():
    whole = good.vti()
    yield "cut in half", whole[:len(whole) // 2]
    yield "empty", b""
    yield "junk", b"this is no image\n"
    yield "zeros", bytes(500)
    for name, text in (("0", "0 0 0"), ("-1", "-4 -4 -4"), ("NaN", "nan nan nan"), ("1e308", "1e308 1e308 1e308"),
                       ("1e-308", "1e-308 1e-308 1e-308"), ("one 0", "4 0 4"), ("two numbers", "4 4"), ("a word", "a b c")):
        yield f"spacing {name}", good.vti(spacing=text)
    for name, text in (("NaN", "nan 0 0"), ("infinite", "inf 0 0"), ("1e308", "1e308 0 0")):
        yield f"origin {name}", good.vti(origin=text)
    for name, text in (("turned", "0 -1 0 1 0 0 0 0 1"), ("mirrored", "-1 0 0 0 1 0 0 0 1"), ("zero", "0 0 0 0 0 0 0 0 0"),
                       ("NaN", "nan 0 0 0 1 0 0 0 1")):
        yield f"direction {name}", good.vti(direction=text)
    for name, text in (("empty", "0 -1 0 -1 0 -1"), ("turned over", "1 0 1 0 1 0"), ("of 1e15 points", "0 99999 0 99999 0 99999"),
                       ("of 2^31-1", "0 2147483647 0 1 0 1"), ("of five numbers", "0 1 0 1 0"), ("of words", "a b c d e f"),
                       ("far below 0", "-2147483648 2147483647 0 1 0 1")):
        yield f"extent {name}", good.vti(extent=text)
    yield "a piece beyond the extent", good.vti(piece="0 9 0 9 0 9")
    yield "fewer numbers than points", good.vti(values="0.1 0 0")
    yield "fewer numbers than points of a part", good.vti(extent="0 1 0 5 0 1", piece="0 1 0 1 0 1", values="0.1 0 0 " * 7)
    yield "NaN in it", good.vti(values="nan 0 0 " * 8)
    yield "1e308 in it", good.vti(values="1e308 0 0 " * 8, kind="Float64")
    yield "one component", good.vti(components=1, values="0 " * 8)
    yield "four components", good.vti(components=4, values="0 " * 32)
    yield "neither Wind nor Velocity", good.vti(name="Draft")
    yield "text in place of numbers", good.vti(kind="String", values="65 0 " * 24)
    yield "more texts than points", good.vti(kind="String", values="65 0 " * 24, components=1)
    yield "a piece beside the extent", good.vti(piece="0 1 0 1 1 2")
    yield "an unknown type", good.vti(kind="Float128")
    yield "2e8 points that are packed", good.vti_packed(584, 584, good.packed_zeros(12 * 585 ** 3))
    yield "room for 2e8 points, and values for eight", good.vti_packed(584, 1, good.packed_zeros(12 * 8) + bytes(200000))
    yield "of another kind", whole.replace(b'"ImageData"', b'"PolyData"', 1)


def pvds():
    yield "empty", b""
    yield "junk", b"no collection\n"
    yield "no entries", good.pvd()
    yield "cut in half", good.pvd((0, "a.vti"), (1, "b.vti"))[:120]
    yield "a file that is not there", good.pvd((0, "none.vti"))
    yield "a file of another kind", good.pvd((0, "m.obj"))
    yield "itself", good.pvd((0, "w.pvd"))
    yield "one time twice", good.pvd((0, "a.vti"), (0, "b.vti"))
    yield "time nan", good.pvd(("nan", "a.vti"), (1, "b.vti"))
    yield "time inf", good.pvd((0, "a.vti"), ("inf", "b.vti"))
    yield "time abc", good.pvd((0, "a.vti"), ("abc", "b.vti"))
    yield "time of nothing", good.pvd((0, "a.vti"), ("", "b.vti"))
    yield "frames of another spacing", good.pvd((0, "a.vti"), (1, "spacing.vti"))
    yield "frames of another extent", good.pvd((0, "a.vti"), (1, "extent.vti"))
    yield "frames of another origin", good.pvd((0, "a.vti"), (1, "origin.vti"))
    yield "frames of another array", good.pvd((0, "a.vti"), (1, "velocity.vti"))
    yield "a damaged frame", good.pvd((0, "a.vti"), (1, "damaged.vti"))
    yield "a frame of 1e15 points", good.pvd((0, "a.vti"), (1, "huge.vti"))


BESIDE = {
    "a.vti": good.vti(), "b.vti": good.vti(), "m.obj": good.obj(),
    "spacing.vti": good.vti(spacing="2 2 2"), "origin.vti": good.vti(origin="0 0 0"),
    "extent.vti": good.vti(extent="0 1 0 1 0 2", values="0 " * 36), "velocity.vti": good.vti(name="Velocity"),
    "damaged.vti": good.vti()[:300], "huge.vti": good.vti(extent="0 99999 0 99999 0 99999"),
}


def vdbs():
    whole = FIXTURE.read_bytes()
    for at in (0, 4, 60, 100, 200, 1000, 5000, len(whole) - 8):
        yield f"cut at {at}", whole[:at]
    for at in (8, 12, 40, 60, 100, 150, 300):
        yield f"damaged at {at}", whole[:at] + b"\xff" * 8 + whole[at + 8:]
    changed = bytearray(whole)
    numbers = random.Random(5)
    for _ in range(60):
        changed[numbers.randrange(100, len(changed))] = numbers.randrange(256)
    yield "damaged at 60 places", bytes(changed)
    yield "junk", b"this is no volume\n"
    yield "zeros", bytes(2000)


def cases():
    group = "winds"
    pointer = "/winds/0"
    for name, content in vtis():
        yield scene_case(group, f"vti: {name}", _wind("w.vti"), pointer, files={"w.vti": content})
    for name, content in pvds():
        yield scene_case(group, f"pvd: {name}", _wind("w.pvd"), pointer, files={"w.pvd": content, **BESIDE})
    for name, content in vdbs():
        # Bytes that are values, and no length of anything, may be other ones.
        status = (0, 2) if "damaged" in name else (2,)
        yield scene_case(group, f"vdb: {name}", _wind("w.vdb"), *([pointer] if status == (2,) else []), status=status,
                         files={"w.vdb": content})
    for file in ("none.vti", "none.pvd", "none.vdb", "w.txt", "w"):
        yield scene_case(group, f"file {file}", _wind(file), pointer, files={"w.txt": b"x", "w": b"x"})
    yield scene_case(group, "a folder", _wind("w.vti"), pointer, files={"w.vti/x": b""})
    yield scene_case(group, "a velocity beside another wind", LEAF | {"winds": [{"file": "w.vti"}, {"file": "w.vti"}]},
                     "/winds", files={"w.vti": good.vti(name="Velocity")})
    yield scene_case(group, "a wind that is right", _wind("w.vti"), files={"w.vti": good.vti()}, status=(0,))
    for name, times in (("that is right", (0, 1)), ("whose times fall", (1, 0))):
        yield scene_case(group, f"a series {name}", _wind("w.pvd"), status=(0,),
                         files=BESIDE | {"w.pvd": good.pvd(*zip(times, ("a.vti", "b.vti")))})
    for name in ("U", "vel"):
        yield scene_case(group, f"a velocity by the name {name}", _wind("w.vti"), status=(0,),
                         files={"w.vti": good.vti(name=name)})
    yield scene_case(group, "what there is in place of a wind", _wind("w.vti"), pointer, "`Draft` (3) of points", "`array`",
                     files={"w.vti": good.vti(name="Draft")})
    yield scene_case(group, "a field of another name", _fields(array="Draft"), status=(0,),
                     files={"w.vti": good.vti(name="Draft")})
    yield scene_case(group, "a field that is not there", _fields(array="Draft"), pointer, "`Draft`", "`Wind` (3)",
                     files={"w.vti": good.vti()})
    for field, values in (("array", ("", 1, ["Wind"], "a\u202eb")), ("up", ("x", "Y", 2, None)),
                          ("firstFrame", (-1, 1.5, 10**7, "0")), ("scale", (0, -1, 1e308, "2", None))):
        for value in values:
            yield scene_case(group, f"{field} {value!r}", _fields(**{field: value}), f"{pointer}/{field}",
                             files={"w.vti": good.vti()})
    yield scene_case(group, "a field outside of the volume", _wind("w.vti"), "outside the volume",
                     files={"w.vti": good.vti(origin="90 90 90")}, status=(0,))
