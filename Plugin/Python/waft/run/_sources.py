# SPDX-License-Identifier: BSD-3-Clause
"""A finished flight as sources of ParaView. Each reads the folder by itself (_filling.py), so that a saved state shows the flight again
without flying."""
from typing import Any, List

_KINDS = ("Bodies", "Paths", "Obstacles", "Marks")
_BEGIN = "import waft.run._filling\nwaft.run._filling."


def sources_of(run: Any) -> List[Any]:
    """The sources of a FinishedRun, made at the first call."""
    from paraview import simple

    if not run._sources:
        for kind in _KINDS:
            arguments = f"(self, {run.folder!r}, {kind!r})\n"
            source = simple.ProgrammableSource(registrationName=kind, OutputDataSetType="vtkPolyData", Script=f"{_BEGIN}give{arguments}",
                                               ScriptRequestInformation=f"{_BEGIN}tell{arguments}")
            run._sources.append(source)
    return list(run._sources)


def look(output: Any, shown: Any) -> None:
    """How the first picture of one of the sources looks; others are shown by their hints."""
    if not str(getattr(output, "Script", "")).startswith(_BEGIN):
        return
    arrays = {name: output.PointData.GetArray(name) for name in output.PointData.keys()}
    if "Color" in arrays:
        shown.ColorArrayName, shown.MapScalars = ["POINTS", "Color"], 0
    elif "Radius" in arrays:
        shown.PointSize, shown.RenderPointsAsSpheres, shown.LineWidth, shown.AmbientColor, shown.DiffuseColor = (
            10, 1, 2, [0.86, 0.25, 0.16], [0.86, 0.25, 0.16])
    elif "ObstacleId" in arrays:
        shown.Opacity = 0.5
    else:
        shown.Opacity = 0.3
