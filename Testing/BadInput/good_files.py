# SPDX-License-Identifier: BSD-3-Clause
"""Small files that are right, to be damaged: pictures, meshes, volumes."""
import base64
import json
import pathlib
import struct
import tempfile
import zlib


def chunk(kind, content, checksum=None):
    """A chunk of a PNG file."""
    return (struct.pack(">I", len(content)) + kind + content +
            struct.pack(">I", zlib.crc32(kind + content) if checksum is None else checksum))


def png(width=12, height=8, depth=8, colours=6, scanlines=None, header=None, data=None, before=b"", claimed=None):
    """A PNG: a dark bar on nothing. claimed: the (width, height) that its header tells instead."""
    signature = b"\x89PNG\r\n\x1a\n"
    if scanlines is None:
        scanlines = b"".join(b"\x00" + b"".join(b"\x20\x40\x20\xff" if 2 <= x < 9 else b"\x00\x00\x00\x00"
                                                for x in range(width)) for _ in range(height))
    if header is None:
        header = struct.pack(">IIBBBBB", *(claimed or (width, height)), depth, colours, 0, 0, 0)
    return (signature + chunk(b"IHDR", header) + before +
            chunk(b"IDAT", zlib.compress(scanlines) if data is None else data) + chunk(b"IEND", b""))


def bmp(width=12, height=8, claimed=None, bits=24, offset=54):
    """A BMP: a dark bar on white."""
    row = b"".join(b"\x20\x40\x20" if 2 <= x < 9 else b"\xff\xff\xff" for x in range(width))
    row += bytes(-len(row) % 4)
    pixels = row * height
    return (b"BM" + struct.pack("<IHHI", 54 + len(pixels), 0, 0, offset) +
            struct.pack("<IiiHHIIiiII", 40, *(claimed or (width, height)), 1, bits, 0, len(pixels), 2835, 2835, 0, 0) + pixels)


def by_writer(writer_name, suffix):
    """The same picture by one of VTK's writers."""
    from vtkmodules import vtkIOImage
    from vtkmodules.vtkCommonCore import VTK_UNSIGNED_CHAR
    from vtkmodules.vtkCommonDataModel import vtkImageData

    image = vtkImageData()
    image.SetDimensions(24, 16, 1)
    image.AllocateScalars(VTK_UNSIGNED_CHAR, 3)
    for y in range(16):
        for x in range(24):
            for c in range(3):
                image.SetScalarComponentFromDouble(x, y, 0, c, 40 if 5 <= x < 18 else 255)
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / f"picture{suffix}"
        writer = getattr(vtkIOImage, writer_name)()
        writer.SetInputData(image)
        writer.SetFileName(str(path))
        writer.Write()
        return path.read_bytes()


def jpg():
    return by_writer("vtkJPEGWriter", ".jpg")


def tif():
    return by_writer("vtkTIFFWriter", ".tif")


# A tetrahedron, its faces outwards.
POINTS = [(0.0, 0.0, 0.0), (0.2, 0.0, 0.0), (0.0, 0.2, 0.0), (0.0, 0.0, 0.2)]
FACES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]


def obj(points=tuple(POINTS), faces=tuple(FACES)):
    lines = ["v " + " ".join(map(str, p)) for p in points] + ["f " + " ".join(str(i + 1) for i in f) for f in faces]
    return ("\n".join(lines) + "\n").encode()


def stl():
    """Binary STL."""
    triangles = b"".join(struct.pack("<12fH", 0, 0, 0, *(x for i in face for x in POINTS[i]), 0) for face in FACES)
    return bytes(80) + struct.pack("<I", len(FACES)) + triangles


def stl_words():
    """STL in words."""
    facets = "".join("facet normal 0 0 0\nouter loop\n" + "".join(
        "vertex " + " ".join(map(str, POINTS[i])) + "\n" for i in face) + "endloop\nendfacet\n" for face in FACES)
    return f"solid tetrahedron\n{facets}endsolid tetrahedron\n".encode()


def ply(points=len(POINTS), faces=len(FACES), lines=None, properties=("float x", "float y", "float z"),
        listed="list uchar int vertex_indices", form="ascii 1.0"):
    """A PLY in text: points and faces are the numbers that its header tells."""
    header = ["ply", f"format {form}", f"element vertex {points}", *(f"property {p}" for p in properties),
              f"element face {faces}", f"property {listed}", "end_header"]
    if lines is None:
        lines = [" ".join(map(str, p)) for p in POINTS] + ["3 " + " ".join(map(str, f)) for f in FACES]
    return ("\n".join(header + lines) + "\n").encode()


def ply_binary():
    head = ply(lines=[], form="binary_little_endian 1.0")
    return (head + b"".join(struct.pack("<3f", *p) for p in POINTS) +
            b"".join(struct.pack("<B3i", 3, *f) for f in FACES))


def gltf_json():
    return {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0],
                       "max": [0.2, 0.2, 0.2]},
                      {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48},
                        {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
        "buffers": [{"byteLength": 72}],
    }


def glb(content=None, binary=None, length=None):
    """A GLB of JSON and bytes; length: the whole length that its header tells."""
    text = json.dumps(gltf_json() if content is None else content).encode()
    text += b" " * (-len(text) % 4)
    if binary is None:
        binary = (b"".join(struct.pack("<3f", *p) for p in POINTS) + b"".join(struct.pack("<3H", *f) for f in FACES))
    whole = 12 + 8 + len(text) + 8 + len(binary)
    return (struct.pack("<4sII", b"glTF", 2, whole if length is None else length) +
            struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(binary), b"BIN\x00") + binary)


def gltf():
    """The same in text, its bytes in base64."""
    content = gltf_json()
    content["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(glb()[-72:]).decode()
    return (json.dumps(content, indent=1) + "\n").encode()


def packed_zeros(count, size=1 << 20):
    """So many bytes as VTK packs them: how many blocks of which size, the packed size of each, the blocks."""
    blocks, rest = divmod(count, size)
    whole, last = zlib.compress(bytes(size), 9), zlib.compress(bytes(rest), 9) if rest else b""
    sizes = [len(whole)] * blocks + [len(last)] * bool(rest)
    return struct.pack(f"<{3 + len(sizes)}Q", len(sizes), size, rest, *sizes) + whole * blocks + last


def packed(kind, inside, values):
    """A VTK file of one kind whose values follow its elements, packed."""
    return (f'<?xml version="1.0"?>\n<VTKFile type="{kind}" version="1.0" byte_order="LittleEndian" header_type="UInt64" '
            f'compressor="vtkZLibDataCompressor">{inside}<AppendedData encoding="raw">_').encode() + values + (
                b"</AppendedData></VTKFile>\n")


def vtp_packed(points, values):
    """Points that are packed."""
    return packed("PolyData", f'<PolyData><Piece NumberOfPoints="{points}"><Points><DataArray type="Float32" '
                  'NumberOfComponents="3" format="appended" offset="0"/></Points></Piece></PolyData>', values)


def vti_packed(last, piece, values):
    """A wind that is packed, at last + 1 points along each axis, of which the piece has (piece + 1)^3."""
    whole, part = (" ".join([f"0 {end}"] * 3) for end in (last, piece))
    return packed("ImageData", f'<ImageData WholeExtent="{whole}" Origin="-2 -2 0" Spacing="1 1 1"><Piece Extent="{part}">'
                  '<PointData><DataArray type="Float32" Name="Wind" NumberOfComponents="3" format="appended" offset="0"/>'
                  '</PointData></Piece></ImageData>', values)


def vtp(points=4, polys=4, coordinates=None, connectivity=None, offsets=None, lines=0):
    """A VTP in text: points, polys and lines are the numbers that its header tells."""
    coordinates = coordinates or " ".join(str(x) for p in POINTS for x in p)
    connectivity = connectivity or " ".join(str(i) for f in FACES for i in f)
    offsets = offsets or "3 6 9 12"
    return f"""<?xml version="1.0"?>
<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64"><PolyData>
<Piece NumberOfPoints="{points}" NumberOfVerts="0" NumberOfLines="{lines}" NumberOfStrips="0" NumberOfPolys="{polys}">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">{coordinates}</DataArray></Points>
<Polys><DataArray type="Int64" Name="connectivity" format="ascii">{connectivity}</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">{offsets}</DataArray></Polys>
</Piece></PolyData></VTKFile>
""".encode()


def vti(extent="0 1 0 1 0 1", piece=None, origin="-2 -2 0", spacing="4 4 4", direction="1 0 0 0 1 0 0 0 1", name="Wind",
        components=3, values=None, kind="Float32"):
    """A VTI in text: a wind at eight points."""
    values = values or " ".join(["0.1 0 0"] * 8)
    return f"""<?xml version="1.0"?>
<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<ImageData WholeExtent="{extent}" Origin="{origin}" Spacing="{spacing}" Direction="{direction}">
<Piece Extent="{piece or extent}"><PointData>
<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii">{values}</DataArray>
</PointData></Piece></ImageData></VTKFile>
""".encode()


def pvd(*entries):
    """A collection of (time, file)."""
    sets = "".join(f'<DataSet timestep="{time}" part="0" file="{file}"/>\n' for time, file in entries)
    return f'<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1"><Collection>\n{sets}</Collection></VTKFile>\n'.encode()
