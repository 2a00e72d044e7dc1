# SPDX-License-Identifier: BSD-3-Clause
"""Runs inside ParaView while an event script plays: gives the Waft Animation that the menu made the file of a scene with a feather;
notes, a line a look, how far the work is. In the middle it saves frames. When it is done it compares with a run all at once,
and ends ParaView."""
import hashlib
import json
import os
import time
import traceback

from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

import waft

DEADLINE = 600.0  # s
scene = waft.Scene(seed=5)
scene.set_time(120)
scene.add_objects("feather", positions=[(-0.6, -0.5, 2.6)])
scene.add_position(0, 60, (0.3, 0.4, 2.1))
scene.add_position(0, 110, (0.5, -0.2, 1.5))
scene.save(os.environ["WAFT_GUI_SCENE"])
log = open(os.environ["WAFT_GUI_LOG"], "w", encoding="utf-8")
view = simple.GetActiveViewOrCreate("RenderView")
began = time.monotonic()
is_busy = False
has_saved = False
works = set()
played = set()  # how far the work was while a film was written


def digest(animation):
    poses = animation.GetClientSideObject().GetOutputDataObject(1)
    arrays = [poses.GetPoints().GetData(), poses.GetPointData().GetArray("Orientation")]
    return hashlib.sha256(b"".join(vtk_to_numpy(array).tobytes() for array in arrays)).hexdigest()


def write(**line):
    log.write(json.dumps({"wall": time.monotonic() - began, "processor": time.process_time(), **line}) + "\n")
    log.flush()


def work_of(animation):
    return animation.GetClientSideObject().GetWorkDone()


def save(animation):
    """Frames and data of all time steps, while the work is not done; the window's events come through meanwhile."""
    global has_saved
    has_saved = True
    folder = os.path.dirname(os.environ["WAFT_GUI_LOG"])
    for name, write_it in (
            ("film", lambda: simple.SaveAnimation(os.path.join(folder, "frame.png"), view, ImageResolution=[80, 60], FrameWindow=[0, 9])),
            ("data", lambda: simple.SaveData(os.path.join(folder, "meshes.pvd"), animation, WriteTimeSteps=1))):
        played.clear()
        before = digest(animation)
        write_it()
        write(save=name, played=sorted(played), before=before, after=digest(animation))


def finish(animation):
    sliced = digest(animation)
    once = simple.WaftAnimation(FileName=animation.FileName)
    simple.UpdatePipeline(proxy=once)
    write(sliced=sliced, once=digest(once), saved=animation.Slice, slices=[made.GetClientSideObject().GetSlice() for made in (animation, once)],
          text=animation.GetClientSideObject().GetProgressText())
    os._exit(0)  # ParaView's own way out asks whether to save


def look():
    animation = simple.FindSource("WaftAnimation1")
    if animation is None:
        return
    if not animation.FileName:
        animation.SMProxy.GetProperty("FileName").SetElement(0, os.environ["WAFT_GUI_SCENE"])  # for Apply to push
        write(chosen=True)
        return
    source = animation.GetClientSideObject()
    shown = view.SMProxy.FindRepresentation(animation.SMProxy, 0) is not None
    meshes = source.GetOutputDataObject(0)
    if not shown or meshes is None or meshes.GetNumberOfPoints() == 0:
        write(waits=True)  # for Apply, and no more once that has begun
        return
    complete = source.GetComplete()
    points = source.GetOutputDataObject(1).GetNumberOfPoints()
    write(complete=complete, points=points, bodies=meshes.GetNumberOfPoints(), flagged=meshes.GetFieldData().HasArray("Complete"),
          work=work_of(animation))
    if complete:
        finish(animation)
    elif not has_saved and len(works) > 3:  # Apply, which sets the session's time, has come back
        save(animation)
    works.add(work_of(animation))


def note(*_):
    global is_busy
    if is_busy:  # in the middle of a save
        if simple.GetAnimationScene().GetClientSideObject().IsInPlay():
            played.add(work_of(simple.FindSource("WaftAnimation1")))
        return
    is_busy = True
    try:
        look()
        if time.monotonic() - began > DEADLINE:
            raise TimeoutError("the work was not done in time")
    except Exception:
        traceback.print_exc()
        os._exit(1)
    is_busy = False


interactor = view.GetInteractor()
interactor.AddObserver("TimerEvent", note)
interactor.CreateRepeatingTimer(50)
