# SPDX-License-Identifier: BSD-3-Clause
"""Where the pictures are taken from. A camera depends on the motion and the frame alone, so that
any frame can be drawn by itself."""

import math

import numpy as np
from vtkmodules.vtkRenderingCore import vtkCamera

_VIEW_ANGLE = 28.0  # degrees, of the picture's height
_MARGIN = 1.06  # room round what must be seen


def _fit(points, direction, aspect):
    """Centre and distance from which all points are seen, looking along `direction`."""
    right = np.cross(direction, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    up = np.cross(right, direction)
    axes = np.stack([right, up, direction])
    seen = points @ axes.T
    center = 0.5 * (seen.min(axis=0) + seen.max(axis=0))
    half = math.tan(math.radians(_VIEW_ANGLE) / 2.0)
    away = np.abs(seen - center)
    distance = np.max(
        np.maximum(away[:, 0] / (half * aspect), away[:, 1] / half) * _MARGIN
        - (seen[:, 2] - center[2])
    )
    return center @ axes, float(distance)


def _perspective(center, direction, distance, size):
    camera = vtkCamera()
    camera.SetViewAngle(_VIEW_ANGLE)
    camera.SetFocalPoint(*center)
    camera.SetPosition(*(center - direction * distance))
    camera.SetViewUp(0.0, 0.0, 1.0)
    camera.SetClippingRange(0.15 * distance, distance + 60.0 * size)
    return camera


class Cameras:
    """`at(view, frame)` gives the camera; the views are hero, side, top and follow."""

    def __init__(self, motion, aspect):
        self._motion = motion
        self._aspect = aspect
        bounds = motion.bounds
        self._size = max(bounds[1] - bounds[0], bounds[3] - bounds[2])
        reach = 0.5 * max(body.extent for body in motion.bodies)
        self._reach = reach
        self._highest = float(motion.positions[..., 2].max()) + reach
        self._fixed = {}
        self._approach = None

    def at(self, view, frame):
        if view == "follow":
            return self._follow(frame)
        if view == "hero":
            return self._hero(frame)
        if view not in self._fixed:
            self._fixed[view] = self._side() if view == "side" else self._top()
        return self._fixed[view]

    def horizon(self, view, frame):
        """Height of the horizon in the picture, 0 at the bottom and 1 at the top; above 1 when
        it is not to be seen."""
        camera = self.at(view, frame)
        pitch = math.asin(-camera.GetDirectionOfProjection()[2])
        if camera.GetParallelProjection() or pitch > 1.2:
            return 2.0
        half = math.tan(math.radians(_VIEW_ANGLE) / 2.0)
        return 0.5 + 0.5 * math.tan(pitch) / half

    def _hero(self, frame):
        """Near and low, but the higher the more objects come to lie, so that what they lay can be read. All that moves in the
        next seconds, of many objects until the end, is in the picture, so the camera nears what the motion ends with."""
        if self._approach is None:
            self._approach = self._make_approach()
        direction, centers, distances = self._approach
        return _perspective(centers[frame], direction, distances[frame], self._size)

    def _make_approach(self):
        """Direction of the hero's camera, and of each frame the centre and distance [frame, 3], [frame]."""
        motion = self._motion
        frames = motion.number_of_frames
        objects, resting = len(motion.positions), len(motion.marks.resting)
        # A few that lie write nothing.
        lying = min(resting / objects, 1.0) * min(max(resting - 1, 0) / 5.0, 1.0)
        ahead = int(2.0 * motion.frames_per_second * math.sqrt(objects))
        pitch = math.radians(12.0 + 38.0 * lying)
        direction = np.array([-0.08, 1.0, 0.0]) / math.hypot(0.08, 1.0) * math.cos(pitch)
        direction[2] = -math.sin(pitch)
        reach = self._reach * np.array([[-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]])
        # Few frames tell as much as all: an object moves less than the margin in between.
        step = max(int(round(0.2 * motion.frames_per_second)), 1)
        keys = np.unique(np.append(np.arange(0, frames, step), frames - 1))
        fits = []
        for at in range(len(keys)):
            places = motion.positions[:, keys[at:][keys[at:] <= keys[at] + ahead], :].reshape(-1, 3)
            center, distance = _fit(np.concatenate([places + reach[0], places + reach[1]]), direction, self._aspect)
            fits.append([*center, distance])
        spread = 0.6 * motion.frames_per_second
        # It comes late, lest the smoothing cuts off what moves last; before the first frame and after the last all stands.
        around = np.arange(-int(3.0 * spread), frames + int(3.0 * spread))
        ways = np.array([np.interp(around - 1.5 * spread, keys, column) for column in np.array(fits).T])
        weights = np.exp(-0.5 * ((np.arange(frames)[:, None] - around) / spread) ** 2)
        smooth = (weights @ ways.T) / weights.sum(axis=1)[:, None]
        return direction, smooth[:, :3], smooth[:, 3]

    def _side(self):
        direction = np.array([-0.20, 1.0, -0.15])
        direction /= np.linalg.norm(direction)
        places = self._motion.positions[:, ::5, :].reshape(-1, 3)
        reach = self._reach * np.array([[-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]])
        # The floor below the motion belongs to the picture.
        floor = places * [1.0, 1.0, 0.0] + [0.0, 0.0, self._motion.bounds[4]]
        seen = np.concatenate([places + reach[0], places + reach[1], floor])
        center, distance = _fit(seen, direction, self._aspect)
        return _perspective(center, direction, distance, self._size)

    def _top(self):
        """Straight down on where the motion ends (a word is read there), x to the right."""
        last = self._motion.positions[:, -1, :]
        places = [last] + [np.atleast_2d(p) for p in self._motion.marks.resting]
        places += [np.atleast_2d(p) for p, _ in self._motion.marks.flying]
        places = np.concatenate(places)
        low = places.min(axis=0)[:2] - 2.0 * self._reach
        high = places.max(axis=0)[:2] + 2.0 * self._reach
        center = 0.5 * (low + high)
        extent = np.maximum(high - low, 0.4 * self._size)
        top = self._highest + 0.5 * self._size
        camera = vtkCamera()
        camera.ParallelProjectionOn()
        camera.SetParallelScale(0.5 * _MARGIN * max(extent[1], extent[0] / self._aspect))
        camera.SetFocalPoint(center[0], center[1], self._motion.bounds[4])
        camera.SetPosition(center[0], center[1], top)
        camera.SetViewUp(0.0, 1.0, 0.0)
        camera.SetClippingRange(0.1 * self._size, top - self._motion.bounds[4] + self._size)
        return camera

    def _follow(self, frame):
        """From the side and a little above, on the middle of all objects, smoothed over time."""
        motion = self._motion
        spread = 0.5 * motion.frames_per_second  # frames; a hand-held camera lags that much
        frames = np.arange(motion.number_of_frames)
        weight = np.exp(-0.5 * ((frames - frame) / spread) ** 2)
        weight /= weight.sum()
        middle = np.einsum("f,ofd->d", weight, motion.positions) / len(motion.positions)
        away = np.linalg.norm(motion.positions - motion.positions.mean(axis=0), axis=2).max(axis=0)
        radius = max(float(weight @ away) + 2.0 * self._reach, 0.12 * self._size)
        direction = np.array([-0.45, 1.0, -0.22])
        direction /= np.linalg.norm(direction)
        half = math.tan(math.radians(_VIEW_ANGLE) / 2.0)
        distance = 1.15 * radius / (half * min(self._aspect, 1.0))
        return _perspective(middle, direction, distance, self._size)
