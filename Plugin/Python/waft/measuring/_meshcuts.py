# SPDX-License-Identifier: BSD-3-Clause
"""Which bodies of a folder's motion are in each other's meshes, and when (Documentation/Measure.md)."""
import numpy as np

from waft import reading
from waft.failures import InputError
from waft.results._arrays import array_of, object_ids
from waft.results._folder import needed, read_surface
from waft.results.writing import settled

FILES = ("poses.vtp", "objects.vtp", "shapes.vtm")


def mesh_cuts(run):
    """(deep, beside marks that leave bodies so wide no room) [object, frame] of a Run's bodies in flight, beside what each of the
    others does; None where a file of FILES is missing."""
    folder = settled(run.folder)
    if any(folder.found(name) is None for name in FILES):
        return None
    poses, objects = (read_surface(folder, name) for name in FILES[:2])
    folder.check_blocks(FILES[2])
    shapes = reading.read_blocks(needed(folder, FILES[2]))
    rows = read_surface(folder, "constraints.vtp") if folder.found("constraints.vtp") is not None else None
    pairs = _pairs(run.folder, poses, objects, shapes, rows)
    flown = _in_flight(run, poses, folder.path / FILES[0])
    place = {number: index for index, number in enumerate(run.ids.tolist())}
    deep, near = np.zeros_like(flown), np.zeros_like(flown)
    for frame, *both, marked in pairs.tolist():
        for index in (place[number] for number in both if number in place):
            (near if marked else deep)[index, frame] = True
    return deep & flown, near & ~deep & flown


def _pairs(name, *inputs):
    """[pair, (frame, object, object, whether beside marks)]."""
    from vtkmodules.vtkCommonDataModel import vtkTable
    from waft.vtkWaftFilters import vtkMeshCuts

    table = vtkTable()
    lack = vtkMeshCuts.Find(*inputs, table)
    if lack:
        raise InputError(f"{name}: {lack}")
    return np.stack([array_of(table.GetRowData(), column, name, kind=int) for column in ("Frame", "ObjectA", "ObjectB", "NearMarks")],
                    axis=1)


def _in_flight(run, poses, path):
    """Whether a body flies, and does not lie where no row has asked it to."""
    flown = run.flights.flying.copy()
    if poses.GetCellData().HasArray("TouchDown"):
        lands = array_of(poses.GetCellData(), "TouchDown", path, kind=int, low=-1)
        for number, touch in zip(object_ids(poses.GetCellData(), path), lands):
            if touch >= 0:
                flown[run.ids == number, touch + 1:] = False
    return flown
