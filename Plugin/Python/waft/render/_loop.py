# SPDX-License-Identifier: BSD-3-Clause
"""An animation that begins again, as one picture that pages show."""

import io
import os

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from waft.failures import InputError, WaftError
from waft.files import write_bytes


class Loop:
    """An animated WebP picture that begins again, by Pillow: the last picture leads on to the first, or (fades) stays for a while and
    fades into it. The best quality is taken that keeps the file within `limit` megabytes."""

    _STAY = 1600  # milliseconds
    _FADE = 8  # pictures
    _QUALITIES = (85, 75, 65, 55, 45, 35, 25, 15)
    _MOST = 2.0e9  # bytes of pictures, which are all kept until the end

    def __init__(self, path, rate, limit, fades=True):
        self._path = str(path)
        self._duration = max(int(round(1000.0 / rate)), 1)
        self._limit = 1e6 * limit
        self._fades = fades
        self._pictures = []

    @staticmethod
    def require(limit):
        """Raises InputError unless a file can be that large, and WaftError where Pillow is missing."""
        if not 0.0 < limit <= 1000.0:
            raise InputError(f"loop {limit}: expected its largest size, from 0 to 1000 megabytes")
        try:
            from PIL import features
        except ImportError:
            features = None
        if features is None or not features.check("webp_anim"):
            raise WaftError("a loop needs Pillow with WebP; on Debian: apt-get install python3-pil")

    @classmethod
    def check(cls, count, size, views):
        """Raises InputError where the pictures of all views are too many to be kept."""
        if 3.0 * size[0] * size[1] * count * views > cls._MOST:
            raise InputError(f"a loop of {count} frames of {size[0]}x{size[1]} in {views} views is too much to be kept: expected fewer "
                             "frames (as A:B:S), smaller ones or fewer views")

    def add(self, picture):
        from PIL import Image

        width, height, _ = picture.GetDimensions()
        pixels = vtk_to_numpy(picture.GetPointData().GetScalars()).reshape(height, width, -1)
        self._pictures.append(Image.fromarray(np.ascontiguousarray(pixels[::-1])))

    def close(self):
        from PIL import Image

        first, last = self._pictures[0], self._pictures[-1]
        steps = range(1, self._FADE + 1) if self._fades and len(self._pictures) > 1 else ()
        fade = [Image.blend(last, first, step / (self._FADE + 1)) for step in steps]
        durations = [self._duration] * (len(self._pictures) + len(fade))
        if self._fades:
            durations[len(self._pictures) - 1] = self._STAY
        # The qualities' sizes grow: half of those left at each try.
        low, high, best = 0, len(self._QUALITIES), None
        while low < high:
            middle = (low + high) // 2
            made = io.BytesIO()
            # Each picture by itself (kmax): else blocks that change little from picture to picture stay as they were, and a
            # fade and what moves slowly leave steps.
            first.save(made, "WEBP", save_all=True, append_images=self._pictures[1:] + fade, duration=durations, loop=0,
                       quality=self._QUALITIES[middle], method=4, kmin=0, kmax=1)
            if made.tell() <= self._limit:
                best, high = made.getvalue(), middle
            else:
                low = middle + 1
        self._pictures = []
        if best is None:
            raise InputError(f"{os.path.basename(self._path)}: does not fit into {self._limit / 1e6:g} megabytes: expected fewer frames "
                             f"(as A:B:S), smaller ones or a larger limit")
        write_bytes(self._path, best)

    def discard(self):
        self._pictures = []
