# SPDX-License-Identifier: BSD-3-Clause
"""Whether bodies move as what they are (Documentation/Measure.md): how they glide by their poses, and keep apart."""
import numpy as np

APART = 0.95  # of the sum of two clearance radii: what is nearer is in each other's balls


def normals_of(orientations):
    """The z axes [..., 3] of bodies of these orientations (w, x, y, z) [..., 4]."""
    w, x, y, z = np.moveaxis(orientations, -1, 0)
    return np.stack([2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)], axis=-1)


def glides(run):
    """(sin(2 tilt), horizontal speed relative to the air downhill [m/s]) of a Run's bodies in free flight, frame by frame; none where
    they have no poses or no `Slip`."""
    if run.flights.glide is None:
        return np.zeros(0), np.zeros(0)
    flown = run.flights.free & np.isfinite(run.orientations[..., 0])
    normals = normals_of(run.orientations[flown])
    normals *= np.where(normals[:, 2:] < 0.0, -1.0, 1.0)
    slope = np.linalg.norm(normals[:, :2], axis=1)  # the sine of the tilt; a plate falls off to where its upper side leans
    downhill = normals[:, :2] / np.maximum(slope, 1e-12)[:, None]
    return 2.0 * slope * normals[:, 2], np.sum(run.flights.glide[flown][:, :2] * downhill, axis=1)


def near_pairs(run):
    """How many body-frames in flight there are of which another flying body's centre is nearer than balls as wide let it."""
    positions, flying = run.flights.positions, run.flights.flying
    found = 0
    for frame in range(positions.shape[1]):
        flown = np.flatnonzero(flying[:, frame])
        own, radii = positions[flown, frame], run.radii[flown]
        squares = np.sum(own**2, axis=1)
        apart = squares[:, None] + squares - 2.0 * own @ own.T
        near = apart < (APART * (radii[:, None] + radii)) ** 2
        np.fill_diagonal(near, False)
        found += int(near.any(axis=1).sum())
    return found
