# SPDX-License-Identifier: BSD-3-Clause
"""Runs inside ParaView while an event script plays: notes, a line a change, the active source, its points, what a plan's
report says and the 3-D widgets of the view, in the file that WAFT_GUI_LOG names."""
from paraview import simple
from watching import view, watch, write_change


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


def look():
    source = simple.GetActiveSource()
    if source is None:
        return
    algorithm = source.GetClientSideObject()
    data = algorithm.GetOutputDataObject(0)
    points = [data.GetPoint(i) for i in range(data.GetNumberOfPoints())] if data else []
    write_change({"source": source.SMProxy.GetXMLName(), "points": points, "statuses": statuses(algorithm), "widgets": widgets()})


watch(look)
