# SPDX-License-Identifier: BSD-3-Clause
"""A binary glTF file that more is put into. Everything given is z-up, as in Waft; the file is y-up."""
import json
import struct

import numpy as np

_FLOAT, _UINT = 5126, 5125
_VERTICES, _INDICES = 34962, 34963
_WIDTHS = {1: "SCALAR", 3: "VEC3"}


def y_up(points):
    """Points or directions [..., 3] with the axes of glTF."""
    points = np.asarray(points, float)
    return np.stack([points[..., 0], points[..., 2], -points[..., 1]], axis=-1)


class Gltf:
    """content: the JSON part. origin: what places of nodes in the file are relative to; places given here are the scene's."""

    def __init__(self, data, origin):
        size = struct.unpack("<I", data[12:16])[0]
        self.content = json.loads(data[20:20 + size])
        self._binary = bytearray(data[28 + size:])
        self._origin = origin
        root = next((node for node in self.content["nodes"] if "children" in node), None)
        self._siblings = root["children"] if root else self.content["scenes"][0]["nodes"]

    def data(self):
        """The file."""
        self.content["buffers"][0]["byteLength"] = len(self._binary)
        text = json.dumps(self.content, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        length = 28 + len(text) + len(self._binary)
        return b"".join([struct.pack("<4sIII4s", b"glTF", 2, length, len(text), b"JSON"), text,
                         struct.pack("<I4s", len(self._binary), b"BIN\0"), bytes(self._binary)])

    def add_mesh(self, name, points, triangles, color):
        """Adds a mesh of points [n, 3] about its own origin, of one colour; returns its number."""
        material = self._append("materials", {"name": name, "doubleSided": True, "pbrMetallicRoughness": {
            "baseColorFactor": [*color, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.9}})
        primitive = {"attributes": {"POSITION": self._accessor(y_up(points).astype("<f4"), _FLOAT, _VERTICES)},
                     "indices": self._accessor(triangles.astype("<u4").reshape(-1, 1), _UINT, _INDICES), "material": material}
        return self._append("meshes", {"name": name, "primitives": [primitive]})

    def add_node(self, name, place, **fields):
        """Adds a node to the scene at a place; returns its number."""
        number = self._append("nodes", {"name": name, "translation": y_up(np.subtract(place, self._origin)).tolist(), **fields})
        self._siblings.append(number)
        return number

    def move_node(self, node, places, rate):
        """Keys a node's place at every frame, at the times of objects that have a key at each where there is one."""
        animation, accessors = self.content["animations"][0], self.content["accessors"]
        times = next((sampler["input"] for sampler in animation["samplers"] if accessors[sampler["input"]]["count"] == len(places)), None)
        if times is None:
            times = self._accessor((np.arange(len(places)) / rate).astype("<f4").reshape(-1, 1), _FLOAT)
        animation["samplers"].append({"input": times, "interpolation": "LINEAR",
                                      "output": self._accessor(y_up(places - self._origin).astype("<f4"), _FLOAT)})
        animation["channels"].append({"sampler": len(animation["samplers"]) - 1, "target": {"node": node, "path": "translation"}})

    def add_camera(self, name, height_angle, near, far):
        """Adds a camera that is `height_angle` radians high; returns its number."""
        return self._append("cameras", {"name": name, "type": "perspective",
                                        "perspective": {"yfov": height_angle, "znear": near, "zfar": far}})

    def _append(self, group, entry):
        self.content.setdefault(group, []).append(entry)
        return len(self.content[group]) - 1

    def _accessor(self, values, kind, target=None):
        view = {"buffer": 0, "byteOffset": len(self._binary), "byteLength": values.nbytes}
        if target:
            view["target"] = target
        self._binary += values.tobytes()  # of four bytes each: what follows stays aligned
        accessor = {"bufferView": self._append("bufferViews", view), "componentType": kind, "count": len(values),
                    "type": _WIDTHS[values.shape[1]], "min": values.min(axis=0).tolist(), "max": values.max(axis=0).tolist()}
        return self._append("accessors", accessor)
