# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of the page on the pipeline: each view of Documentation/examples/six_stages.pvsm.

PYTHONPATH=build/lib/python3/dist-packages xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" \\
  pvbatch Documentation/scripts/make_pipeline_pictures.py
"""
import os
import pathlib

from paraview import simple

import waft

ROOT = pathlib.Path(__file__).resolve().parents[2]
GALLERY = ROOT / "Documentation" / "gallery"
SIZE = (560, 440)
RANGES = {"Residual": (0.0, 1.0)}  # m/s^2; single particles have more


def load(**where):
    """{name: view} of the state, whose tabs are "1 NAME" and so on; `where`: arguments of LoadState."""
    simple.LoadState(str(ROOT / "Documentation" / "examples" / "six_stages.pvsm"), **where)
    return {name: simple.FindView(name) for name in (tab.partition(" ")[2] for tab, _ in simple.GetLayouts())}


def draw(view, path, size):
    """Colours and camera by the data that there are now."""
    view.ViewSize = size
    time = view.ViewTime
    parts = [shown for shown in view.Representations if getattr(shown, "Visibility", 0)]
    waft.show([shown.Input for shown in parts], view)
    view.ViewTime = time
    for shown in parts:
        array = shown.ColorArrayName[1]
        if array in RANGES:
            simple.GetColorTransferFunction(array).RescaleTransferFunction(*RANGES[array])
        elif array == "Strength":  # of either sense, about 0
            most = max(map(abs, shown.Input.CellData[array].GetRange()))
            simple.GetColorTransferFunction(array).RescaleTransferFunction(-most, most)
        elif array:
            shown.RescaleTransferFunctionToDataRange()
    simple.SaveScreenshot(str(path), view, ImageResolution=size)


def main():
    os.chdir(ROOT)  # the state has the scene's name from there
    for name, view in load().items():
        draw(view, GALLERY / f"pipeline_{name}.png", SIZE)


if __name__ == "__main__":
    main()
