# SPDX-License-Identifier: BSD-3-Clause
"""Runs inside ParaView: what its virtual screen shows, window and all, as the X server keeps it in the file that WAFT_GUI_SCREEN
names (an X window dump)."""
import ctypes
import os

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter

HEADER_SIZE, WIDTH, HEIGHT, BYTES_PER_LINE, NUMBER_OF_COLORS = 0, 4, 5, 12, 19  # words of the dump's header
BYTES_PER_COLOR = 12


def pixels():
    """Rows from the top, columns, red, green and blue."""
    dump = np.fromfile(os.environ["WAFT_GUI_SCREEN"], dtype=np.uint8)
    words = np.frombuffer(dump[:100].tobytes(), dtype=">u4").astype(int)
    begin = words[HEADER_SIZE] + BYTES_PER_COLOR * words[NUMBER_OF_COLORS]
    rows = dump[begin:begin + words[HEIGHT] * words[BYTES_PER_LINE]].reshape(words[HEIGHT], -1, 4)
    return rows[:, :words[WIDTH], 2::-1]


def size():
    height, width, _ = pixels().shape
    return width, height


def ends_of_lines(left, top, right, bottom):
    """Of lines of dark text in a part of the screen, from the top: the pixel at which each ends."""
    is_dark = pixels()[top:bottom, left:right].max(axis=2) < 100
    lines = np.flatnonzero(np.diff(is_dark.any(axis=1), prepend=False, append=False)).reshape(-1, 2)
    return [int(left + np.flatnonzero(is_dark[begin:end].any(axis=0))[-1]) for begin, end in lines]


def move_pointer(x, y):
    """To a pixel of the screen, as a hand does it."""
    xlib = ctypes.CDLL("libX11.so.6")
    xlib.XOpenDisplay.restype = ctypes.c_void_p
    display = ctypes.c_void_p(xlib.XOpenDisplay(None))
    xlib.XDefaultRootWindow.restype = ctypes.c_ulong
    xlib.XWarpPointer(display, ctypes.c_ulong(0), ctypes.c_ulong(xlib.XDefaultRootWindow(display)), 0, 0, 0, 0, int(x), int(y))
    xlib.XCloseDisplay(display)


def save(path, step=1):
    """The screen as a PNG file, its colours rounded to a step: soft backgrounds pack so much better."""
    shown = pixels()[::-1] // step * step
    image = vtkImageData()
    image.SetDimensions(shown.shape[1], shown.shape[0], 1)
    image.GetPointData().SetScalars(numpy_to_vtk(np.ascontiguousarray(shown).reshape(-1, 3), deep=True))
    writer = vtkPNGWriter()
    writer.SetFileName(str(path))
    writer.SetCompressionLevel(9)
    writer.SetInputData(image)
    writer.Write()
