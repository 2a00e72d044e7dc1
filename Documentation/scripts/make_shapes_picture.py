# SPDX-License-Identifier: BSD-3-Clause
"""A sheet of bodies: leaves, feathers, one cut from a photograph, petal, bubble; each from its source, with its
painted skin.

PYTHONPATH=build/lib/python3/dist-packages xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" \\
  pvbatch Documentation/scripts/make_shapes_picture.py [PICTURE.png]
"""

import os
import sys
import tempfile
import types

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (the rendering back end)
from paraview import simple
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkRenderingCore import vtkLight, vtkRenderer, vtkRenderWindow, vtkTextActor3D

import waft  # noqa: F401 (loads the plugin)
from waft.render._flyers import _Look, _set
from waft.render._output import grab, write_png

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
COLUMNS = 4
CELL = 0.16  # m
SAMPLES = 2
GREEN = {}
RED = {"BaseColor": (0.80, 0.20, 0.09), "EdgeColor": (0.88, 0.46, 0.12), "VeinColor": (0.48, 0.10, 0.07), "Blotches": 0.6}
BROWN = {"BaseColor": (0.70, 0.43, 0.16), "EdgeColor": (0.45, 0.25, 0.10), "VeinColor": (0.86, 0.66, 0.36), "Blotches": 0.6}
YELLOW = {"BaseColor": (0.80, 0.74, 0.28), "EdgeColor": (0.66, 0.48, 0.14), "VeinColor": (0.93, 0.89, 0.55), "Blotches": 0.5}
GOLD = {"BaseColor": (0.90, 0.68, 0.15), "EdgeColor": (0.80, 0.42, 0.10), "VeinColor": (0.62, 0.38, 0.12), "Blotches": 0.6}
GREY = {"BaseColor": (0.80, 0.80, 0.82), "EdgeColor": (0.30, 0.32, 0.38), "VeinColor": (0.85, 0.83, 0.78), "Blotches": 0.7}
WHITE = {"BaseColor": (0.98, 0.97, 0.95), "EdgeColor": (0.80, 0.82, 0.86), "VeinColor": (0.95, 0.95, 0.95), "Blotches": 0.0}
SHAPES = [
    ("ovate", simple.LeafShapeSource, {"Kind": "Ovate", **GREEN}),
    ("maple", simple.LeafShapeSource, {"Kind": "Maple", **RED}),
    ("oak", simple.LeafShapeSource, {"Kind": "Oak", **BROWN}),
    ("willow", simple.LeafShapeSource, {"Kind": "Willow", "Curl": 0.5, "Camber": 0.1, "Twist": 0.3, **YELLOW}),
    ("birch", simple.LeafShapeSource, {"Kind": "Birch", **GOLD}),
    ("oak, slender, curled", simple.LeafShapeSource,
     {"Kind": "Oak", "Width": 0.7, "Lobing": 1.3, "Curl": 1.2, "Camber": 0.15, "Bend": 3.0, **RED}),
    ("flight feather", simple.FeatherShapeSource, {"Kind": "Flight"}),
    ("contour feather", simple.FeatherShapeSource, {"Kind": "Contour", **GREY}),
    ("down", simple.FeatherShapeSource, {"Kind": "Down", "Curl": 0.3, **WHITE}),
    ("from a photograph", simple.PhotographShapeSource, {}),
]


def shape_of(source, folder, name, options):
    """The one block of a source, its skin painted into the folder."""
    made = source(**options)
    if source is simple.PhotographShapeSource:
        made.Photograph = os.path.join(ROOT, "Data", "Shapes", "maple-red.png")
    else:
        made.TextureFile = os.path.join(folder, name + ".png")
        made.TextureSize = 768
    made.Length = 0.13
    made.UpdatePipeline()
    return simple.servermanager.Fetch(made).GetBlock(0)


def scene_shapes(folder):
    """Petal and bubble come by name, as a scene asks for them."""
    path = os.path.join(folder, "two.waft.json")
    petal = os.path.join(ROOT, "Data", "Shapes", "petal-pink.png")
    with open(path, "w", encoding="utf-8") as file:
        file.write('{"waft": 1, "shapes": {"petal": {"builtin": "petal", "size": 0.1, "texture": "%s"},'
                   '"bubble": {"builtin": "bubble", "size": 0.1}},'
                   '"objects": [{"shape": "petal", "position": [0, 0, 3]}]}' % os.path.relpath(petal, folder))
    reader = simple.MotionSceneReader(FileName=path)
    reader.UpdatePipeline()
    shapes = reader.GetClientSideObject().GetOutputDataObject(3)
    return [("petal", shapes.GetBlock(0)), ("bubble", shapes.GetBlock(1))]


def body_of(block):
    fields = block.GetFieldData()
    extent = max(b - a for a, b in zip(block.GetBounds()[0::2], block.GetBounds()[1::2]))
    return types.SimpleNamespace(
        surface=block, extent=extent, texture=fields.GetAbstractArray("Texture").GetValue(0),
        color=fields.GetArray("Color").GetTuple3(0), opacity=fields.GetArray("Opacity").GetValue(0))


def main():
    picture = sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, "Documentation", "gallery", "shapes.png")
    renderer = vtkRenderer()
    renderer.SetBackground(0.93, 0.94, 0.95)
    with tempfile.TemporaryDirectory() as folder:
        items = [(name, shape_of(source, folder, name, options)) for name, source, options in SHAPES]
        items += scene_shapes(folder)
        rows = (len(items) + COLUMNS - 1) // COLUMNS
        for index, (name, block) in enumerate(items):
            actor = _Look(body_of(block)).object_actor()
            matrix = vtkMatrix4x4()
            x, y = CELL * (index % COLUMNS), -CELL * (index // COLUMNS)
            _set(matrix, [[1, 0, 0], [0, 1, 0], [0, 0, 1]], (x, y, 0))
            actor.SetUserMatrix(matrix)
            renderer.AddActor(actor)
            label = vtkTextActor3D()
            label.SetInput(name)
            label.GetTextProperty().SetColor(0.2, 0.2, 0.2)
            label.GetTextProperty().SetFontSize(36)
            label.GetTextProperty().SetJustificationToCentered()
            label.SetScale(0.0003)
            label.SetPosition(x, y - 0.5 * CELL + 0.004, 0.0)
            renderer.AddActor(label)
        lamp = vtkLight()
        lamp.SetPosition(-0.6, 0.8, 1.0)
        lamp.SetFocalPoint(0.3, -0.2, 0.0)
        renderer.AddLight(lamp)
        camera = renderer.GetActiveCamera()
        center = (0.5 * CELL * (COLUMNS - 1), -0.5 * CELL * (rows - 1))
        camera.SetFocalPoint(center[0], center[1], 0.0)
        camera.SetPosition(center[0], center[1] - 0.9, 1.5)
        camera.SetViewUp(0.0, 1.0, 0.0)
        camera.ParallelProjectionOn()
        camera.SetParallelScale(0.49 * CELL * rows)
        renderer.ResetCameraClippingRange()
        window = vtkRenderWindow()
        window.SetOffScreenRendering(1)
        window.SetMultiSamples(0)
        window.SetSize(1000 * SAMPLES, int(1000 * SAMPLES * 0.72))
        window.AddRenderer(renderer)
        window.Render()
        write_png(grab(window, SAMPLES), picture)
    print(picture)


if __name__ == "__main__":
    main()
