# SPDX-License-Identifier: BSD-3-Clause
"""Lets bodies of a folder go in its air, without control and without any code of Waft: how far they miss their marks.

    replay_alone.py DIR     a folder that was flown with `--keep air`; prints the median and the 90th percentile of the misses over the
                            volume's width, of bodies let go a second before each mark, and at the start and after each lift-off

It needs numpy alone: VTK's XML files are read here, their values in base64, compressed by zlib or LZMA or as they are."""
import base64
import lzma
import os
import sys
import xml.etree.ElementTree as tree
import zlib

import numpy as np

KINDS = {"Float32": "<f4", "Float64": "<f8", "Int32": "<i4", "Int64": "<i8", "UInt8": "u1", "Int8": "i1", "UInt64": "<u8", "UInt32": "<u4"}
POSITION, REST, MET = 0, 4, 0


class File:
    """Arrays of a file of VTK by the section and the name that they stand under."""

    def __init__(self, path):
        self.root = tree.parse(path).getroot()
        self.word = np.dtype("<u8" if self.root.get("header_type") == "UInt64" else "<u4")
        self.unpack = {"vtkZLibDataCompressor": zlib.decompress, "vtkLZMADataCompressor": lzma.decompress}.get(self.root.get("compressor"))
        self.piece = self.root[0].find("Piece")

    def values(self, section, name=None):
        parts = [part for part in self.root[0].iter(section) for part in part.findall("DataArray") if name in (None, part.get("Name"))]
        array = parts[0]
        text = "".join(array.text.split())
        width = int(array.get("NumberOfComponents") or 1)
        values = np.frombuffer(self.bytes_of(text), KINDS[array.get("type")])
        return values.reshape(-1, width) if width > 1 else values

    def bytes_of(self, text):
        size = self.word.itemsize
        if self.unpack is None:
            return base64.b64decode(text)[size:]
        count = int(np.frombuffer(base64.b64decode(text[:4 * ((size + 2) // 3)])[:size], self.word)[0])
        head = 4 * (((3 + count) * size + 2) // 3)
        sizes = np.frombuffer(base64.b64decode(text[:head])[:(3 + count) * size], self.word)[3:].astype(int)
        body, blocks, at = base64.b64decode(text[head:]), [], 0
        for length in sizes:
            blocks.append(self.unpack(body[at:at + length]))
            at += length
        return b"".join(blocks)


def tracks(path):
    """Ids [body], and points and arrays by body and frame."""
    file = File(path)
    frames = np.diff(np.concatenate([[0], file.values("Lines", "offsets")]))[0]
    order = file.values("Lines", "connectivity").reshape(-1, frames)
    cells = file.values("CellData", "ObjectId")
    return file, cells, order, file.values("Points")[order]


def air_of(folder):
    """Velocity by frame [k, j, i, 3], origin and spacing of the lattice."""
    fields = []
    for entry in tree.parse(os.path.join(folder, "air.pvd")).getroot().iter("DataSet"):
        file = File(os.path.join(folder, entry.get("file")))
        extent = np.array(file.root[0].get("WholeExtent").split(), int)
        shape = (extent[1::2] - extent[::2] + 1)[::-1]
        fields.append(file.values("PointData", "Velocity").reshape(*shape, 3))
        origin, spacing = (np.array(file.root[0].get(name).split(), float) for name in ("Origin", "Spacing"))
    return fields, origin, spacing


def sample(field, origin, spacing, places):
    where = np.clip((places - origin) / spacing, 0.0, np.array(field.shape[2::-1]) - 1.0)
    low = np.minimum(where.astype(int), np.array(field.shape[2::-1]) - 2)
    part = where - low
    total = np.zeros_like(places)
    for i in (0, 1):
        for j in (0, 1):
            for k in (0, 1):
                weight = np.abs(1 - i - part[:, 0]) * np.abs(1 - j - part[:, 1]) * np.abs(1 - k - part[:, 2])
                total += weight[:, None] * field[low[:, 2] + k, low[:, 1] + j, low[:, 0] + i]
    return total


def flights(folder, ids, frames, rate, is_free):
    """[(body, start, marks)]: of a rest the mark is 0.8 s before its touch-down; a body that lay begins anew 0.6 s after its lift-off."""
    rows = File(os.path.join(folder, "constraints.vtp"))
    column = {name: rows.values("PointData", name) for name in ("ObjectId", "Frame", "Kind", "Until", "TouchDown", "LiftOff", "Status")}
    found = []
    for body, identity in enumerate(ids):
        own = column["ObjectId"] == identity
        inside = own & (column["Frame"] >= 0) & (column["Frame"] < frames)
        marks = column["Frame"][inside & (column["Kind"] == POSITION) & (column["Status"] == MET)]
        rests = sorted((int(column["TouchDown"][row] if column["TouchDown"][row] >= 0 else column["Frame"][row]),
                        int(max(column["Until"][row], column["LiftOff"][row]))) for row in np.flatnonzero(inside & (column["Kind"] == REST)))
        start = 0
        for touch, lift in rests + [(frames, frames)]:
            last = touch - int(round(0.8 * rate))
            ends = {int(mark) for mark in marks if start < mark < touch} | ({last} if start < last and touch < frames else set())
            if ends:
                found.append((body, start, sorted(mark for mark in ends if is_free[body, mark - 1])))
            start = max(touch, lift) + int(round(0.6 * rate))
    return found


def fly(body, start, marks, positions, slip, is_free, air, rate, width):
    """Misses at the marks. The implicit mid-point rule, in the mean of both frames' air and slip."""
    fields, origin, spacing = air
    x, misses = positions[body, start], []
    for frame in range(start, max(marks, default=start)):
        if is_free[body, frame]:
            before, own = x, 0.5 * (slip[body, frame] + slip[body, frame + 1])
            for _ in range(12):
                middle = 0.5 * (before + x)[None]
                given = 0.5 * (sample(fields[frame], origin, spacing, middle) + sample(fields[frame + 1], origin, spacing, middle))[0]
                x = before + (given + own) / rate
        else:
            x = positions[body, frame + 1]
        if frame + 1 in marks:
            misses.append(np.linalg.norm(x - positions[body, frame + 1]) / width)
    return misses


def main(folder):
    file, ids, order, positions = tracks(os.path.join(folder, "assimilated.vtp"))
    bounds, rate = file.values("FieldData", "Bounds").ravel(), float(file.values("FieldData", "FramesPerSecond").ravel()[0])
    is_free = file.values("PointData", "Free")[order] > 0
    try:
        slip = file.values("PointData", "Slip")[order]
    except IndexError:  # what is round sinks straight down
        bodies = File(os.path.join(folder, "objects.vtp"))
        speed = dict(zip(bodies.values("PointData", "ObjectId").tolist(), bodies.values("PointData", "SettlingSpeed").tolist()))
        slip = np.zeros_like(positions)
        slip[..., 2] = -np.array([speed[number] for number in ids.tolist()])[:, None]
    width, air = max(bounds[1] - bounds[0], bounds[3] - bounds[2]), air_of(folder)
    whole = flights(folder, ids, positions.shape[1], rate, is_free)
    last = [(body, max(mark - int(round(rate)), 0), [mark]) for body, _, marks in whole for mark in marks]
    for name, flown in (("last", last), ("whole", whole)):
        misses = np.concatenate([fly(*flight, positions, slip, is_free, air, rate, width) for flight in flown] + [[]])
        print(name, *(["none"] if not len(misses) else [f"{np.percentile(misses, share):.9g}" for share in (50, 90)]))


if __name__ == "__main__":
    main(sys.argv[1])
