# SPDX-License-Identifier: BSD-3-Clause
"""The animation as a page has it: a key at each frame that it shows, of a motion that is too much for a browser at every n-th."""
import json
import math
import struct

import numpy as np

MOST_POSES = 1_000_000  # of all objects in all frames: some 40 MB of page, and lines that a small machine draws


def interval(objects, frames):
    """Every how many frames one is shown."""
    return max(1, math.ceil(objects * frames / MOST_POSES))


def shown(content, frames, every):
    """The bytes of an animation.glb of so many frames with a key at every n-th alone. Raises ValueError, LookupError or TypeError on a
    damaged one."""
    gltf, binary = _parts(content)
    if "keys" in gltf["asset"]["extras"]:
        return _filled(gltf, binary, np.arange(0, frames, every))
    return _thinned(gltf, binary, every) if every > 1 else content


def _parts(content):
    size = struct.unpack_from("<I", content, 12)[0]
    return json.loads(content[20:20 + size]), memoryview(content)[28 + size:]


def _joined(gltf, blocks):
    """The file of a JSON part and blocks of bytes."""
    size = sum(len(block) for block in blocks)
    gltf["buffers"][0]["byteLength"] = size
    text = json.dumps(gltf, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    return b"".join([struct.pack("<4sII", b"glTF", 2, 28 + len(text) + size), struct.pack("<I4s", len(text), b"JSON"), text,
                     struct.pack("<I4s", size, b"BIN\0"), *blocks])


def _thinned(gltf, binary, every):
    """Of keys at all frames, a view of the buffer an accessor, every n-th."""
    keyed = {number for sampler in gltf["animations"][0]["samplers"] if not _steps(sampler) for number in (sampler["input"], sampler["output"])}
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
    return _joined(gltf, kept)


def _steps(sampler):
    """Whether it says when a body is in the shot: at instants of its own."""
    return sampler.get("interpolation") == "STEP"


def _filled(gltf, binary, frames):
    """Of keys of which those are left out that others give back, in the last view of the buffer, keys at these frames."""
    extras, animation, accessors, views = gltf["asset"]["extras"], gltf["animations"][0], gltf["accessors"], gltf["bufferViews"]
    first = [accessor["bufferView"] for accessor in accessors].index(len(views) - 1)
    begin = views[-1]["byteOffset"]

    def read(number, width):
        if number < first:
            raise ValueError("keys that are not in the last view")
        accessor = accessors[number]
        return np.frombuffer(binary, "<f4", accessor["count"] * width, begin + accessor.get("byteOffset", 0)).reshape(-1, width)

    def add(values, kind, **more):
        added.append({"bufferView": len(views) - 1, "byteOffset": len(data), "componentType": 5126, "count": len(values),
                      "type": kind, **more})
        data.extend(values.astype("<f4").tobytes())

    times = (frames / extras["framesPerSecond"]).astype("<f4")
    data, added = bytearray(), []
    add(times, "SCALAR", min=[float(times[0])], max=[float(times[-1])])
    for channel in animation["channels"]:
        sampler = animation["samplers"][channel["sampler"]]
        if _steps(sampler):
            instants, sizes = read(sampler["input"], 1), read(sampler["output"], 3)
            sampler.update(input=first + len(added), output=first + len(added) + 1)
            add(instants, "SCALAR", min=[float(instants[0, 0])], max=[float(instants[-1, 0])])
            add(sizes, "VEC3")
            continue
        is_turn = channel["target"]["path"] == "rotation"
        keys, values = read(sampler["input"], 1)[:, 0].astype(float), read(sampler["output"], 3 + is_turn).astype(float)
        sampler.update(input=first, output=first + len(added))
        add(_between(keys, values, times, is_turn), "VEC4" if is_turn else "VEC3")
    del extras["keys"]
    accessors[first:] = added
    views[-1]["byteLength"] = len(data)
    return _joined(gltf, [binary[:begin], data])


def _between(keys, values, times, is_turn):
    """Values at keys, by time, as they are at other times: on straight lines, or turned evenly the short way. At a key exactly its own."""
    index = np.clip(np.searchsorted(keys, times, side="right") - 1, 0, max(len(keys) - 2, 0))
    after = np.minimum(index + 1, len(keys) - 1)
    length = keys[after] - keys[index]
    part = np.clip((times - keys[index]) / np.where(length > 0.0, length, 1.0), 0.0, 1.0)[:, None]
    begin, end = values[index], values[after]
    if not is_turn:
        return (1.0 - part) * begin + part * end
    cosine = np.sum(begin * end, axis=1, keepdims=True)
    angle = np.arccos(np.minimum(np.abs(cosine), 1.0))
    sine = np.where(angle < 1e-6, 1.0, np.sin(angle))
    first = np.where(angle < 1e-6, 1.0 - part, np.sin((1.0 - part) * angle) / sine)
    return first * begin + np.where(angle < 1e-6, part, np.sin(part * angle) / sine) * np.where(cosine < 0.0, -end, end)
