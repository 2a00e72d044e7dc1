# SPDX-License-Identifier: BSD-3-Clause
"""Meshes that are damaged, as a shape, as an obstacle, as targets."""
import json
import struct

import good_files as good
from case import LEAF, scene_case


def _of(kind, file):
    """A scene that names a mesh, and the place where it does."""
    if kind == "shape":
        return LEAF | {"shapes": {"leaf": {"mesh": file, "size": 0.1}}}, "/shapes/leaf"
    if kind == "obstacle":
        return LEAF | {"obstacles": [{"kind": "mesh", "file": file, "position": [1.0, 1.0, 1.0]}]}, "/obstacles/0"
    return LEAF | {"constraints": [{"kind": "keyframe", "frame": 30, "radius": 1.0, "targets": {
        "mesh": file, "origin": [0.0, 0.0, 1.8], "count": 1}}]}, "/constraints/0/targets"


def objs():
    points = "v 0 0 0\nv 0.2 0 0\nv 0 0.2 0\nv 0 0 0.2\n"
    faces = "f 1 3 2\nf 1 2 4\nf 1 4 3\n"
    for name, text in {
        "an index of 999999999": points + faces + "f 1 2 999999999\n",
        "an index of 0": points + faces + "f 0 1 2\n",
        "an index below its points": points + faces + "f -1 -2 -9\n",
        "an index beyond all numbers": points + faces + "f 1 2 99999999999999999999\n",
        "an index that is a word": points + faces + "f 1 2 x\n",
        "a face of two": points + "f 1 2\n",
        "NaN": points + "v nan 0 0\n" + faces + "f 2 3 5\n",
        "infinity": points + "v inf 0 0\n" + faces + "f 2 3 5\n",
        "1e308": points + "v 1e308 0 0\n" + faces + "f 2 3 5\n",
        "two numbers": points + "v 0.2 0.2\n" + faces + "f 2 3 5\n",
        "a word for a number": points + "v a b c\n" + faces + "f 2 3 5\n",
        "no faces": points,
        "no points": faces,
        "one point": "v 0 0 0\n",
        "triangles without area": "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n",
    }.items():
        yield name, ".obj", text.encode()
    yield "a line of 5 MB", ".obj", b"v " + b"1" * 5000000 + b"\n"
    yield "random bytes", ".obj", bytes((i * 7919) % 256 for i in range(2000))
    yield "1e20 m", ".obj", good.obj([tuple(1e20 * x for x in p) for p in good.POINTS])


def plys():
    lines = [" ".join(map(str, p)) for p in good.POINTS] + ["3 " + " ".join(map(str, f)) for f in good.FACES]
    whole = good.ply()
    yield "header only", ".ply", good.ply(lines=[])
    yield "header cut", ".ply", whole[:40]
    yield "magic only", ".ply", b"ply\n"
    yield "fewer faces than said", ".ply", good.ply(lines=lines[:-2])
    yield "fewer points than said", ".ply", good.ply(lines=lines[:3])
    yield "an index beyond", ".ply", good.ply(lines=lines[:-1] + ["3 0 1 99"])
    yield "an index below 0", ".ply", good.ply(lines=lines[:-1] + ["3 0 1 -1"])
    yield "a list of 255", ".ply", good.ply(lines=lines[:-1] + ["255 0 1 2"])
    yield "a list of -1", ".ply", good.ply(lines=lines[:-1] + ["-1 0 1 2"], listed="list char int vertex_indices")
    yield "no x, y, z", ".ply", good.ply(properties=("float a", "float b", "float c"))
    yield "no z", ".ply", good.ply(properties=("float x", "float y"))
    yield "no list", ".ply", good.ply(listed="int vertex_indices")
    yield "an unknown type", ".ply", good.ply(properties=("quad x", "quad y", "quad z"))
    yield "1e9 points", ".ply", good.ply(points=10 ** 9)
    yield "1e9 faces", ".ply", good.ply(faces=10 ** 9)
    yield "-4 points", ".ply", good.ply(points=-4)
    yield "2^40 points", ".ply", good.ply(points=2 ** 40)
    yield "an unknown form", ".ply", good.ply(form="morse 1.0")
    yield "NaN", ".ply", good.ply(lines=["nan 0 0"] + lines[1:])
    yield "binary, cut", ".ply", good.ply_binary()[:-20]
    yield "binary, cut in the header", ".ply", good.ply_binary()[:60]
    yield "binary, only the header", ".ply", good.ply(lines=[], form="binary_little_endian 1.0")
    yield "binary, 1e9 faces", ".ply", good.ply_binary().replace(b"face 4", b"face 1000000000")
    yield "binary, the other order", ".ply", good.ply_binary().replace(b"little", b"big")
    yield "a word for a number", ".ply", good.ply(lines=["a b c"] + lines[1:])


def stls():
    whole = good.stl()
    yield "cut in half", ".stl", whole[:len(whole) // 2]
    yield "header only", ".stl", whole[:84]
    yield "header cut", ".stl", whole[:50]
    yield "2^32-1 triangles", ".stl", whole[:80] + struct.pack("<I", 2 ** 32 - 1) + whole[84:]
    yield "no triangles", ".stl", whole[:80] + bytes(4)
    yield "NaN", ".stl", whole[:96] + struct.pack("<f", float("nan")) + whole[100:]
    yield "in words, cut", ".stl", b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0"
    yield "in words, a word for a number", ".stl", (b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex x 0 0\n"
                                                    b"vertex 0 1 0\nendloop\nendfacet\nendsolid a\n")


def glbs():
    def changed(change, **more):
        content = good.gltf_json()
        change(content)
        return good.glb(content, **more)

    def put(holder, key, value):
        def change(content):
            place = content
            for step in holder:
                place = place[step]
            if value is None:
                del place[key]
            else:
                place[key] = value
        return change

    whole = good.glb()
    yield "cut in half", ".glb", whole[:len(whole) // 2]
    yield "header only", ".glb", whole[:12]
    yield "without its bytes", ".glb", good.glb(binary=b"")
    yield "a length beyond its end", ".glb", good.glb(length=2 ** 31)
    yield "a length of 12", ".glb", good.glb(length=12)
    yield "version 9", ".glb", whole[:4] + struct.pack("<I", 9) + whole[8:]
    yield "no JSON in it", ".glb", whole[:20] + b"#" * 40 + whole[60:]
    for name, holder, key, value in (
            ("a view beyond the buffer", ("bufferViews", 0), "byteLength", 10 ** 6),
            ("a view at 10^9", ("bufferViews", 1), "byteOffset", 10 ** 9),
            ("a view at -96", ("bufferViews", 0), "byteOffset", -96),
            ("a view of -48", ("bufferViews", 0), "byteLength", -48),
            ("a view of no buffer", ("bufferViews", 0), "buffer", 7),
            ("an accessor of 2^31", ("accessors", 0), "count", 2 ** 31),
            ("an accessor of 400", ("accessors", 0), "count", 400),
            ("an accessor of -4", ("accessors", 0), "count", -4),
            ("an accessor at 10^9", ("accessors", 0), "byteOffset", 10 ** 9),
            ("an accessor of no view", ("accessors", 0), "bufferView", 9),
            ("an accessor of an unknown type", ("accessors", 0), "componentType", 1),
            ("points of two numbers", ("accessors", 0), "type", "VEC2"),
            ("indices of three numbers", ("accessors", 1), "type", "VEC3"),
            ("indices of floats", ("accessors", 1), "componentType", 5126),
            ("a stride of 1", ("bufferViews", 0), "byteStride", 1),
            ("points of no accessor", ("meshes", 0, "primitives", 0, "attributes"), "POSITION", 9),
            ("indices of no accessor", ("meshes", 0, "primitives", 0), "indices", 9),
            ("a primitive without points", ("meshes", 0, "primitives", 0, "attributes"), "POSITION", None),
            ("a primitive of unknown mode", ("meshes", 0, "primitives", 0), "mode", 77),
            ("a mesh that is not there", ("nodes", 0), "mesh", 5),
            ("a node that is not there", ("scenes", 0), "nodes", [5]),
            ("a node that is its own child", ("nodes", 0), "children", [0]),
            ("a matrix of nine", ("nodes", 0), "matrix", [1] * 9),
            ("a scale of 1e308", ("nodes", 0), "scale", [1e308, 1, 1]),
            ("a buffer that is not there", ("buffers", 0), "uri", "none.bin"),
            ("a buffer of 2^40", ("buffers", 0), "byteLength", 2 ** 40),
            ("no buffers", (), "buffers", None),
            ("no meshes", (), "meshes", None),
            ("no accessors", (), "accessors", None),
            ("accessors that are a text", (), "accessors", "none")):
        yield name, ".glb", changed(put(holder, key, value))
    ring = good.gltf_json()
    ring["nodes"] = [{"children": [1]}, {"children": [0], "mesh": 0}]
    yield "two nodes that are each other's child", ".glb", good.glb(ring)
    beyond = good.glb()[:-2] + struct.pack("<H", 60000)
    yield "an index beyond", ".glb", beyond
    yield "points that are NaN", ".glb", good.glb(binary=struct.pack("<12f", *[float("nan")] * 12) + good.glb()[-24:])
    yield "JSON that is a list", ".glb", good.glb(json.loads("[]"))


def required(extension):
    content = good.gltf_json()
    content["extensionsUsed"] = content["extensionsRequired"] = [extension]
    return good.glb(content)


def _deep_glb():
    deep = good.gltf_json()
    deep["nodes"] = [{"children": [i + 1]} for i in range(20000)] + [{"mesh": 0}]
    return good.glb(deep)


def vtps():
    whole = good.vtp()
    yield "cut in half", ".vtp", whole[:len(whole) // 2]
    yield "1e12 points", ".vtp", good.vtp(points=10 ** 12)
    yield "1e12 triangles", ".vtp", good.vtp(polys=10 ** 12)
    yield "2^60 lines", ".vtp", good.vtp(lines=2 ** 60)
    yield "-4 points", ".vtp", good.vtp(points=-4)
    yield "more points than there are", ".vtp", good.vtp(points=400)
    yield "more triangles than there are", ".vtp", good.vtp(polys=400)
    yield "an index beyond", ".vtp", good.vtp(connectivity="0 2 1 0 1 3 0 3 2 1 2 99999")
    yield "an index below 0", ".vtp", good.vtp(connectivity="0 2 1 0 1 3 0 3 2 1 2 -5")
    yield "offsets that fall", ".vtp", good.vtp(offsets="3 9 6 12")
    yield "offsets beyond", ".vtp", good.vtp(offsets="3 6 9 1000000")
    yield "NaN", ".vtp", good.vtp(coordinates="nan " + "0 " * 11)
    yield "1e308", ".vtp", good.vtp(coordinates="1e308 " + "0 " * 11)
    yield "words for numbers", ".vtp", good.vtp(coordinates="a b c " * 4)
    yield "too few numbers", ".vtp", good.vtp(coordinates="0 0 0")
    yield "no points", ".vtp", good.vtp(points=0, polys=0)
    yield "of another type", ".vtp", whole.replace(b'"PolyData"', b'"UnstructuredGrid"')
    yield "an unknown compressor", ".vtp", whole.replace(b'header_type', b'compressor="vtkNoCompressor" header_type')
    yield "an appended array that is not there", ".vtp", whole.replace(b'format="ascii"', b'format="appended" offset="99"', 1)
    yield "points of one number", ".vtp", whole.replace(b' NumberOfComponents="3"', b"")
    for kind in (b"Bit", b"String"):
        yield f"points of type {kind.decode()}", ".vtp", whole.replace(b"Float64", kind)
    texts = b'<Array type="String" Name="w" NumberOfTuples="2" format="ascii">' + b"65 0 " * 100 + b"</Array>"
    yield "more texts than points", ".vtp", whole.replace(b"<Points>", b"<PointData>" + texts + b"</PointData><Points>")
    yield "more texts than said", ".vtp", whole.replace(b"<PolyData>", b"<PolyData><FieldData>" + texts + b"</FieldData>")
    yield "values at two places", ".vtp", whole.replace(b'format="ascii"', b'format="ascii" offset="0"')
    zeros = good.packed_zeros(12 * 2 * 10 ** 8)
    yield "2e8 points that are packed", ".vtp", good.vtp_packed(2 * 10 ** 8, zeros)
    yield "a block of 2^40 bytes", ".vtp", good.vtp_packed(4, struct.pack("<4Q", 1, 2 ** 40, 0, 100) + bytes(100))
    yield "no blocks of 2^63 bytes", ".vtp", good.vtp_packed(4, struct.pack("<3Q", 0, 2 ** 63, 2 ** 63) + bytes(100))
    yield "blocks that say less than they unpack to", ".vtp", good.vtp_packed(4, zeros[:16] + struct.pack("<Q", 48) + zeros[24:])
    yield "laughs", ".vtp", (b'<?xml version="1.0"?><!DOCTYPE l [<!ENTITY a "ha">' + b"".join(
        f'<!ENTITY {chr(98 + i)} "{f"&{chr(97 + i)};" * 10}">'.encode() for i in range(9)) + b"]><VTKFile>&j;</VTKFile>")


def cases():
    group = "meshes"
    kinds = ("shape", "obstacle", "targets")
    number = 0
    for family in (objs, plys, stls, glbs, vtps):
        for name, suffix, content in family():
            # Every file as a shape, where no later check looks at it, and in turn as one of the others.
            number += 1
            for kind in ("shape", kinds[1 + number % 2]) if number % 2 else ("shape",):
                scene, pointer = _of(kind, f"m{suffix}")
                yield scene_case(group, f"{kind}: {suffix[1:]}: {name}", scene, pointer,
                                 files={f"m{suffix}": content})
    for suffix in (".obj", ".ply", ".stl", ".glb", ".vtp"):
        for name, content in (("empty", b""), ("junk", b"this is no mesh\n"), ("zeros", bytes(500))):
            scene, pointer = _of("obstacle", f"m{suffix}")
            yield scene_case(group, f"obstacle: {suffix[1:]}: {name}", scene, pointer,
                             files={f"m{suffix}": content})
    for kind in kinds:
        for name, file in (("that is not there", "none.obj"), ("of an unknown kind", "m.fbx"), ("without a kind", "m")):
            scene, pointer = _of(kind, file)
            yield scene_case(group, f"{kind} {name}", scene, pointer, files={"m.fbx": b"x", "m": b"x"})
    for extension in ("KHR_draco_mesh_compression", "EXT_meshopt_compression", "ACME_warp"):
        scene, pointer = _of("obstacle", "m.glb")
        yield scene_case(group, f"glb: requires {extension}", scene, pointer, extension, "export without",
                         files={"m.glb": required(extension)})
    scene, pointer = _of("obstacle", "m.obj")
    yield scene_case(group, "an open obstacle", scene, pointer, "closed",
                     files={"m.obj": good.obj(faces=good.FACES[:3])})
    for make, suffix in ((good.obj, ".obj"), (good.ply, ".ply"), (good.ply_binary, ".ply"), (good.stl, ".stl"),
                         (good.stl_words, ".stl"), (good.glb, ".glb"), (good.gltf, ".gltf"), (_deep_glb, ".glb"),
                         (good.vtp, ".vtp")):
        scene, _ = _of("obstacle", f"m{suffix}")
        yield scene_case(group, f"obstacle that is right: {make.__name__}", scene, files={f"m{suffix}": make}, status=(0,))
