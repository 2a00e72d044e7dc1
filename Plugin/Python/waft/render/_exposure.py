# SPDX-License-Identifier: BSD-3-Clause
"""Pictures as a camera takes them: through a lens of some width, while a shutter is open. Many plain pictures, each of
another moment and from another point on the lens, are averaged in linear light."""

import math
from dataclasses import dataclass

import numpy as np
from vtkmodules.vtkRenderingCore import vtkCamera

from waft.failures import InputError

MOST_SUBFRAMES = 256
WIDEST = 1000.0  # mm, of a lens


@dataclass(frozen=True)
class Exposure:
    """shutter: fraction of a frame's time in which it is open, about the frame, 0 to 1; aperture: width of the lens in mm, which is
    sharp where the camera looks; subframes: pictures that are averaged."""

    shutter: float = 0.0
    aperture: float = 0.0
    subframes: int = 16

    def __post_init__(self):
        if not 0.0 <= self.shutter <= 1.0:
            raise InputError(f"shutter {self.shutter}: expected the fraction of a frame in which it is open, 0 to 1")
        if not 0.0 <= self.aperture <= WIDEST:
            raise InputError(f"aperture {self.aperture}: expected the width of the lens, 0 to {WIDEST:g} millimetres")
        if not 2 <= self.subframes <= MOST_SUBFRAMES:
            raise InputError(f"subframes {self.subframes}: expected a whole number from 2 to {MOST_SUBFRAMES}")

    @property
    def is_plain(self):
        return self.shutter == 0.0 and self.aperture == 0.0

    def moments(self):
        """(time from the frame [frames], point on the lens [m, 2], point in the pixel [-0.5 to 0.5, 2]) of each picture: evenly
        in time, and spread evenly over lens and pixel whatever their number."""
        step = 1.2207440846057596  # 1 / step and its powers fill a cube evenly: step^4 = step + 1
        for number in range(self.subframes):
            turn, away, x, y = (math.fmod(0.5 + (number + 1) * ratio, 1.0) for ratio in
                                (1.0 / step, 1.0 / step**2, 1.0 / step**3, (math.sqrt(5.0) - 1.0) / 2.0))
            radius = 0.0005 * self.aperture * math.sqrt(away)
            lens = np.array([radius * math.cos(2.0 * math.pi * turn), radius * math.sin(2.0 * math.pi * turn)])
            yield self.shutter * ((number + 0.5) / self.subframes - 0.5), lens, np.array([x - 0.5, y - 0.5])


def seen_through(camera, lens, pixel, size):
    """The camera moved to a point on its lens [m] and by a part of a pixel; what is as far as its focal point stays in place."""
    made = vtkCamera()
    made.DeepCopy(camera)
    center = 2.0 * pixel / size
    if not camera.GetParallelProjection():
        along = np.array(camera.GetDirectionOfProjection())
        right = np.cross(along, camera.GetViewUp())
        right /= np.linalg.norm(right)
        shift = lens[0] * right + lens[1] * np.cross(right, along)
        made.SetPosition(*(camera.GetPosition() + shift))
        made.SetFocalPoint(*(camera.GetFocalPoint() + shift))
        half = math.tan(math.radians(camera.GetViewAngle()) / 2.0) * camera.GetDistance()
        center = center - lens / (half * np.array([size[0] / size[1], 1.0]))
    made.SetWindowCenter(*center)
    return made


_LIGHT = np.concatenate([np.arange(11) / 255.0 / 12.92, ((np.arange(11, 256) / 255.0 + 0.055) / 1.055) ** 2.4]).astype(np.float32)
_STEPS = 0.5 * (_LIGHT[1:] + _LIGHT[:-1])  # where one byte's light passes into the next one's


class Film:
    """The mean of pictures [row, column, red, green, blue and perhaps alpha] of bytes, colours in linear light (sRGB's curve)."""

    def __init__(self):
        self._sum = None
        self._count = 0

    def add(self, pixels):
        light = _LIGHT[pixels]
        if pixels.shape[2] == 4:
            light[..., 3] = pixels[..., 3] / np.float32(255.0)
        self._sum = light if self._sum is None else np.add(self._sum, light, out=self._sum)
        self._count += 1

    def mean(self):
        light = self._sum / np.float32(self._count)
        made = np.searchsorted(_STEPS, light.ravel()).astype(np.uint8).reshape(light.shape)
        if light.shape[2] == 4:
            made[..., 3] = 255.0 * light[..., 3] + 0.5
        return made
