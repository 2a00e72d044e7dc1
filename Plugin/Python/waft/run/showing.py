# SPDX-License-Identifier: BSD-3-Clause
"""First pictures in ParaView's views. How each port of a stage is shown is said by the hints of its proxy."""
import itertools
import math
from typing import Any, List, Optional

import numpy as np
from paraview import servermanager, simple
from vtkmodules.vtkCommonDataModel import vtkDataObject

from waft.failures import InputError
from waft.run.updating import update

_SERIES = ("E", "Ex", "Ev", "Ec", "NewSegments")  # what of a table is drawn
_DIRECTION = (-0.35, 1.0, -0.55)  # that the first camera looks in: from the front and above
_AROUND = 1.5  # radii of an object that are to be seen
_NEAR = 0.05  # of the extent of what flies: obstacles this near belong to the picture
_FILLED = 0.9  # of the view's height or width
_BELOW, _ABOVE = (0.43, 0.51, 0.57), (0.27, 0.36, 0.44)  # what is behind all, at the foot of the picture and above
_COURSE = 1e-6  # of the largest cost: what is less is not drawn


def show(shown: Any, view: Any = None, port: Optional[int] = None) -> List[Any]:
    """Shows a stage, several in a list, or a Run; with `port` that output of a stage alone.

    Of a stage every output that its proxy shows by itself: what is in space in a render view (view: default the active one, or a
    new one), a table of costs in a line chart with a logarithmic axis; where it shows none, its tables. An output that is named,
    by `port` or as OutputPort(stage, 1), is shown in any case. The camera takes all in, a view that showed nothing gets a soft
    background, and the animation of the session has the frames of the scene. Returns the views, the one in
    space first. Raises InputError with the sentence of a stage that fails.
    """
    ports = [pair for one in (shown if isinstance(shown, (list, tuple)) else [shown]) for pair in _ports_of(one, port)]
    in_space = [output for output, kind in ports if kind == ""]
    charts = [_chart(output) for output, kind in ports if kind == "XYChartView" and _about(output).GetNumberOfRows() > 1]
    if not in_space:
        return charts
    active = simple.GetActiveView()
    if view is None:
        view = active if active is not None and active.SMProxy.IsA("vtkSMRenderViewProxy") else simple.CreateRenderView()
    if not any(_is_seen(one) for one in view.Representations):
        _set_backdrop(view)
    for output in in_space:
        simple.Show(output, view)
    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.NumberOfFrames = max(scene.NumberOfFrames, len(simple.GetTimeKeeper().TimestepValues or []))
    simple.Render(view)  # the first of a session sets the camera
    _look_at(view, in_space)
    simple.Render(view)
    return [view, *charts]


def kind_of(stage: Any, port: int) -> str:
    """"" of an output that is shown in space by itself, "None" of one that is not shown, else the kind of its view."""
    hints = stage.SMProxy.GetHints()
    for element in (hints.GetNestedElement(i) for i in range(hints.GetNumberOfNestedElements() if hints else 0)):
        if element.GetName() == "View" and int(element.GetAttribute("port") or port) == port:
            return element.GetAttribute("type")
    return ""


def _ports_of(shown, port):
    """(output, kind of its view) of all that is to be shown."""
    if hasattr(shown, "rotation") and hasattr(shown, "reader"):  # a Result
        marks = simple.OutputPort(shown.planner, 3) if shown.planner is not None else simple.OutputPort(shown.reader, 1)
        return [*_ports_of(shown.rotation, None), (simple.OutputPort(shown.reader, 2), ""), (marks, "")]
    if hasattr(shown, "_stage"):  # a FinishedRun
        shown = shown._stage()
    if not isinstance(shown, servermanager.SourceProxy):
        raise InputError(f"show: expected a stage, a Run or a list of stages, found {shown!r}")
    update(shown)
    count = shown.SMProxy.GetNumberOfOutputPorts()
    if port is None:
        port = shown.Port or None  # an OutputPort is its stage with the number of the port
    elif not isinstance(port, int) or not 0 <= port < count:
        raise InputError(f"show: port: expected a whole number from 0 to {count - 1}, found {port!r}")
    if port is not None:
        output = simple.OutputPort(shown, port)
        return [(output, "XYChartView" if _about(output).GetDataClassName() == "vtkTable" else "")]
    ports = [(simple.OutputPort(shown, number), kind_of(shown, number)) for number in range(count)]
    return [(output, kind) for output, kind in ports if kind != "None"] or [
        (output, "XYChartView") for output, _ in ports if _about(output).GetDataClassName() == "vtkTable"]


def _about(output):
    return output.GetDataInformation().DataInformation


def _chart(output):
    """A line chart, of costs with a logarithmic axis."""
    chart = simple.CreateView("XYChartView")
    lines = simple.Show(output, chart)
    rows = _about(output).GetAttributeInformation(vtkDataObject.ROW)
    columns = [rows.GetArrayInformation(i).GetName() for i in range(rows.GetNumberOfArrays())]
    drawn = [name for name in columns if name in _SERIES] or columns
    lines.SeriesVisibility = drawn
    if "E" in drawn:
        highest = rows.GetArrayInformation("E").GetComponentRange(0)[1]
        chart.LeftAxisLogScale = 1
        chart.LeftAxisUseCustomRange = 1
        chart.LeftAxisRangeMinimum, chart.LeftAxisRangeMaximum = _COURSE * highest, 10 * highest
    chart.LeftAxisTitle = ", ".join(drawn)
    chart.BottomAxisTitle = "row"
    simple.Render(chart)
    return chart


def _is_seen(shown):
    return hasattr(shown, "Input") and bool(shown.Visibility)


def _set_backdrop(view):
    """A soft background in place of the palette's; nothing where a user has chosen one."""
    if view.UseColorPaletteForBackground:
        view.UseColorPaletteForBackground = 0
        view.BackgroundColorMode = "Gradient"
        view.Background, view.Background2 = _BELOW, _ABOVE


def _look_at(view, outputs):
    """Takes in all that is shown, as near as it fits; of obstacles, a wide ground say, what is near the rest. Plugin/Qt/WaftFrame.cxx
    says the same for the window."""
    outputs = [output for output in outputs if _about(output).GetNumberOfPoints() > 0]
    wide = [output for output in outputs if "ObstacleId" in output.PointData.keys()]
    low, high = _box([output for output in outputs if output not in wide] or wide)
    if not low:
        return
    if wide:
        near = _NEAR * max(end - begin for begin, end in zip(low, high))
        least, most = _box(wide)
        low = [min(own, max(end, own - near)) for own, end in zip(low, least)]
        high = [max(own, min(end, own + near)) for own, end in zip(high, most)]
    if low == high:
        drawn = view.GetRenderer().ComputeVisiblePropBounds()  # a mark's has the volume in it
        low, high = drawn[::2], drawn[1::2]
    forward = _unit(_DIRECTION)
    right = _unit(np.cross(forward, (0.0, 0.0, 1.0)))
    up = np.cross(right, forward)
    width, height = view.ViewSize
    aspect = width / height if width > 0 and height > 0 else 1.0
    half = math.tan(math.radians(view.CameraViewAngle) / 2)
    center = (np.array(low) + high) / 2
    corners = np.array(list(itertools.product(*zip(low, high)))) - center
    needed = np.maximum(np.abs(corners @ right) / aspect, np.abs(corners @ up))
    distance = float(np.max(needed / (_FILLED * half) - corners @ forward))
    view.InteractionMode = "3D"  # for what lies in a plane as well
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = center - distance * forward, center, [0, 0, 1]
    view.CameraParallelScale = distance * half
    view.CenterOfRotation = center


def _unit(vector):
    return np.array(vector) / np.linalg.norm(vector)


def _box(outputs):
    """Lowest and highest corner of all outputs, empty without any."""
    bounds = [np.array(_about(output).GetBounds()) + np.tile((-1.0, 1.0), 3) * _reach(output) for output in outputs]
    return ([min(box[2 * axis] for box in bounds) for axis in range(3)] if bounds else [],
            [max(box[2 * axis + 1] for box in bounds) for axis in range(3)] if bounds else [])


def _reach(output):
    """How far objects reach beyond their places, with room round them."""
    radii = output.PointData.GetArray("ClearanceRadius")
    return _AROUND * radii.GetRange(0)[1] if radii is not None else 0.0
