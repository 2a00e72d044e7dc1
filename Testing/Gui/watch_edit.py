# SPDX-License-Identifier: BSD-3-Clause
"""Runs inside ParaView while an event script plays: gives the Waft Animation that the menu made the file of a small scene; once it is
planned, puts the camera before the mark of body 1, so that it is in the middle of the picture, and before a corner of the box when that
mark was moved again; notes, whenever the work is done, the edits and the bytes of each body's path; ends ParaView when the scene was
saved. A pause of an event script lets no work go on, so that the scene is planned alone, which is one slice (Python.Edits flies)."""
import hashlib
import json
import os
import pathlib
import time
import traceback

from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

import waft  # noqa: F401 (the classes of its sources)

DEADLINE = 600.0  # s
FRAMES = 90
SCENE = """{
  "waft": 1, "_why": "three leaves,   each to its mark",
  "seed": 5,
  "time": {"frames": 90, "framesPerSecond": 30},
  "shapes": {"m": {"builtin": "maple", "size": 2e-1}},
  "objects": [{"shape": "m", "positions": [[-0.60, -0.5, 2.6], [0.4, 0.3, 2.8], [0.8, -0.6, 2.7]]}],
  "obstacles": [{"kind": "box", "min": [1.2, 1.2, 0], "max": [1.5, 1.5, 1]}],
  "constraints": [
    {"kind": "position", "object": 0, "frame": 70, "value": [-0.5, -0.3, 1.8]},
    {"kind": "position", "object": 1, "frame": 70, "value": [0.1, 0.1, 1.90], "_note": "soft"},
    {"kind": "position", "object": 2, "frame": 70, "value": [0.6, -0.2, 1.7]}
  ]
}
"""
scene = pathlib.Path(os.environ["WAFT_GUI_SCENE"])
scene.write_text(SCENE, encoding="utf-8")
log = open(os.environ["WAFT_GUI_LOG"], "w", encoding="utf-8")
view = simple.GetActiveViewOrCreate("RenderView")
began = time.monotonic()
seen = None


def write(**line):
    log.write(json.dumps(line) + "\n")
    log.flush()


def number_of_notes():
    with open(os.environ["WAFT_GUI_LOG"], encoding="utf-8") as lines:
        return sum(1 for _ in lines)


def look_at(place):
    """It comes to the middle of the picture, seen along y."""
    view.CameraFocalPoint = place
    view.CameraPosition = [place[0], place[1] - 5, place[2]]
    view.CameraViewUp = [0, 0, 1]
    simple.Render(view)


def look(animation):
    global seen
    source = animation.GetClientSideObject()
    poses = source.GetOutputDataObject(5)
    if not source.GetComplete() or poses is None or poses.GetNumberOfPoints() != 3 * FRAMES:
        return
    places = vtk_to_numpy(poses.GetPoints().GetData()).reshape(-1, FRAMES, 3)
    bytes_of = [hashlib.sha256(place.tobytes()).hexdigest() for place in places]
    edits = animation.SMProxy.GetProperty("Edits").GetElement(0)
    if (edits, bytes_of) != seen:
        seen = (edits, bytes_of)
        write(edits=json.loads(edits or "[]"), bodies=bytes_of, at=places[1, 70].tolist(), processor=time.process_time())
    if seen[0] in (None, "") and number_of_notes() <= 1:  # the window frames what comes first
        look_at([0.1, 0.1, 1.9])
    elif len(json.loads(seen[0] or "[]")) == 1 and number_of_notes() >= 4:  # done again
        look_at([1.5, 1.5, 1])


def note(*_):
    try:
        animation = simple.FindSource("WaftAnimation1")
        if animation is None:
            return
        if not animation.FileName:
            animation.SMProxy.GetProperty("FileName").SetElement(0, str(scene))  # for Apply to push
            animation.SMProxy.GetProperty("StopAfter").SetElement(0, 1)
            return
        look(animation)
        if scene.read_text(encoding="utf-8") != SCENE and not animation.SMProxy.GetProperty("Edits").GetElement(0):
            write(saved=scene.read_text(encoding="utf-8"), was=SCENE)
            os._exit(0)  # ParaView's own way out asks whether to save
        if time.monotonic() - began > DEADLINE:
            raise TimeoutError("the scene was not saved in time")
    except Exception:
        traceback.print_exc()
        os._exit(1)


interactor = view.GetInteractor()
interactor.AddObserver("TimerEvent", note)
interactor.CreateRepeatingTimer(50)
