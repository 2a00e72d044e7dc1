# SPDX-License-Identifier: BSD-3-Clause
"""A scene made in Python, or read from a scene file: waft.Scene. Needs nothing but Python."""
from __future__ import annotations

import json
import os
import re
from typing import Any, Dict, Iterable, List, Mapping, Optional, SupportsFloat, Union

from waft.failures import InputError
from waft.files import whole_file, write_text
from waft.reading import json_of, read_json, read_text
from waft.scene import _schema
from waft.scene._entries import argument_name, documented, entry_of, refusal, sensible
from waft.scene._sense import classes_of, last_frame, last_frames, latest, targets_of

Frame = Union[int, Mapping[str, int]]  # or a window {"from": frame, "to": frame}
Releases = Union[int, Mapping[str, SupportsFloat]]  # or {"from": frame, "to": frame} or {"from": frame, "rate": objects a second}
Order = Union[str, Mapping[str, Any], Iterable[int]]  # a word, a direction or a list of ranks
Vector = Iterable[SupportsFloat]  # a tuple, a list, a numpy array, ... of three numbers
Quaternion = Iterable[SupportsFloat]  # w, x, y, z
Path = Union[str, "os.PathLike[str]"]
Motion = Iterable[Mapping[str, Any]]  # [{"frame": 0, "position": (0, 0, 1)}, ...]

_LISTS = ("objects", "constraints", "obstacles", "winds", "vortices")
_TOP = 4.0  # of the volume where none is set [m]
_TARGETS = {"points": "pointTargets", "text": "textTargets", "image": "imageTargets", "mesh": "meshTargets"}


class Scene:
    """What flies, where it is to be and when, what stands in the way and which winds blow.

        scene = waft.Scene("A word")
        leaves = scene.add_objects("maple", count=60, region={"min": (-1, -1, 2.5), "max": (1, 1, 3.8)})
        scene.add_keyframe(299, text="HELLO", origin=(0, 0, 1.5), v=(0, 0, 1), width=3)
        scene.save("hello.waft.json")
        run = waft.synthesize(scene)

    Metres, seconds, kilograms, radians; z is up; frames are counted from 0. Arguments are the fields of scene files
    (Documentation/SceneFiles.md) with underscores: settling_speed is settlingSpeed. A vector is a tuple, list or numpy array
    [x, y, z], or whatever gives three numbers, a quaternion [w, x, y, z]. Paths of files are relative to the working directory; in a saved scene they are
    relative to it. A wrong argument raises waft.InputError at once, naming the argument, what was expected and what was found.
    Shapes, objects and obstacles come before what names them.
    """

    @documented("scene")
    def __init__(self, title: Optional[str] = None, *, seed: Optional[int] = None, comment: Optional[str] = None) -> None:
        """An empty scene: a volume of 4 m x 4 m x 4 m, 300 frames, 30 a second."""
        self._data = entry_of("__init__", "scene", _given(locals()), waft=1)
        self._ids: Dict[int, None] = {}  # in their order

    # The stage

    @documented("time")
    def set_time(self, frames: Optional[int] = None, frames_per_second: Optional[float] = None, *, loop: Optional[bool] = None,
                 comment: Optional[str] = None) -> None:
        """How long the scene is. Frames of marks are checked against it, so that it comes before them."""
        self._set("set_time", "time", locals())

    @documented("domain")
    def set_domain(self, min: Optional[Vector] = None, max: Optional[Vector] = None, *, open: Optional[Iterable[str]] = None,
                   comment: Optional[str] = None) -> None:
        """The volume that objects stay in; its sides are walls, but for those that are open (x, y, top)."""
        self._set("set_domain", "domain", locals(), "ground")

    @documented("ground")
    def set_ground(self, height: Optional[float] = None, enabled: Optional[bool] = None, *,
                   comment: Optional[str] = None) -> None:
        """A closed slab below a height, an obstacle."""
        self._set("set_ground", "ground", locals(), "domain")

    @documented("air")
    def set_air(self, density: Optional[float] = None, *, breeze: Union[str, Vector, None] = None, comment: Optional[str] = None) -> None:
        """The air that carries the objects."""
        self._set("set_air", "air", locals())

    # What flies

    @documented("shape")
    def add_shape(self, name: str, builtin: Optional[str] = None, *, mesh: Optional[Path] = None, align: Optional[bool] = None,
                  texture: Optional[Path] = None, size: Optional[float] = None, area_density: Optional[float] = None,
                  thickness: Optional[float] = None, drag_coefficient: Optional[float] = None,
                  settling_speed: Optional[float] = None, color: Optional[Vector] = None, class_: Optional[str] = None,
                  comment: Optional[str] = None) -> str:
        """A body by a name: a built-in one, or a mesh or photograph. Returns the name."""
        if not isinstance(name, str) or not name or name.startswith("_") or name in self.shapes:
            raise refusal("add_shape", "name", "a new name that does not begin with _", _schema.shown(name))
        wrong = _schema.fault(name, _schema.definition("name"), "name")
        if wrong:
            raise refusal("add_shape", *wrong)
        given = {key: value for key, value in _given(locals()).items() if key != "name"}
        self._make_room("add_shape", "shapes", len(self.shapes))
        entry = self._with_files("add_shape", "shape", entry_of("add_shape", "shape", given))
        self._data.setdefault("shapes", {})[name] = entry
        return name

    @documented("singleObject")
    def add_object(self, shape: str, position: Vector, *, id: Optional[int] = None, velocity: Optional[Vector] = None,
                   orientation: Optional[Quaternion] = None, angular_velocity: Optional[Vector] = None,
                   mass: Optional[float] = None, settling_speed: Optional[float] = None,
                   clearance_radius: Optional[float] = None, rest_height: Optional[float] = None, class_: Optional[str] = None,
                   release: Optional[Releases] = None, appears: Optional[bool] = None, on: Optional[int] = None,
                   leave: Optional[Mapping[str, Any]] = None, order: Optional[Order] = None, spread: Optional[str] = None,
                   comment: Optional[str] = None) -> int:
        """One object; returns its id. `shape`: one that was added, or a built-in one."""
        entry = self._objects_entry("add_object", "singleObject", locals())
        return self._append_objects("add_object", entry)[0]

    @documented("objectsInRegion", "objectsAtPositions")
    def add_objects(self, shape: str, *, count: Optional[int] = None, region: Optional[Mapping[str, Vector]] = None,
                    positions: Optional[Iterable[Vector]] = None, seed: Optional[int] = None,
                    velocity: Optional[Vector] = None, orientation: Optional[Quaternion] = None,
                    angular_velocity: Optional[Vector] = None, mass: Optional[float] = None,
                    settling_speed: Optional[float] = None, clearance_radius: Optional[float] = None,
                    rest_height: Optional[float] = None, class_: Optional[str] = None,
                    release: Optional[Releases] = None, appears: Optional[bool] = None, on: Optional[int] = None,
                   leave: Optional[Mapping[str, Any]] = None, order: Optional[Order] = None, spread: Optional[str] = None,
                    comment: Optional[str] = None) -> List[int]:
        """Several objects: `count` spread in a `region` {"min": ..., "max": ...}, or one at each of `positions`. Returns their
        ids. `shape`: one that was added, or a built-in one."""
        kind = "objectsInRegion" if positions is None else "objectsAtPositions"
        return self._append_objects("add_objects", self._objects_entry("add_objects", kind, locals()))

    # Marks

    @documented("positionConstraint")
    def add_position(self, object: int, frame: Frame, value: Vector, *, order: Optional[Order] = None,
                     spread: Optional[str] = None, on: Optional[int] = None, hold: Optional[int] = None,
                     drift: Optional[bool] = None, hold_radius: Optional[float] = None, leave: Optional[Mapping[str, Any]] = None, radius: Optional[float] = None,
                     facing: Optional[Mapping[str, Any]] = None, comment: Optional[str] = None) -> int:
        """An object is at a place at a frame. Returns the row, as all constraints do."""
        return self._add_mark("add_position", "position", locals())

    @documented("velocityConstraint")
    def add_velocity(self, object: int, frame: int, value: Vector, *, radius: Optional[float] = None,
                     comment: Optional[str] = None) -> int:
        """An object has a velocity at a frame."""
        return self._add_mark("add_velocity", "velocity", locals())

    @documented("accelerationConstraint")
    def add_acceleration(self, object: int, frame: int, value: Vector, *, radius: Optional[float] = None,
                         comment: Optional[str] = None) -> int:
        """An object has an acceleration at a frame."""
        return self._add_mark("add_acceleration", "acceleration", locals())

    @documented("orientationConstraint")
    def add_orientation(self, object: int, frame: int, value: Quaternion, *, radius: Optional[float] = None,
                        comment: Optional[str] = None) -> int:
        """An object is turned so at a frame."""
        return self._add_mark("add_orientation", "orientation", locals())

    @documented("restConstraint")
    def add_rest(self, object: int, frame: Frame, value: Vector, *, order: Optional[Order] = None,
                 spread: Optional[str] = None, on: Optional[int] = None, until: Optional[int] = None,
                 leave: Optional[Mapping[str, Any]] = None,
                 face_up: Optional[str] = None, comment: Optional[str] = None) -> int:
        """An object lies still on the first surface straight below a place, from a frame on."""
        return self._add_mark("add_rest", "rest", locals())

    @documented("pathConstraint")
    def add_path(self, object: int, first_frame: int, points: Iterable[Vector], *, radius: Optional[float] = None,
                 comment: Optional[str] = None) -> int:
        """An object follows points, one a frame."""
        return self._add_mark("add_path", "path", locals())

    @documented("keyframeConstraint", "pointTargets", "textTargets", "imageTargets", "meshTargets")
    def add_keyframe(self, frame: Frame, *, order: Optional[Order] = None, spread: Optional[str] = None,
                     points: Optional[Iterable[Vector]] = None, text: Optional[str] = None,
                     image: Optional[Path] = None, mesh: Optional[Path] = None, origin: Optional[Vector] = None,
                     u: Optional[Vector] = None, v: Optional[Vector] = None, width: Optional[float] = None,
                     count: Optional[int] = None, font: Optional[Path] = None,
                     classes: Union[Iterable[str], Mapping[str, Vector], None] = None,
                     objects: Optional[Iterable[int]] = None, assign: Optional[str] = None,
                     velocity: Union[str, Vector, None] = None, until: Optional[int] = None, hold: Optional[int] = None,
                     drift: Optional[bool] = None, hold_radius: Optional[float] = None, on: Optional[int] = None, leave: Optional[Mapping[str, Any]] = None,
                     radius: Optional[float] = None, facing: Optional[Mapping[str, Any]] = None, face_up: Optional[str] = None,
                     comment: Optional[str] = None) -> int:
        """Objects form points, a text, an image or the surface of a mesh at a frame (one of these four)."""
        given = _given(locals())
        kinds = [kind for kind in _TARGETS if given[kind] is not None]
        if len(kinds) != 1:
            raise refusal("add_keyframe", " or ".join(_TARGETS), "one of these", f"{len(kinds)} of them")
        definition = _TARGETS[kinds[0]]
        own = {argument_name(field) for field in _schema.definition("keyframeConstraint")["properties"]}
        others = {name: value for name, value in given.items() if name not in own and name != "comment"}
        targets = self._with_files("add_keyframe", definition, entry_of("add_keyframe", definition, others))
        known = classes_of(self._data)
        for name in targets.get("classes", ()):
            if name and not name.startswith("_") and name not in known:
                raise refusal("add_keyframe", "classes", f"classes of shapes and objects ({', '.join(sorted(known)) or 'none has one'})",
                              _schema.shown(name))
        rest = {name: value for name, value in given.items() if name not in others}
        return self._append_mark("add_keyframe", entry_of("add_keyframe", "keyframeConstraint", {**rest, "targets": targets},
                                                          kind="keyframe"))

    # What stands in the way

    @documented("boxObstacle")
    def add_box(self, min: Vector, max: Vector, *, id: Optional[int] = None, motion: Optional[Motion] = None,
                comment: Optional[str] = None) -> int:
        """A box along the axes. Returns its id, as all obstacles do."""
        return self._add_obstacle("add_box", "box", locals())

    @documented("sphereObstacle")
    def add_sphere(self, center: Vector, radius: float, *, id: Optional[int] = None, motion: Optional[Motion] = None,
                   comment: Optional[str] = None) -> int:
        """A ball."""
        return self._add_obstacle("add_sphere", "sphere", locals())

    @documented("cylinderObstacle")
    def add_cylinder(self, base: Vector, top: Vector, radius: float, *, id: Optional[int] = None,
                     motion: Optional[Motion] = None, comment: Optional[str] = None) -> int:
        """A round bar from base to top."""
        return self._add_obstacle("add_cylinder", "cylinder", locals())

    @documented("meshObstacle")
    def add_mesh(self, file: Path, *, position: Optional[Vector] = None, scale: Optional[float] = None,
                 up: Optional[str] = None, id: Optional[int] = None, motion: Optional[Motion] = None,
                 comment: Optional[str] = None) -> int:
        """A closed surface from a file."""
        return self._add_obstacle("add_mesh", "mesh", locals())

    # What blows

    @documented("analyticWind")
    def add_wind(self, direction: Vector, strength: float, center: Vector, radius: float, center_time: float,
                 duration: float, *, comment: Optional[str] = None) -> None:
        """A gust: strength dir exp(-|x - center|^2 / 2 radius^2) exp(-(t - center_time)^2 / 2 duration^2)."""
        self._append("winds", "add_wind", "analyticWind", locals())

    @documented("windFront")
    def add_front(self, direction: Vector, speed: float, strength: float, *, width: Optional[float] = None,
                  start_frame: Optional[int] = None, origin: Optional[Vector] = None, comment: Optional[str] = None) -> None:
        """A gust whose edge travels, and lifts what lies to the end as it passes."""
        self._append("winds", "add_front", "windFront", locals(), kind="front")

    @documented("windFile")
    def add_wind_file(self, file: Path, *, array: Optional[str] = None, up: Optional[str] = None,
                      first_frame: Optional[int] = None, scale: Optional[float] = None, comment: Optional[str] = None) -> None:
        """A wind from a file of fields."""
        self._append("winds", "add_wind_file", "windFile", locals())

    @documented("vortex")
    def add_vortex(self, p1: Vector, p2: Vector, strength: float, center_time: float, duration: float, core_radius: float, *,
                   comment: Optional[str] = None) -> None:
        """Air that turns about the line from p1 to p2."""
        self._append("vortices", "add_vortex", "vortex", locals())

    # Files and looking inside

    def save(self, path: Path, *, is_new: bool = False) -> None:
        """Writes the scene file; paths in it are relative to it. Raises InputError where there is no such folder, where something else
        than a scene is there, or with is_new anything, which stays, and OSError where it cannot be written."""
        path = _schema.plain(path)
        if not isinstance(path, str) or not path:
            raise refusal("save", "path", "the path of a file", _schema.shown(path))
        folder = os.path.dirname(os.path.abspath(path))
        if not os.path.isdir(folder):
            raise refusal("save", "path", "the path of a file in a folder that is there", _schema.shown(path))
        for number, row in enumerate(self._data.get("constraints", ())):
            if row["kind"] == "keyframe" and "objects" not in row and targets_of(row) > len(self._ids):
                raise refusal("save", f"constraints[{number}]", f"at most {len(self._ids)} targets, the number of objects", targets_of(row))
        content = _schema.with_files(self._data, _schema.definition("scene"), lambda file: os.path.relpath(file, folder))
        text = re.sub(r"\[\s+([-+.\deE,\s]+?)\s+\]", lambda list_: f"[{' '.join(list_[1].split())}]", json.dumps(content, indent=2))
        with whole_file(path, None if is_new else _is_scene) as part:
            write_text(part, text + "\n")

    @classmethod
    def load(cls, path: Path) -> "Scene":
        """Reads a scene file, comments included. Raises InputError that names file and place where it is malformed."""
        path = os.fspath(path)
        data = read_json(path, what="a scene file", parse_constant=_no_number)
        wrong = _schema.fault(data, _schema.definition("scene"), "")
        if wrong:
            place, expected, found = wrong
            raise InputError(f"{path}: {place or '/'}: expected {expected}, found {found}")
        scene = cls()
        scene._data = _schema.with_files(data, _schema.definition("scene"), lambda file: _file_of_scene(path, file))
        for objects in scene._data.get("objects", ()):
            scene._ids.update(dict.fromkeys(scene._new_ids(objects)))
        return scene

    def as_dict(self) -> Dict[str, Any]:
        """A copy of the scene as JSON has it, paths absolute."""
        return json.loads(json.dumps(self._data))

    def files(self) -> List[str]:
        """Paths of all files that the scene names."""
        found: Dict[str, None] = {}
        _schema.with_files(self._data, _schema.definition("scene"), lambda file: found.setdefault(file))
        return list(found)

    @property
    def shapes(self) -> List[str]:
        """Names of the shapes."""
        return [name for name in self._data.get("shapes", ()) if not name.startswith("_")]

    @property
    def objects(self) -> List[int]:
        """Ids of the objects."""
        return list(self._ids)

    @property
    def frames(self) -> int:
        """Number of frames."""
        return int(self._data.get("time", {}).get("frames", _schema.definition("time")["properties"]["frames"]["default"]))

    def with_seed(self, seed: int) -> "Scene":
        """A copy whose seed is another: another flight to the same marks."""
        copy = type(self)(seed=seed)  # refuses what is no seed
        copy._data = {**self._data, **copy._data}
        copy._ids = dict(self._ids)
        return copy

    def __repr__(self) -> str:
        counts = ", ".join(f"{len(self._data.get(name, ()))} {name}" for name in _LISTS[1:] if self._data.get(name))
        title = self._data.get("title")
        return f"<Scene{' ' + repr(title) if title else ''}: {len(self._ids)} objects, {self.frames} frames" + (
            f", {counts}>" if counts else ">")

    # Inside

    def _set(self, method, name, given, other=None):
        """Sets fields of a part of the stage; other: the part that it has to go with, of ground and domain."""
        entry = sensible(method, name, {**self._data.get(name, {}), **entry_of(method, name, _given(given))})
        for what, last in last_frames(self._data) if "frames" in entry and name == "time" else ():
            if entry["frames"] <= last:
                raise refusal(method, "frames", f"more than {last}, a frame of {what}", entry["frames"])
        if other is not None:
            parts = {**self._data, name: entry}
            height, top = parts.get("ground", {}).get("height"), parts.get("domain", {}).get("max", [0.0, 0.0, _TOP])[2]
            if height is not None and height >= top:
                raise refusal(method, "height" if name == "ground" else "max", "a ground below the top of the volume",
                              f"{height:g} m and {top:g} m")
        self._data[name] = entry

    def _make_room(self, method, name, count):
        """Refuses one entry more than a scene may have."""
        field = _schema.definition("scene")["properties"][name]
        most = field.get("maxItems", field.get("maxProperties"))
        if count >= most:
            raise refusal(method, name, f"at most {most} of them in a scene", count + 1)

    def _append(self, name, method, definition, given, **more):
        self._make_room(method, name, len(self._data.get(name, ())))
        entry = self._with_files(method, definition, entry_of(method, definition, _given(given), **more))
        self._data.setdefault(name, []).append(entry)

    def _with_files(self, method, definition, entry):
        """The entry with the absolute paths of its files, which have to be there."""
        def there(given):
            path = os.path.abspath(os.path.expanduser(given))
            if not os.path.isfile(path):
                argument = next(name for name, value in entry.items() if value == given)
                raise refusal(method, argument, "a file that is there", _schema.shown(path))
            return path
        return _schema.with_files(entry, _schema.definition(definition), there)

    def _objects_entry(self, method, definition, given):
        self._make_room(method, "objects", len(self._data.get("objects", ())))
        entry = entry_of(method, definition, {name: value for name, value in _given(given).items() if name != "kind"})
        if entry["shape"] not in self.shapes:
            builtins = _schema.definition("shape")["properties"]["builtin"]["enum"]
            if entry["shape"] not in builtins:
                names = ", ".join(dict.fromkeys([*self.shapes, *builtins]))
                raise refusal(method, "shape", f"one of {names}", _schema.shown(entry["shape"]))
            self._make_room(method, "shapes", len(self.shapes))
            self._data.setdefault("shapes", {})[entry["shape"]] = {"builtin": entry["shape"]}
        self._check_on(method, entry)
        taken = next((number for number in self._new_ids(entry) if number in self._ids), None)
        if taken is not None:
            raise refusal(method, "id", "an id that no object has", taken)
        return entry

    def _check_on(self, method, entry):
        """Refuses what is to go along with an obstacle that is not there."""
        there = [obstacle.get("id", place) for place, obstacle in enumerate(self._data.get("obstacles", ()))]
        if "on" in entry and entry["on"] not in there:
            raise refusal(method, "on", f"the id of one of the scene's {len(there)} obstacles", entry["on"])

    def _new_ids(self, entry):
        count = entry["count"] if "count" in entry else len(entry["positions"]) if "positions" in entry else 1
        first = entry.get("id", len(self._ids))
        return list(range(int(first), int(first) + int(count)))

    def _append_objects(self, method, entry):
        ids = self._new_ids(entry)
        most = _schema.definition("objectsAtPositions")["properties"]["positions"]["maxItems"]  # of all entries, too
        if len(self._ids) + len(ids) > most:
            raise refusal(method, "objects", f"at most {most} in a scene", len(self._ids) + len(ids))
        self._data.setdefault("objects", []).append(entry)
        self._ids.update(dict.fromkeys(ids))
        return ids

    def _add_mark(self, method, kind, given):
        return self._append_mark(method, entry_of(method, f"{kind}Constraint", _given(given), kind=kind))

    def _append_mark(self, method, entry):
        """Adds a row; its objects have to be there, its frames among those of the scene."""
        self._make_room(method, "constraints", len(self._data.get("constraints", ())))
        self._check_on(method, entry)
        for name in ("object", "objects"):
            ids = entry.get(name, [])
            for number in ids if isinstance(ids, list) else [ids]:
                if number != -1 and number not in self._ids:
                    raise refusal(method, name, f"the id of one of the scene's {len(self._ids)} objects", number)
        last = self.frames - 1
        for name, frame in (("frame", latest(entry["frame"]) if "frame" in entry else None), ("until", entry.get("until")),
                            ("first_frame", entry.get("firstFrame")), ("points", last_frame(entry))):
            if frame is not None and frame > last:
                raise refusal(method, name, f"a frame from 0 to {last}, as set_time says", frame)
        self._data.setdefault("constraints", []).append(entry)
        return len(self._data["constraints"]) - 1

    def _add_obstacle(self, method, kind, given):
        there = self._data.get("obstacles", [])
        entry = self._with_files(method, f"{kind}Obstacle", entry_of(method, f"{kind}Obstacle", _given(given), kind=kind))
        own = entry.get("id", len(there))
        if own in (obstacle.get("id", place) for place, obstacle in enumerate(there)):
            raise refusal(method, "id", "an id that no obstacle has", own)
        late = next((step["frame"] for step in entry.get("motion", ()) if step["frame"] >= self.frames), None)
        if late is not None:
            raise refusal(method, "motion", f"frames from 0 to {self.frames - 1}, as set_time says", late)
        self._make_room(method, "obstacles", len(there))
        self._data.setdefault("obstacles", []).append(entry)
        return own


def _is_scene(path):
    """Whether a file is a scene, or is empty: it may be saved over."""
    try:
        text = read_text(path)
        content = json_of(text, path) if text else {"waft": 1}
    except InputError:
        return False
    return isinstance(content, dict) and "waft" in content


def _file_of_scene(scene, name):
    """The path of a file that a scene names: beside its own file, else, where that is a link, beside what it leads to."""
    beside, behind = (os.path.join(os.path.dirname(own), name) for own in (os.path.abspath(scene), os.path.realpath(scene)))
    return behind if os.path.exists(behind) and not os.path.exists(beside) else beside


def _given(arguments):
    return {name: value for name, value in arguments.items() if name not in ("self", "kind")}


def _no_number(text):
    raise ValueError(f"{text} is no number")
