# SPDX-License-Identifier: BSD-3-Clause
"""Where the pictures are taken from. A camera depends on the motion and the frame alone, so that
any frame can be drawn by itself."""

import math

import numpy as np
from vtkmodules.vtkRenderingCore import vtkCamera

_VIEW_ANGLE = 28.0  # degrees, of the picture's height
_MARGIN = 1.06  # room round what must be seen
_LOW, _HIGH = 20.0, 50.0  # degrees that the hero's camera looks down by, on what flies and on what lies
_RISE = 1.0  # s, spread of the time in which it rises
_LAG = 0.3  # s, spread of the time over which a camera that goes along is smoothed
_AROUND = 0.4  # s, before and after a frame, of whose way a single object fills the picture
_CUT, _FEW = 0.2, 10  # share that the hero's camera may cut off of what flies, but for that many objects
_LEAST = 1.8  # half the picture's height at least, in halves of the largest body's extent


def _axes(direction):
    """Right, up and along [..., 3, 3] of cameras that look along directions [..., 3]."""
    level = np.hypot(direction[..., :1], direction[..., 1:2])
    right = np.where(level > 0.0, np.cross(direction, [0.0, 0.0, 1.0]), [1.0, 0.0, 0.0])
    right /= np.linalg.norm(right, axis=-1, keepdims=True)
    return np.stack([right, np.cross(right, direction), direction], axis=-2)


def _fit(points, direction, aspect):
    """Centre and distance from which all points are seen, looking along `direction`."""
    axes = _axes(direction)
    seen = points @ axes.T
    center = 0.5 * (seen.min(axis=0) + seen.max(axis=0))
    half = math.tan(math.radians(_VIEW_ANGLE) / 2.0)
    away = np.abs(seen - center)
    distance = np.max(
        np.maximum(away[:, 0] / (half * aspect), away[:, 1] / half) * _MARGIN
        - (seen[:, 2] - center[2])
    )
    return center @ axes, float(distance)


def _windows(values, reach, loops):
    """Of each frame the values [frame, ...] within so many frames of it, along the last axis. Before the first frame and after the last
    all stands, or (loops) it goes on from the last to the first."""
    beside = [(reach, reach), *[(0, 0)] * (values.ndim - 1)]
    return np.lib.stride_tricks.sliding_window_view(np.pad(values, beside, mode="wrap" if loops else "edge"), 2 * reach + 1, axis=0)


def _blurred(values, spread, loops):
    """Averages over time [frame, ...], by a bell that ends after three spreads."""
    reach = max(int(3.0 * spread), 1)
    weights = np.exp(-0.5 * (np.arange(-reach, reach + 1) / max(spread, 1e-9)) ** 2)
    return _windows(values, reach, loops) @ (weights / weights.sum())


class Cameras:
    """`at(view, frame)` gives the camera; the views are hero, side, top and follow."""

    def __init__(self, motion, aspect):
        self._motion = motion
        self._aspect = aspect
        bounds = motion.bounds
        self._size = max(bounds[1] - bounds[0], bounds[3] - bounds[2])
        self._reaches = np.array([0.5 * motion.bodies[shape].extent for shape in motion.shapes])
        self._reach = float(self._reaches.max())
        self._highest = float(motion.positions[..., 2].max()) + self._reach
        self._still = None
        self._tracks = {}

    def at(self, view, frame):
        if view == "side":
            self._still = self._still or self._side()
            return self._still
        if view not in self._tracks:
            self._tracks[view] = self._track(*getattr(self, f"_{view}")(), is_parallel=view == "top")
        directions, centers, distances = self._tracks[view]
        make = self._overhead if view == "top" else self._perspective
        return make(centers[frame], directions[frame], distances[frame])

    def horizon(self, view, frame):
        """Height of the horizon in the picture, 0 at the bottom and 1 at the top; above 1 when
        it is not to be seen."""
        camera = self.at(view, frame)
        pitch = math.asin(-camera.GetDirectionOfProjection()[2])
        if camera.GetParallelProjection() or pitch > 1.2:
            return 2.0
        half = math.tan(math.radians(_VIEW_ANGLE) / 2.0)
        return 0.5 + 0.5 * math.tan(pitch) / half

    def _hero(self):
        """Directions [frame, 3], low while things fly, and the higher the more of them lie, so that what they lay can be read; and how
        many may be cut off [frame]: a picture of many that fly is full where it cuts some at its edges, but not what they lay."""
        motion = self._motion
        objects, resting = len(motion.positions), len(motion.marks.resting)
        # A few that lie write nothing.
        most = min(resting / objects, 1.0) * min(max(resting - 1, 0) / 5.0, 1.0)
        away = np.linalg.norm(motion.positions - motion.positions[:, -1:], axis=2)
        lying = most * _blurred((away < self._reaches[:, None]).mean(axis=0), _RISE * motion.frames_per_second,
                                motion.loops)
        pitch = np.radians(_LOW + (_HIGH - _LOW) * lying)
        level = np.array([-0.08, 1.0]) / math.hypot(0.08, 1.0)
        directions = np.column_stack([np.cos(pitch)[:, None] * level, -np.sin(pitch)])
        free = max(1.0 - len(motion.marks.flying) / objects, 0.0)  # of what passes marks in the air one wants to see all
        return directions, _CUT * free * max(objects - _FEW, 0) * np.clip(1.0 - 1.5 * lying, 0.0, 1.0)

    def _follow(self):
        """From the side and a little above, none cut off."""
        direction = np.array([-0.45, 1.0, -0.22])
        return self._constant(direction / np.linalg.norm(direction))

    def _top(self):
        """Straight down (a word is read there), x to the right, none cut off."""
        return self._constant([0.0, 0.0, -1.0])

    def _constant(self, direction):
        count = self._motion.number_of_frames
        return np.tile(direction, (count, 1)), np.zeros(count)

    def _track(self, directions, cut, is_parallel):
        """(directions, centres, distances) of a camera that has all objects but `cut` [frame] in each frame's picture and goes without
        a jolt: its centre is that of their box, smoothed, and from it the distance is found that is needed, over some time the
        largest. Of a parallel projection it is half the picture's height."""
        motion = self._motion
        rate, count = motion.frames_per_second, motion.number_of_frames
        objects, each = len(motion.positions), np.arange(count)
        cut = np.minimum(cut.astype(int), objects - 1)
        axes = _axes(directions)
        seen = np.einsum("fad,ofd->ofa", axes, motion.positions)
        reaches = self._reaches[:, None, None]
        low = np.sort(seen - reaches, axis=0)[cut // 2, each]
        high = np.sort(seen + reaches, axis=0)[objects - 1 - cut // 2, each]
        centers = _blurred(np.einsum("fa,fad->fd", 0.5 * (low + high), axes), _LAG * rate, motion.loops)
        # Few objects are small in the picture of what they pass through; many are their own surroundings.
        around = _AROUND * rate / math.sqrt(objects)
        half = np.array([self._aspect, 1.0]) * (1.0 if is_parallel else math.tan(math.radians(_VIEW_ANGLE) / 2.0))
        needed = np.full(count, _LEAST * self._reach / half[1])
        for shift in sorted({int(round(around * part)) for part in (-1.0, -0.5, 0.0, 0.5, 1.0)}):
            frames = (each + shift) % count if motion.loops else np.clip(each + shift, 0, count - 1)
            away = np.einsum("fad,ofd->ofa", axes, motion.positions[:, frames] - centers)
            room = ((np.abs(away[..., :2]) + reaches) / half).max(axis=2) * _MARGIN
            room -= 0.0 if is_parallel else away[..., 2]
            needed = np.maximum(needed, np.sort(room, axis=0)[objects - 1 - cut, each])
        spread = _LAG * rate
        return directions, centers, _blurred(_windows(needed, max(int(3.0 * spread), 1), motion.loops).max(axis=1), spread, motion.loops)

    def _side(self):
        direction = np.array([-0.20, 1.0, -0.15])
        direction /= np.linalg.norm(direction)
        places = self._motion.positions[:, ::5, :].reshape(-1, 3)
        reach = self._reach * np.array([[-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]])
        # The floor below the motion belongs to the picture.
        floor = places * [1.0, 1.0, 0.0] + [0.0, 0.0, self._motion.bounds[4]]
        seen = np.concatenate([places + reach[0], places + reach[1], floor])
        center, distance = _fit(seen, direction, self._aspect)
        return self._perspective(center, direction, distance)

    def _perspective(self, center, direction, distance):
        camera = vtkCamera()
        camera.SetViewAngle(_VIEW_ANGLE)
        camera.SetFocalPoint(*center)
        camera.SetPosition(*(center - direction * distance))
        camera.SetViewUp(0.0, 0.0, 1.0)
        camera.SetClippingRange(0.15 * distance, distance + 60.0 * self._size)
        return camera

    def _overhead(self, center, direction, height):
        """A parallel projection that shows so much to each side of the centre, from above all that flies."""
        bottom, top = self._motion.bounds[4], self._highest + 0.5 * self._size
        camera = vtkCamera()
        camera.ParallelProjectionOn()
        camera.SetParallelScale(height)
        camera.SetFocalPoint(center[0], center[1], bottom)
        camera.SetPosition(center[0], center[1], top)
        camera.SetViewUp(0.0, 1.0, 0.0)
        camera.SetClippingRange(0.1 * self._size, top - bottom + self._size)
        return camera
