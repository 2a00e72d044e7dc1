# SPDX-License-Identifier: BSD-3-Clause
"""`waft synthesize --watch`: flies again whenever the scene is saved."""
import os
import time

from waft import failures
from waft.reading import check_scene_file
from waft.scene import Scene
from waft.texts import say
from waft.watching import interruptible

POLL = 0.25  # s between two looks at the files


def fly_when_saved(scene, fly):
    """Calls fly(), a status, now and after each change of the scene file or a file that it names, until it is stopped; a scene that
    is malformed is reported, and waited for. Returns the status of the last flight that came to its end."""
    check_scene_file(scene)
    look = Look(scene)
    while True:
        seen = look()
        try:
            status = fly()
        except failures.BadInput as error:
            status = error.status
            say(f"waft: {error}", "error")
        if status == failures.STOPPED_EARLY:
            return status
        try:
            with interruptible(""):  # the last flight is whole: nobody has to end this process
                say(f"waft: {scene}: waiting for it to be saved; Ctrl-C ends this")
                while look() == seen:
                    time.sleep(POLL)
                settled = look()
                while time.sleep(POLL) or look() != settled:  # written whole by then
                    settled = look()
        except failures.Interrupted:
            return status


class Look:
    """Called: {file: (size, time)} of a scene file and the files that it names, as far as it can be read. The scene is read when it
    changed, and not at every look."""

    def __init__(self, scene):
        self._scene = os.path.abspath(scene)
        self._read = None  # (size, time) of the scene that names the files
        self._files = ()

    def __call__(self):
        now = _about(self._scene)
        if now != self._read:
            self._read, self._files = now, _named(self._scene)
        return {**{file: _about(file) for file in self._files}, self._scene: now}


def _named(scene):
    try:
        return Scene.load(scene).files()
    except failures.BadInput:
        return ()


def _about(file):
    try:
        about = os.stat(file)
        return about.st_size, about.st_mtime_ns
    except OSError:
        return None
