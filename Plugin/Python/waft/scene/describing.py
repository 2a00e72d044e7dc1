# SPDX-License-Identifier: BSD-3-Clause
"""What a scene file says, in figures: `waft info SCENE`."""
import collections
import json
import os

from waft.reading import check_scene_file
from waft.scene import _schema
from waft.scene.builder import Scene


def describe_scene(path):
    """The document on a scene file. Raises InputError where it is none."""
    check_scene_file(path, "no such folder of results, and no such scene file")
    scene = Scene.load(path)
    said = scene.as_dict()
    rate = said.get("time", {}).get("framesPerSecond", _default("time", "framesPerSecond"))
    domain = said.get("domain", {})
    bodies = collections.Counter()
    for entry in said.get("objects", ()):
        bodies[entry["shape"]] += int(entry.get("count", len(entry.get("positions", (0,)))))
    folder = os.path.dirname(os.path.abspath(path))
    return {"file": path, "title": said.get("title", ""), "seed": said.get("seed", _default("scene", "seed")),
            "time": {"frames": scene.frames, "framesPerSecond": rate},
            "volume": {side: domain.get(side, _default("domain", side)) for side in ("min", "max")},
            "objects": len(scene.objects), "shapes": dict(bodies),
            "constraints": dict(collections.Counter(row["kind"] for row in said.get("constraints", ()))),
            **{name: len(said.get(name, ())) for name in ("obstacles", "winds", "vortices")},
            "files": [{"name": os.path.relpath(file, folder), "found": os.path.isfile(file)} for file in scene.files()]}


def _default(definition, name):
    field = _schema.definition(definition)["properties"][name]
    return field["default"] if "default" in field else json.loads(field["description"].removeprefix("default "))  # of a vector


def words_of_scene(held):
    """The same in lines for a reader."""
    time, volume = held["time"], held["volume"]
    sides = " x ".join(f"{high - low:g}" for low, high in zip(volume["min"], volume["max"]))
    yield f"{held['file']}: {held['title'] or 'a scene without a title'}, seed {held['seed']}"
    seconds = time["frames"] / time["framesPerSecond"]
    yield f"  {time['frames']} frames at {time['framesPerSecond']:g} a second ({seconds:.3g} s), a volume of {sides} m"
    yield f"  {held['objects']} objects: " + ", ".join(f"{count} {shape}" for shape, count in held["shapes"].items())
    rows = ", ".join(f"{count} {kind}" for kind, count in held["constraints"].items())
    yield f"  constraints: {rows or 'none'}"
    others = [f"{held[name]} {name}" for name in ("obstacles", "winds", "vortices") if held[name]]
    if others:
        yield f"  {', '.join(others)}"
    for file in held["files"]:
        yield f"  {file['name']}" + ("" if file["found"] else ": no such file")
