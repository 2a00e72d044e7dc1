# SPDX-License-Identifier: BSD-3-Clause
"""`waft synthesize --watch`: flies again whenever the scene is saved."""
import os
import sys
import time

from waft import failures
from waft.scene import Scene
from waft.watching import interruptible

POLL = 0.25  # s between two looks at the files


def fly_when_saved(scene, fly):
    """Calls fly(), a status, now and after each change of the scene file or a file that it names, until it is stopped; a scene that
    is malformed is told, and waited for. Returns the status of the last flight that came to its end."""
    if not os.path.isfile(scene):
        raise failures.BadInput(f"{scene}: no such scene file")
    while True:
        seen = look(scene)
        try:
            status = fly()
        except failures.BadInput as error:
            status = error.status
            print(f"waft: {error}", file=sys.stderr)
        if status == failures.STOPPED_EARLY:
            return status
        try:
            with interruptible(""):  # the last flight is whole: nobody has to end this process
                print(f"waft: {scene}: waiting for it to be saved; Ctrl-C ends this", file=sys.stderr, flush=True)
                while look(scene) == seen:
                    time.sleep(POLL)
                settled = look(scene)
                while time.sleep(POLL) or look(scene) != settled:  # written whole by then
                    settled = look(scene)
        except failures.Interrupted:
            return status


def look(scene):
    """{file: (size, time)} of a scene file and the files that it names, as far as it can be read."""
    files = {os.path.abspath(scene)}
    try:
        files |= set(Scene.load(scene).files())
    except failures.BadInput:
        pass
    return {file: _about(file) for file in files}


def _about(file):
    try:
        about = os.stat(file)
        return about.st_size, about.st_mtime_ns
    except OSError:
        return None
