# SPDX-License-Identifier: BSD-3-Clause
"""Runs inside ParaView while an event script plays: gives the Waft Animation that the menu made the file of a small scene; notes, a
line a change, which of its outputs are to be seen, as what, and what stands in the pipeline browser."""
import json
import os

from paraview import simple

import waft

scene = waft.Scene(seed=5)
scene.set_time(20)
scene.add_objects("maple", count=2, region={"min": (-0.5, -0.5, 2.5), "max": (0.5, 0.5, 3)})
scene.add_position(0, 15, (0.2, 0.1, 2.5), radius=0.1)
scene.save(os.environ["WAFT_GUI_SCENE"])
log = open(os.environ["WAFT_GUI_LOG"], "w", encoding="utf-8")
view = simple.GetActiveViewOrCreate("RenderView")
last = None


def note(*_):
    global last
    animation = simple.FindSource("WaftAnimation1")
    if animation is None:
        return
    if not animation.FileName:
        animation.SMProxy.GetProperty("FileName").SetElement(0, os.environ["WAFT_GUI_SCENE"])  # for Apply to push
    shown = {}
    for name in (animation.SMProxy.GetOutputPortName(i) for i in range(animation.SMProxy.GetNumberOfOutputPorts())):
        found = simple.GetRepresentation(animation[name], view) if view.SMProxy.FindRepresentation(
            animation.SMProxy, animation[name].Port) else None
        if found is not None and found.Visibility:
            shown[name] = found.SMProxy.GetXMLName()
    line = json.dumps({"shown": shown, "views": len(simple.GetViews()), "sources": sorted(name for name, _ in simple.GetSources())})
    if line != last:
        log.write(line + "\n")
        log.flush()
        last = line


interactor = view.GetInteractor()
interactor.AddObserver("TimerEvent", note)
interactor.CreateRepeatingTimer(50)
