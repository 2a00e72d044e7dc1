# SPDX-License-Identifier: BSD-3-Clause
"""From the scene to a take: what Check and Fly do, whoever asks for it."""
import contextlib
import os
import re

import bpy

from . import flight as flights
from . import takes
from .problems import Problems
from .stage import Stage

_POINTER = re.compile(r"/(constraints|obstacles|objects|winds|vortices|shapes)/([^/:]+)|\bobstacle (?P<obstacle>\d+)")
_RESULT = "result"  # folder of a run's files, beside the scene file

found = Problems()  # what the panel shows
running = None  # the Run that is under way


class Run:
    """A flight of a scene: from its folder to its take."""

    def __init__(self, stage, name, folder, flight, quality, edited):
        self.stage = stage
        self.name = name
        self.folder = folder
        self.flight = flight
        self.quality = quality
        self.edited = edited  # the name of the take that it is an edit of, or ""


def check(context):
    """Reads the scene; returns its Stage. What stands against a flight is in its problems, and in `found`."""
    stage = Stage(context)
    if not bpy.data.filepath:
        stage.problems.error("the file is not saved: save it, results are kept in a folder beside it")
    _, lack = flights.find_command(_chosen(context), os.path.dirname(os.path.abspath(__file__)))
    if lack:
        stage.problems.error(lack)
    found[:] = stage.problems
    return stage


def begin(context):
    """Begins a flight; returns whether it did. Nothing in the file is changed."""
    global running
    stage = check(context)
    if stage.problems.is_fatal:
        return False
    command, _ = flights.find_command(_chosen(context), os.path.dirname(os.path.abspath(__file__)))
    quality = context.scene.waft.quality
    name, folder = _new_folder()
    try:
        edited = _edited(context.scene, stage, quality)
        scene_file = stage.write(folder)
        flight = flights.Flight(command, scene_file, os.path.join(folder, _RESULT), quality, edited)
    except OSError as error:
        _discard(stage, folder)
        found.error(f"{command}: {error.strerror}")
        return False
    running = Run(stage, name, folder, flight, quality, os.path.basename(os.path.dirname(edited)) if edited else "")
    return True


def end(context, outcome):
    """Takes in what a flight that ended has brought; returns whether it is a take."""
    global running
    run, running = running, None
    _report(run, outcome, context)
    if not outcome.has_result:
        _discard(run.stage, run.folder)
        return False
    result = os.path.join(run.folder, _RESULT)
    try:
        poses = flights.read_poses(result, len(run.stage.flyers), len(run.stage.frames))
    except (OSError, ValueError) as error:
        found.error(str(error))
        return False
    for row in flights.unmet(result):
        sources = run.stage.sources.get("constraints", [])
        about = context.scene.objects.get(sources[int(row["Row"])])
        found.warn(f"{row['Status']} at frame {int(row['Frame']) + run.stage.frames[0]}: {row['Message']}", about)
    take = {"name": run.name, "folder": bpy.path.relpath(run.folder), "quality": run.quality, "edited": run.edited,
            "is_stopped": outcome.status == flights.STOPPED_EARLY}
    for name in takes.add(context.scene, take, run.stage, *poses):
        found.warn(f"{name} is no longer there: its motion is left out")
    return True


def drop():
    """Ends a flight without its result: its file is closed."""
    global running
    run, running = running, None
    if run is not None:
        run.flight.kill()
        _discard(run.stage, run.folder)


def _chosen(context):
    addon = context.preferences.addons.get(__package__)
    return bpy.path.abspath(addon.preferences.command) if addon else ""


def _new_folder():
    """(name, path) of a folder for the next take, which is made: FILE-waft/take-001 beside FILE.blend."""
    base = f"{os.path.splitext(bpy.data.filepath)[0]}-waft"
    number = 1
    while True:
        name = f"take-{number:03d}"
        try:
            os.makedirs(os.path.join(base, name))
            return name, os.path.join(base, name)
        except FileExistsError:
            number += 1


def _discard(stage, folder):
    """Takes away what a flight without a result has left, and its folder where nothing else is in it: what somebody put there
    meanwhile stays."""
    flights.discard(os.path.join(folder, _RESULT))
    for name in stage.written():
        flights.remove(os.path.join(folder, name))
    with contextlib.suppress(OSError):
        os.rmdir(folder)


def _edited(scene, stage, quality):
    """The result that the next one is an edit of: the latest finished take of this quality from which it differs in its constraints
    alone; None where there is none."""
    for take in reversed(scene.waft.takes):
        folder = bpy.path.abspath(take.folder)
        result = os.path.join(folder, _RESULT)
        if take.quality != quality or take.is_stopped or not os.path.isfile(os.path.join(result, "report.json")):
            continue
        edit = flights.as_edit_of(folder, stage.scene, stage.files)
        if edit is not None:
            stage.scene = edit
            return result
    return None


def _report(run, outcome, context):
    """Says in `found` how a flight ended."""
    stage = run.stage
    found.clear()
    lines = [line.removeprefix("waft: ") for line in outcome.words.splitlines() if line.startswith("waft: ")]
    if run.flight.was_stopped and not outcome.has_result:
        found.warn("stopped before there was anything to keep: nothing was changed")
    elif outcome.status < 0 or outcome.status > 128:  # as a process ends, and as a shell tells it
        found.error(f"waft was killed (signal {-outcome.status if outcome.status < 0 else outcome.status - 128}): nothing was changed")
    elif not outcome.has_result:
        for line in [line for line in lines if not line.startswith("warning:")] or [outcome.words[-300:] or "waft ended without a word"]:
            found.error(line, _about(stage, line, context))
        found.warn(f"waft ended with status {outcome.status}: nothing was changed")
    for line in lines:
        if line.startswith("warning: "):
            found.warn(line.removeprefix("warning: "), _about(stage, line, context))


def _about(stage, line, context):
    """The object that a sentence of waft is about, by its place in the scene file."""
    for match in _POINTER.finditer(line):
        if match["obstacle"]:
            group, entry = "obstacles", match["obstacle"]
        else:
            group, entry = match[1], match[2]
        if group == "shapes":
            name = stage.scene["shapes"].get(entry, {}).get("_object", "")
        else:
            names = stage.sources.get(group, [])
            name = names[int(entry)] if entry.isdigit() and int(entry) < len(names) else ""
        if name:
            return context.scene.objects.get(name)
    return None
