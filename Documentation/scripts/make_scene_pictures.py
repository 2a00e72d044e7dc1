# SPDX-License-Identifier: BSD-3-Clause
"""Two pictures of each folder that `waft synthesize` wrote, named after the folder: scene_NAME.png, four moments
from left to right, those at which many marks are passed among them, and scene_NAME_end.png, the last frame. What
lies at rest is seen from above, what flies from the side.

PYTHONPATH=build/lib/python3/dist-packages xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" \\
  pvbatch Documentation/scripts/make_scene_pictures.py RESULTS/leaves-letters RESULTS/feather-spiral-a ...
"""

import collections
import csv
import os
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from waft.render import Stage
from waft.render._output import write_png
from waft.render._scenery import image
from waft.results._folder import load

GALLERY = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "gallery")
PANEL = (300, 260)
END = (480, 360)
GAP = 6
MOMENTS = 4
MANY = 20  # marks: more of them would hide what passes them


def keyframes(folder):
    """[(frame, whether things lie there)] of the frames at which many rows are to be met."""
    with open(os.path.join(folder, "constraints.csv"), newline="", encoding="utf-8") as stream:
        counts = collections.Counter((int(row["Frame"]), row["Kind"] == "rest") for row in csv.DictReader(stream))
    return sorted(key for key, count in counts.items() if count >= MANY)


def moments(folder, last):
    """[(view, frame)]: soon after the start, keyframes before the last landing, the middles of the longest times
    between, the end."""
    keys = keyframes(folder)
    lands = bool(keys) and keys[-1][1]
    chosen = {round(0.12 * last): "side", last: "top" if lands else "side"}
    for frame, rests in keys[:-1] if lands else keys:
        chosen[frame] = "top" if rests else "side"
    while len(chosen) < MOMENTS:
        frames = sorted(chosen)
        before, after = max(zip(frames, frames[1:]), key=lambda pair: pair[1] - pair[0])
        chosen[(before + after) // 2] = "side"
    return [(chosen[frame], frame) for frame in sorted(chosen)]


def draw(motion, size, views):
    marks = len(motion.marks.flying) + len(motion.marks.resting)
    stage = Stage(motion, size, samples=3, targets=marks < MANY)
    return [vtk_to_numpy(stage.draw(*view).GetPointData().GetScalars()).reshape(size[1], size[0], 3) for view in views]


def write(path, pixels):
    write_png(image(np.ascontiguousarray(pixels)), str(path))


def draw_moments(folder, path):
    """Writes the moments of a folder side by side; returns its motion and the last of its views."""
    motion = load(str(folder))
    views = moments(folder, motion.number_of_frames - 1)
    gap = np.full((PANEL[1], GAP, 3), 255, np.uint8)
    panels = [part for panel in draw(motion, PANEL, views) for part in (panel, gap)]
    write(path, np.concatenate(panels[:-1], axis=1))
    return motion, views[-1]


def main(folder):
    path = os.path.join(GALLERY, "scene_" + os.path.basename(folder))
    motion, last = draw_moments(folder, path + ".png")
    write(path + "_end.png", draw(motion, END, [last])[0])


if __name__ == "__main__":
    for each in sys.argv[1:]:
        main(each.rstrip("/"))
