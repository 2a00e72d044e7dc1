# SPDX-License-Identifier: BSD-3-Clause
"""Runs inside ParaView while an event script plays: gives the Waft Animation that the menu made the file of a small scene, of which
only a plan is to be made; notes, a line a change, how many stages it was unfolded into."""
import json
import os

from paraview import simple

import waft

scene = waft.Scene(seed=5)
scene.set_time(20)
scene.add_objects("maple", count=2, region={"min": (-0.5, -0.5, 2.5), "max": (0.5, 0.5, 3)})
scene.save(os.environ["WAFT_GUI_SCENE"])
log = open(os.environ["WAFT_GUI_LOG"], "w", encoding="utf-8")
last = None


def note(*_):
    global last
    animation = simple.FindSource("WaftAnimation1")
    if animation is None:
        return
    if not animation.FileName:  # for Apply to push
        animation.SMProxy.GetProperty("FileName").SetElement(0, os.environ["WAFT_GUI_SCENE"])
        animation.SMProxy.GetProperty("StopAfter").SetElement(0, 1)
    line = json.dumps(len(simple.GetSources()) - 1)
    if line != last:
        log.write(line + "\n")
        log.flush()
        last = line


interactor = simple.GetActiveViewOrCreate("RenderView").GetInteractor()
interactor.AddObserver("TimerEvent", note)
interactor.CreateRepeatingTimer(50)
