# SPDX-License-Identifier: BSD-3-Clause
"""From the scene to a take: what Check and Fly do, whoever asks for it."""
import contextlib
import json
import os
import time

import bpy

from . import flight as flights
from . import takes
from .command import STOPPED_EARLY, find_command
from .look import Look
from .problems import Problem, Problems
from .properties import quality_of
from .reporting import Reporter, gathered
from .stage import Stage

_RESULT = "result"  # folder of a run's files, beside the scene file
_TICK = 0.1  # s

found = Problems()  # what the panel shows
running = None  # the Run that is under way
looking = None  # (Stage, Look) of the check that is under way


class Run:
    """A flight of a scene: from its folder to its take."""

    def __init__(self, stage, name, folder, flight, quality, edited):
        self.stage = stage
        self.name = name
        self.folder = folder
        self.flight = flight
        self.quality = quality
        self.edited = edited  # the name of the take that it is an edit of, or ""


def read(context):
    """Reads the scene; returns its Stage. What Blender alone shows to stand against a flight is in its problems, and in `found`."""
    drop_look()
    stage = Stage(context)
    stage.problems += _place_problems()
    _, lack = _command(context)
    if lack:
        stage.problems.error(lack)
    mended = sum(problem.is_error for problem in stage.problems)
    found.put(f"Not ready: {_count(mended, 'thing')} to mend" if mended else _ready(stage), gathered(stage.problems))
    return stage


def begin_look(context):
    """Begins a check: reads the scene, and has waft look at it (`looking`) where something can fly. Returns the Stage. Nothing in the
    file is changed."""
    global looking
    stage = read(context)
    if not stage.problems.is_fatal:
        command, _ = _command(context)
        try:
            looking = stage, Look(command, stage.write)
        except OSError as error:
            found.error(f"{error.filename or command}: {error.strerror}")
    return stage


def end_look():
    """Takes in what waft has said where it has ended; returns whether it has."""
    global looking
    stage, look = looking
    ended = look.poll()
    if ended is None:
        return False
    looking = None
    count, lost, hard, wrong = ended
    report = Reporter(stage).report
    stage.problems[:0] = [*(report(line, True) for line in wrong), *(report(line) for line in lost)]
    stage.problems += [report(line) for line in hard]
    title = "Not ready: it cannot be flown" if wrong else _ready(stage)
    if count:
        title = f"It flies, but {_count(count, 'mark')} cannot be met"
    found.put(title, gathered(stage.problems))
    return True


def check(context):
    """A whole check, for scripts: waits for waft. Returns the Stage, with all that was found in its problems."""
    stage = begin_look(context)
    while looking is not None and not end_look():
        time.sleep(_TICK)
    return stage


def _ready(stage):
    """The line of a scene that can fly."""
    remarks = len(gathered(stage.problems))
    asked = len(stage.sources.get("constraints", []))
    return (f"Ready: {_count(len(stage.flyers), 'flyer')}, {_count(asked, 'mark or target', 'marks and targets')}"
            + (f", {_count(remarks, 'remark')}" if remarks else ""))


def _count(number, one, many=""):
    return f"{number} {one if number == 1 else many or one + 's'}"


def begin(context):
    """Begins a flight; returns whether it did. Nothing in the file is changed."""
    global running
    stage = read(context)
    if stage.problems.is_fatal:
        return False
    command, _ = _command(context)
    quality = context.scene.waft.quality
    folder = None
    try:
        name, folder = _new_folder()
        edited = _edited(context.scene, stage, quality)
        scene_file = stage.write(folder)
        flight = flights.Flight(command, scene_file, os.path.join(folder, _RESULT), quality, edited)
    except OSError as error:
        if folder is not None:
            _discard(stage, folder)
        found.put("Not flown", [*found])
        found.error(f"{error.filename or command}: {error.strerror}")
        return False
    running = Run(stage, name, folder, flight, quality, os.path.basename(os.path.dirname(edited)) if edited else "")
    return True


def end(context, outcome):
    """Takes in what a flight that ended has brought; returns whether it is a take."""
    global running
    run, running = running, None
    problems = _reported(run, outcome)
    if not outcome.has_result:
        found.put("No take: nothing was changed", gathered(problems))
        _discard(run.stage, run.folder)
        return False
    result = os.path.join(run.folder, _RESULT)
    try:
        poses = flights.read_poses(result, len(run.stage.flyers), len(run.stage.frames))
        marks = flights.marks(result)
    except (OSError, ValueError) as error:
        found.put("No take: nothing was changed", problems)
        found.error(str(error))
        return False
    report = Reporter(run.stage).report
    unmet = [row for row in marks if row["Status"] != "met"]
    missed = [report(f"row {row['Row']} target {row['Target']} (object {row['ObjectId']}, frame {row['Frame']}, {row['Kind']}): "
                     f"{row['Status']}: {row['Message']}") for row in unmet]
    take = {"name": run.name, "folder": bpy.path.relpath(run.folder), "quality": run.quality, "edited": run.edited,
            "is_stopped": outcome.status == STOPPED_EARLY, "written": json.dumps(run.stage.manifest)}
    log = Problems(gathered([*missed, *problems]))
    gone, strays = takes.add(context.scene, take, run.stage, *poses)
    for name in gone:
        log.warn(f"{name} is no longer there: its motion is left out")
    for name, apart in strays:
        log.append(Problem(f"is up to {apart:.2g} m from where the take puts it: something else in the file moves it", name, False))
    met = f"all {len(marks)} marks are met" if not unmet else f"{len(marks) - len(unmet)} of {len(marks)} marks are met"
    found.put(f"{run.name}: {met if marks else 'flown'}" + (f", {_count(len(log), 'remark')}" if log else ""), log)
    return True


def remove(scene, index):
    """Removes a take, and of its folder what its run wrote, if that is beside this very file; returns the bytes that this freed."""
    take = scene.waft.takes[index]
    folder = os.path.abspath(bpy.path.abspath(take.folder))
    name, written = take.name, take.written
    takes.remove(scene, index)
    if not bpy.data.filepath or folder != os.path.join(_base(), name) or os.path.islink(folder) or os.path.islink(_base()):
        return 0
    result = os.path.join(folder, _RESULT)
    freed = 0 if os.path.islink(result) else flights.free(result, flights.manifest_of(result))
    with contextlib.suppress(ValueError):
        freed += flights.free(folder, json.loads(written))
    for emptied in (result, folder, _base()):
        with contextlib.suppress(OSError):
            os.rmdir(emptied)
    return freed


def drop_look():
    """Ends a check without its findings."""
    global looking
    if looking is not None:
        looking[1].kill()
    looking = None


def drop():
    """Ends a flight without its result: its file is closed."""
    global running
    drop_look()
    run, running = running, None
    if run is not None:
        run.flight.kill()
        _discard(run.stage, run.folder)


def chosen(context):
    """The path of waft in the add-on's preferences, or ""."""
    addon = context.preferences.addons.get(__package__)
    return bpy.path.abspath(addon.preferences.command) if addon else ""


def _command(context):
    return find_command(chosen(context), os.path.dirname(os.path.abspath(__file__)))


def _place_problems():
    """What stands against results beside the file."""
    problems = Problems()
    if not bpy.data.filepath:
        problems.error("the file is not saved: save it, results are kept in a folder beside it")
        return problems
    base = _base()
    place = base if os.path.lexists(base) else os.path.dirname(base)
    if not os.path.isdir(place):
        problems.error(f"{place} is no folder: results are kept in a folder of that name")
    elif not os.access(place, os.W_OK | os.X_OK):
        problems.error(f"{place} may not be written in: save the file elsewhere, results are kept in a folder beside it")
    return problems


def _base():
    """The folder of all takes of the file: FILE-waft beside FILE.blend."""
    return f"{os.path.splitext(bpy.data.filepath)[0]}-waft"


def _new_folder():
    """(name, path) of a folder for the next take, which is made: take-001 and so on."""
    number = 1
    while True:
        name = f"take-{number:03d}"
        try:
            os.makedirs(os.path.join(_base(), name))
            return name, os.path.join(_base(), name)
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
        if quality_of(take.quality) != quality or take.is_stopped or not os.path.isfile(os.path.join(result, "report.json")):
            continue
        edit = flights.as_edit_of(folder, stage.scene, stage.files)
        if edit is not None:
            stage.scene = edit
            return result
    return None


def _reported(run, outcome):
    """What a flight that ended said, as Problems."""
    log = Problems()
    report = Reporter(run.stage).report
    lines = [line.removeprefix("waft: ") for line in outcome.words.splitlines() if line.startswith("waft: ")]
    if run.flight.was_stopped and not outcome.has_result:
        log.warn("stopped before there was anything to keep: nothing was changed")
    elif outcome.status < 0 or outcome.status > 128:  # as a process ends, and as a shell tells it
        log.error(f"waft was killed (signal {-outcome.status if outcome.status < 0 else outcome.status - 128}): nothing was changed")
    elif not outcome.has_result:
        wrong = [line for line in lines if not line.startswith("warning:")] or [outcome.words[-300:] or "waft ended without a word"]
        log += [report(line, True) for line in wrong]
        log.warn(f"waft ended with status {outcome.status}: nothing was changed")
    log += [report(line.removeprefix("warning: ")) for line in lines if line.startswith("warning: ")]
    return log
