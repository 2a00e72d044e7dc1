# SPDX-License-Identifier: BSD-3-Clause
"""Bodies that are let go in the air as it was written, without control, and what the air was given for their marks' sake."""
import numpy as np

from waft.scene._kinds import POSITION, REST

LAST = 1.0  # before a mark, when bodies are let go [s]
BEFORE_TOUCH = 0.8  # the mark of a rest: where its body is then [s]
BEFORE_HOLD = 0.4  # likewise of a position at which its body is held
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
            stops = int(run.rows["Until"][row]) > frame  # it is held there, and comes to a stop before
            marks.setdefault(index, set()).add(frame - int(round(BEFORE_HOLD * rate)) if stops else frame)
    found = []
    for index in range(len(run.ids)):
        start = max(int(run.releases[index]), 0)
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


def _law(run):
    """(e, b0, b1) [object, 1] of v_k = e v_k-1 + b0 w_k-1 + b1 w_k, the velocity in a step of a body in air that with its slip gives it w:
    (0, 0, 1) where it has no inertia."""
    steps = np.maximum(run.arrays.get("ResponseTime", np.zeros(len(run.ids))), 1e-9)[:, None] * run.flights.rate
    kept = np.exp(-1.0 / steps)
    now = 1.0 - steps * (1.0 - kept)
    return kept, 1.0 - kept - now, now


def _given(run, air):
    """By step: velocities along the tracks, and what the air half way and the mean slip of both frames give there [object, 3]."""
    flights = run.flights
    slip = 0.5 * (flights.own()[:, 1:] + flights.own()[:, :-1])
    for frame in range(flights.positions.shape[1] - 1):
        ends = flights.positions[:, frame:frame + 2]
        given = air.at(ends.mean(axis=1), (frame + 0.5) / flights.rate)
        yield frame, (ends[:, 1] - ends[:, 0]) * flights.rate, given, slip[:, frame]


def _missed(run, air, is_free, flown):
    """Of bodies [(object, frame at which it is let go, frames of its marks)]: each step by the implicit mid-point rule, in the mean of
    both frames' air and slip, those with inertia by its exact step; where a step is not free they are where the track is."""
    flights, (kept, past, now) = run.flights, _law(run)
    dt = 1.0 / flights.rate
    bodies = np.array([index for index, _, _ in flown], int)
    starts = np.array([start for _, start, _ in flown], int)
    ends = np.array([max(marks, default=start) for _, start, marks in flown], int)
    path = {frame: [] for frame in range(flights.positions.shape[1])}
    for number, (_, _, marks) in enumerate(flown):
        for mark in marks:
            path[mark].append(number)
    places = flights.positions[bodies, starts] if len(bodies) else np.zeros((0, 3))
    velocity, given = np.zeros_like(places), np.zeros_like(places)
    found = []
    for frame, track, there, slip in _given(run, air):
        going = np.flatnonzero((starts <= frame) & (frame < ends))
        free = going[is_free[bodies[going], frame]]
        held = going[~is_free[bodies[going], frame]]
        begin = np.flatnonzero(starts == frame + 1)
        for which in (held, begin):  # these go the track's way, or did
            places[which] = flights.positions[bodies[which], frame + 1]
            velocity[which], given[which] = track[bodies[which]], (there + slip)[bodies[which]]
        if len(free):
            own, before = bodies[free], places[free]
            first = (starts[free] == 0) & (frame == 0)
            share = np.where(first[:, None], 1.0, now[own])
            coming = np.where(first[:, None], 0.0, kept[own] * velocity[free] + past[own] * given[free])
            after = before
            for _ in range(ROUNDS):
                wind = air.at(0.5 * (before + after), (frame + 0.5) * dt) + slip[own]
                after = before + dt * (coming + share * wind)
            places[free] = after
            velocity[free], given[free] = (after - before) / dt, wind
        for number in path[frame + 1]:
            found.append(np.linalg.norm(places[number] - flights.positions[bodies[number], frame + 1]) / run.width)
    return np.array(found)


def control(run, air):
    """What moves bodies half way through their free steps beside the air and their slip, over the rms of the air's velocity there: of all
    of them, and of those away from others and the floor; and the share of steps near these. NaN without any."""
    kept, past, now = _law(run)
    squares, flows, nears = [np.zeros(0)], [np.zeros(0)], [np.zeros(0, bool)]
    last = None
    for frame, velocity, given, slip in _given(run, air):
        wind = given + slip
        lacking = velocity - wind if last is None else (velocity - kept * last[0] - past * last[1] - now * wind) / (1.0 - kept)
        last = velocity, wind
        free = np.flatnonzero(run.arrays["Free"][:, frame])
        middle = run.flights.positions[:, frame:frame + 2].mean(axis=1)
        own = np.sum(middle**2, axis=1)
        apart = own[free, None] + own - 2.0 * middle[free] @ middle.T
        apart[np.arange(len(free)), free] = np.inf
        squares.append(np.sum(lacking[free]**2, axis=1))
        flows.append(np.sum(given[free]**2, axis=1))
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
