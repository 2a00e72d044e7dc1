# SPDX-License-Identifier: BSD-3-Clause
"""Counts where objects pass through each other in results of several scenes, as a table of a page.

    pvpython make_contact_table.py DIR...

A line a folder: pairs of objects that both move, counted once a frame, whose centres are nearer than the sum of their clearance
radii by more than 5 % and by more than 20 % of it; in the plan, the assimilated and the optimised motion.
"""
import pathlib
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

MOTIONS = ("planned", "assimilated", "optimized")
DEPTHS = (0.05, 0.2)
STILL = 1e-9  # m in two frames


def read(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def overlaps(tracks, radii):
    """How many pairs are deeper than each of DEPTHS; tracks: [object, frame, 3] in m."""
    counts = np.zeros(len(DEPTHS), int)
    sums = radii[:, None] + radii
    pairs = np.triu(np.ones_like(sums, bool), 1)
    for frame in range(1, tracks.shape[1] - 1):
        moves = np.linalg.norm(tracks[:, frame + 1] - tracks[:, frame - 1], axis=1) > STILL
        apart = np.linalg.norm(tracks[:, None, frame] - tracks[None, :, frame], axis=2)
        depths = (1.0 - apart / sums)[pairs & moves[:, None] & moves]
        counts += [np.count_nonzero(depths > depth) for depth in DEPTHS]
    return counts


def main(folders):
    print("| scene | " + " | ".join(MOTIONS) + " |")
    print("|---" * (len(MOTIONS) + 1) + "|")
    for folder in map(pathlib.Path, folders):
        radii = vtk_to_numpy(read(folder / "objects.vtp").GetPointData().GetArray("ClearanceRadius")).astype(float)
        cells = []
        for motion in MOTIONS:
            points = vtk_to_numpy(read(folder / f"{motion}.vtp").GetPoints().GetData()).astype(float)
            cells.append(", ".join(map(str, overlaps(points.reshape(len(radii), -1, 3), radii))))
        print(f"| {folder.name} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main(sys.argv[1:])
