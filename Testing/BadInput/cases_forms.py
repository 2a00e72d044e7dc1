# SPDX-License-Identifier: BSD-3-Clause
"""Good files as other programs and systems write them, or without their last byte: read, or refused in words."""
import json

import good_files as good
from case import LEAF, Case


def _obstacle(file):
    return LEAF | {"obstacles": [{"kind": "mesh", "file": file, "position": [1.0, 1.0, 1.0], "up": "z"}]}


def _picture(file):
    return LEAF | {"constraints": [{"kind": "keyframe", "frame": 30, "radius": 1.0, "targets": {
        "image": file, "origin": [0.0, 0.0, 1.8], "u": [1.0, 0.0, 0.0], "v": [0.0, 0.0, 1.0], "width": 0.2, "count": 1}}]}


def _wind(file):
    return LEAF | {"winds": [{"file": file}]}


# Maker, suffix, scene, whether it is a text, whether lines and marks of any system are read.
FILES = (
    (good.obj, ".obj", _obstacle, True, True),
    (good.ply, ".ply", _obstacle, True, True),
    (good.ply_binary, ".ply", _obstacle, False, False),
    (good.stl, ".stl", _obstacle, False, False),
    (good.stl_words, ".stl", _obstacle, True, True),
    (good.glb, ".glb", _obstacle, False, False),
    (good.gltf, ".gltf", _obstacle, True, True),
    (good.vtp, ".vtp", _obstacle, True, False),
    (good.png, ".png", _picture, False, False),
    (good.jpg, ".jpg", _picture, False, False),
    (good.tif, ".tif", _picture, False, False),
    (good.bmp, ".bmp", _picture, False, False),
    (good.vti, ".vti", _wind, True, False),
)
EITHER = (0, 2)


def forms(content, is_text, is_free):
    """(name, bytes, exit statuses)"""
    yield "without its last byte", content[:-1], (0,) if is_free else EITHER
    if is_text:
        status = (0,) if is_free else EITHER
        yield "with CR LF", content.replace(b"\n", b"\r\n"), status
        yield "with CR", content.replace(b"\n", b"\r"), status
        yield "behind a byte order mark", b"\xef\xbb\xbf" + content, status
        yield "with empty lines", content.replace(b"\n", b"\n\n"), status
        yield "in UTF-16", content.decode().encode("utf-16"), (2,)


def objs():
    points = b"".join(b"v %g %g %g\n" % p for p in good.POINTS) + b"vn 0 0 1\nvt 0 0\n"
    rows = [[i + 1 for i in face] for face in good.FACES]

    def faces(form, *others):
        return points + b"".join(b"f " + b" ".join((others or (form,))[k % max(1, len(others))] % i for i in row) + b"\n"
                                 for k, row in enumerate(rows))

    yield "corners 1/", faces(b"%d/")
    yield "corners 1//", faces(b"%d//")
    yield "corners 1//1", faces(b"%d//1")
    yield "corners 1/1", faces(b"%d/1")
    yield "corners 1/1/", faces(b"%d/1/")
    yield "corners 1/1/1", faces(b"%d/1/1")
    yield "corners 1 and 1//1", faces(b"", b"%d", b"%d//1")
    yield "corners 1/1 and 1", faces(b"", b"%d/1", b"%d")
    yield "lines that go on", faces(b"%d \\\n")
    yield "remarks behind faces", faces(b"%d").replace(b"\n", b" # 9 9 9\n")
    yield "usemtl without a name", points + b"usemtl\n" + faces(b"%d/1")[len(points):]


def _case(name, scene, files, status):
    def make(folder, _):
        (folder / "scene.waft.json").write_text(json.dumps(scene), encoding="utf-8")
        for file, content in files.items():
            (folder / file).write_bytes(content)
        return ["check", "scene.waft.json"]
    return Case("forms", name, make, status=status, says=("scene.waft.json",))


def cases():
    for make, suffix, scene, is_text, is_free in FILES:
        content = make()
        for name, changed, status in forms(content, is_text, is_free):
            yield _case(f"{make.__name__}: {name}", scene(f"m{suffix}"), {f"m{suffix}": changed}, status)
    for name, content in objs():
        yield _case(f"obj: {name}", _obstacle("m.obj"), {"m.obj": content}, (0,))
    series = good.pvd((0, "a.vti"), (1, "b.vti"))[:-1]
    yield _case("pvd: without its last byte", _wind("w.pvd"), {"w.pvd": series, "a.vti": good.vti(), "b.vti": good.vti()}, EITHER)
