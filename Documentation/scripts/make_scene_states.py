# SPDX-License-Identifier: BSD-3-Clause
"""Writes states of scenes to open in ParaView, Documentation/examples/NAME.pvsm: a Waft Animation of each, as waft.show shows it.

PYTHONPATH=build/lib/python3/dist-packages xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" \\
  pvbatch Documentation/scripts/make_scene_states.py [FOLDER]
"""
import os
import pathlib
import sys

from paraview import simple

import waft
from make_pipeline_state import ROOT, strip

SCENES = ("feather-waypoints", "leaves-letters", "scraps-doorway")


def make(scene, path):
    simple.ResetSession()
    animation = simple.WaftAnimation(registrationName="Flight", FileName=f"Data/Scenes/{scene}.waft.json")
    view = simple.CreateRenderView(registrationName="Flight")
    simple.AssignViewToLayout(view, simple.CreateLayout("Flight"))
    waft.update(animation)
    waft.show([animation[port] for port in ("Meshes", "Poses", "Obstacles", "Marks")], view)
    simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
    simple.SaveState(str(path))
    strip(path)


if __name__ == "__main__":
    os.chdir(ROOT)
    folder = pathlib.Path(sys.argv[1]).resolve() if sys.argv[1:] else ROOT / "Documentation" / "examples"
    for name in SCENES:
        make(name, folder / (name + ".pvsm"))
