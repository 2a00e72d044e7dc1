# SPDX-License-Identifier: BSD-3-Clause
"""Bodies that are let go in the air as it was written, without control, and what the air was given for their marks' sake."""
import numpy as np

from waft.scene._kinds import POSITION, REST

LAST = 1.0  # before a mark, when bodies are let go [s]
BEFORE_TOUCH = 0.8  # the mark of a rest: where its body is then [s]
AFTER_LIFT = 0.6  # and when one that lay is let go again [s]
NEAR = 0.13  # of another's centre or of the floor, where bodies are held off besides [m]
ROUNDS = 12  # of the mid-point rule; a step's error falls by |grad u| dt / 2 in each


def legs(run):
    """[(object, frame of the start, frames of the marks on the way)] of all that flies: from the start or a lift-off to the next rest."""
    rate, frames = run.flights.rate, run.flights.positions.shape[1]
    place = {number: index for index, number in enumerate(run.ids.tolist())}
    marks, rests = {}, {}
    met = run.rows.get("Met", np.ones(len(run.rows["Frame"]), bool))
    for row in range(len(run.rows["Frame"])):
        index, frame, kind = place.get(int(run.rows["ObjectId"][row])), int(run.rows["Frame"][row]), run.rows["Kind"][row]
        if index is None or not 0 <= frame < frames:
            continue
        if kind == REST:
            touch = int(run.rows["TouchDown"][row])
            lift = max(int(run.rows["Until"][row]), int(run.rows["LiftOff"][row]))
            rests.setdefault(index, []).append((touch if touch >= 0 else frame, lift))
        elif kind == POSITION and met[row]:
            marks.setdefault(index, set()).add(frame)
    found = []
    for index in range(len(run.ids)):
        start = 0
        for touch, lift in [*sorted(rests.get(index, [])), (frames, frames)]:
            end = touch - int(round(BEFORE_TOUCH * rate)) if touch < frames else frames
            own = {frame for frame in marks.get(index, ()) if start < frame < touch}
            if start < end < frames:
                own.add(end)
            if own:
                found.append((index, start, sorted(own)))
            start = max(touch, lift) + int(round(AFTER_LIFT * rate))
    return found


def misses(run, air):
    """How far bodies miss their marks over the volume's width, that are let go a second before each, and that are let go once, at the
    start and after each lift-off."""
    back = int(round(LAST * run.flights.rate))
    is_free = run.arrays["Free"]
    found = [(index, start, [mark for mark in marks if is_free[index, mark - 1]]) for index, start, marks in legs(run)]
    last = [(index, max(mark - back, 0), [mark]) for index, _, marks in found for mark in marks]
    return _missed(run, air, is_free, last), _missed(run, air, is_free, found)


def _missed(run, air, is_free, flown):
    """Of bodies [(object, frame at which it is let go, frames of its marks)]: each step by the implicit mid-point rule, in the mean of
    both frames' air and slip; where a step is not free they are where the track is."""
    flights = run.flights
    slip = 0.5 * (flights.own()[:, 1:] + flights.own()[:, :-1])
    dt = 1.0 / flights.rate
    bodies = np.array([index for index, _, _ in flown], int)
    starts = np.array([start for _, start, _ in flown], int)
    ends = np.array([max(marks, default=start) for _, start, marks in flown], int)
    path = {frame: [] for frame in range(flights.positions.shape[1])}
    for number, (_, _, marks) in enumerate(flown):
        for mark in marks:
            path[mark].append(number)
    places = flights.positions[bodies, starts] if len(bodies) else np.zeros((0, 3))
    found = []
    for frame in range(flights.positions.shape[1] - 1):
        going = np.flatnonzero((starts <= frame) & (frame < ends))
        free = going[is_free[bodies[going], frame]]
        held = going[~is_free[bodies[going], frame]]
        places[held] = flights.positions[bodies[held], frame + 1]
        if len(free):
            before = places[free]
            after = before
            for _ in range(ROUNDS):
                after = before + dt * (air.at(0.5 * (before + after), (frame + 0.5) * dt) + slip[bodies[free], frame])
            places[free] = after
        for number in path[frame + 1]:
            found.append(np.linalg.norm(places[number] - flights.positions[bodies[number], frame + 1]) / run.width)
    return np.array(found)


def control(run, air):
    """What moves bodies half way through their free steps beside the air and their slip, over the rms of the air's velocity there: of all
    of them, and of those away from others and the floor; and the share of steps near these. NaN without any."""
    flights = run.flights
    slip = 0.5 * (flights.own()[:, 1:] + flights.own()[:, :-1])
    squares, flows, nears = [np.zeros(0)], [np.zeros(0)], [np.zeros(0, bool)]
    for frame in range(flights.positions.shape[1] - 1):
        free = np.flatnonzero(run.arrays["Free"][:, frame])
        ends = flights.positions[:, frame:frame + 2]
        middle = ends.mean(axis=1)
        given = air.at(middle[free], (frame + 0.5) / flights.rate)
        lacking = (ends[free, 1] - ends[free, 0]) * flights.rate - given - slip[free, frame]
        own = np.sum(middle**2, axis=1)
        apart = own[free, None] + own - 2.0 * middle[free] @ middle.T
        apart[np.arange(len(free)), free] = np.inf
        squares.append(np.sum(lacking**2, axis=1))
        flows.append(np.sum(given**2, axis=1))
        nears.append((apart.min(axis=1, initial=np.inf) < NEAR**2) | (middle[free, 2] - run.bounds[4] < NEAR))
    squares, flows, nears = map(np.concatenate, (squares, flows, nears))
    return [float(np.sqrt(squares[mask].mean() / flows.mean())) if mask.any() and flows.any() else float("nan")
            for mask in (np.ones_like(nears), ~nears)] + [float(nears.mean()) if len(nears) else float("nan")]


def rush(run, air):
    """Mean acceleration that the air was given for the marks' sake, at the bodies: in the last second before marks, and in all free
    flight; NaN without either."""
    flights, back = run.flights, int(round(LAST * run.flights.rate))
    is_free = run.arrays["Free"]
    late = np.zeros_like(is_free)
    for index, _, marks in legs(run):
        for mark in marks:
            late[index, max(mark - back, 0):mark] = True
    sizes = np.full(is_free.shape, np.nan)
    for frame in range(is_free.shape[1]):
        if frame in air.wind:
            sizes[:, frame] = np.linalg.norm(air.within(air.wind[frame], flights.positions[:, frame]), axis=1)
    known = is_free & np.isfinite(sizes)
    return [float(sizes[mask].mean()) if mask.any() else float("nan") for mask in (known & late, known)]


def sinking(run):
    """[(speed down 0.5 to 2 s after a body's last mark, its settling speed)] of those that fly freely then [m/s]."""
    flights, is_free = run.flights, run.arrays["Free"]
    last = {index: marks[-1] for index, _, marks in legs(run)}
    found = []
    for index, mark in last.items():
        begin, end = (mark + int(round(seconds * flights.rate)) for seconds in (0.5, 2.0))
        if end < is_free.shape[1] and is_free[index, begin:end].all():
            drop = flights.positions[index, begin, 2] - flights.positions[index, end, 2]
            found.append((drop * flights.rate / (end - begin), flights.slip[index]))
    return np.array(found).reshape(-1, 2)
