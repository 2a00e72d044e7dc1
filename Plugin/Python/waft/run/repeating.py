# SPDX-License-Identifier: BSD-3-Clause
"""`waft synthesize --watch`: flies again whenever the scene is saved."""
import os
import time

from waft import failures
from waft.display import start
from waft.loading import command
from waft.reading import check_scene_file
from waft.scene import Scene
from waft.texts import say, warn
from waft.watching import interruptible, passed_on

POLL = 0.25  # s between two looks at the files


def fly_when_saved(scene, output, arguments):
    """Flies a scene file to a preview and its page, now and after each change of it or of a file that it names, until it is stopped; a
    scene that is malformed is reported, and waited for. arguments: of `waft synthesize`. Returns the status of the last flight that came to its
    end."""
    check_scene_file(scene)
    look = Look(scene)
    while True:
        seen = look()
        status = _fly(arguments)
        if status == failures.STOPPED_EARLY:
            return status
        if status in (failures.ALL_MET, failures.NOT_ALL_MET):
            _show(output)
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


def _fly(arguments):
    """The status of `waft synthesize`, which has the stops that come meanwhile."""
    # Of a session of its own: a stop of the terminal comes to it once.
    child = start([command(), "synthesize", *arguments, "--preview"], start_new_session=True)
    with passed_on(child):
        return child.wait()


def _show(output):
    """The page, which loads itself again after the next one; without it there is all else."""
    from waft.page import write_page

    try:
        say(f"waft: {write_page(output, is_watched=True)}: open it in a browser, it follows")
    except failures.WaftError as error:
        warn(error)


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
    except failures.InputError:
        return ()


def _about(file):
    try:
        about = os.stat(file)
        return about.st_size, about.st_mtime_ns
    except OSError:
        return None
