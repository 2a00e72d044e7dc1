# SPDX-License-Identifier: BSD-3-Clause
"""How bodies come to a mark that they have in common: spread out, or poured in ropes."""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkIdList, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStaticPointLocator

from waft.scene._kinds import POSITION, REST

LEAST_BODIES = 8  # that a common mark has
FIRST, LAST = 4.0, 1.0  # seconds before the mark


def approaches(run):
    """[(the mark's frame, its bodies [n], their frames of the mark before or of the start [n])] of a waft.measuring Run."""
    place = {number: index for index, number in enumerate(run.ids.tolist())}
    marks = {}  # {body: frames of its rows of place}
    for row in np.flatnonzero(np.isin(run.rows["Kind"], (POSITION, REST))):
        index, frame = place.get(int(run.rows["ObjectId"][row])), int(run.rows["Frame"][row])
        if index is not None and 0 <= frame < run.flights.positions.shape[1]:
            until = max(frame, int(run.rows["Until"][row]))
            marks.setdefault(index, []).append((frame, until))
    together = {}
    for index, own in marks.items():
        for frame, _ in own:
            together.setdefault(frame, []).append(index)
    found = []
    for frame, bodies in sorted(together.items()):
        before = [max([0] + [until for begin, until in marks[index] if begin < frame]) for index in bodies]
        if len(bodies) >= LEAST_BODIES:
            found.append((frame, np.array(bodies), np.array(before)))
    return found


def _nearest(places):
    """Distance to the nearest, and which it is, of places [n, 3]."""
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(places, float)))
    data = vtkPolyData()
    data.SetPoints(points)
    locator = vtkStaticPointLocator()
    locator.SetDataSet(data)
    locator.BuildLocator()
    found, nearest = vtkIdList(), np.empty(len(places), int)
    for number, place in enumerate(places.tolist()):
        locator.FindClosestNPoints(2, place, found)
        nearest[number] = found.GetId(0) if found.GetId(0) != number else found.GetId(1)
    return np.linalg.norm(places - places[nearest], axis=1), nearest


def _alignment(velocities, nearest):
    """Mean cosine between the velocity of each and that of its nearest."""
    unit = velocities / np.maximum(np.linalg.norm(velocities, axis=1, keepdims=True), 1e-9)
    return np.sum(unit * unit[nearest], axis=1).mean()


def approach(run, air):
    """Figures by frame, from FIRST to LAST seconds before each common mark: mean distance to the nearest of bodies, and of straight
    paths with the same ends; alignment of neighbours' velocities, and of free bodies' that are let go where the bodies are at the
    first of these frames (none without an air)."""
    flights = run.flights
    own, straight, aligned, free = [], [], [], []
    for mark, bodies, before in approaches(run):
        first, last = mark - int(round(FIRST * flights.rate)), mark - int(round(LAST * flights.rate))
        flown = before <= first
        bodies, before = bodies[flown], before[flown]
        if first < 0 or len(bodies) < LEAST_BODIES:
            continue
        path = flights.positions[bodies]
        number = np.arange(first, last + 1)
        share = (number[None] - before[:, None]) / (mark - before)[:, None]
        start, end = path[np.arange(len(bodies)), before], path[:, mark]
        line = start[:, None] + share[..., None] * (end - start)[:, None]
        drift = None if air is None else air.drift(path[:, first], flights.own()[bodies, first:last + 1], first, len(number), flights.rate)
        velocity = flights.velocity[bodies]
        drifting = None if drift is None else np.gradient(drift, 1.0 / flights.rate, axis=1)
        for step, frame in enumerate(number):
            inside = flights.inside[bodies, frame]
            if inside.sum() < LEAST_BODIES:
                continue
            away, nearest = _nearest(path[inside, frame])
            own.append(away.mean())
            straight.append(_nearest(line[inside, step])[0].mean())
            aligned.append(_alignment(velocity[inside, frame], nearest))
            if drift is not None:
                free.append(_alignment(drifting[inside, step], _nearest(drift[inside, step])[1]))
    return own, straight, aligned, free
