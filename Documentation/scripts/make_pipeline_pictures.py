# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of the page on the pipeline, from the stages that Documentation/examples/six_stages.py joins.

PYTHONPATH=build/lib/python3/dist-packages xvfb-run -a -s "-screen 0 1280x1024x24" \\
  pvbatch Documentation/scripts/make_pipeline_pictures.py [SCENE]        default: leaves-letters
"""
import pathlib
import runpy
import sys
import tempfile

from paraview import simple
from paraview.simple import OutputPort

import waft

DOCUMENTATION = pathlib.Path(__file__).resolve().parents[1]
SCENE = DOCUMENTATION.parent / "Data" / "Scenes" / "leaves-letters.waft.json"
TIME = 4.0  # s
SIZE = (560, 440)

# Of each picture what is in it: stage, port, and what it is coloured by, where that is not what Apply would take.
PICTURES = {
    "smoke": (("smoke", 0, None), ("smoke", 1, None)),
    "tracers": (("tracers", 0, ("POINTS", "ForceType")),),
    "segments": (("segments", 0, ("CELLS", "Group")),),
    "plan": (("plan", 0, ("CELLS", "ObjectId")), ("reader", 1, None)),
    "trees": (("flights", 0, ("CELLS", "Tree")),),
    "gas": (("gas", 1, ("POINTS", "Residual")),),
    "vortices": (("fit", 0, None), ("fit", 1, ("POINTS", "ResidualForce"))),
    "poses": (("turn", 0, None), ("reader", 2, None)),
}
RANGES = {"Residual": (0.0, 1.0)}  # m/s^2; single particles have more


def draw(stages, parts, path):
    view = simple.CreateRenderView()
    view.ViewSize = SIZE
    view.ViewTime = TIME
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    outputs = [OutputPort(stages[stage], port) for stage, port, _ in parts]
    waft.show(outputs, view)
    for output, (_, _, array) in zip(outputs, parts):
        shown = simple.GetDisplayProperties(output, view)
        if array is not None:
            simple.ColorBy(shown, array)
            shown.RescaleTransferFunctionToDataRange()
            if array[1] in RANGES:
                simple.GetColorTransferFunction(array[1]).RescaleTransferFunction(*RANGES[array[1]])
        shown.SetScalarBarVisibility(view, False)
    simple.SaveScreenshot(str(path), view, ImageResolution=SIZE)
    simple.Delete(view)


def main():
    with tempfile.TemporaryDirectory() as folder:
        sys.argv[1:] = [*(sys.argv[1:] or [str(SCENE)]), folder]
        stages = runpy.run_path(str(DOCUMENTATION / "examples" / "six_stages.py"))
    stages["segments"] = simple.ExtractBlock(Input=stages["database"], Selectors=["/Root/Segments"])
    stages["flights"] = simple.Threshold(Input=OutputPort(stages["plan"], 1), Scalars=["CELLS", "ObjectId"])
    stages["flights"].LowerThreshold = stages["flights"].UpperThreshold = 0
    for name, parts in PICTURES.items():
        draw(stages, parts, DOCUMENTATION / "gallery" / f"pipeline_{name}.png")


main()
