# SPDX-License-Identifier: BSD-3-Clause
"""Paper against Plate: one object of a finished run, turned along the same path by both models; poses side by side, seen
from the side.

PYTHONPATH=build/lib/python3/dist-packages xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" \\
  pvbatch Documentation/scripts/make_models_picture.py RUN_FOLDER OBJECT FIRST STEP [PICTURE.png]
"""

import os
import sys

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (the rendering back end)
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow

import waft  # noqa: F401 (loads the plugin)
from waft.render._flyers import _Look, _set, rotation
from waft.render._output import grab, write_png
from waft.results._folder import load

GALLERY = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "gallery")
COUNT = 14
SAMPLES = 2


def orientations(folder, model):
    def read(name, reader=simple.XMLPolyDataReader):
        return reader(FileName=[os.path.join(folder, name)])

    turned = simple.RotationRefineFilter(
        Tracks=read("optimized.vtp"), Objects=read("objects.vtp"),
        Shapes=read("shapes.vtm", simple.XMLMultiBlockDataReader), Constraints=read("constraints.vtp"), Model=model)
    turned.UpdatePipeline()
    poses = turned.GetClientSideObject().GetOutputDataObject(1)
    objects = poses.GetNumberOfCells()
    return vtk_to_numpy(poses.GetPointData().GetArray("Orientation")).reshape(objects, -1, 4)


def main():
    folder, index, first, step = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4])
    picture = sys.argv[5] if len(sys.argv) > 5 else os.path.join(GALLERY, "models.png")
    motion = load(folder)
    body = motion.bodies[motion.shapes[index]]
    look = _Look(body)
    renderer = vtkRenderer()
    renderer.SetBackground(0.93, 0.94, 0.95)
    cell = 1.05 * body.extent
    for row, model in enumerate(("Paper", "Plate")):
        turned = orientations(folder, model)
        for i in range(COUNT):
            actor = look.object_actor()
            matrix = vtkMatrix4x4()
            _set(matrix, rotation(turned[index, first + i * step]), np.array([i * cell, 0.0, -row * cell]))
            actor.SetUserMatrix(matrix)
            renderer.AddActor(actor)
    camera = renderer.GetActiveCamera()
    middle = 0.5 * (COUNT - 1) * cell
    camera.SetFocalPoint(middle, 0.0, -0.5 * cell)
    camera.SetPosition(middle, -3.0, 0.9 - 0.5 * cell)
    camera.SetViewUp(0.0, 0.0, 1.0)
    camera.ParallelProjectionOn()
    camera.SetParallelScale(1.15 * cell)
    renderer.ResetCameraClippingRange()
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(1200 * SAMPLES, int(1200 * SAMPLES * 2.3 / (COUNT + 0.6)))
    window.AddRenderer(renderer)
    window.Render()
    write_png(grab(window, SAMPLES), picture)
    print(picture)


if __name__ == "__main__":
    main()
