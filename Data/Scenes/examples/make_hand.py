#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes hand.obj, a hand with its palm up and a piece of its arm, beside itself: rods with round ends that run into one
another, as a closed surface. Its origin is the middle of the palm, its fingers point along -x; metres.

python3 Data/Scenes/examples/make_hand.py        (needs python3-vtk9 or ParaView's pvpython)
"""
import pathlib

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkFlyingEdges3D, vtkQuadricDecimation

HERE = pathlib.Path(__file__).resolve().parent
# Begin and end of each rod, and their radii.
RODS = [
    *[((0.045, y, -0.020), (-0.045, 1.1 * y, -0.018), 0.017, 0.015) for y in (-0.034, -0.012, 0.011, 0.032)],
    ((0.050, 0.0, -0.022), (0.095, 0.0, -0.022), 0.030, 0.025), ((0.095, 0.0, -0.022), (0.36, 0.0, -0.06), 0.025, 0.036),
    ((-0.045, -0.037, -0.018), (-0.078, -0.042, -0.010), 0.0105, 0.0095), ((-0.078, -0.042, -0.010), (-0.100, -0.044, 0.012), 0.0095, 0.008),
    ((-0.045, -0.013, -0.018), (-0.090, -0.015, -0.008), 0.0115, 0.0100), ((-0.090, -0.015, -0.008), (-0.116, -0.016, 0.018), 0.0100, 0.0085),
    ((-0.045, 0.012, -0.018), (-0.094, 0.013, -0.009), 0.0115, 0.0105), ((-0.094, 0.013, -0.009), (-0.122, 0.013, 0.017), 0.0105, 0.0085),
    ((-0.045, 0.035, -0.018), (-0.086, 0.040, -0.009), 0.0110, 0.0100), ((-0.086, 0.040, -0.009), (-0.110, 0.042, 0.015), 0.0100, 0.0085),
    ((0.040, 0.035, -0.016), (0.000, 0.066, -0.004), 0.017, 0.013), ((0.000, 0.066, -0.004), (-0.040, 0.078, 0.012), 0.013, 0.009),
]
BLEND = 0.006  # m about which two rods run into one another
STEP = 0.0035  # m
TRIANGLES = 1800


def distances(places):
    total = None
    for begin, end, first, last in RODS:
        begin, along = np.array(begin), np.subtract(end, begin)
        share = np.clip((places - begin) @ along / (along @ along), 0.0, 1.0)
        away = np.linalg.norm(places - begin - share[..., None] * along, axis=-1) - (first + (last - first) * share)
        if total is None:
            total = away
            continue
        near = np.clip(0.5 + 0.5 * (away - total) / BLEND, 0.0, 1.0)
        total = away + (total - away) * near - BLEND * near * (1.0 - near)
    return total


def main():
    low, high = np.array([-0.15, -0.08, -0.12]), np.array([0.42, 0.11, 0.05])
    counts = np.ceil((high - low) / STEP).astype(int) + 1
    axes = [start + STEP * np.arange(count) for start, count in zip(low, counts)]
    z, y, x = np.meshgrid(axes[2], axes[1], axes[0], indexing="ij")
    image = vtkImageData()
    image.SetDimensions(*counts)
    image.SetOrigin(*low)
    image.SetSpacing(STEP, STEP, STEP)
    image.GetPointData().SetScalars(numpy_to_vtk(distances(np.stack([x, y, z], axis=-1)).ravel(), deep=True))
    surface = vtkFlyingEdges3D()
    surface.SetInputData(image)
    surface.SetValue(0, 0.0)
    surface.ComputeNormalsOff()
    surface.Update()
    fewer = vtkQuadricDecimation()
    fewer.SetInputConnection(surface.GetOutputPort())
    fewer.SetTargetReduction(1.0 - TRIANGLES / surface.GetOutput().GetNumberOfPolys())
    clean = vtkCleanPolyData()
    clean.SetInputConnection(fewer.GetOutputPort())
    clean.Update()
    hand = clean.GetOutput()
    faces = vtk_to_numpy(hand.GetPolys().GetConnectivityArray()).reshape(-1, 3) + 1
    lines = [f"v {px:.4f} {py:.4f} {pz:.4f}" for px, py, pz in vtk_to_numpy(hand.GetPoints().GetData())]
    lines += [f"f {a} {b} {c}" for a, b, c in faces]
    (HERE / "hand.obj").write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
