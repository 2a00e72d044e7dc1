# SPDX-License-Identifier: BSD-3-Clause
"""Writes the table of a scene's fields into its page, from the schema.

    python3 make_scene_tables.py PAGES [--check]

PAGES is the folder Documentation. With --check nothing is written, and the exit status is 1 where the page has another table."""
import json
import pathlib
import sys

BEGIN, END = "<!-- fields: by make_scene_tables.py -->", "<!-- end of fields -->"
# What stands together: place, and the definitions that an entry there may be, by the words that tell them apart.
PLACES = [
    ("/", {"": "scene"}), ("/time", {"": "time"}), ("/domain", {"": "domain"}), ("/ground", {"": "ground"}), ("/air", {"": "air"}),
    ("/shapes/NAME", {"": "shape"}),
    ("/objects[]", {"one": "singleObject", "several, given": "objectsAtPositions", "several, spread": "objectsInRegion"}),
    ("region", {"": "region"}),
    ("/constraints[]", {kind: kind + "Constraint"
                        for kind in ("position", "rest", "velocity", "acceleration", "orientation", "path", "keyframe")}),
    ("window", {"": "window"}),
    ("releases", {"": "releases"}),
    ("leave", {"": "leave"}),
    ("orderDirection", {"": "orderDirection"}),
    ("facing", {"": "facing"}),
    ("targets", {"points": "pointTargets", "text": "textTargets", "picture": "imageTargets", "mesh": "meshTargets"}),
    ("/obstacles[]", {kind: kind + "Obstacle" for kind in ("box", "sphere", "cylinder", "mesh")}),
    ("motion[]", {"": "motionKey"}),
    ("/winds[]", {"formula": "analyticWind", "front": "windFront", "file": "windFile"}),
    ("/vortices[]", {"": "vortex"}),
]


def number(value):
    short = f"{value:g}".replace("e+0", "e").replace("e-0", "e-")
    return short if float(short) == value else f"{value:.16g}"


def held(field):
    """(what a field holds, its bounds) in words."""
    if "$ref" in field:
        return field["$ref"].rpartition("/")[2], ""
    if "const" in field:
        return json.dumps(field["const"]), ""
    if "enum" in field:
        return ", ".join(field["enum"]), ""
    if "anyOf" in field:
        choices = [held(choice) for choice in field["anyOf"]]
        return " or ".join(what for what, _ in choices), "; ".join(bounds for _, bounds in choices if bounds)
    kind = field.get("type")
    if kind == "array" and field.get("minItems") == field["maxItems"]:
        return f"{field['maxItems']} numbers", held(field["items"])[1]
    if kind in ("array", "object"):
        what, inner = held(field["items"] if kind == "array" else field["additionalProperties"])
        most = f"at most {field.get('maxItems', field.get('maxProperties'))}"
        return (f"list of {what}" if kind == "array" else f"{what} by name"), f"{most}; {inner}" if inner else most
    if kind in ("integer", "number"):
        return "whole number" if kind == "integer" else kind, f"{number(field['minimum'])} to {number(field['maximum'])}"
    if kind == "boolean":
        return "true or false", ""
    if kind == "string":
        what = {"file": "file", "font": "font or file"}.get(field.get("format"), "text")
        return what, f"{field['minLength']} to {field['maxLength']} letters" if "maxLength" in field else ""
    return held(field["allOf"][0])


def rows(place, kinds, schema):
    """Each field of a place once, with the kinds of entry that have it alike where not all do."""
    having = {}  # the kinds by field; fields as texts, in their order
    for word, definition in kinds.items():
        kind = schema if definition == "scene" else schema["definitions"][definition]
        for name, field in kind["properties"].items():
            if name != "kind":
                having.setdefault((name, json.dumps(field), name in kind.get("required", ())), []).append(word)
            elif not any(key[0] == name for key in having):
                having[name, json.dumps({"enum": list(kinds)}), True] = list(kinds)
    for (name, text, is_required), words in sorted(having.items(), key=lambda item: len(item[1]) == len(kinds)):
        field = json.loads(text)
        what, limits = held(field)
        default = "required" if is_required else json.dumps(field["default"]) if "default" in field else ""
        of = "" if len(words) == len(kinds) else " " + ", ".join(words)
        yield f"| {place}{of} | `{name}` | {what} | {limits} | {default} | {field.get('description', '')} |"


def table(schema):
    lines = ["| place | field | holds | bounds | default | unit and meaning |", "|---|---|---|---|---|---|"]
    for place, kinds in PLACES:
        lines += rows(place, kinds, schema)
    return "\n".join(lines)


def main(folder, *options):
    folder = pathlib.Path(folder)
    page = folder / "SceneFiles.md"
    text = page.read_text(encoding="utf-8")
    before, rest = text.split(BEGIN)
    _, after = rest.split(END)
    schema = json.loads((folder / "scene.schema.json").read_text(encoding="utf-8"))
    told = {name for _, kinds in PLACES for name in kinds.values()} - {"scene"}
    known = {name for name, definition in schema["definitions"].items() if "additionalProperties" in definition}
    if told != known:
        raise SystemExit(f"make_scene_tables.py: expected a place for each of {sorted(known - told)}, none for {sorted(told - known)}")
    made = f"{before}{BEGIN}\n{table(schema)}\n{END}{after}"
    if "--check" not in options:
        page.write_text(made, encoding="utf-8")
    elif made != text:
        raise SystemExit("SceneFiles.md has another table of fields; python3 make_scene_tables.py PAGES writes it anew")


main(*sys.argv[1:])
