# SPDX-License-Identifier: BSD-3-Clause
"""What the JSON of a results folder holds, looked at before it is used. A schema says what is read of each; other fields may be
there."""
from waft.failures import InputError
from waft.scene import _schema

_TEXT = {"type": "string", "maxLength": 1 << 20}
_COUNT = {"type": "integer", "minimum": 0, "maximum": 1 << 53}
_FIGURE = {"anyOf": [{"type": "number", "minimum": -1e300, "maximum": 1e300}, {"type": "null"}]}
_SECONDS = {"type": "number", "minimum": 0, "maximum": 1e12}
_YES = {"type": "boolean"}


def _object(required="", **properties):
    return {"type": "object", "required": required.split(), "properties": properties}


def _list(items, **limits):
    return {"type": "array", "items": items, **limits}


_STAGE = _object(seconds=_SECONDS, processorSeconds=_SECONDS, threadSeconds=_SECONDS, peakMemoryMB=_SECONDS)
_STATUSES = {status: _COUNT for status in ("met", "infeasible", "conflict", "unreachable")}
REPORT = _object("version scene seed", version=_TEXT, key=_TEXT, scene=_TEXT, title=_TEXT, quality=_TEXT, stoppedEarly=_YES, inertia=_YES,
                 warnings=_list(_TEXT),
                 seed={"type": "integer", "minimum": 0, "maximum": 9007199254740991}, constraints=_object(**_STATUSES, unmet=_list({})),
                 stages={"type": "object", "additionalProperties": _STAGE})
FLOWN = {**REPORT, "required": [*REPORT["required"], "constraints", "stages"], "properties": {
    **REPORT["properties"], "constraints": _object("met", **_STATUSES), "stages": {
        "type": "object", "additionalProperties": {**_STAGE, "required": ["processorSeconds", "peakMemoryMB"]}}}}
_ROW = {"anyOf": [_COUNT, {"type": "string", "description": "a whole number", "pattern": r"\A-?[0-9]{1,15}\Z"}]}
_UNMET = _object("Row Target ObjectId Frame Kind Status Message", Row=_ROW, Target=_ROW, ObjectId=_ROW, Frame=_ROW, Kind=_TEXT,
                 Status=_TEXT, Message=_TEXT)
_RATE = {"type": "number", "minimum": 0.001, "maximum": 1000000}
TOLD = {**REPORT, "properties": {
    **REPORT["properties"], "constraints": _object(**_STATUSES, unmet=_list(_UNMET)), "objects": _list({}), "warnings": _list(_TEXT),
    "without": _list(_TEXT), "time": _object("frames framesPerSecond", frames=_COUNT, framesPerSecond=_RATE),
    "stopped": {"type": "object", "required": ["in", "motion", "leftOut"], "properties": {
        "in": _TEXT, "motion": _TEXT, "leftOut": _list(_TEXT)}},
    "energy": _object(before=_FIGURE, after=_FIGURE), "settled": _object(objects=_COUNT, largestShift=_SECONDS),
    "defaults": {"type": "object", "additionalProperties": {"type": "object", "required": ["value", "from"], "properties": {
        "value": {"anyOf": [_COUNT, _TEXT]}, "from": _TEXT}}}}}
_MEASURE = _object("key row value wanted drifters met why", key=_TEXT, row=_TEXT, value=_FIGURE, drifters=_FIGURE, why=_TEXT,
                   wanted=_list(_FIGURE, minItems=2, maxItems=2), met={"anyOf": [_YES, {"type": "null"}]})
MEASURED = _list(_object("folder tracks notes rows", folder=_TEXT, tracks=_TEXT, notes=_list(_TEXT), rows=_list(_MEASURE)))
TAKES = _object("takes", takes=_list(_object(
    "seed folder key status outcome message seconds", seed=REPORT["properties"]["seed"], key=_TEXT, outcome=_TEXT, message=_TEXT,
    folder={"type": "string", "pattern": r"^take-\d{4,}\Z", "description": "the name of a take's folder"}, seconds=_SECONDS,
    status={"type": "integer", "minimum": 0, "maximum": 255}, met=_COUNT, wishes=_COUNT, processorSeconds=_SECONDS, peakMemoryMB=_SECONDS,
    measures=_list(_object("key value met", **_MEASURE["properties"])))))
_NODE = _object(extras=_object("ObjectId", **dict.fromkeys(("ObjectId", "LoopTo"), {"type": "integer", "minimum": 0, "maximum": 1000000000})),
                translation=_list({"type": "number", "minimum": -1e9, "maximum": 1e9}, minItems=3, maxItems=3))
_INDEX = {"type": "integer", "minimum": 0, "maximum": 1 << 31}
_ANIMATION = _object("channels samplers", channels=_list({"type": "object"}), samplers=_list(_object("input", input=_INDEX), minItems=1))
_EXTRAS = {"type": "object"}
GLTF = _object("asset nodes animations accessors bufferViews buffers scenes",
               asset=_object("extras", extras=_object("framesPerSecond", keys=_object("frames", frames={
                   "type": "integer", "minimum": 1, "maximum": 1000000}), framesPerSecond={
                   "type": "number", "minimum": 0.001, "maximum": 1000000})),
               nodes=_list(_NODE, minItems=1), animations=_list(_ANIMATION, minItems=1),
               accessors=_list(_object("count bufferView", count=_INDEX, bufferView=_INDEX, byteOffset=_INDEX)),
               bufferViews=_list(_object("byteLength", byteLength=_INDEX, byteOffset=_INDEX)),
               buffers=_list(_object("byteLength", byteLength=_INDEX), minItems=1, maxItems=1),
               scenes=_list(_object("nodes", nodes=_list(_INDEX), extras=_EXTRAS), minItems=1),
               meshes=_list({"type": "object"}), materials=_list({"type": "object"}), cameras=_list({"type": "object"}))
KEPT = _object("key objects", key=_TEXT, objects=_list(_object(
    "objectId rows met status cost branches seconds message", objectId=_COUNT, rows=_COUNT, met=_COUNT, status=_TEXT, cost={},
    branches=_COUNT, seconds=_SECONDS, message=_TEXT)))
_NAME = {"type": "string", "minLength": 1, "maxLength": 4095}
_DIGEST = {"type": "string", "description": "sha256: and 64 digits", "pattern": r"\Asha256:[0-9a-f]{64}\Z", "maxLength": 71}
_ROWS = _list({**_object("name size digest", name=_NAME, size={"type": "integer", "minimum": 0, "maximum": 2 ** 63}, digest=_DIGEST),
               "additionalProperties": False})
SEALED = _object("manifest", manifest=_ROWS)
CHANGE = {**_object("seal new old", seal=_NAME, new=_ROWS, old=_ROWS), "additionalProperties": False}


def checked(value, schema, place):
    """A value that is what a schema says. Raises InputError that names the file (place), the field, what was expected and what was
    found."""
    wrong = _schema.fault(value, schema, "")
    if wrong is not None:
        field, expected, found = wrong
        raise InputError(f"{place}: {field or '/'}: expected {expected}, found {found}")
    return value


def record_of(folder, name, schema):
    """What a file of a beneath.Folder holds; None where there is none."""
    return checked(folder.json(name), schema, folder.path / name) if folder.found(name) else None
