# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of `waft render` compared pixel by pixel. They are whole scenes, in which VTK's own means (baseline.py) does not
see a frame go by.

As a program: python3 picture.py A.png B.png; exit status 0 when they agree."""

import glob
import os
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

TOLERANCE = 8  # of 255, in the channel that differs most
FRACTION = 0.001  # of the pixels that may differ by more


def read(path):
    """Pixels [row from the bottom, column, red green blue] as integers."""
    if not os.path.isfile(path):
        raise FileNotFoundError(path)
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    scalars = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    return scalars.reshape(height, width, -1)[..., :3].astype(int)


def differing(first, second):
    """Part of the pixels (0..1) that differ; 1 when the sizes do."""
    if first.shape != second.shape:
        return 1.0
    return float(np.mean(np.abs(first - second).max(axis=2) > TOLERANCE))


def kept(path, pixels):
    """Of the pictures that are kept as NAME.png and NAME.DRAWER.png (drawn by another version of Mesa), the one most like `pixels`."""
    others = sorted(glob.glob(f"{glob.escape(os.path.splitext(path)[0])}.*.png"))
    return min(map(read, [path, *others]), key=lambda wanted: differing(pixels, wanted))


def agree(first, second):
    return differing(first, second) <= FRACTION


def mirrored(pixels):
    """Left and right changed over."""
    return pixels[:, ::-1, :]


def main(first, second):
    part = differing(read(first), read(second))
    print(f"{100.0 * part:.4f} % of the pixels differ by more than {TOLERANCE}")
    return 0 if part <= FRACTION else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:3]))
