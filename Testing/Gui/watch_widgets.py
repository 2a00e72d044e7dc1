# SPDX-License-Identifier: BSD-3-Clause
"""Runs inside ParaView while an event script plays: notes, a line a change, the active source, its points, what a plan's
report says and the 3-D widgets of the view, in the file that WAFT_GUI_LOG names."""
import json
import os

from paraview import simple

log = open(os.environ["WAFT_GUI_LOG"], "w", encoding="utf-8")
view = simple.GetActiveViewOrCreate("RenderView")
last = None


def widgets():
    held = view.SMProxy.GetProperty("HiddenRepresentations")
    found = []
    for index in range(held.GetNumberOfProxies()):
        proxy = held.GetProxy(index)
        shown = proxy.GetProperty("Visibility")
        place = proxy.GetProperty("WorldPosition")
        found.append({"kind": proxy.GetXMLName(), "shown": bool(shown.GetElement(0)) if shown else None,
                      "place": [place.GetElement(i) for i in range(3)] if place else None})
    return found


def statuses(algorithm):
    table = algorithm.GetOutputDataObject(2) if algorithm.GetNumberOfOutputPorts() > 2 else None
    rows = table.GetNumberOfRows() if table is not None and table.IsA("vtkTable") else 0
    return [table.GetValueByName(row, "Status").ToString() for row in range(rows)]


def note(*_):
    global last
    source = simple.GetActiveSource()
    if source is None:
        return
    algorithm = source.GetClientSideObject()
    data = algorithm.GetOutputDataObject(0)
    points = [data.GetPoint(i) for i in range(data.GetNumberOfPoints())] if data else []
    line = json.dumps({"source": source.SMProxy.GetXMLName(), "points": points, "statuses": statuses(algorithm),
                       "widgets": widgets()})
    if line != last:
        log.write(line + "\n")
        log.flush()
        last = line


interactor = view.GetInteractor()
interactor.AddObserver("TimerEvent", note)
interactor.CreateRepeatingTimer(50)
