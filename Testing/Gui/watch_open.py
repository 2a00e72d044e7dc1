# SPDX-License-Identifier: BSD-3-Clause
"""Runs inside ParaView while an event script plays: makes a scene and a folder of results; notes, a line a change, what stands in the
pipeline browser."""
import json
import os
import pathlib
import sys

from paraview import simple

import waft

sys.path.insert(0, os.environ["WAFT_GUI_SAMPLES"])
import sample_folder  # noqa: E402

scene = waft.Scene(seed=5)
scene.set_time(20)
scene.add_objects("maple", positions=[(0, 0, 2)])
scene.save(os.environ["WAFT_GUI_SCENE"])
flight = pathlib.Path(os.environ["WAFT_GUI_SCENE"]).with_name("flight")
sample_folder.write(str(flight))
(flight / "report.json").write_text("{}", encoding="utf-8")
log = open(os.environ["WAFT_GUI_LOG"], "w", encoding="utf-8")
view = simple.GetActiveViewOrCreate("RenderView")
last = None


def note(*_):
    global last
    line = json.dumps(sorted(source.SMProxy.GetXMLName() for source in simple.GetSources().values()))
    if line != last:
        log.write(line + "\n")
        log.flush()
        last = line


interactor = view.GetInteractor()
interactor.AddObserver("TimerEvent", note)
interactor.CreateRepeatingTimer(50)
