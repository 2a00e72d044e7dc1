# SPDX-License-Identifier: BSD-3-Clause
"""A page of a motion that is too much for a browser: every n-th frame of it."""
import json
import math
import struct

import numpy as np

MOST_POSES = 1_000_000  # of all objects in all frames: some 40 MB of page, and lines that a small machine draws


def interval(objects, frames):
    """Every how many frames one is shown."""
    return max(1, math.ceil(objects * frames / MOST_POSES))


def thinned(content, every):
    """The bytes of an animation.glb, a view of the buffer an accessor, with every n-th of its keys."""
    size = struct.unpack_from("<I", content, 12)[0]
    gltf, binary = json.loads(content[20:20 + size]), memoryview(content)[28 + size:]
    times = {sampler["input"] for sampler in gltf["animations"][0]["samplers"]}
    keyed = times | {sampler["output"] for sampler in gltf["animations"][0]["samplers"]}
    counts = {gltf["accessors"][number]["bufferView"]: gltf["accessors"][number]["count"] for number in keyed}
    kept, at = [], 0
    for number, view in enumerate(gltf["bufferViews"]):
        first = view.get("byteOffset", 0)
        data = np.frombuffer(binary[first:first + view["byteLength"]], np.uint8)
        if number in counts:
            data = np.ascontiguousarray(data.reshape(counts[number], -1)[::every]).ravel()
        view.update(byteOffset=at, byteLength=len(data))
        kept.append(data.tobytes() + bytes(-len(data) % 4))
        at += len(kept[-1])
    for number in keyed:
        accessor = gltf["accessors"][number]
        accessor["count"] = math.ceil(accessor["count"] / every)
        values = np.frombuffer(kept[accessor["bufferView"]], "<f4").reshape(accessor["count"], -1)
        accessor.update(min=values.min(axis=0).tolist(), max=values.max(axis=0).tolist())
    gltf["buffers"][0]["byteLength"] = at
    text = json.dumps(gltf, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    return b"".join([struct.pack("<4sII", b"glTF", 2, 28 + len(text) + at), struct.pack("<I4s", len(text), b"JSON"), text,
                     struct.pack("<I4s", at, b"BIN\0"), *kept])
