# SPDX-License-Identifier: BSD-3-Clause
"""The files of a run and the volume of its scene as plain Python data, read without VTK or Waft, so that checks
rest on what was written alone."""
import array
import base64
import collections
import csv
import lzma
import math
import pathlib
import struct
import sys
import xml.etree.ElementTree as ElementTree
import zlib

Pose = collections.namedtuple("Pose", "x q v w")

# A row that the run was to meet: Constraints of the run, with the status of its line in the report.
Row = collections.namedtuple("Row", "row target object frame until kind value radius status")
POSITION, VELOCITY, ACCELERATION, ORIENTATION, REST = range(5)

_TYPES = {"Float64": "d", "Float32": "f", "Int64": "q", "UInt64": "Q", "Int32": "i", "UInt32": "I",
          "Int16": "h", "UInt16": "H", "Int8": "b", "UInt8": "B"}
_UNPACKERS = {None: None, "vtkZLibDataCompressor": zlib.decompress, "vtkLZMADataCompressor": lzma.decompress}


def volume(scene):
    """Corners of the volume, height of the ground (None without one), width L."""
    domain = scene.get("domain", {})
    low = domain.get("min", [-2.0, -2.0, 0.0])
    high = domain.get("max", [2.0, 2.0, 4.0])
    ground = scene.get("ground", {})
    height = ground.get("height", low[2]) if ground.get("enabled", True) else None
    return low, high, height, max(high[0] - low[0], high[1] - low[1])


def read_poses(path):
    """{object: [Pose per frame]} of a poses.csv."""
    tracks = collections.defaultdict(list)
    with open(path, newline="", encoding="utf-8") as stream:
        for row in csv.DictReader(stream):
            values = {name: float(value) for name, value in row.items() if name not in ("object", "frame")}
            assert len(tracks[int(row["object"])]) == int(row["frame"]), "frames out of order"
            tracks[int(row["object"])].append(Pose(
                tuple(values[c] for c in ("x", "y", "z")),
                tuple(values[c] for c in ("qw", "qx", "qy", "qz")),
                tuple(values[c] for c in ("vx", "vy", "vz")),
                tuple(values[c] for c in ("wx", "wy", "wz"))))
    return dict(tracks)


class _XmlFile:
    """A VTK file of one piece, and how its values are written."""

    def __init__(self, path, kind):
        text, self._appended = _without_appended(pathlib.Path(path).read_bytes())
        root = ElementTree.fromstring(text)
        assert root.get("byte_order") == "LittleEndian" and sys.byteorder == "little", path
        self._header = {"UInt32": "I", "UInt64": "Q"}[root.get("header_type", "UInt32")]
        self._unpack = _UNPACKERS[root.get("compressor")]
        entry = root.find("AppendedData")
        self._is_raw = entry is not None and entry.get("encoding") == "raw"
        self._data = root.find(kind)
        self._piece = self._data.find("Piece")
        self.field = self._arrays(self._data.find("FieldData"))
        self.point = self._arrays(self._piece.find("PointData"))
        self.cell = self._arrays(self._piece.find("CellData"))

    def _arrays(self, parent):
        found = parent.findall("DataArray") if parent is not None else []
        return {a.get("Name"): self._values(a) for a in found if a.get("type") in _TYPES}

    def _values(self, entry):
        if entry.get("format") == "ascii":
            flat = [float(word) for word in (entry.text or "").split()]
        else:
            is_appended = entry.get("format") == "appended"
            text = self._appended[int(entry.get("offset")):] if is_appended else entry.text.strip().encode()
            values = array.array(_TYPES[entry.get("type")])
            values.frombytes(self._bytes(text, _raw if is_appended and self._is_raw else _decode))
            flat = values.tolist()
        width = int(entry.get("NumberOfComponents", 1))
        return flat if width == 1 else [tuple(flat[i:i + width]) for i in range(0, len(flat), width)]

    def _bytes(self, text, decode):
        size = struct.calcsize("<" + self._header)

        def numbers(start, count):
            return struct.unpack(f"<{count}{self._header}", decode(text, start, count * size)[0])

        if self._unpack is None:
            length, = numbers(0, 1)
            return decode(text, 0, size + length)[0][size:]
        blocks, = numbers(0, 1)
        lengths = numbers(0, 3 + blocks)[3:]
        _, start = decode(text, 0, (3 + blocks) * size)
        packed, _ = decode(text, start, sum(lengths))
        result, place = b"", 0
        for length in lengths:
            result += self._unpack(packed[place:place + length])
            place += length
        return result


class PolyData(_XmlFile):
    """points [(x, y, z)]; lines and polys [[point index]]; point, cell and field {name: [value or tuple]}."""

    def __init__(self, path):
        super().__init__(path, "PolyData")
        self.points = next(iter(self._arrays(self._piece.find("Points")).values()), [])
        self.lines = self._cells(self._piece.find("Lines"))
        self.polys = self._cells(self._piece.find("Polys"))

    def _cells(self, parent):
        arrays = self._arrays(parent)
        starts = [0] + arrays.get("offsets", [])
        return [arrays["connectivity"][a:b] for a, b in zip(starts, starts[1:])]


class ImageData(_XmlFile):
    """dimensions (points along x, y, z), origin and spacing; point and field {name: [value or tuple]}, x fastest."""

    def __init__(self, path):
        super().__init__(path, "ImageData")
        extent = [int(word) for word in self._data.get("WholeExtent").split()]
        self.dimensions = tuple(high - low + 1 for low, high in zip(extent[::2], extent[1::2]))
        spacing = [float(word) for word in self._data.get("Spacing").split()]
        corner = [float(word) for word in self._data.get("Origin").split()]
        self.origin = tuple(at + low * step for at, low, step in zip(corner, extent[::2], spacing))
        self.spacing = tuple(spacing)


def read_series(path):
    """Times [s] of a .pvd and their files."""
    entries = [(float(entry.get("timestep")), pathlib.Path(path).parent / entry.get("file"))
               for entry in ElementTree.parse(path).iter("DataSet")]
    times, files = zip(*sorted(entries))
    return list(times), list(files)


def _decode(text, start, length):
    """The bytes of a piece of base64 of this many bytes, and where the next one begins."""
    end = start + (length + 2) // 3 * 4
    return base64.b64decode(text[start:end])[:length], end


def _without_appended(content):
    """A VTK file whose appended values, which may be no text, are taken out, and these."""
    start = content.find(b"<AppendedData")
    if start < 0:
        return content, b""
    start = content.index(b"_", start) + 1
    end = content.rindex(b"</AppendedData>")
    return content[:start] + content[end:], content[start:end]


def _raw(content, start, length):
    """The same of bytes as they are."""
    return content[start:start + length], start + length


def read_tracks(path):
    """{object: [position per frame]} of Tracks."""
    data = PolyData(path)
    return {number: [data.points[i] for i in line] for number, line in zip(data.cell["ObjectId"], data.lines)}


def read_rows(folder):
    """Every Row of a run, those for any object assigned, with the status of its line in constraints.csv."""
    folder = pathlib.Path(folder)
    with open(folder / "constraints.csv", newline="", encoding="utf-8") as stream:
        status = {(int(line["Row"]), int(line["Target"])): line["Status"] for line in csv.DictReader(stream)}
    point = PolyData(folder / "constraints.vtp").point
    names = ("Row", "Target", "ObjectId", "Frame", "Until", "Kind", "Value", "Radius")
    return [Row(*values, status[values[0], values[1]]) for values in zip(*(point[name] for name in names))]


def read_shape_meshes(folder):
    """{object: (points of its shape in body axes, [triangle of three places in points])}."""
    folder = pathlib.Path(folder)
    files = [entry.get("file") for entry in ElementTree.parse(folder / "shapes.vtm").iter("DataSet")]
    shapes = [(data.points, data.polys) for data in (PolyData(folder / file) for file in files)]
    objects = PolyData(folder / "objects.vtp").point
    return {number: shapes[shape] for number, shape in zip(objects["ObjectId"], objects["ShapeId"])}


def read_shapes(folder):
    """{object: points of its shape in body axes}."""
    return {number: points for number, (points, _) in read_shape_meshes(folder).items()}


def read_obstacle_surfaces(folder):
    """{ObstacleId: [triangle of three points]} as they stand at frame 0."""
    folder = pathlib.Path(folder)
    path = folder / "obstacles.vtp"
    if (folder / "obstacles.pvd").exists():
        path = folder / next(ElementTree.parse(folder / "obstacles.pvd").iter("DataSet")).get("file")
    data = PolyData(path)
    surfaces = collections.defaultdict(list)
    for corners in data.polys:
        surfaces[data.point["ObstacleId"][corners[0]]].append([data.points[i] for i in corners])
    return dict(surfaces)


def rotated(quaternion, vector):
    """A vector turned by a unit quaternion (w, x, y, z)."""
    w, x, y, z = quaternion
    a, b, c = vector
    t = (2 * (y * c - z * b), 2 * (z * a - x * c), 2 * (x * b - y * a))
    return (a + w * t[0] + y * t[2] - z * t[1], b + w * t[1] + z * t[0] - x * t[2], c + w * t[2] + x * t[1] - y * t[0])


distance = math.dist
