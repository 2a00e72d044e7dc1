# SPDX-License-Identifier: BSD-3-Clause
"""The motion in a result folder, and when its objects fly: what `waft measure` needs of it."""
import functools
import os
from dataclasses import dataclass

import numpy as np

from waft.failures import InputError
from waft.measuring._flights import END, START, Flights
from waft.measuring._meshcuts import mesh_cuts
from waft.reading import dynamics
from waft.results._arrays import array_of, bounds_of, field_of, object_ids, points_of, polylines, present_of, rate_of
from waft.results._folder import read_surface
from waft.results._records import REPORT, record_of
from waft.results.writing import settled
from waft.scene._kinds import POSITION, REST, VELOCITY

TRACKS = ("optimized", "assimilated", "planned", "poses")
LEAST_FRAMES, MEASURED_RATES = 8, (4.0, 1000.0)  # of what can be measured; frames a second
MET = 0  # `Status` of a constraint that is met
NEAR_ROW = 8  # frames about a position row that are no free flight


@dataclass
class Run:
    """A folder's motion: its flights, the arrays of its tracks {name: [object, frame, ...]}, the columns of its rows {name:
    [row]}, the touch-downs [(object, frame)], whether a row of position holds an object at a frame [object, frame],
    orientations (w, x, y, z) [object, frame, 4] (NaN without poses), how far poses are from what turns bodies, median and 90th
    percentile in degrees (NaN where they do not say), the limit of their turning in degrees a frame (likewise), clearance radii
    [object] (NaN where they are not given), and what the optimiser says of its own motion {name: number}."""

    folder: str
    flights: Flights
    bounds: np.ndarray
    arrays: dict
    rows: dict
    ids: np.ndarray
    touches: list
    placed: np.ndarray
    orientations: np.ndarray
    agreement: np.ndarray
    limit: float
    radii: np.ndarray
    inertia: bool
    figures: dict
    poses_off: float  # how far poses.vtp lies off the tracks in flight at most [m]; NaN without
    releases: np.ndarray  # frames until which objects hang still [object]; -1: they fly from the first
    still: np.ndarray  # where they hang, or a row holds them [object, frame]

    @property
    def width(self):
        return max(self.bounds[1] - self.bounds[0], self.bounds[3] - self.bounds[2])

    @property
    def turns(self):
        """How far each turns from a frame to the next [object, step] in degrees; NaN without poses."""
        cosines = np.abs(np.sum(self.orientations[:, 1:] * self.orientations[:, :-1], axis=2))
        return np.degrees(2.0 * np.arccos(np.minimum(cosines, 1.0)))

    @functools.cached_property
    def cuts(self):
        """As mesh_cuts says, which takes seconds."""
        return mesh_cuts(self)


def read_run(folder, tracks="optimized"):
    """Reads a folder; raises InputError that names the file and the lack."""
    below = settled(folder)
    path = os.path.join(folder, f"{tracks}.vtp")
    data = read_surface(below, f"{tracks}.vtp")
    ids, positions, arrays = _tracks(path, data)
    positions[~arrays.pop("Present")] = np.nan
    bounds, rate = bounds_of(data, path), rate_of(data, path, *MEASURED_RATES)
    slip, radii, releases = _bodies(below, ids)
    orientations, agreement, limit, posed = _poses(below, ids, positions.shape[1])
    rows = _rows(below)
    flying, free, touches = flight(rows, ids, positions.shape[1], rate, releases)
    report = record_of(below, "report.json", REPORT) or {}
    off = np.linalg.norm(posed - positions, axis=2)[flying]
    inertia = report.get("inertia", False)
    return Run(str(folder), Flights(positions, rate, flying, free, slip, arrays.get("Slip")), bounds, arrays, rows, ids, touches,
               held(rows, ids, positions.shape[1]), orientations, agreement, limit, radii, inertia, dynamics(data),
               float(off.max()) if len(off) else np.nan, releases,
               still(rows, ids, positions.shape[1], releases))


def _tracks(path, data):
    """Ids, positions, and of the arrays that are measured those that are there [object, frame, 3], Present and Free [object, frame], where bodies glide
    Orientation [object, frame, 4] and AngularVelocity, and where they have inertia ResponseTime [object]."""
    ids, order = polylines(data, path, LEAST_FRAMES)
    columns = data.GetPointData()
    arrays = {name: array_of(columns, name, path, 3, high=np.inf, low=-np.inf)[order] for name in ("AirVelocity", "Control", "Residual", "Slip")
              if columns.HasArray(name)}
    arrays["Present"] = present_of(columns, path, order)
    if columns.HasArray("Slip") and columns.HasArray("Orientation") and columns.HasArray("AngularVelocity"):
        arrays.update(Orientation=array_of(columns, "Orientation", path, 4)[order], AngularVelocity=array_of(columns, "AngularVelocity", path, 3)[order])
    if data.GetCellData().HasArray("ResponseTime"):
        arrays["ResponseTime"] = array_of(data.GetCellData(), "ResponseTime", path, low=0.0)
    if columns.HasArray("Free"):
        arrays["Free"] = array_of(columns, "Free", path, kind=int, low=0, high=1)[order] > 0
    return ids, points_of(data, path)[order], arrays


def _bodies(folder, ids):
    """Settling speeds and clearance radii of objects, and the frames until which they hang."""
    path = folder.path / "objects.vtp"
    columns = read_surface(folder, "objects.vtp").GetPointData()
    place = {number: index for index, number in enumerate(object_ids(columns, path).tolist())}
    lost = [number for number in ids.tolist() if number not in place]
    if lost:
        raise InputError(f"{path}: object {lost[0]} of the tracks is missing")
    own = [place[number] for number in ids.tolist()]
    has_radii = columns.HasArray("ClearanceRadius")
    radii = array_of(columns, "ClearanceRadius", path, low=0.0)[own] if has_radii else np.full(len(own), np.nan)
    releases = array_of(columns, "Release", path, kind=int, low=-1)[own] if columns.HasArray("Release") else np.full(len(own), -1)
    return array_of(columns, "SettlingSpeed", path, low=0.0)[own], radii, releases


def _poses(folder, ids, frames):
    """Orientations, agreement, limit of turning and places [object, frame, 3] of poses.vtp, where it is there and has these objects and
    frames."""
    unknown = np.full((len(ids), frames, 4), np.nan), np.full(2, np.nan), np.nan, np.full((len(ids), frames, 3), np.nan)
    path = folder.path / "poses.vtp"
    if folder.found("poses.vtp") is None:
        return unknown
    data = read_surface(folder, "poses.vtp")
    own, order = polylines(data, path, LEAST_FRAMES)
    if order.shape[1] != frames or not np.isin(ids, own).all():
        return unknown
    place = {number: index for index, number in enumerate(own.tolist())}
    order = order[[place[number] for number in ids.tolist()]]
    turns = array_of(data.GetPointData(), "Orientation", path, 4)[order]
    told = data.GetFieldData().HasArray
    agreement = field_of(data, "Agreement", path, 2, low=0.0, high=180.0) if told("Agreement") else unknown[1]
    limit = field_of(data, "TurningLimit", path, 1, low=0.0, high=180.0)[0] if told("TurningLimit") else unknown[2]
    return turns, agreement, limit, points_of(data, path)[order]


def _rows(folder):
    """Columns of constraints.vtp, TouchDown and LiftOff (-1 where they are not given) among them; no rows without the file."""
    whole, times = ("ObjectId", "Frame", "Kind", "Until"), ("TouchDown", "LiftOff")
    path = folder.path / "constraints.vtp"
    if folder.found("constraints.vtp") is None:
        return {name: np.zeros((0, 4) if name == "Value" else 0) for name in (*whole, "Radius", "Value", *times)}
    columns = read_surface(folder, "constraints.vtp").GetPointData()
    rows = {name: array_of(columns, name, path, kind=int, low=-1) for name in whole}
    rows.update(Radius=array_of(columns, "Radius", path, low=0.0), Value=array_of(columns, "Value", path, 4))
    for name in times:
        rows[name] = array_of(columns, name, path, kind=int, low=-1) if columns.HasArray(name) else np.full(len(rows["Frame"]), -1)
    if columns.HasArray("Facing") and columns.HasArray("FacingTolerance"):
        rows.update(Facing=array_of(columns, "Facing", path, 3), FacingTolerance=array_of(columns, "FacingTolerance", path, low=0.0))
    if columns.HasArray("Status"):
        rows["Met"] = array_of(columns, "Status", path, kind=int) == MET
    return rows


def flight(rows, ids, frames, rate, releases=None):
    """(in the air, in free flight) [object, frame], and the touch-downs [(object, frame)]. In the air is an object from the start, its
    release or a lift-off to its touch-down, but for a path that is given frame by frame; free flight leaves out what is near them, and near
    rows of position."""
    flying = np.ones((len(ids), frames), bool)
    free = np.ones((len(ids), frames), bool)
    touches = []
    start, end = int(np.ceil(START * rate)), int(np.ceil(END * rate))
    number = np.arange(frames)
    for index, identity in enumerate(ids):
        own = np.flatnonzero(rows["ObjectId"] == identity)
        begin = max(int(releases[index]), 0) if releases is not None else 0
        flying[index, :begin] = False
        free[index, :begin + start] = False
        for row in own[rows["Kind"][own] == REST]:
            touch = int(rows["TouchDown"][row]) if rows["TouchDown"][row] >= 0 else int(rows["Frame"][row])
            until = max(int(rows["Until"][row]), int(rows["LiftOff"][row]))
            flying[index, touch + 1 if touch > 0 else 0:until if until < frames - 1 else frames] = False
            free[index, max(touch - end, 0):until + start] = False
            if touch > 0:
                touches.append((index, min(touch, frames - 1)))
        placed = np.zeros(frames, bool)
        for row in own[rows["Kind"][own] == POSITION]:
            first, last = int(rows["Frame"][row]), max(int(rows["Frame"][row]), int(rows["Until"][row]))
            placed[first:last + 1] = True
            if last > first:  # it is held there: it comes to a stop before, and begins from rest after
                free[index, max(first - end, 0):last + start] = False
        flying[index, 1:] &= ~(placed[1:] & placed[:-1])
        flying[index, :-1] &= ~(placed[1:] & placed[:-1])
        for frame in np.flatnonzero(placed):
            free[index, np.abs(number - frame) <= NEAR_ROW] = False
    return flying, free & flying, touches


def still(rows, ids, frames, releases):
    """Where objects hang, or are held after they have come to a position [object, frame]."""
    found = np.arange(frames) <= releases[:, None]
    place = {number: index for index, number in enumerate(ids.tolist())}
    for row in np.flatnonzero((rows["Kind"] == POSITION) & (rows["Until"] > rows["Frame"])):
        index = place.get(int(rows["ObjectId"][row]))
        if index is not None:
            found[index, int(rows["Frame"][row]) + 1:int(rows["Until"][row]) + 1] = True
    return found


def held(rows, ids, frames):
    """Whether a row of position, exact or a ball, holds an object at a frame [object, frame]."""
    found = np.zeros((len(ids), frames), bool)
    place = {number: index for index, number in enumerate(ids.tolist())}
    for row in np.flatnonzero(rows["Kind"] == POSITION):
        index, frame = place.get(int(rows["ObjectId"][row])), int(rows["Frame"][row])
        if index is not None and 0 <= frame < frames:
            found[index, frame] = True
    return found


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
