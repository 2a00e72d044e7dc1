# SPDX-License-Identifier: BSD-3-Clause
"""Writes Documentation/examples/six_stages.pvsm: the stages that six_stages.py joins, under the names that they have there, and a
tab with a view of each port that the page on the pipeline shows.

PYTHONPATH=build/lib/python3/dist-packages xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" \\
  pvbatch Documentation/scripts/make_pipeline_state.py [FILE.pvsm]
"""
import functools
import os
import pathlib
import runpy
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from unittest import mock

from paraview import simple
from paraview.simple import OutputPort

import waft

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENE = "Data/Scenes/leaves-letters.waft.json"  # from the folder of the sources, so that a state is good in any copy of it
TIME = 4.0  # s

# What is shown first depends on which arrays there are, and not on how fine: stages have these until all is shown.
COARSE = {"GridSmokeSource": {"Resolution": [16, 16, 16], "NumberOfFrames": 60},
          "SPHSpacetimeFilter": {"NumberOfGasParticles": 216, "LeashIterations": 2, "MaximumNumberOfIterations": 6}}

# Of each view what is in it: stage, port, and what it is coloured by, where that is not what Apply would take.
VIEWS = {
    "smoke": (("smoke", 0, None), ("smoke", 1, None)),
    "tracers": (("tracers", 0, ("POINTS", "ForceType")),),
    "segments": (("segments", 0, ("CELLS", "Group")),),
    "plan": (("plan", 0, ("CELLS", "ObjectId")), ("reader", 1, None)),
    "trees": (("flights", 0, ("CELLS", "Tree")),),
    "gas": (("gas", 1, None),),
    "vortices": (("fit", 0, None), ("fit", 1, ("POINTS", "ResidualForce"))),
    "poses": (("turn", 0, None), ("reader", 2, None)),
}

# Before what waft.show puts behind them: what is pale is not seen on white.
DARK = ("smoke", "gas", "vortices", "poses")


def join(folder):
    """{name: stage} of six_stages.py, without what it writes, and two that pick from its outputs."""
    made = {name: functools.partial(getattr(simple, name), **settings) for name, settings in COARSE.items()}
    with mock.patch.multiple(simple, **made), mock.patch.object(sys, "argv", ["", SCENE, folder]):
        script = runpy.run_path("Documentation/examples/six_stages.py")
    stages = {name: script[name] for name in ("smoke", "tracers", "database", "reader", "plan", "gas", "fit", "turn")}
    stages["segments"] = simple.ExtractBlock(Input=stages["database"], Selectors=["/Root/Segments"])
    stages["flights"] = simple.Threshold(Input=OutputPort(stages["plan"], 1), Scalars=["CELLS", "ObjectId"])
    stages["flights"].LowerThreshold = stages["flights"].UpperThreshold = 0
    for name, stage in stages.items():
        simple.RenameSource(name, stage)
    for stage in set(simple.GetSources().values()) - set(stages.values()):
        simple.Delete(stage)
    return stages


def show(stages, name, number):
    layout = simple.CreateLayout(f"{number} {name}")  # a state has its tabs by the alphabet
    view = simple.CreateRenderView(registrationName=name)
    simple.AssignViewToLayout(view, layout)
    view.OrientationAxesVisibility = 0
    if name not in DARK:
        view.UseColorPaletteForBackground = 0
        view.Background = [1.0, 1.0, 1.0]
    view.ViewTime = TIME
    outputs = [OutputPort(stages[stage], port) for stage, port, _ in VIEWS[name]]
    waft.show(outputs, view)
    for output, (_, _, array) in zip(outputs, VIEWS[name]):
        shown = simple.GetDisplayProperties(output, view)
        if array is not None:
            simple.ColorBy(shown, array)
            shown.RescaleTransferFunctionToDataRange()
        if shown.LookupTable is not None:  # ParaView warns of a bar that is hidden where no array is shown
            shown.SetScalarBarVisibility(view, False)


def strip(path):
    """Leaves out of a state what loading it gives without: values that a property may have, what is asked of the data, and all
    defaults but those of the stages. It is a fifth then, and says what is set."""
    state = ElementTree.parse(path)
    session = simple.servermanager.ActiveConnection.Session
    kinds = {stage.SMProxy.GetXMLName() for stage in simple.GetSources().values()}
    for element in state.iter("Proxy"):
        proxy = session.GetRemoteObject(int(element.get("id", 0)))
        own = proxy is not None and proxy.GetXMLName() in kinds
        for held in element.findall("Property"):
            for domain in held.findall("Domain"):
                held.remove(domain)
            known = proxy.GetProperty(held.get("name"))
            kept = known is None or known.IsA("vtkSMProxyProperty") or own or not known.IsValueDefault()
            if not kept or held.get("name") == "TimestepValues" or known is not None and known.GetInformationOnly():
                element.remove(held)
    state.write(path, encoding="unicode")


def main(path):
    os.chdir(ROOT)
    with tempfile.TemporaryDirectory() as folder:
        stages = join(folder)
        simple.GetAnimationScene().AnimationTime = TIME
        for number, name in enumerate(VIEWS, 1):
            show(stages, name, number)
    for stage, kind in ((stages["smoke"], "GridSmokeSource"), (stages["gas"], "SPHSpacetimeFilter")):
        for name in COARSE[kind]:
            stage.GetProperty(name).ResetToDefault()
    simple.SaveState(str(path))
    strip(path)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]).resolve() if sys.argv[1:] else ROOT / "Documentation" / "examples" / "six_stages.pvsm")
