# SPDX-License-Identifier: BSD-3-Clause
"""What the data of a results folder hold, looked at before it is used: a file that VTK reads well may hold anything. All here raise
InputError that names the file and the array, what was expected and what was found; place: the file."""
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from waft.failures import InputError

LARGEST = 1e9  # of a number, as scenes have it
MOST_FRAMES = 1000000  # of a scene
RATES = (0.001, 1e6)  # frames per second


def array_of(attributes, name, place, components=1, kind=float, low=-LARGEST, high=LARGEST):
    """The values of an array, [n] where they have one component, else [n, components]; of the kind int as whole numbers."""
    array = attributes.GetAbstractArray(name)
    if array is None:
        raise InputError(f"{place}: the array {name} is missing")
    if array.GetNumberOfComponents() != components:
        raise InputError(f"{place}: the array {name}: expected values of {components} number{'s' * (components != 1)}, found "
                         f"{array.GetNumberOfComponents()}")
    return _numbers(array, f"{place}: the array {name}", kind, low, high).reshape((-1, components) if components > 1 else -1)


def present_of(attributes, place, order):
    """Whether objects are in the shot [object, frame]; folders of before say nothing, where all are. order: of points by object and frame."""
    if not attributes.HasArray("Present"):
        return np.ones(order.shape, bool)
    return array_of(attributes, "Present", place, kind=int, low=0, high=1)[order] > 0


def field_of(data, name, place, size, kind=float, low=-LARGEST, high=LARGEST):
    """So many numbers [size] of the field data."""
    array = data.GetFieldData().GetAbstractArray(name)
    if array is None or array.GetNumberOfValues() != size:
        raise InputError(f"{place}: the field data {name}: expected {size} number{'s' * (size != 1)}, found "
                         f"{'none' if array is None else array.GetNumberOfValues()}")
    return _numbers(array, f"{place}: the field data {name}", kind, low, high)


def _numbers(array, what, kind, low, high):
    """All values in one row, those of single precision among them as doubles."""
    if not array.IsA("vtkDataArray") or array.IsA("vtkBitArray"):
        raise InputError(f"{what}: expected numbers, found {'bits' if array.IsA('vtkBitArray') else 'texts'}")
    values = vtk_to_numpy(array).ravel()
    is_right = np.isfinite(values) & (values >= low) & (values <= high)
    if kind is int:
        is_right &= values == np.rint(values)
    if not is_right.all():
        index = int(np.argmin(is_right))
        raise InputError(f"{what}: entry {index // max(array.GetNumberOfComponents(), 1)}: expected a {'whole ' * (kind is int)}number from "
                         f"{low:.16g} to {high:.16g}, found {values[index]:.16g}")
    return values.astype(np.int64 if kind is int else float)


def text_of(data, name, place):
    """The first text of an array of the field data; empty where there is none."""
    array = data.GetFieldData().GetAbstractArray(name)
    if array is None or array.GetNumberOfValues() == 0:
        return ""
    if not array.IsA("vtkStringArray"):
        raise InputError(f"{place}: the field data {name}: expected a text, found numbers")
    return array.GetValue(0)


def points_of(data, place):
    """Places [n, 3]."""
    points = data.GetPoints()
    if points is None or points.GetNumberOfPoints() == 0:
        return np.empty((0, 3))
    return _numbers(points.GetData(), f"{place}: points", float, -LARGEST, LARGEST).reshape(-1, 3)


def polylines(tracks, place, least=1):
    """Ids of the objects of Tracks, and the index of each point by [object, frame]."""
    count = tracks.GetNumberOfLines()
    if count == 0 or tracks.GetNumberOfCells() != count:
        raise InputError(f"{place}: expected one polyline per object, found {count} and {tracks.GetNumberOfCells() - count} other cells")
    lengths, order = _corners(tracks.GetLines(), tracks, place)
    if np.any(lengths != lengths[0]) or not least <= lengths[0] <= MOST_FRAMES:
        raise InputError(f"{place}: expected polylines with the same number of frames, {least} to {MOST_FRAMES}, found {lengths.min()} to "
                         f"{lengths.max()}")
    return object_ids(tracks.GetCellData(), place), order.reshape(count, -1)


def object_ids(attributes, place):
    """Those of a list of objects, each once."""
    ids = array_of(attributes, "ObjectId", place, kind=int, low=0)
    if len(np.unique(ids)) != len(ids):
        raise InputError(f"{place}: the array ObjectId: expected each object once")
    return ids


def _corners(cells, data, place, least=1):
    """(number of points of each cell, points of all in a row)."""
    lengths = np.diff(vtk_to_numpy(cells.GetOffsetsArray()))
    corners = vtk_to_numpy(cells.GetConnectivityArray())
    if np.any(lengths < least) or (len(corners) and not 0 <= corners.min() <= corners.max() < data.GetNumberOfPoints()):
        raise InputError(f"{place}: expected cells of {least} or more of the {data.GetNumberOfPoints()} points of the file")
    return lengths, corners


def triangles_of(surface, place):
    """[triangle, 3] of the polygons, as fans."""
    lengths, corners = _corners(surface.GetPolys(), surface, place, 3)
    offsets = np.concatenate([[0], np.cumsum(lengths)])
    return np.array([(corners[first], corners[at], corners[at + 1]) for first, last in zip(offsets, offsets[1:])
                     for at in range(first + 1, last - 1)], np.int64).reshape(-1, 3)


def check_surface(surface, place):
    """Looks at what is drawn of a surface."""
    points_of(surface, place)
    _corners(surface.GetPolys(), surface, place, 3)
    coordinates = surface.GetPointData().GetTCoords()
    if coordinates is not None:
        if coordinates.GetNumberOfComponents() != 2:
            raise InputError(f"{place}: texture coordinates: expected values of 2 numbers, found {coordinates.GetNumberOfComponents()}")
        _numbers(coordinates, f"{place}: texture coordinates", float, -LARGEST, LARGEST)


def bounds_of(data, place):
    """The volume of a run [low and high of x, y and z]."""
    bounds = field_of(data, "Bounds", place, 6)
    if np.any(bounds[::2] >= bounds[1::2]):
        raise InputError(f"{place}: the field data Bounds: expected the least and the most of x, y and z in turn, found "
                         f"{', '.join(f'{end:g}' for end in bounds)}")
    return bounds


def check_steps(steps, place):
    """Looks at the [(time in seconds, file)] of a series."""
    times = [time for time, _ in steps]
    if any(after <= before for before, after in zip(times, times[1:])) or len({file for _, file in steps}) < len(steps):
        raise InputError(f"{place}: expected steps of times that grow, with a file each")
    if times and max(abs(times[0]), abs(times[-1])) > LARGEST:
        raise InputError(f"{place}: expected times from {-LARGEST:g} to {LARGEST:g} s")


def rate_of(data, place, low=RATES[0], high=RATES[1]):
    """Frames per second."""
    return float(field_of(data, "FramesPerSecond", place, 1, low=low, high=high)[0])


def orientations_of(attributes, place):
    """Unit quaternions (w, x, y, z) [n, 4]."""
    turns = array_of(attributes, "Orientation", place, 4)
    sizes = np.linalg.norm(turns, axis=1)
    if np.any(np.abs(sizes - 1.0) > 1e-3):
        raise InputError(f"{place}: the array Orientation: entry {int(np.argmax(np.abs(sizes - 1.0)))}: expected a unit quaternion")
    return turns
