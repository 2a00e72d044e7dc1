# SPDX-License-Identifier: BSD-3-Clause
"""Makes the corpora that the fuzzers start from, out of the cases of bad input, right files and damaged ones, and what fuzzers found.

    pvpython make_corpus.py FOLDER TARGET...      writes FOLDER/TARGET/NAME, the same bytes each time
"""
import json
import pathlib
import random
import re
import shutil
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "BadInput"))

import cases_forms  # noqa: E402
import cases_meshes  # noqa: E402
import cases_targets  # noqa: E402
import cases_winds  # noqa: E402
import good_files as good  # noqa: E402
from case import LEAF, WIDE, places, with_value  # noqa: E402

FOLDER = pathlib.Path(sys.argv[1])
LARGEST = 4000  # bytes of an input
# As the targets number them.
PICTURES = (".png", ".jpg", ".tif", ".bmp")
MESHES = (".obj", ".ply", ".stl", ".glb", ".vtp", ".gltf")
WINDS = (".vti", ".pvd", ".vdb")


def write(target, name, content):
    if len(content) <= LARGEST:
        path = FOLDER / target / re.sub(r"[^a-z0-9.]+", "-", name.lower()).strip("-")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


def of_kind(kinds, suffix, content):
    return bytes([kinds.index(suffix)]) + content


def scene_texts():
    write("SceneText", "leaf", json.dumps(LEAF).encode())
    write("SceneText", "wide", json.dumps(WIDE).encode())
    for number, (pointer, value) in enumerate(places(WIDE)):
        if number % 31 == 3:
            write("SceneText", f"null{pointer}", json.dumps(with_value(WIDE, pointer, None)).encode())
            write("SceneText", f"huge{pointer}", json.dumps(with_value(WIDE, pointer, 1e308)).encode())
    write("SceneText", "a region within an obstacle", json.dumps(with_value(WIDE, "/obstacles/1/radius", 5.2)).encode())


def pictures():
    for make, suffix in ((good.png, ".png"), (good.jpg, ".jpg"), (good.tif, ".tif"), (good.bmp, ".bmp")):
        write("Pictures", f"right{suffix}", of_kind(PICTURES, suffix, make()))
    for name, content in cases_targets.damaged_pngs():
        write("Pictures", f"{name}.png", of_kind(PICTURES, ".png", content))
    for name, content in cases_targets.damaged_others():
        write("Pictures", name, of_kind(PICTURES, "." + name.rpartition(".")[2], content))


def meshes():
    for make, suffix in ((good.obj, ".obj"), (good.ply, ".ply"), (good.ply_binary, ".ply"), (good.stl, ".stl"),
                         (good.stl_words, ".stl"), (good.glb, ".glb"), (good.gltf, ".gltf"), (good.vtp, ".vtp")):
        write("Meshes", f"right-{make.__name__}{suffix}", of_kind(MESHES, suffix, make()))
    for number, (_, content) in enumerate(cases_forms.objs()):
        write("Meshes", f"form-{number}.obj", of_kind(MESHES, ".obj", content))
    for family in (cases_meshes.objs, cases_meshes.plys, cases_meshes.stls, cases_meshes.glbs, cases_meshes.vtps):
        for name, suffix, content in family():
            write("Meshes", name + suffix, of_kind(MESHES, suffix, content))


def winds():
    write("Winds", "right.vti", of_kind(WINDS, ".vti", good.vti()))
    for family, suffix in ((cases_winds.vtis, ".vti"), (cases_winds.pvds, ".pvd"), (cases_winds.vdbs, ".vdb")):
        for name, content in family():
            write("Winds", name + suffix, of_kind(WINDS, suffix, content))


def any_bytes(target, sizes):
    """For targets that make of bytes what they like."""
    for size in sizes:
        for seed in range(4):
            numbers = random.Random(100 * size + seed)
            small = bytes(numbers.randrange(8 if seed % 2 else 256) for _ in range(size))
            write(target, f"{size}-bytes-{seed}", small)


MAKERS = {"SceneText": scene_texts, "Pictures": pictures, "Meshes": meshes, "Winds": winds,
          "PolyData": lambda: any_bytes("PolyData", (0, 20, 100, 400, 1000)),
          "StateFiles": lambda: any_bytes("StateFiles", (0, 8, 50, 300))}
for name in sys.argv[2:]:
    shutil.rmtree(FOLDER / name, ignore_errors=True)
    MAKERS[name]()
    found = HERE / "Found" / name
    if found.is_dir():
        shutil.copytree(found, FOLDER / name, dirs_exist_ok=True)
