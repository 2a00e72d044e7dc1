# SPDX-License-Identifier: BSD-3-Clause
"""A strip of pictures of each folder that `waft synthesize` wrote: four moments from the side, and the end from
above where things lie on the ground. Named after the folder.

PYTHONPATH=build/lib/python3/dist-packages xvfb-run -a -s "-screen 0 1280x1024x24" \\
  pvbatch Documentation/gallery/make_scene_pictures.py RESULTS/leaves-letters RESULTS/feather-spiral-a ...
"""

import os
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from waft._folder import load
from waft._output import write_png
from waft._scenery import image
from waft.render import Stage

HERE = os.path.dirname(os.path.abspath(__file__))
PANEL = (300, 260)
MOMENTS = (0.12, 0.38, 0.64, 1.0)
GAP = 6


def strip(folder):
    motion = load(folder)
    stage = Stage(motion, PANEL, samples=3)
    views = [("side", part) for part in MOMENTS]
    if motion.marks.resting:
        views[-1] = ("top", 1.0)
    panels = []
    for view, part in views:
        drawn = stage.draw(view, round(part * (motion.number_of_frames - 1)))
        panels += [vtk_to_numpy(drawn.GetPointData().GetScalars()).reshape(PANEL[1], PANEL[0], 3),
                   np.full((PANEL[1], GAP, 3), 255, np.uint8)]
    write_png(image(np.concatenate(panels[:-1], axis=1)), os.path.join(HERE, os.path.basename(folder) + ".png"))


for each in sys.argv[1:]:
    strip(each.rstrip("/"))
