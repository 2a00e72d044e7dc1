# SPDX-License-Identifier: BSD-3-Clause
"""A run of `waft synthesize` beside Blender. Nothing here knows of Blender."""
import base64
import contextlib
import csv
import dataclasses
import hashlib
import json
import os
import pathlib
import re
import shutil
import stat

import numpy as np

from .command import ALL_MET, NOT_ALL_MET, STOPPED_EARLY, Process

SCENE = "scene.waft.json"  # in the folder of a flight
# What a run that is killed leaves: its folder `checkpoint` with these files (Plugin/Python/waft/run/resuming.py), its lock, and temporary
# folders whose names end in what goes with their start (temporary.py); one with a manifest has results that are whole (place.py).
_CHECKPOINT = re.compile(r"(planned|constraints|vortices)\.vtp|report\.csv|key|(assimilation|assimilated)\.state(\.part\d+)?")
_TEMPORARY = re.compile(r"\.waft-([0-9a-z]{4})([0-9a-z]{4})")
_POSES = "poses.csv"
_SEAL = "report.json"  # of a result: holds its manifest
_LARGEST_SEAL = 1 << 28  # bytes
_ROUNDING = 1e-6  # of a number, as a share of it and of 1


@dataclasses.dataclass
class Outcome:
    """How a run ended. status: as above; negative: killed by that signal. has_result: whether its folder holds a motion. words:
    what it said last."""

    status: int
    has_result: bool
    words: str


class Flight(Process):
    """A running `waft synthesize`. fraction (0 to 1) and text say how far it is."""

    def __init__(self, command, scene_file, folder, quality, edit_of=None):
        self.fraction = 0.0
        self.text = "beginning"
        self.folder = folder
        self.was_stopped = False
        line = [command, "synthesize", scene_file, "--output", folder, "--quality", quality, "--progress", "json"]
        super().__init__(line + (["--edit-of", edit_of] if edit_of else []))

    def take(self, line):
        try:
            progress = json.loads(line)
            self.fraction, self.text = float(progress["fraction"]), str(progress["text"])
        except (ValueError, KeyError, TypeError):
            super().take(line)

    def stop(self):
        """Asks for the best so far; a second time it ends the run."""
        if self.was_stopped:
            self.kill()
        elif self.ask_to_stop():
            self.was_stopped = True
            self.text = "stopping, with the best so far"

    def poll(self):
        """The Outcome where the run has ended, else None."""
        status = self.status()
        if status is None:
            return None
        has_result = status in (ALL_MET, NOT_ALL_MET, STOPPED_EARLY) and _has_poses(self.folder)
        return Outcome(status, has_result, "\n".join(self.said))


def _has_poses(folder):
    """Whether there is any: a run that is stopped before anything has flown writes none."""
    try:
        with open(os.path.join(folder, _POSES), encoding="ascii") as stream:
            return len(stream.readlines(2000)) > 1
    except OSError:
        return False


def read_poses(folder, objects, frames):
    """(positions [objects, frames, 3], orientations [objects, frames, 4], whether they are in the shot [objects, frames]) of a result;
    ValueError where it is not whole."""
    with open(os.path.join(folder, _POSES), encoding="ascii") as stream:
        names = stream.readline().strip().split(",")
        width = len(names)
        values = np.fromstring(stream.read().replace("\n", ","), sep=",")
    if values.size != objects * frames * width:
        raise ValueError(f"{folder}/{_POSES}: expected {objects} objects at {frames} frames, found {values.size / width:g} lines")
    table = values.reshape(-1, width)
    table = table[np.lexsort((table[:, 1], table[:, 0]))].reshape(objects, frames, width)
    present = table[:, :, -1] > 0.0 if names[-1] == "present" else np.ones((objects, frames), bool)
    return table[:, :, 3:6], table[:, :, 6:10], present


def marks(folder):
    """The rows of a result's constraints.csv, as dictionaries of texts."""
    with open(os.path.join(folder, "constraints.csv"), encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


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
        if match and match[2] == _check_of(match[1]) and not temporary.is_symlink() and not (temporary / "manifest.json").exists():
            shutil.rmtree(temporary, ignore_errors=True)
    checkpoint = folder / "checkpoint"
    for file in checkpoint.glob("*"):
        if _CHECKPOINT.fullmatch(file.name) and not file.is_dir():
            remove(file)
    lock = folder / ".waft-lock"
    if lock.is_file() and not lock.is_symlink() and not lock.stat().st_size:
        remove(lock)
    for emptied in (checkpoint, folder):
        with contextlib.suppress(OSError):
            emptied.rmdir()


def free(folder, rows):
    """Removes those files below a folder that rows of a manifest name and that are still what was written, and the folders that this
    empties. Returns how many bytes they had. Everything else stays."""
    return sum(_free(pathlib.Path(folder), row) for row in rows)


def _free(folder, row):
    try:
        parts = pathlib.PurePosixPath(row["name"]).parts
        if not parts or ".." in parts or parts[0] == "/" or not row["digest"]:
            return 0
        above = [folder.joinpath(*parts[:count]) for count in range(1, len(parts))]
        path = folder.joinpath(*parts)
        if not all(stat.S_ISDIR(os.lstat(one).st_mode) for one in above) or row_of(folder, "/".join(parts)) != row:
            return 0
        os.remove(path)
    except (OSError, ValueError, KeyError, TypeError):
        return 0
    with contextlib.suppress(OSError):  # what holds something else stays
        for one in reversed(above):
            one.rmdir()
    return row["size"]


def row_of(folder, name):
    """The row of a manifest for a file below a folder; OSError where it is no regular file."""
    content, size = hashlib.sha256(), 0
    with open(os.open(os.path.join(folder, name), os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK), "rb") as stream:
        if not stat.S_ISREG(os.fstat(stream.fileno()).st_mode):
            raise OSError(f"{name} is no file")
        while block := stream.read(1 << 20):
            content.update(block)
            size += len(block)
    return {"name": name, "size": size, "digest": f"sha256:{content.hexdigest()}"}


def manifest_of(result):
    """The rows of the manifest of a result, its seal as it is last; none where there is no whole one."""
    try:
        if os.path.getsize(os.path.join(result, _SEAL)) > _LARGEST_SEAL:
            return []
        own = row_of(result, _SEAL)
        with open(os.path.join(result, _SEAL), encoding="utf-8") as stream:
            rows = json.load(stream)["manifest"]
        return [row for row in rows if row["name"] != _SEAL] + [own]
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return []


def _check_of(start):
    return base64.b32encode(hashlib.sha256(f"temporary of waft: {start}".encode()).digest()).decode()[:4].lower()


def remove(file):
    with contextlib.suppress(OSError):
        os.remove(file)
