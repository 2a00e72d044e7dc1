# SPDX-License-Identifier: BSD-3-Clause
"""What the sources of a finished flight (_sources.py) do when ParaView asks them."""
import os
from typing import Any, Dict, Tuple

from waft.failures import WaftError
from waft.run._bodies import marked, posed
from waft.run.finished import load

_kept: Dict[str, Tuple[Any, Any]] = {}  # {folder: (its state when it was read, the flight)}, the last one alone


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
    try:
        about = os.stat(os.path.join(folder, "report.json"))
        state = (about.st_size, about.st_mtime_ns, about.st_ino)
    except OSError as error:
        raise WaftError(f"{folder}: {error.strerror}: expected the folder of a flight that `waft synthesize` wrote") from error
    if _kept.get(folder, (None,))[0] != state:
        _kept.clear()
        _kept[folder] = (state, load(folder))
    return _kept[folder][1]
