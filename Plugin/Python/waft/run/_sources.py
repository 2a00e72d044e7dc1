# SPDX-License-Identifier: BSD-3-Clause
"""A finished flight as sources of ParaView. Each reads the folder by itself, so that a saved state shows the flight again without flying."""
import os
from typing import Any, Dict, List, Tuple

from waft.failures import WaftError

_KINDS = ("Bodies", "Paths", "Obstacles", "Marks")
_BEGIN = "import waft.run._sources\nwaft.run._sources."
_kept: Dict[str, Tuple[Any, Any]] = {}  # {folder: (its state when it was read, the flight)}, the last one alone


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


def tell(source: Any, folder: str, _kind: str) -> None:
    """The times of the frames."""
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Sddp

    times = _run(folder).times
    about = source.GetOutputInformation(0)
    about.Set(Sddp.TIME_STEPS(), times.tolist(), len(times))
    about.Set(Sddp.TIME_RANGE(), [float(times[0]), float(times[-1])], 2)


def give(source: Any, folder: str, kind: str) -> None:
    """The data of a kind at the time that is asked for."""
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Sddp

    from waft.run._bodies import marked, posed

    run = _run(folder)
    about = source.GetOutputInformation(0)
    time = about.Get(Sddp.UPDATE_TIME_STEP()) if about.Has(Sddp.UPDATE_TIME_STEP()) else 0.0
    frame = int(min(max(round(time * run._motion.frames_per_second), 0), len(run.times) - 1))
    output = source.GetPolyDataOutput()
    found = {"Bodies": lambda: posed(run._motion, frame), "Paths": run._poses, "Marks": lambda: marked(run._motion),
             "Obstacles": lambda: run._motion.obstacles_at(frame)}[kind]()
    if found is not None:
        output.ShallowCopy(found)


def _run(folder):
    """The flight of a folder, read anew when its report changed."""
    from waft.run.finished import load

    try:
        about = os.stat(os.path.join(folder, "report.json"))
        state = (about.st_size, about.st_mtime_ns, about.st_ino)
    except OSError as error:
        raise WaftError(f"{folder}: {error.strerror}: expected the folder of a flight that `waft synthesize` wrote") from error
    if _kept.get(folder, (None,))[0] != state:
        _kept.clear()
        _kept[folder] = (state, load(folder))
    return _kept[folder][1]
