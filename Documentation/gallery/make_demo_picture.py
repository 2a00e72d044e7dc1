# SPDX-License-Identifier: BSD-3-Clause
"""The README's picture, from what `./waft demo` leaves: in the air at the left, the end from above at the right.

PYTHONPATH=build/lib/python3/dist-packages xvfb-run -a -s "-screen 0 1280x1024x24" \\
  pvbatch Documentation/gallery/make_demo_picture.py demo/leaves-letters
"""

import os
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from waft._folder import load
from waft._output import write_png
from waft._scenery import image
from waft.render import Stage

HEIGHT = 440
PANELS = (("side", 0.37, 560), ("top", 1.0, 800))  # view, part of the time, width


def panel(motion, view, part, width):
    stage = Stage(motion, (width, HEIGHT), samples=3)
    drawn = stage.draw(view, round(part * (motion.number_of_frames - 1)))
    return vtk_to_numpy(drawn.GetPointData().GetScalars()).reshape(HEIGHT, width, 3)


def main():
    motion = load(sys.argv[1])
    left, right = (panel(motion, *each) for each in PANELS)
    gap = np.full((HEIGHT, 8, 3), 255, np.uint8)
    write_png(image(np.concatenate([left, gap, right], axis=1)),
              os.path.join(os.path.dirname(os.path.abspath(__file__)), "demo.png"))


main()
