# SPDX-License-Identifier: BSD-3-Clause
"""Runs inside ParaView while an event script plays: notes, a line a change, the active source, its points and the 3-D
widgets of the view, in the file that WAFT_GUI_LOG names."""
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


def look():
    source = simple.GetActiveSource()
    if source is None:
        return
    algorithm = source.GetClientSideObject()
    data = algorithm.GetOutputDataObject(0)
    points = [data.GetPoint(i) for i in range(data.GetNumberOfPoints())] if data else []
    write_change({"source": source.SMProxy.GetXMLName(), "points": points, "widgets": widgets()})


watch(look)
