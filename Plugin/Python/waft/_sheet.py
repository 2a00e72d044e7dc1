# SPDX-License-Identifier: BSD-3-Clause
"""A contact sheet: pictures of a view beside one another, with the numbers of their frames."""

import math

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from ._output import reduced, write_png
from ._scenery import image

# Rows of the digits 0 to 9 from the top, three bits each.
_DIGITS = ((7, 5, 5, 5, 7), (2, 6, 2, 2, 7), (7, 1, 7, 4, 7), (7, 1, 7, 1, 7), (5, 5, 7, 1, 1),
           (7, 4, 7, 1, 7), (7, 4, 7, 5, 7), (7, 1, 2, 2, 2), (7, 5, 7, 5, 7), (7, 5, 7, 1, 7))
_INK, _LABEL, _GAP = 235, 40, 4


def _written(number, scale):
    """The pixels of a number [row from the top, column], true where ink is, with a margin."""
    digits = [np.array([[row >> bit & 1 for bit in (2, 1, 0)] for row in _DIGITS[int(digit)]]) for digit in str(number)]
    line = np.concatenate([np.pad(digit, ((1, 1), (1, 0))) for digit in digits] + [np.zeros((7, 1), int)], axis=1)
    return np.kron(line, np.ones((scale, scale), int)) > 0


class Sheet:
    """A picture of up to twenty of those that are added, evenly spread, in rows from the top; each about 320 wide."""

    _MOST = 20
    _WIDTH = 320

    def __init__(self, path, frames):
        self._path = path
        frames = list(frames)
        count = min(len(frames), self._MOST)
        self._shown = [frames[round(place * (len(frames) - 1) / max(count - 1, 1))] for place in range(count)]
        self._coming = iter(frames)
        self._tiles = []

    def add(self, picture):
        frame = next(self._coming)
        if frame not in self._shown:
            return
        width, height, _ = picture.GetDimensions()
        pixels = vtk_to_numpy(picture.GetPointData().GetScalars()).reshape(height, width, -1)
        share = max(width // self._WIDTH, 1)
        tile = reduced(pixels[: height // share * share, : width // share * share], share)[::-1].copy()
        ink = _written(frame, 2)[: tile.shape[0], : tile.shape[1]]
        label = np.where(ink[..., None], _INK, _LABEL).astype(np.uint8)
        corner = tile[: ink.shape[0], : ink.shape[1]]
        corner[..., :3] = label
        corner[..., 3:] = 255
        self._tiles.append(tile)

    def close(self):
        rows, columns, channels = self._tiles[0].shape
        across = math.ceil(math.sqrt(len(self._tiles)))
        down = math.ceil(len(self._tiles) / across)
        made = np.full((down * (rows + _GAP) - _GAP, across * (columns + _GAP) - _GAP, channels), _LABEL, np.uint8)
        made[..., 3:] = 0
        for place, tile in enumerate(self._tiles):
            row, column = place // across * (rows + _GAP), place % across * (columns + _GAP)
            made[row: row + rows, column: column + columns] = tile
        write_png(image(made[::-1]), self._path)

    def discard(self):
        self._tiles = []
