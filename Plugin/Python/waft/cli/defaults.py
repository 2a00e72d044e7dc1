# SPDX-License-Identifier: BSD-3-Clause
"""What a user has said once for all of `waft synthesize`: threads, quality and output, by the variables WAFT_THREADS and so on, or by
the file waft.toml in the user's folder of settings. A command line that says otherwise is asked first, then the variables. With
WAFT_DEFAULTS=off nothing of this counts, as in takes and tests."""
import argparse
import json
import os
import pathlib
import tomllib
from typing import Any, Dict, Optional

from waft.failures import BadInput
from waft.reading import read_text
from waft.texts import shortened

NAMES = {"threads": int, "quality": str, "output": str}
FILE = "waft.toml"
_MOST = 1 << 14  # bytes of the file
_SWITCH = "WAFT_DEFAULTS"


def place() -> Optional[pathlib.Path]:
    """The file, be it there or not: below XDG_CONFIG_HOME, else ~/.config; None without a home."""
    named, home = os.environ.get("XDG_CONFIG_HOME", ""), os.environ.get("HOME")
    if os.path.isabs(named):  # others are to be ignored, as the convention has it
        return pathlib.Path(named, FILE)
    return pathlib.Path(home, ".config", FILE) if home else None


def apply(options: argparse.Namespace, actions: Dict[str, argparse.Action]) -> Dict[str, Dict[str, Any]]:
    """Fills in those of the options that the command line leaves open (None), by their actions in the parser; returns {name: {value,
    from}} of what was filled in. Raises BadInput that names file, line and key, or the variable."""
    if os.environ.get(_SWITCH) == "off":
        return {}
    taken = {}
    file = _of_file(actions)
    for name, action in actions.items():
        variable = f"WAFT_{name.upper()}"
        said = os.environ.get(variable, "")
        if getattr(options, name) is not None:
            continue
        if said:
            value, source = _value(action, said, variable), variable
        elif name in file:
            value, source = file[name], FILE
        else:
            continue
        setattr(options, name, value)
        taken[name] = {"value": value, "from": source}
    return taken


def _of_file(actions):
    """{name: value} of the file, all of it right."""
    path = place()
    if path is None or not os.path.lexists(path):
        return {}
    text = read_text(path, _MOST, "a file of TOML")
    try:
        found = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise BadInput(_unreadable(path, text, error)) from error
    values = {}
    for key, value in found.items():
        where = f"{path}: line {_line_of(text, key)}: {key}"
        if key not in NAMES:
            raise BadInput(f"{where}: expected one of {', '.join(NAMES)}, found a key of another name")
        if not isinstance(value, NAMES[key]) or isinstance(value, bool):
            kind = "a whole number" if NAMES[key] is int else "a text in quotes"
            raise BadInput(f"{where}: expected {kind}, found {shortened(json.dumps(value, default=str), 100)}")
        if key in actions:
            values[key] = _value(actions[key], str(value), where)
    return values


def _value(action, text, where):
    """What a text means as the value of an option."""
    try:
        value = action.type(text)
    except argparse.ArgumentTypeError as error:
        raise BadInput(f"{where}: {error}") from error
    if action.choices and value not in action.choices:
        raise BadInput(f"{where}: expected one of {', '.join(action.choices)}, found '{shortened(text, 100)}'")
    return value


def _line_of(text, key):
    """The number of the line with which a right text says what a key is: tomllib does not tell."""
    lines = text.split("\n")
    for number in range(1, len(lines) + 1):
        if _says("\n".join(lines[:number]), key):
            return number
    return len(lines)


def _says(text, key):
    try:
        return key in tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        return False


def _unreadable(path, text, error):
    """The sentence on a text that is no TOML: tomllib has the place at the end of its own."""
    said, _, at = str(error).rpartition(" (at ")
    found = at.removeprefix("line ").partition(",")[0]
    number = int(found) if found.isdigit() else text.count("\n") + 1  # "end of document"
    key = text.split("\n")[number - 1].partition("=")[0].strip()
    return f"{path}: line {number}: {shortened(key, 60) or '(no key)'}: expected TOML such as quality = \"preview\": {said or error}"
