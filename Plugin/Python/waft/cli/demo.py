# SPDX-License-Identifier: BSD-3-Clause
"""The embedded scenes, start to finish, with pictures and pages."""
import os
import pathlib

from waft import failures
from waft.beneath import Folder
from waft.loading import data_file
from waft.run.synthesis import report_run, synthesize
from waft.texts import say, warn
from waft.watching import interruptible

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
        run = synthesize(data_file(f"Scenes/{name}.waft.json"), output=target, threads=threads, quiet=False)
        report_run(run, target)
        status = max(status, run.status)
        if run.stopped:
            return run.status
        last = len(run.times) - 1
        say(f"{name}: rendering ...")
        with interruptible("stopped: the pictures that were drawn are whole"):
            render(target, frames=f"0:{last}:{max(1, last // 6)}", size=(960, 540), style="dark")
        try:
            pages.append(write_page(target))
        except failures.BadInput:
            raise
        except failures.WaftError as error:  # without three.js there is all else
            warn(error)
    say(f"Pictures are in {folder}/*/frames; {folder}/*/animation.glb opens in Blender.")
    if pages:
        say(f"To watch it, open in a browser: {' '.join(pages)}")
    return status
