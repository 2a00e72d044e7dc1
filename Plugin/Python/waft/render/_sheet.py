# SPDX-License-Identifier: BSD-3-Clause
"""A contact sheet: pictures of a view beside one another, with the numbers of their frames."""

import math

import numpy as np
import vtkmodules.vtkRenderingFreeType  # noqa: F401
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import vtkTextProperty, vtkTextRenderer

from waft.render._output import reduced, write_png
from waft.render._scenery import image

_MOST = 20  # pictures
_WIDTH = 320  # of a picture at least, where it has so much
_GAP = 4
_INK, _PAPER = 235, 40
_DOTS_PER_INCH = 72


def _label(number):
    """A number in light ink on a dark field [row from the top, column], bytes."""
    style = vtkTextProperty()
    style.SetFontSize(16)
    drawn, size = vtkImageData(), [0, 0]
    vtkTextRenderer.GetInstance().RenderString(style, str(number), drawn, size, _DOTS_PER_INCH)
    width, height, _ = drawn.GetDimensions()
    ink = vtk_to_numpy(drawn.GetPointData().GetScalars()).reshape(height, width, 4)[:size[1], :size[0], 3]
    return np.pad((_PAPER + (_INK - _PAPER) * (ink[::-1] / 255.0)).astype(np.uint8), 3, constant_values=_PAPER)


class Sheet:
    """A picture of up to twenty of those that are added, evenly spread, in rows from the top."""

    def __init__(self, path, frames):
        self._path = path
        frames = list(frames)
        count = min(len(frames), _MOST)
        self._shown = {frames[round(index * (len(frames) - 1) / max(count - 1, 1))] for index in range(count)}
        self._coming = iter(frames)
        self._tiles = []

    def add(self, picture):
        frame = next(self._coming)
        if frame not in self._shown:
            return
        width, height, _ = picture.GetDimensions()
        pixels = vtk_to_numpy(picture.GetPointData().GetScalars()).reshape(height, width, -1)
        step = max(min(width // _WIDTH, height), 1)
        tile = reduced(pixels[: height // step * step, : width // step * step], step)[::-1].copy()
        label = _label(frame)[: tile.shape[0], : tile.shape[1]]
        corner = tile[: label.shape[0], : label.shape[1]]
        corner[..., :3] = label[..., None]
        corner[..., 3:] = 255
        self._tiles.append(tile)

    def close(self):
        rows, columns, channels = self._tiles[0].shape
        across = math.ceil(math.sqrt(len(self._tiles)))
        down = math.ceil(len(self._tiles) / across)
        made = np.full((down * (rows + _GAP) - _GAP, across * (columns + _GAP) - _GAP, channels), _PAPER, np.uint8)
        made[..., 3:] = 0
        for index, tile in enumerate(self._tiles):
            row, column = index // across * (rows + _GAP), index % across * (columns + _GAP)
            made[row: row + rows, column: column + columns] = tile
        write_png(image(made[::-1]), self._path)

    def discard(self):
        self._tiles = []
