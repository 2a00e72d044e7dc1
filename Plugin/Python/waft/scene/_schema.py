# SPDX-License-Identifier: BSD-3-Clause
"""What a scene may say: scene.schema.json, the one place of its fields, ranges and units, read and asked.

Only the keywords that the schema has are known here. `format` is Waft's own: "file" is the path of a file, "font" such a path or
the name of a family.
"""
import collections.abc
import functools
import itertools
import json
import math
import os
import pathlib
import re

from waft.reading import read_json

FAMILIES = ("sans", "serif", "mono")
_ENDLESS = 1 << 17  # items that are taken of what has no length: more than any list may have


@functools.lru_cache(maxsize=None)
def schema():
    return read_json(pathlib.Path(__file__).parents[1] / "scene.schema.json")


def definition(name):
    """The schema of one kind of entry; of the whole scene for "scene"."""
    return schema() if name == "scene" else schema()["definitions"][name]


def resolved(field):
    """A field's schema with what it refers to."""
    while "$ref" in field or list(field) in (["allOf"], ["description", "allOf"]):
        inner = field if "$ref" in field else field["allOf"][0]
        own = {"description": field["description"]} if "description" in field else {}
        field = {**schema()["definitions"][inner["$ref"].rpartition("/")[2]], **own}
    return field


def plain(value):
    """A value as JSON has it: what is iterated becomes a list, what float() takes a number, a path a text. What is none of these stays,
    for `fault` to name."""
    if value is None or isinstance(value, (bool, int, float, str, bytes, bytearray)):
        return value
    if hasattr(value, "tolist"):
        listed = value.tolist()
        if type(listed) is not type(value):  # a number that Python has none for gives itself
            return plain(listed)
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, collections.abc.Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    try:
        items = iter(value)
    except TypeError:
        return _number(value)
    return [plain(item) for item in itertools.islice(items, _ENDLESS)]


def _number(value):
    for kind, name in ((int, "__index__"), (float, "__float__")):
        if hasattr(value, name):
            try:
                return kind(value)
            except (TypeError, ValueError, ArithmeticError):
                break
    return value


def shown(value):
    try:
        text = json.dumps(value, ensure_ascii=False, default=repr) if isinstance(value, (dict, list, str, bool, type(None))) else repr(value)
    except RecursionError:
        return "lists in lists"
    return text if len(text) <= 80 else text[:76] + " ..."


_TYPES = {"object": (dict, "an object of named fields"), "array": (list, "a list"), "string": (str, "a text"),
          "boolean": (bool, "true or false"), "integer": (int, "a whole number"), "number": ((int, float), "a number"),
          "null": (type(None), "null")}


def _limits(field):
    return f" from {field['minimum']:.16g} to {field['maximum']:.16g}" if "minimum" in field else ""


def expected(field):
    """What a field takes, in words."""
    field = resolved(field)
    if "const" in field:
        return json.dumps(field["const"])
    if "enum" in field:
        return "one of " + ", ".join(field["enum"])
    for choices in ("anyOf", "oneOf"):
        if choices in field and "type" not in field:
            return " or ".join(expected(choice) for choice in field[choices])
    kind = field.get("type")
    if kind == "array":
        item = resolved(field["items"])
        count = f"{field['minItems']} " if field.get("minItems") == field.get("maxItems", -1) else ""
        inner = "numbers" if item.get("type") in ("number", "integer") else f"items, each {expected(item)}"
        return f"a list of {count}{inner}{_limits(item)}"
    if kind == "object" and "properties" in field:
        return "fields " + ", ".join(field["properties"])
    if kind == "string" and field.get("format") == "file":
        return "the path of a file"
    return _TYPES.get(kind, (None, "a value"))[1] + _limits(field)


def fault(value, field, place):
    """(place, what was expected, what was found) of the first thing that is wrong with a JSON value; None when it is right."""
    if "$ref" in field:
        return fault(value, resolved(field), place)
    if "if" in field:
        branch = field.get("then" if fault(value, field["if"], place) is None else "else")
        wrong = fault(value, branch, place) if branch else None
        if wrong:
            return wrong
    for inner in field.get("allOf", ()):
        wrong = fault(value, inner, place)
        if wrong:
            return wrong
    choices = field.get("anyOf") or field.get("oneOf")
    if choices and all(fault(value, choice, place) for choice in choices):
        return _nearest(value, choices, place) or (place, expected(field), shown(value))
    if "oneOf" in field and sum(fault(value, choice, place) is None for choice in choices) > 1:
        return place, f"one of {_first_fields(choices)} and not both", "both"
    return _own_fault(value, field, place)


def _nearest(value, choices, place):
    """The fault by the choice whose first required field is there, or what is required by any; None where there is no choice of
    objects."""
    if not isinstance(value, dict) or not all("required" in resolved(choice) for choice in choices):
        return None
    for choice in map(resolved, choices):
        if choice.get("required", [None])[0] in value:
            return fault(value, choice, place)
    return place, _first_fields(choices), "the fields " + ", ".join(value) if value else "no field"


def _first_fields(choices):
    return " or ".join(resolved(choice)["required"][0] for choice in choices)


def _own_fault(value, field, place):
    wrong = (place, expected(field), shown(value))
    if "const" in field and (value != field["const"] or isinstance(value, bool)):
        return wrong
    if "enum" in field and value not in field["enum"]:
        return wrong
    kind = field.get("type")
    if kind is not None:
        if not isinstance(value, _TYPES[kind][0]) or (isinstance(value, bool) and kind != "boolean"):
            if not (kind == "integer" and isinstance(value, float) and value.is_integer()):
                return wrong
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        is_finite = isinstance(value, int) or math.isfinite(value)  # a whole number may be too large to be asked
        if not (is_finite and field.get("minimum", -math.inf) <= value <= field.get("maximum", math.inf)):
            return wrong
    if isinstance(value, str):
        if any("\ud800" <= letter <= "\udfff" for letter in value):
            return place, "a text of whole letters", "half of one"
        if not field.get("minLength", 0) <= len(value) <= field.get("maxLength", 1 << 30):
            return place, f"a text of {field.get('minLength', 0)} to {field['maxLength']} letters", f"{len(value)} letters"
        if "pattern" in field and not re.search(field["pattern"], value):
            return place, field["description"], shown(value)
    if isinstance(value, list):
        if len(value) > field.get("maxItems", 1 << 40) and field.get("minItems") != field["maxItems"]:
            return too_many(field["maxItems"], len(value), place)
        if not field.get("minItems", 0) <= len(value) <= field.get("maxItems", 1 << 40):
            return wrong
        for number, item in enumerate(value):
            inner = fault(item, field["items"], f"{place}/{number}") if "items" in field else None
            if inner:
                return inner
    if isinstance(value, dict):
        return _members_fault(value, field, place)
    return None


def too_many(most, count, place):
    return place, f"at most {most} entries", count


def _members_fault(value, field, place):
    if "maxProperties" in field:
        count = sum(not name.startswith("_") for name in value)
        if count > field["maxProperties"]:
            return too_many(field["maxProperties"], count, place)
    for name in field.get("required", ()):
        if name not in value:
            return f"{place}/{name}", expected(field.get("properties", {}).get(name, {})), "nothing"
    known = field.get("properties", {})
    rest = field.get("additionalProperties", True)
    for name, member in value.items():
        unnamed = fault(name, field.get("propertyNames", {}), f"{place}/{name}")
        if unnamed:
            return unnamed
        if name.startswith("_") and "patternProperties" in field:
            continue
        inner = known.get(name, rest)
        if inner is False:
            return f"{place}/{name}", "one of " + ", ".join(known), "a field of another name"
        wrong = fault(member, inner, f"{place}/{name}") if isinstance(inner, dict) else None
        if wrong:
            return wrong
    return None


def described(field):
    """A field in one line of documentation: what it takes, unit, default."""
    field = resolved(field)
    parts = [expected(field), field.get("description"), f"default {field['default']}" if "default" in field else None]
    return "; ".join(part for part in parts if part)


def with_files(value, field, change):
    """A copy of a right value in which change(path) took the place of each path of a file."""
    field = resolved(field)
    if field.get("format") == "file" or (field.get("format") == "font" and value not in FAMILIES):
        return change(value)
    if isinstance(value, list):
        return [with_files(item, field.get("items", {}), change) for item in value]
    if isinstance(value, dict):
        members = _members(value, field)
        return {name: with_files(item, members(name), change) if not name.startswith("_") else item
                for name, item in value.items()}
    return value


def _members(value, field):
    """The schemas of a value's members by name, those of the branches that it takes."""
    fields, waiting = {}, [field]
    rest = {}
    while waiting:
        one = resolved(waiting.pop())
        if "if" in one and not ("properties" in one and "additionalProperties" in one):
            waiting.append(one.get("then" if fault(value, one["if"], "") is None else "else", {}))
        waiting += one.get("allOf", [])
        waiting += [choice for choice in one.get("oneOf", []) if "$ref" in choice and fault(value, choice, "") is None]
        fields.update(one.get("properties", {}))
        if isinstance(one.get("additionalProperties"), dict):
            rest = one["additionalProperties"]
    return lambda name: fields.get(name, rest)
