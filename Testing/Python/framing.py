# SPDX-License-Identifier: BSD-3-Clause
"""What a picture of `waft render` shows of what flies, in numbers: how much of the frame the bodies' box and the bodies themselves take,
how they stand out from what is behind them, and how much of the picture is nearly white."""

from dataclasses import dataclass

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from waft.render import Stage

PALE = 205  # of 255: a pixel whose darkest channel is lighter
_SEEN = 2  # of 255: a body that is drawn black changes what is behind it by more


@dataclass(frozen=True)
class Shown:
    """Shares of the frame, and of 255 (contrast)."""

    box: float  # of its height or width, whichever is more, that the box of all bodies' middles in this frame takes
    shot: float  # the same of where they are in all frames of the shot, cut off at the frame's edges
    lost: float  # of the bodies, those whose middles are outside the frame
    bodies: float  # of its pixels, those that bodies cover
    contrast: float  # median over the bodies' pixels: what the channel changes that changes most, where the body is taken away
    pale: float  # of its pixels, those that are nearly white

    def __str__(self):
        return (f"box {self.box:4.2f}  shot {self.shot:4.2f}  lost {self.lost:4.2f}  bodies {100.0 * self.bodies:5.2f} %  "
                f"contrast {self.contrast:4.2f}  pale {self.pale:4.2f}")


class Framing:
    """Measures pictures of one motion."""

    def __init__(self, motion, size=(480, 270), style="day"):
        self._motion = motion
        self._size = size
        self._stage = Stage(motion, size, 1, paths=False, targets=False, style=style)
        self._bodies = [actors[0] for _, _, actors, _ in self._stage._objects._items]

    def shown(self, view, frame):
        drawn = self._drawn(view, frame)
        for body in self._bodies:
            body.VisibilityOff()
        behind = self._drawn(view, frame)
        looks = []
        for body in self._bodies:
            body.VisibilityOn()
            look = body.GetProperty()
            looks.append((look, look.GetAmbient(), look.GetDiffuse(), look.GetSpecular()))
            _light(look, 0.0, 0.0, 0.0)
        covered = np.abs(self._drawn(view, frame) - behind).max(axis=2) > _SEEN
        for each in looks:
            _light(*each)
        change = np.abs(drawn - behind).max(axis=2)[covered]
        now = self._on_picture(view, frame, self._motion.positions[:, frame])
        shot = self._on_picture(view, frame, self._motion.positions.reshape(-1, 3))
        return Shown(
            box=_extent(now), shot=_extent(np.clip(shot, -1.0, 1.0)), lost=float(np.mean(np.abs(now).max(axis=1) > 1.0)),
            bodies=float(covered.mean()), contrast=float(np.median(change)) / 255.0 if change.size else 0.0,
            pale=float(np.mean(drawn.min(axis=2) > PALE)))

    def _drawn(self, view, frame):
        taken = self._stage.draw(view, frame).GetPointData().GetScalars()
        return vtk_to_numpy(taken).reshape(self._size[1], self._size[0], -1)[..., :3].astype(int)

    def _on_picture(self, view, frame, places):
        """Where places lie on the picture [place, 2], -1 to 1."""
        camera = self._stage._cameras.at(view, frame)
        matrix = camera.GetCompositeProjectionTransformMatrix(self._size[0] / self._size[1], -1.0, 1.0)
        entries = np.array([[matrix.GetElement(row, column) for column in range(4)] for row in range(4)])
        seen = np.append(places, np.ones((len(places), 1)), axis=1) @ entries.T
        return seen[:, :2] / seen[:, 3:]


def _light(look, ambient, diffuse, specular):
    look.SetAmbient(ambient)
    look.SetDiffuse(diffuse)
    look.SetSpecular(specular)


def _extent(places):
    return float(np.max(places.max(axis=0) - places.min(axis=0))) / 2.0
