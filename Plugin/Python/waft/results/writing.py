# SPDX-License-Identifier: BSD-3-Clause
"""The folder of a flight: names in it, and how it is come by. Its files are written in C++ (Bridge/Run/FlyScene.h)."""
import os

from waft import failures
from waft.beneath import Folder
from waft.results.place import ResultPlace

STATUS_ORDER = ("met", "infeasible", "conflict", "unreachable")
REPORT = "report.json"
STATE = "assimilated.state"
_SERIES = ("air", "air_wind", "wind", "meshes", "particles")


def result_place(folder):
    """The ResultPlace of a folder of results."""
    return ResultPlace(folder, REPORT)


def settled(folder):
    """The Folder of finished results, to be read: where a change of them was cut short it is finished first."""
    if not os.path.isdir(folder):
        raise failures.InputError(f"{folder}: no such folder; `waft synthesize` makes it")
    result_place(folder).settle()
    return Folder(folder)


def is_beyond_results(name):
    """Whether a file of a run is one that the motion does without: a series of fields, of particles or of meshes, a state."""
    return name.partition("/")[0].removesuffix(".pvd") in (*_SERIES, STATE)
