# SPDX-License-Identifier: BSD-3-Clause
"""What a case of bad input is, and the scenes that cases start from."""
import copy
import dataclasses
import json
import typing

OUT = "out"  # where a command of a case writes when it is to write


@dataclasses.dataclass
class Case:
    """One input and what is to become of it.

    make(folder, results) puts the files in the case's empty folder, from where the command is called, and returns its
    arguments. results: a folder with an older run's results, which has to stay as it is. Or act() is called instead of a
    command, for what is no file, and returns what was wrong, a sentence, or nothing.
    status: the exit statuses that are right. says: what the message has to contain. limits: resource limits of the
    case's process. environment: its variables beside those there are.
    """

    group: str
    name: str
    make: typing.Optional[typing.Callable] = None
    act: typing.Optional[typing.Callable] = None
    status: tuple = (2,)
    says: tuple = ()
    limits: dict = dataclasses.field(default_factory=dict)
    environment: dict = dataclasses.field(default_factory=dict)


LEAF = {
    "waft": 1,
    "time": {"frames": 31},
    "shapes": {"leaf": {"builtin": "leaf"}},
    "objects": [{"shape": "leaf", "position": [0.0, 0.0, 2.0]}],
}

# Every field of the format once, and right.
WIDE = {
    "waft": 1,
    "title": "Everything",
    "seed": 3,
    "time": {"frames": 31, "framesPerSecond": 30.0},
    "domain": {"min": [-2.0, -2.0, 0.0], "max": [2.0, 2.0, 4.0]},
    "ground": {"height": 0.1, "enabled": True},
    "air": {"density": 1.2},
    "shapes": {
        "leaf": {"builtin": "leaf", "size": 0.1, "areaDensity": 0.1, "thickness": 0.0003, "dragCoefficient": 1.1,
                 "settlingSpeed": 0.8, "color": [0.2, 0.6, 0.1], "class": "green"},
    },
    "objects": [
        {"shape": "leaf", "position": [0.0, 0.0, 2.0], "id": 0, "velocity": [0.0, 0.0, -0.5],
         "orientation": [1.0, 0.0, 0.0, 0.0], "angularVelocity": [0.0, 0.0, 0.1], "mass": 0.0005,
         "settlingSpeed": 0.8, "clearanceRadius": 0.05, "restHeight": 0.001, "class": "green"},
        {"shape": "leaf", "count": 2, "region": {"min": [-1.5, -1.5, 2.5], "max": [-0.5, -0.5, 3.5]}, "seed": 4},
        {"shape": "leaf", "positions": [[1.5, 1.5, 3.0], [1.5, 0.5, 3.0]]},
    ],
    "constraints": [
        {"kind": "position", "object": 0, "frame": 10, "value": [0.0, 0.0, 1.9], "radius": 0.1,
         "facing": {"direction": [0.0, -1.0, 0.0], "tolerance": 0.5}},
        {"kind": "rest", "object": -1, "frame": 28, "until": 30, "value": [1.5, 0.5, 3.0], "faceUp": "any"},
        {"kind": "velocity", "object": 0, "frame": 20, "value": [0.0, 0.0, -0.5], "radius": 1.0},
        {"kind": "acceleration", "object": 0, "frame": 20, "value": [0.0, 0.0, 0.0], "radius": 1.0},
        {"kind": "orientation", "object": 0, "frame": 20, "value": [1.0, 0.0, 0.0, 0.0], "radius": 0.5},
        {"kind": "path", "object": 3, "firstFrame": 5, "points": [[1.5, 1.5, 2.9], [1.5, 1.5, 2.88]], "radius": 0.2},
        {"kind": "keyframe", "frame": 25, "targets": {"points": [[0.0, 0.0, 1.5]]}, "objects": [0],
         "assign": "optimal", "velocity": [0.0, 0.0, -0.5], "radius": 0.5},
        {"kind": "keyframe", "frame": 26, "objects": [0, 1],
         "targets": {"text": "I", "font": "sans", "origin": [0.0, 0.0, 1.4], "u": [1.0, 0.0, 0.0],
                     "v": [0.0, 0.0, 1.0], "width": 0.3, "count": 2}},
    ],
    "obstacles": [
        {"kind": "box", "min": [1.0, -1.5, 0.1], "max": [1.5, -1.0, 0.5], "id": 7},
        {"kind": "sphere", "center": [-1.5, 1.5, 1.0], "radius": 0.2,
         "motion": [{"frame": 0, "position": [-1.5, 1.5, 1.0]}, {"frame": 30, "position": [-1.5, 1.5, 1.2]}]},
        {"kind": "cylinder", "base": [-1.5, -1.5, 0.1], "top": [-1.5, -1.5, 0.6], "radius": 0.2},
    ],
    "winds": [{"direction": [1.0, 0.0, 0.0], "strength": 0.2, "center": [0.0, 0.0, 2.0], "radius": 1.0,
               "centerTime": 0.5, "duration": 0.5}],
    "vortices": [{"p1": [0.0, 0.0, 1.0], "p2": [0.0, 0.0, 2.0], "strength": 0.1, "centerTime": 0.5, "duration": 0.5,
                  "coreRadius": 0.2}],
}


def places(value, pointer=""):
    """Every (pointer, value) in JSON, outermost first."""
    yield pointer, value
    if isinstance(value, dict):
        members = value.items()
    elif isinstance(value, list):
        members = enumerate(value)
    else:
        return
    for key, member in members:
        yield from places(member, f"{pointer}/{key}")


def at(scene, pointer):
    """The list or object that holds the thing at a pointer, and its key there."""
    *path, last = pointer.split("/")[1:]
    for key in path:
        scene = scene[int(key) if isinstance(scene, list) else key]
    return scene, int(last) if isinstance(scene, list) else last


def with_value(scene, pointer, value):
    """A copy in which the thing at the pointer is another one."""
    changed = copy.deepcopy(scene)
    holder, key = at(changed, pointer)
    if isinstance(holder, list) and key == len(holder):
        holder.append(value)
    else:
        holder[key] = value
    return changed


def without(scene, pointer):
    changed = copy.deepcopy(scene)
    holder, key = at(changed, pointer)
    del holder[key]
    return changed


def synthesize(scene, output, *options):
    """Arguments of a run that is short when the scene is taken."""
    return ["synthesize", str(scene), "--output", str(output), "--preview", "--threads", "1", *map(str, options)]


def scene_case(group, name, scene, *says, status=(2,), files=None, options=(), **more):
    """A scene (JSON or bytes) with the files {name: bytes} beside it. Its name has to stand in every refusal."""
    def make(folder, results):
        text = scene if isinstance(scene, bytes) else json.dumps(scene).encode()
        (folder / "scene.waft.json").write_bytes(text)
        for file, content in (files or {}).items():
            path = folder / file
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content() if callable(content) else content)
        return synthesize("scene.waft.json", OUT if is_taken else results, *options)
    is_taken = 0 in status or 3 in status
    said = ("scene.waft.json", *says) if 2 in status else says
    return Case(group, name, make, status=status, says=said, **more)
