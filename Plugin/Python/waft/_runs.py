# SPDX-License-Identifier: BSD-3-Clause
"""The motion in a result folder, and when its objects fly: what `waft measure` needs of it."""
import os
from dataclasses import dataclass

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from waft._drifters import END, START
from waft._flights import Flights
from waft._kinds import POSITION, REST, VELOCITY
from waft._folder import read_surface
from waft.failures import BadInput
from waft.reading import dynamics
from waft.writing import settled

TRACKS = ("optimized", "assimilated", "planned", "poses")
NEAR_ROW = 8  # frames about a position row that are no free flight


@dataclass
class Run:
    """A folder's motion: its flights, the arrays of its tracks {name: [object, frame, ...]}, the columns of its rows {name: [row]},
    the touch-downs [(object, frame)], and what the optimiser says of its own motion {name: number}."""

    folder: str
    flights: Flights
    bounds: np.ndarray
    arrays: dict
    rows: dict
    ids: np.ndarray
    touches: list
    inertia: bool
    figures: dict

    @property
    def width(self):
        return max(self.bounds[1] - self.bounds[0], self.bounds[3] - self.bounds[2])


def read_run(folder, tracks="optimized"):
    """Reads a folder; raises BadInput that names the file and the lack."""
    below = settled(folder)
    path = os.path.join(folder, f"{tracks}.vtp")
    data = read_surface(below, f"{tracks}.vtp")
    ids, positions, arrays = _tracks(path, data)
    bounds, rate = _field(path, data, "Bounds", 6), float(_field(path, data, "FramesPerSecond", 1)[0])
    if not rate > 0.0:
        raise BadInput(f"{path}: FramesPerSecond: expected a positive number, found {rate:g}")
    slip = _slips(below, ids)
    rows = _rows(below)
    flying, free, touches = flight(rows, ids, positions.shape[1], rate)
    report = below.json("report.json") if below.found("report.json") else None
    inertia = bool(report.get("inertia")) if isinstance(report, dict) else False
    return Run(str(folder), Flights(positions, rate, flying, free, slip), bounds, arrays, rows, ids, touches, inertia,
               dynamics(data))


def _field(path, data, name, size):
    array = data.GetFieldData().GetArray(name)
    if array is None or array.GetNumberOfValues() != size:
        raise BadInput(f"{path}: expected the field data {name} of {size} numbers")
    return vtk_to_numpy(array).astype(float).ravel()


def _tracks(path, data):
    count = data.GetNumberOfLines()
    if count == 0 or data.GetNumberOfPoints() == 0:
        raise BadInput(f"{path}: expected one polyline per object, found none")
    lengths = np.diff(vtk_to_numpy(data.GetLines().GetOffsetsArray()))
    if np.any(lengths != lengths[0]) or lengths[0] < 8:
        raise BadInput(f"{path}: expected polylines with the same number of frames, at least 8")
    order = vtk_to_numpy(data.GetLines().GetConnectivityArray())
    identity = data.GetCellData().GetArray("ObjectId")
    if identity is None:
        raise BadInput(f"{path}: the array ObjectId is missing")
    shape = (count, int(lengths[0]))
    positions = vtk_to_numpy(data.GetPoints().GetData()).astype(float)[order].reshape(*shape, 3)
    if not np.isfinite(positions).all():
        raise BadInput(f"{path}: expected positions that are finite numbers")
    arrays = {}
    for index in range(data.GetPointData().GetNumberOfArrays()):
        array = data.GetPointData().GetArray(index)
        if array is not None:
            values = vtk_to_numpy(array)[order]
            arrays[array.GetName()] = values.reshape(*shape, *values.shape[1:])
    return vtk_to_numpy(identity).astype(int), positions, arrays


def _slips(folder, ids):
    path = folder.path / "objects.vtp"
    data = read_surface(folder, "objects.vtp")
    identity, speed = (data.GetPointData().GetArray(name) for name in ("ObjectId", "SettlingSpeed"))
    if identity is None or speed is None:
        raise BadInput(f"{path}: the array {'ObjectId' if identity is None else 'SettlingSpeed'} is missing")
    of = dict(zip(vtk_to_numpy(identity).tolist(), vtk_to_numpy(speed).tolist()))
    lost = [number for number in ids.tolist() if number not in of]
    if lost:
        raise BadInput(f"{path}: object {lost[0]} of the tracks is missing")
    return np.array([of[number] for number in ids.tolist()])


def _rows(folder):
    """Columns of constraints.vtp, TouchDown and LiftOff (-1 where they are not told) among them; no rows without the file."""
    names = ("ObjectId", "Frame", "Kind", "Until", "Radius", "Value")
    told = ("TouchDown", "LiftOff")
    path = folder.path / "constraints.vtp"
    if folder.found("constraints.vtp") is None:
        return {name: np.zeros((0, 4) if name == "Value" else 0) for name in (*names, *told)}
    data = read_surface(folder, "constraints.vtp")
    rows = {}
    for name in names:
        array = data.GetPointData().GetArray(name)
        if array is None:
            raise BadInput(f"{path}: the array {name} is missing")
        rows[name] = vtk_to_numpy(array)
    for name in told:
        array = data.GetPointData().GetArray(name)
        rows[name] = np.full(len(rows["Frame"]), -1) if array is None else vtk_to_numpy(array)
    status = data.GetPointData().GetAbstractArray("Status")
    if status is not None and status.IsA("vtkStringArray"):
        rows["Met"] = np.array([status.GetValue(i) == "met" for i in range(len(rows["Frame"]))])
    return rows


def flight(rows, ids, frames, rate):
    """(in the air, in free flight) [object, frame], and the touch-downs [(object, frame)]. In the air is an object from the start or
    a lift-off to its touch-down, but for a path that is given frame by frame; free flight leaves out what is near them, and near
    rows of position."""
    flying = np.ones((len(ids), frames), bool)
    free = np.ones((len(ids), frames), bool)
    touches = []
    start, end = int(np.ceil(START * rate)), int(np.ceil(END * rate))
    number = np.arange(frames)
    for index, identity in enumerate(ids):
        own = np.flatnonzero(rows["ObjectId"] == identity)
        free[index, :start] = False
        for row in own[rows["Kind"][own] == REST]:
            touch = int(rows["TouchDown"][row]) if rows["TouchDown"][row] >= 0 else int(rows["Frame"][row])
            until = max(int(rows["Until"][row]), int(rows["LiftOff"][row]))
            flying[index, touch + 1 if touch > 0 else 0:until if until < frames - 1 else frames] = False
            free[index, max(touch - end, 0):until + start] = False
            if touch > 0:
                touches.append((index, min(touch, frames - 1)))
        placed = np.isin(number, rows["Frame"][own[rows["Kind"][own] == POSITION]])
        flying[index, 1:] &= ~(placed[1:] & placed[:-1])
        flying[index, :-1] &= ~(placed[1:] & placed[:-1])
        for frame in np.flatnonzero(placed):
            free[index, np.abs(number - frame) <= NEAR_ROW] = False
    return flying, free & flying, touches


def largest_residual(run):
    """The most by which a row that is called met misses the exported motion, beyond its radius: position and rest (its place in
    plan) over the volume's width, velocity over the top speed; NaN without such rows."""
    x, v = run.flights.positions, run.flights.velocity
    place = {number: index for index, number in enumerate(run.ids.tolist())}
    frames = x.shape[1]
    speeds = np.linalg.norm(v[:, 1:-1], axis=2)
    found = []
    met = run.rows.get("Met", np.ones(len(run.rows["Frame"]), bool))
    for row in np.flatnonzero(met):
        frame, kind = int(run.rows["Frame"][row]), int(run.rows["Kind"][row])
        index = place.get(int(run.rows["ObjectId"][row]))
        if index is None or not 0 <= frame < frames or kind not in (POSITION, VELOCITY, REST):
            continue
        wanted, radius = run.rows["Value"][row][:3], float(run.rows["Radius"][row])
        if kind == VELOCITY:
            if 0 < frame < frames - 1 and speeds.max() > 0.0:
                found.append(max(np.linalg.norm(v[index, frame] - wanted) - radius, 0.0) / speeds.max())
            continue
        axes = 3 if kind == POSITION else 2
        found.append(max(np.linalg.norm((x[index, frame] - wanted)[:axes]) - radius, 0.0) / run.width)
    return max(found) if found else float("nan")
