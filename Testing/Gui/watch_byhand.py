# SPDX-License-Identifier: BSD-3-Clause
"""Runs inside ParaView while an event script plays that makes a scene and flies it, of as many frames as WAFT_GUI_FRAMES says: lets
the script go on when all that was asked to fly has flown; notes, a line a change, what stands in the pipeline browser, what it is
joined to, what is seen, how bodies move and what became of the rows."""
import os

from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from watching import steps, view, wait_until, watch, write_change

import waft  # the classes of its stages

FRAMES = int(os.environ["WAFT_GUI_FRAMES"])
NAMES = ("Tracks", "Objects", "Constraints", "Obstacles", "Shapes", "Wind", "Air", "Input")


def stages():
    return {name: source for (name, _), source in simple.GetSources().items() if source.SMProxy.GetProperty("Complete")}


def is_done():
    return all(stage.GetClientSideObject().GetComplete() for stage in stages().values() if stage.Active)


def joined(source):
    """{input: [name of a giver]}"""
    inputs = {}
    for name in NAMES:
        port = source.SMProxy.GetProperty(name)
        if port is not None and hasattr(port, "GetNumberOfProxies"):
            inputs[name] = [source.SMProxy.GetSessionProxyManager().GetProxyName("sources", port.GetProxy(i))
                            for i in range(port.GetNumberOfProxies())]
    return inputs


def shown():
    """{source: {port}} of what the view shows."""
    seen = {}
    for one in view.Representations:
        source = getattr(one, "Input", None)
        if source is not None and one.Visibility:
            name = view.SMProxy.GetSessionProxyManager().GetProxyName("sources", source.SMProxy)
            seen.setdefault(name, []).append(f"{source.Port}:{one.SMProxy.GetXMLName()}")
    return {name: sorted(ports) for name, ports in seen.items()}


def flight():
    """Of the stage that turns bodies: whether each has a mesh with a skin's coordinates, where they begin and end, and how far
    their poses turn."""
    rotation, planner = simple.FindSource("Rotation"), simple.FindSource("Planner")
    if rotation is None:
        return {}
    meshes, poses = (rotation.GetClientSideObject().GetOutputDataObject(port) for port in (0, 1))
    report = planner.GetClientSideObject().GetOutputDataObject(2)
    bodies = poses.GetNumberOfLines()
    places = vtk_to_numpy(poses.GetPoints().GetData()).reshape(bodies, -1, 3)
    turns = vtk_to_numpy(poses.GetPointData().GetArray("Orientation")).reshape(bodies, -1, 4)
    return {"bodies": bodies, "triangles": meshes.GetNumberOfPolys(), "frames": places.shape[1],
            "starts": places[:, 0].tolist(), "middle": places[:, round(view.ViewTime * 30)].mean(axis=0).tolist(),
            "ends": places[:, -1].tolist(), "half": places[:, places.shape[1] // 2].tolist(),
            "turned": abs((turns[:, 0] * turns[:, places.shape[1] // 2]).sum(axis=1)).tolist(),
            "statuses": [report.GetValueByName(row, "Status").ToString() for row in range(report.GetNumberOfRows())]}


def shorten():
    """What is not applied yet."""
    for source in simple.GetSources().values():
        for name, value in (("NumberOfFrames", FRAMES), ("Frame", FRAMES - 5)):
            number = source.SMProxy.GetProperty(name)
            if FRAMES and number is not None and number.GetElement(0) > FRAMES:
                number.SetElement(0, value)


def look():
    shorten()
    wait_until(is_done)
    write_change({"sources": sorted(name for name, _ in simple.GetSources()),
                  "joined": {name: joined(source) for (name, _), source in simple.GetSources().items()},
                  "resolution": {name: stage.Resolution for name, stage in stages().items() if hasattr(stage, "Resolution")},
                  "shown": shown(), "flight": flight(), "steps": steps(), "time": view.ViewTime,
                  "focus": list(view.CameraFocalPoint), "views": [one.SMProxy.GetXMLName() for one in simple.GetViews()]})


assert waft.__name__
watch(look)
