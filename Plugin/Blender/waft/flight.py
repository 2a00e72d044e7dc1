# SPDX-License-Identifier: BSD-3-Clause
"""A run of `waft synthesize` beside Blender. Nothing here knows of Blender."""
import atexit
import base64
import collections
import contextlib
import csv
import dataclasses
import hashlib
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import threading

import numpy as np

ALL_MET, FAILED, BAD_INPUT, NOT_ALL_MET, STOPPED_EARLY = range(5)  # what waft ends with
SCENE = "scene.waft.json"  # in the folder of a flight
# What a run that is killed leaves: its folder `checkpoint` with these files (Plugin/Python/waft/resuming.py), and temporary folders
# whose names end in what goes with their start (results.py).
_CHECKPOINT = re.compile(r"(planned|constraints|vortices)\.vtp|report\.csv|key|(spacetime|assimilation|assimilated)\.state(\.part\d+)?")
_TEMPORARY = re.compile(r"\.waft-([0-9a-z]{4})([0-9a-z]{4})")
_KEPT_LINES = 200  # of what it says
_POSES = "poses.csv"
_ROUNDING = 1e-6  # of a number, as a share of it and of 1


def find_command(chosen, package):
    """(path of the program waft, "") or (None, what is said where there is none). chosen: a path of the user's, or "". package:
    the add-on's folder, PREFIX/share/blender/scripts/addons/... where it came with Waft."""
    if chosen:
        if os.path.isfile(chosen) and os.access(chosen, os.X_OK):
            return chosen, ""
        return None, f"{chosen} (of the add-on's preferences) is no program: expected the path of waft"
    beside = pathlib.Path(package).parents[4] / "bin" / "waft"
    found = str(beside) if os.access(beside, os.X_OK) else shutil.which("waft")
    if found:
        return found, ""
    return None, f"no waft was found, neither {beside} nor on the PATH: name it in the add-on's preferences"


@dataclasses.dataclass
class Outcome:
    """How a run ended. status: as above; negative: killed by that signal. has_result: whether its folder holds a motion. words:
    what it said last."""

    status: int
    has_result: bool
    words: str


class Flight:
    """A running `waft synthesize`. fraction (0 to 1) and text say how far it is."""

    def __init__(self, command, scene_file, folder, quality, edit_of=None):
        self.fraction = 0.0
        self.text = "beginning"
        self.folder = folder
        self.was_stopped = False
        self._said = collections.deque(maxlen=_KEPT_LINES)
        line = [command, "synthesize", scene_file, "--output", folder, "--quality", quality, "--progress", "json"]
        # A group of its own: a Ctrl-C for Blender is not one for the run, which Blender stops by itself.
        self._process = subprocess.Popen(line + (["--edit-of", edit_of] if edit_of else []), stdin=subprocess.DEVNULL,
                                         stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True)
        self._readers = [threading.Thread(target=read, daemon=True) for read in (self._follow, self._listen)]
        for reader in self._readers:
            reader.start()
        atexit.register(self.kill)

    @property
    def pid(self):
        return self._process.pid

    def _follow(self):
        for line in self._process.stdout:
            try:
                told = json.loads(line)
                self.fraction, self.text = float(told["fraction"]), str(told["text"])
            except (ValueError, KeyError, TypeError):
                self._said.append(line.decode(errors="replace").strip())

    def _listen(self):
        for line in self._process.stderr:
            self._said.append(line.decode(errors="replace").strip())

    def stop(self):
        """Asks for the best so far; a second time it ends the run."""
        if self.was_stopped:
            self.kill()
        elif self._process.poll() is None:
            self.was_stopped = True
            self.text = "stopping, with the best so far"
            self._process.send_signal(signal.SIGTERM)

    def kill(self):
        """Ends the run and all that it began."""
        atexit.unregister(self.kill)
        if self._process.poll() is None:
            os.killpg(self._process.pid, signal.SIGKILL)
            self._process.wait()

    def poll(self):
        """The Outcome where the run has ended, else None."""
        status = self._process.poll()
        if status is None:
            return None
        atexit.unregister(self.kill)
        for reader in self._readers:
            reader.join(1.0)
        has_result = status in (ALL_MET, NOT_ALL_MET, STOPPED_EARLY) and _has_poses(self.folder)
        return Outcome(status, has_result, "\n".join(self._said))


def _has_poses(folder):
    """Whether there is any: a run that is stopped before anything has flown writes none."""
    try:
        with open(os.path.join(folder, _POSES), encoding="ascii") as stream:
            return len(stream.readlines(2000)) > 1
    except OSError:
        return False


def read_poses(folder, objects, frames):
    """(positions [objects, frames, 3], orientations [objects, frames, 4]) of a result; ValueError where it is not whole."""
    with open(os.path.join(folder, _POSES), encoding="ascii") as stream:
        width = stream.readline().count(",") + 1
        values = np.fromstring(stream.read().replace("\n", ","), sep=",")
    if values.size != objects * frames * width:
        raise ValueError(f"{folder}/{_POSES}: expected {objects} objects at {frames} frames, found {values.size / width:g} lines")
    table = values.reshape(-1, width)
    table = table[np.lexsort((table[:, 1], table[:, 0]))].reshape(objects, frames, width)
    return table[:, :, 3:6], table[:, :, 6:10]


def unmet(folder):
    """The rows of a result's constraints.csv that are not met, as dictionaries of texts."""
    with open(os.path.join(folder, "constraints.csv"), encoding="utf-8", newline="") as stream:
        return [row for row in csv.DictReader(stream) if row["Status"] != "met"]


def as_edit_of(folder, scene, files):
    """A scene as an edit of an earlier run, whose scene file is in a folder; None where they differ in more than constraints."""
    try:
        with open(os.path.join(folder, SCENE), encoding="utf-8") as stream:
            before = json.load(stream)
        for name, content in files.items():
            with open(os.path.join(folder, name), "rb") as stream:
                if stream.read() != (content if isinstance(content, bytes) else content.encode()):
                    return None
    except (OSError, ValueError):
        return None
    now = _settled(json.loads(json.dumps(scene)), before)
    return now if {**now, "constraints": []} == {**before, "constraints": []} else None


def _settled(now, before):
    """What was read now, with the numbers of before where they differ in their rounding alone: what came back as keys, which are of single
    precision, is what went out."""
    if isinstance(now, dict) and isinstance(before, dict):
        return {key: _settled(value, before.get(key)) for key, value in now.items()}
    if isinstance(now, list) and isinstance(before, list):
        return [_settled(*pair) for pair in zip(now, before)] + now[len(before):]
    if isinstance(now, float) and isinstance(before, (int, float)) and abs(now - before) <= _ROUNDING * max(1.0, abs(now)):
        return before
    return now


def discard(result):
    """Takes away what a run without a result has left of its own in its folder, and the folder where nothing else is in it."""
    folder = pathlib.Path(result)
    for temporary in folder.glob(".waft-*"):
        match = _TEMPORARY.fullmatch(temporary.name)
        if match and match[2] == _check_of(match[1]) and not temporary.is_symlink():
            shutil.rmtree(temporary, ignore_errors=True)
    checkpoint = folder / "checkpoint"
    for file in checkpoint.glob("*"):
        if _CHECKPOINT.fullmatch(file.name) and not file.is_dir():
            remove(file)
    for emptied in (checkpoint, folder):
        with contextlib.suppress(OSError):
            emptied.rmdir()


def _check_of(start):
    return base64.b32encode(hashlib.sha256(f"temporary of waft: {start}".encode()).digest()).decode()[:4].lower()


def remove(file):
    with contextlib.suppress(OSError):
        os.remove(file)
