# SPDX-License-Identifier: BSD-3-Clause
"""How bodies come to face where marks ask them to."""
import numpy as np

from waft.measuring._gliding import normals_of

FACING_TIME = 0.4  # s before its frame, in which a mark may turn a body


def facings(run):
    """Of the marks that ask their body to face a direction: whether it does [mark]; angular accelerations [rad/s^2] in the 0.4 s
    before these, and elsewhere in flight."""
    rows, rate, frames = run.rows, run.flights.rate, run.orientations.shape[1]
    asked = np.flatnonzero(np.linalg.norm(rows["Facing"], axis=1) > 0.0) if "Facing" in rows else ()
    place = {number: index for index, number in enumerate(run.ids.tolist())}
    marks = [(row, place[number]) for row, number in ((row, int(rows["ObjectId"][row])) for row in asked)
             if number in place and 0 <= rows["Frame"][row] < frames]
    if not marks or not np.isfinite(run.orientations).all():
        return np.zeros(0, bool), np.zeros(0), np.zeros(0)
    within, turned = [], np.zeros((len(run.ids), frames), bool)
    span = int(np.ceil(FACING_TIME * rate))
    for row, index in marks:
        frame = int(rows["Frame"][row])
        wanted = rows["Facing"][row] / np.linalg.norm(rows["Facing"][row])
        within.append(np.arccos(np.clip(normals_of(run.orientations[index, frame]) @ wanted, -1.0, 1.0)) <= rows["FacingTolerance"][row] + 1e-6)
        turned[index, max(frame - span, 0):frame + 1] = True
    spins = _spins(run.orientations, rate)
    pushes = np.linalg.norm(np.diff(spins, axis=1), axis=2) * rate  # at all frames but the first and the last one
    flying = run.flights.flying[:, :-2] & run.flights.flying[:, 1:-1] & run.flights.flying[:, 2:]
    return np.array(within), pushes[turned[:, 1:-1] & flying], pushes[~turned[:, 1:-1] & flying]


def _spins(orientations, rate):
    """The mean angular velocity from each frame to the next [object, step, 3]."""
    after, before = orientations[:, 1:], orientations[:, :-1] * np.array([1.0, -1.0, -1.0, -1.0])
    real = np.sum(orientations[:, 1:] * orientations[:, :-1], axis=2)
    turn = after[..., :1] * before[..., 1:] + before[..., :1] * after[..., 1:] + np.cross(after[..., 1:], before[..., 1:])
    turn *= np.where(real < 0.0, -1.0, 1.0)[..., None]
    sine = np.linalg.norm(turn, axis=2)
    angle = 2.0 * np.arctan2(sine, np.abs(real))
    return turn * (angle / np.maximum(sine, 1e-12) * rate)[..., None]
