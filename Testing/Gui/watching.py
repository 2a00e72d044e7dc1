# SPDX-License-Identifier: BSD-3-Clause
"""What scripts share that run inside ParaView while an event script plays: a log, and a look again and again."""
import ctypes
import hashlib
import json
import os
import time
import traceback

from paraview import simple
from paraview.modules.vtkRemotingServerManager import vtkSMProxyManager
from vtkmodules.util.numpy_support import vtk_to_numpy

SCENE = os.environ["WAFT_GUI_SCENE"]  # the file of the scene that the script makes
DEADLINE = 600.0                      # s: a look may end ParaView, and has not
LOOK = 50                             # ms
log = open(os.environ["WAFT_GUI_LOG"], "w", encoding="utf-8")
view = simple.GetActiveViewOrCreate("RenderView")
_last = None
_longest = 0.0
# Of the Qt that ParaView has, whichever it is; its Python has no binding of it.
_let_events_come = ctypes.CDLL(None)["_ZN16QCoreApplication13processEventsE6QFlagsIN10QEventLoop17ProcessEventsFlagEE"]


def note_gap(since):
    """The longest time [s] in which the window was dead stands in a file beside the log."""
    global _longest
    gap = time.monotonic() - since
    if gap > _longest:
        _longest = gap
        with open(log.name + ".gap", "w", encoding="utf-8") as stream:
            stream.write(f"{gap:.2f}")


def write(line):
    log.write(json.dumps(line) + "\n")
    log.flush()


def write_change(line):
    """Where it is another than the last."""
    global _last
    if line != _last:
        _last = line
        write(line)


def end(status=0):
    """At once: ParaView's own way out asks whether to save."""
    log.flush()
    os._exit(status)


def watch(look, between=LOOK, ends=False):
    """Calls `look` as long as ParaView runs, one call at a time; with `ends` it is one that ends ParaView, and has a deadline."""
    began = last = time.monotonic()
    is_busy = False

    def tick(*_):
        nonlocal is_busy, last
        if is_busy:
            return
        is_busy = True
        note_gap(last)
        try:
            look()
            if ends and time.monotonic() - began > DEADLINE:
                raise TimeoutError(f"expected an end within {DEADLINE:g} s")
        except Exception:
            traceback.print_exc()
            end(1)
        is_busy, last = False, time.monotonic()

    interactor = view.GetInteractor()
    interactor.AddObserver("TimerEvent", tick)
    interactor.CreateRepeatingTimer(between)


def wait_until(condition):
    """Within a look: the event script stands, the window goes on. A pause of an event script alone is a sleep of the window."""
    began = time.monotonic()
    while not condition():
        if time.monotonic() - began > DEADLINE:
            raise TimeoutError(f"expected an end of what is waited for within {DEADLINE:g} s")
        before = time.monotonic()
        _let_events_come(0)
        note_gap(before)
        time.sleep(0.01)


def steps():
    """What Undo would take back, the last first."""
    stack = vtkSMProxyManager.GetProxyManager().GetUndoStackBuilder().GetUndoStack()
    return [stack.GetUndoSetLabel(i) for i in range(stack.GetNumberOfUndoSets())]


def is_in_the_air():
    """Whether a source of Waft has work, or its last picture is to come."""
    made = [source.GetClientSideObject() for source in simple.GetSources().values()]
    return any(one.GetWorkState() != one.NO_WORK for one in made if hasattr(one, "GetWorkState"))


def animation_of_the_menu(name="WaftAnimation1", file=SCENE, **numbers):
    """The source that an event script makes, None before; it gets its file for Apply to push, and numbers beside."""
    animation = simple.FindSource(name)
    if animation is not None and not animation.FileName:
        for key, value in numbers.items():
            animation.SMProxy.GetProperty(key).SetElement(0, value)
        animation.SMProxy.GetProperty("FileName").SetElement(0, file)
    return animation


def has_bodies(animation):
    """Whether Apply has come to a first picture."""
    meshes = animation.GetClientSideObject().GetOutputDataObject(0)
    shown = view.SMProxy.FindRepresentation(animation.SMProxy, 0) is not None
    return shown and meshes is not None and meshes.GetNumberOfPoints() > 0


def digest(animation):
    """Of all poses."""
    poses = animation.GetClientSideObject().GetOutputDataObject(1)
    arrays = [poses.GetPoints().GetData(), poses.GetPointData().GetArray("Orientation")]
    return hashlib.sha256(b"".join(vtk_to_numpy(array).tobytes() for array in arrays)).hexdigest()
