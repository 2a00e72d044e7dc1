# SPDX-License-Identifier: BSD-3-Clause
"""Scenes that are no JSON, not in UTF-8, or of the wrong make."""
import json
import random

from case import LEAF, WIDE, Case, places, scene_case, synthesize, with_value, without

TEXT = json.dumps(LEAF)
HOSTILE = {
    "a long name": "n" * 100000,
    "a million letters": "n" * 1000000,
    "control characters": "a\x01\x1b[31m\x7fb",
    "percent signs": "%s%n%d",
    "two lines": "one\ntwo",
    "quotes": "\"'`$(id)\\",
    "other writing": "\u00e9\u4e2d\U0001f341\u202e",
    "a zero byte": "a\x00b",
    "nothing": "",
    "slashes": "a/b~c",
}


def _rewritten(find, put):
    assert find in TEXT
    return TEXT.replace(find, put).encode()


def _random_bytes(seed, count):
    return bytes(random.Random(seed).randrange(256) for _ in range(count))


def cases():
    group = "json"
    broken = {
        "empty": b"",
        "blanks": b"  \n\n ",
        "cut in half": TEXT[:len(TEXT) // 2].encode(),
        "last brace missing": TEXT[:-1].encode(),
        "one brace too many": TEXT.encode() + b"}",
        "two scenes": TEXT.encode() * 2,
        "comma at the end": _rewritten('"waft": 1,', '"waft": 1,,'),
        "single quotes": TEXT.replace('"', "'").encode(),
        "comment": b"// leaf\n" + TEXT.encode(),
        "a number with two points": _rewritten("2.0]", "2.0.0]"),
        "NaN": _rewritten("2.0]", "NaN]"),
        "Infinity": _rewritten("2.0]", "Infinity]"),
        "a number beyond all": _rewritten("2.0]", "1e999]"),
        "a hexadecimal number": _rewritten("2.0]", "0x2]"),
        "a plus in front": _rewritten("2.0]", "+2.0]"),
        "a zero in front": _rewritten("2.0]", "02.0]"),
        "a bare word": b"scene",
        "random bytes": _random_bytes(1, 300),
        "more random bytes": _random_bytes(2, 5000),
        "zero bytes": bytes(200),
        "UTF-16": TEXT.encode("utf-16"),
        "UTF-16 without a mark": TEXT.encode("utf-16-le"),
        "UTF-32": TEXT.encode("utf-32"),
        "Latin-1": _rewritten('"waft": 1,', '"waft": 1, "title": "\u00e9",').decode().encode("latin-1"),
        "half a mark": b"\xef\xbb" + TEXT.encode(),
        "half a letter": _rewritten('"waft": 1,', '"waft": 1, "title": "@",').replace(b"@", b"\xc3"),
        "overlong letters": _rewritten('"waft": 1,', '"waft": 1, "title": "@",').replace(b"@", b"\xc0\xaf"),
        "half a surrogate": _rewritten('"waft": 1,', '"waft": 1, "title": "\\ud800",'),
        "a tab in a text": _rewritten('"waft": 1,', '"waft": 1, "title": "a\tb",'),
        "an unknown escape": _rewritten('"waft": 1,', '"waft": 1, "title": "\\q",'),
        "ten thousand lists": b"[" * 10000,
        "a million lists": b"[" * 1000000,
        "a million objects": b'{"a":' * 1000000,
        "a picture": b"\x89PNG\r\n\x1a\n" + bytes(100),
        "XML": b'<?xml version="1.0"?><VTKFile type="PolyData"/>',
    }
    for name, text in broken.items():
        yield scene_case(group, name, text)
    lists = "[" * 1000000 + "]" * 1000000
    yield scene_case(group, "a million lists in a comment", _rewritten('"waft": 1,', f'"_a": {lists}, "waft": 2,'), "/waft")
    yield scene_case(group, "a million lists for a shape", _rewritten('"waft": 1,', f'"waft": 1, "winds": {lists},'), "/winds")
    yield scene_case(group, "a mark in front", b"\xef\xbb\xbf" + TEXT.encode(), status=(0, 2))
    for name, value in (("a list", []), ("a number", 1), ("a text", "waft"), ("null", None), ("true", True)):
        yield scene_case(group, f"{name} for a scene", json.dumps(value).encode())
    for text, name in HOSTILE.items():
        says = ("found the unknown field", "expected one of the fields") if len(name) > 1000 else ()
        yield scene_case(group, f"unknown field: {text}", with_value(LEAF, "/waft", 1) | {name: 1}, *says)
        if name:
            yield scene_case(group, f"unknown shape: {text}", with_value(LEAF, "/objects/0/shape", name), "/objects/0/shape")
            yield scene_case(group, f"unknown body: {text}", with_value(LEAF, "/shapes/leaf/builtin", name),
                             "/shapes/leaf/builtin")
            yield scene_case(group, f"file that is not there: {text}",
                             with_value(LEAF, "/shapes", {"leaf": {"mesh": name + ".obj"}}), "/shapes/leaf")
    for control in "\x01\n\x1b\x7f\x85\x9f\u061c\u200e\u200f\u202a\u202e\u2066\u2069\ufffe\uffff":
        name, code = f"a{control}b", f"U+{ord(control):04X}"
        yield scene_case(group, f"{code} in the name of a shape", with_value(LEAF, "/shapes", {name: {"builtin": "leaf"}}),
                         "/shapes", code)
        yield scene_case(group, f"{code} in a class", with_value(LEAF, "/shapes/leaf/class", name), "/shapes/leaf/class", code)
        yield scene_case(group, f"{code} in the title", with_value(LEAF, "/title", name), "/title", code)
    yield scene_case(group, "a field twice", _rewritten('"frames": 31', '"frames": 31, "frames": 32'), "/time", "frames")
    yield scene_case(group, "a field of the scene twice", _rewritten('"waft": 1,', '"waft": 1, "waft": 1,'), "waft")
    yield scene_case(group, "a field of an object twice", _rewritten('"position"', '"position": [0,0,2], "position"'),
                     "/objects/0", "position")
    for version in (0, 2, -1, "1", 1.5, None):
        yield scene_case(group, f"version {version}", with_value(LEAF, "/waft", version), "/waft")
    for field in ("waft", "objects", "shapes"):
        yield scene_case(group, f"without {field}", without(LEAF, f"/{field}"), field if field != "shapes" else "/objects")
    for pointer, value in places(WIDE):
        if isinstance(value, dict) and pointer:
            yield scene_case(group, f"unknown field in {pointer}", with_value(WIDE, f"{pointer}/colour2", 1), pointer, "colour2")
            yield scene_case(group, f"a list in place of {pointer}", with_value(WIDE, pointer, [1]), pointer)
    for name, scene in (("that is not there", "none.waft.json"), ("that is a folder", "."), ("of 5000 letters", "s" * 5000),
                        ("without a name", ""), ("with a zero byte", "a\x00.waft.json")):
        if "\x00" not in scene:
            yield Case(group, f"scene {name}", lambda folder, results, scene=scene: synthesize(scene, results))
