# SPDX-License-Identifier: BSD-3-Clause
"""The embedded scenes, start to finish, with pictures and pages."""
import os
import pathlib

from waft import failures
from waft.beneath import Folder
from waft.display import start
from waft.loading import command, data_file
from waft.results._records import TOLD, record_of
from waft.texts import say, warn
from waft.watching import interruptible, passed_on

SCENES = ("feather-waypoints", "leaves-letters")


def run_demo(folder, threads=None):
    """Synthesises and renders each scene into FOLDER/<scene>, with a page; returns the worst exit status."""
    from waft.page import write_page
    from waft.render import render

    status = failures.ALL_MET
    pages = []
    for name in SCENES:
        target = pathlib.Path(folder) / name
        if os.path.isdir(folder):
            Folder(folder).is_folder(name)  # raises of a link, which would lead elsewhere
        say(f"{name}: planning, optimising, turning ...")
        flown = _fly(data_file(f"Scenes/{name}.waft.json"), target, threads)
        if flown not in (failures.ALL_MET, failures.NOT_ALL_MET):
            return flown
        status = max(status, flown)
        last = record_of(Folder(target), "report.json", TOLD)["time"]["frames"] - 1
        say(f"{name}: rendering ...")
        with interruptible("stopped: the pictures that were drawn are whole"):
            render(target, frames=f"0:{last}:{max(1, last // 6)}", size=(960, 540), style="dark")
        try:
            pages.append(write_page(target))
        except failures.InputError:
            raise
        except failures.WaftError as error:  # without three.js there is all else
            warn(error)
    say(f"Pictures are in {folder}/*/frames; {folder}/*/animation.glb opens in Blender.")
    if pages:
        say(f"To watch it, open in a browser: {' '.join(pages)}")
    return status


def _fly(scene, output, threads):
    """The status of `waft synthesize`, which has the stops that come meanwhile."""
    child = start([command(), "synthesize", scene, "--output", str(output), *([] if threads is None else ["--threads", str(threads)])],
                  env={**os.environ, "WAFT_DEFAULTS": "off"}, start_new_session=True)  # where a stop of the terminal comes to it once
    with passed_on(child):
        return child.wait()
