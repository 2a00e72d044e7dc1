# SPDX-License-Identifier: BSD-3-Clause
"""How far the Slip of bodies that glide is from what their poses say by the law of a plate (Documentation/Measure.md)."""
import numpy as np

from waft import reading
from waft.measuring._meshcuts import FILES
from waft.measuring._platelaw import FACTORS, Plate, gradients_of, matrices, slips_of
from waft.results._arrays import array_of, field_of, object_ids, points_of, triangles_of
from waft.results._folder import needed, read_surface
from waft.results.writing import settled

STEPS = 1  # a frame: 5 tell the same to a thousandth


def slips(run, air):
    """(by the law from that of the first frame on, as it is) [step, 3] of free flight up to a second before a first touch-down, of the
    tracks; None where a file of FILES or an array is missing, or nothing glides."""
    folder = settled(run.folder)
    if "Orientation" not in run.arrays or any(folder.found(name) is None for name in FILES):
        return None
    poses, objects = (read_surface(folder, name) for name in FILES[:2])
    cells, path, file = poses.GetCellData(), folder.path / FILES[0], folder.path / FILES[1]
    if not all(cells.HasArray(name) for name in FACTORS) or not objects.GetPointData().HasArray("ShapeId"):
        return None
    ids = object_ids(cells, path).tolist()
    own = object_ids(objects.GetPointData(), file).tolist()
    if not set(run.ids.tolist()) <= set(ids) & set(own):
        return None
    factors = {name: array_of(cells, name, path)[[ids.index(number) for number in run.ids.tolist()]] for name in FACTORS}
    rows = [own.index(number) for number in run.ids.tolist()]
    shape_of = array_of(objects.GetPointData(), "ShapeId", file, kind=int, low=0)[rows]
    factors["SettlingSpeed"] = run.flights.slip
    density = field_of(poses, "AirDensity", path, 1, low=0.0)[0]
    folder.check_blocks(FILES[2])
    shapes = reading.read_blocks(needed(folder, FILES[2]))
    free = _free(run)
    places = np.nan_to_num(run.flights.positions)  # where a body is not in the shot, anywhere
    last = int(np.flatnonzero(free.any(axis=0)).max(initial=0)) + 1
    found, theirs = [np.zeros((0, 3))], [np.zeros((0, 3))]
    for shape in np.unique(shape_of):
        which = np.flatnonzero((shape_of == shape) & (factors["BroadsideSpeed"] > 0.0))
        if not len(which) or shape >= shapes.GetNumberOfBlocks():
            continue
        mesh = shapes.GetBlock(int(shape))
        plate = Plate(points_of(mesh, needed(folder, FILES[2])), triangles_of(mesh, needed(folder, FILES[2])))
        gradients = np.stack([air.over(lambda field, x: gradients_of(field, air.origin, air.spacing, x), places[which, frame],
                                       frame / run.flights.rate) for frame in range(last)], axis=1)
        lawful = slips_of(plate, {name: values[which] for name, values in factors.items()}, density, 1.0 / run.flights.rate,
                          matrices(run.arrays["Orientation"][which, :last]), run.arrays["AngularVelocity"][which, :last], gradients,
                          run.arrays["Slip"][which, :last], run.still[which, :last], STEPS)
        found.append(lawful[free[which, :last]])
        theirs.append(run.arrays["Slip"][which, :last][free[which, :last]])
    return np.concatenate(found), np.concatenate(theirs)


def _free(run):
    """Free flight [object, frame] up to a second before a first touch-down: bodies were turned as if they came down sooner."""
    free = (run.arrays["Free"] if "Free" in run.arrays else run.flights.free).copy()
    for body, touch in run.touches:
        free[body, max(touch - int(round(run.flights.rate)), 0):] = False
    return free
