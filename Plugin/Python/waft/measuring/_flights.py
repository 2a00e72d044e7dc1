# SPDX-License-Identifier: BSD-3-Clause
"""Paths of bodies through air, and the figures by which their motion is judged (Documentation/Measure.md).

All figures are of positions alone. A motion is a list of Flights, one for each air: what is about the mean of a frame is about the
mean of the bodies of one air.
"""
from dataclasses import dataclass
from typing import Optional

import numpy as np

BANDS = ((0.1, 0.3), (0.3, 0.6), (0.6, 1.2), (1.2, 2.4))  # Hz
DISTANCES = np.linspace(0.15, 1.5, 10)  # ends of the bins of pairs [m]
NEAR = 0.5  # pairs by whose differences the share along their line is judged [m]
LEAST_PAIRS = 50  # a bin with fewer says nothing
START, END = 0.5, 0.8  # of a flight, not free: after the start and before the touch-down [s]
NEAR_GROUND = 0.3  # a body that ends nearer to the floor has landed; others left the volume [m]


@dataclass
class Flights:
    """Bodies in one air: positions [body, frame, 3] in metres, NaN where a body is not; when each is in the air, and when it
    flies freely [body, frame]; settling speeds [body] in m/s; where bodies glide their own velocity relative to the air [body, frame,
    3] in m/s, in place of sinking at these."""

    positions: np.ndarray
    rate: float
    flying: np.ndarray
    free: np.ndarray
    slip: np.ndarray
    glide: Optional[np.ndarray] = None

    def __post_init__(self):
        x, dt = self.positions, 1.0 / self.rate
        self.velocity, self.acceleration, self.jerk = (np.full_like(x, np.nan) for _ in range(3))
        self.velocity[:, 1:-1] = (x[:, 2:] - x[:, :-2]) / (2.0 * dt)
        self.acceleration[:, 1:-1] = (x[:, 2:] - 2.0 * x[:, 1:-1] + x[:, :-2]) / dt**2
        self.jerk[:, 2:-2] = (x[:, 4:] - 2.0 * x[:, 3:-1] + 2.0 * x[:, 1:-3] - x[:, :-4]) / (2.0 * dt**3)
        self.carried = self.velocity if self.glide is None else self.velocity - self.glide  # what the air gives
        self.free = self.free & np.isfinite(self.jerk[..., 0])
        # A central difference across a lift-off or touch-down is no velocity of flight.
        inside = self.flying.copy()
        inside[:, 1:] &= self.flying[:, :-1]
        inside[:, :-1] &= self.flying[:, 1:]
        self.inside = inside & np.isfinite(self.acceleration[..., 0])

    def __len__(self):
        return len(self.positions)

    def own(self):
        """The velocity [body, frame, 3] that bodies have relative to the air."""
        if self.glide is not None:
            return self.glide
        sinking = np.zeros_like(self.positions)
        sinking[..., 2] = -self.slip[:, None]
        return sinking


def stretches(mask):
    """[(body, first frame, frame after the last)] of the runs of a mask [body, frame]."""
    edges = np.diff(np.pad(mask.astype(np.int8), ((0, 0), (1, 1))), axis=1)
    bodies, starts = np.nonzero(edges == 1)
    _, ends = np.nonzero(edges == -1)
    return list(zip(bodies.tolist(), starts.tolist(), ends.tolist()))


def widened(mask, frames):
    """A mask [body, frame], and that many frames before and after."""
    wide = mask.copy()
    for shift in range(1, frames + 1):
        wide[:, shift:] |= mask[:, :-shift]
        wide[:, :-shift] |= mask[:, shift:]
    return wide


def rms(vectors):
    """Root of the mean square length; NaN of none."""
    return float(np.sqrt(np.mean(np.sum(vectors**2, axis=-1)))) if len(vectors) else float("nan")


def about_frames(values, mask):
    """Squares of the distances of values [body, frame, 3] from the mean of their frame, where there are at least two; unbiased."""
    count = mask.sum(axis=0)
    kept = mask & (count >= 2)
    filled = np.where(mask[..., None], values, 0.0)
    mean = filled.sum(axis=0) / np.maximum(count, 1)[:, None]
    squares = np.sum((filled - mean) ** 2, axis=-1) * (count / np.maximum(count - 1, 1))
    return squares[kept]


def about_paths(values, mask, longest):
    """The same about the mean of each stretch of flight, cut into pieces of at most a number of frames."""
    squares = [np.zeros(0)]
    for body, first, last in stretches(mask):
        for begin in range(first, last, longest):
            piece = values[body, begin:min(begin + longest, last)]
            if len(piece) >= min(longest, last - first) and len(piece) > 1:
                squares.append(np.sum((piece - piece.mean(axis=0)) ** 2, axis=-1))
    return np.concatenate(squares)


def variances(airs, seconds=None):
    """Variance of velocity and of acceleration in free flight: about each frame's mean, or with a length of time about each path's
    own mean over that."""
    found = []
    for name in ("velocity", "acceleration"):
        squares = [about_frames(getattr(air, name), air.free) if seconds is None else
                   about_paths(getattr(air, name), air.free, max(int(round(seconds * air.rate)), 2)) for air in airs]
        squares = np.concatenate(squares) if squares else np.zeros(0)
        found.append(float(squares.mean()) if len(squares) else float("nan"))
    return found


def flight_seconds(airs):
    """Median length of the stretches of free flight [s]; NaN without one."""
    lengths = [(last - first) / air.rate for air in airs for _, first, last in stretches(air.free)]
    return float(np.median(lengths)) if lengths else float("nan")


def spectrum(airs, seconds):
    """(frequencies [Hz], energy density of the velocity [m^2/s^2/Hz]) of pieces of free flight of that length, under Hann's window,
    their straight line taken off; None without a piece."""
    step, most = 0.05, 6.0
    frequencies = np.arange(step, most, step)
    total, count = np.zeros(len(frequencies)), 0
    for air in airs:
        length = int(round(seconds * air.rate))
        pieces = [air.velocity[body, begin:begin + length] for body, first, last in stretches(air.free)
                  for begin in range(first, last - length + 1, max(length // 2, 1))]
        if not pieces or length < 8:
            continue
        time = np.arange(length) / air.rate
        line = np.stack([np.ones(length), time], axis=1)
        values = np.stack(pieces).transpose(1, 0, 2).reshape(length, -1)
        values = values - line @ np.linalg.lstsq(line, values, rcond=None)[0]
        window = np.hanning(length)
        waves = np.exp(-2j * np.pi * np.outer(frequencies, time)) * window
        power = 2.0 * np.abs(waves @ values) ** 2 / (air.rate * np.sum(window**2))
        total += power.sum(axis=1)
        count += len(pieces)
    return (frequencies, total / count) if count else None


def band_energies(airs, seconds):
    """Energy of the velocity in each of BANDS [m^2/s^2]; NaN without a piece of flight of that length."""
    found = spectrum(airs, seconds)
    if found is None:
        return np.full(len(BANDS), np.nan)
    frequencies, density = found
    step = frequencies[1] - frequencies[0]
    return np.array([density[(frequencies >= low - 1e-9) & (frequencies < high - 1e-9)].sum() * step for low, high in BANDS])


def _pairs(air, every):
    """(distance, squared difference of velocity, its part along the pair's line) of pairs of bodies in free flight."""
    found = [np.zeros((3, 0))]
    for frame in range(0, air.positions.shape[1], every):
        here = np.flatnonzero(air.free[:, frame])
        if len(here) < 2:
            continue
        i, j = np.triu_indices(len(here), 1)
        x, v = air.positions[here, frame], air.carried[here, frame]
        apart, differing = x[i] - x[j], v[i] - v[j]
        distance = np.linalg.norm(apart, axis=1)
        near = (distance < DISTANCES[-1]) & (distance > 1e-6)
        along = np.sum(apart[near] * differing[near], axis=1) / distance[near]
        found.append(np.stack([distance[near], np.sum(differing[near] ** 2, axis=1), along**2]))
    return np.concatenate(found, axis=1)


def structure(airs, every=5):
    """S2(r) = <|dv|^2> / (2 var v) in the bins between DISTANCES (NaN where pairs are few), and 3 S_L / S of the pairs nearer than
    NEAR."""
    pairs = np.concatenate([np.zeros((3, 0))] + [_pairs(air, every) for air in airs], axis=1)
    squares = np.concatenate([np.zeros(0)] + [about_frames(air.carried, air.free) for air in airs])
    variance = float(squares.mean()) if len(squares) else float("nan")
    bin_of = np.searchsorted(DISTANCES, pairs[0]) - 1
    values = np.full(len(DISTANCES) - 1, np.nan)
    for bin_ in range(len(values)):
        chosen = pairs[1, bin_of == bin_]
        if len(chosen) >= LEAST_PAIRS and variance > 0.0:
            values[bin_] = chosen.mean() / (2.0 * variance)
    near = pairs[:, pairs[0] < NEAR]
    total = near[1].sum()
    return values, 3.0 * near[2].sum() / total if near.shape[1] >= LEAST_PAIRS and total > 0.0 else float("nan")


def distance_of(values, others):
    """Mean of |ln| of the ratio of two S2(r); NaN where no bin is known of both."""
    known = (values > 0.0) & (others > 0.0)
    return float(np.mean(np.abs(np.log(values[known] / others[known])))) if known.any() else float("nan")
