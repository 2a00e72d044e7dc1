# SPDX-License-Identifier: BSD-3-Clause
"""Pictures and movies as files."""

import contextlib
import os
import shutil
import subprocess
import sys
import tempfile

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOFFMPEG import vtkFFMPEGWriter
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOOggTheora import vtkOggTheoraWriter
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter

from waft.render._scenery import image


def grab(window, is_clear=False):
    """The window's pixels [row from the bottom, column, red, green, blue and, where it is clear, alpha], bytes."""
    reader = vtkWindowToImageFilter()
    reader.SetInput(window)
    (reader.SetInputBufferTypeToRGBA if is_clear else reader.SetInputBufferTypeToRGB)()
    reader.ReadFrontBufferOff()
    reader.ShouldRerenderOff()
    reader.Update()
    taken = reader.GetOutput()
    width, height, _ = taken.GetDimensions()
    return vtk_to_numpy(taken.GetPointData().GetScalars()).reshape(height, width, -1)


def reduced(pixels, samples):
    """`samples` x `samples` pixels averaged to one."""
    if samples == 1:
        return pixels
    pixels = pixels.astype(np.uint16)
    rows = sum(pixels[i::samples] for i in range(samples))
    total = sum(rows[:, i::samples] for i in range(samples))
    return ((total + samples * samples // 2) // (samples * samples)).astype(np.uint8)


def finished(pixels):
    """Pixels as vtkImageData. With alpha they were drawn over black, so that their colours come as their alpha's share."""
    if pixels.shape[2] == 4:
        whole = pixels.astype(np.uint32)
        whole[..., :3] = np.minimum(whole[..., :3] * 255 // np.maximum(whole[..., 3:], 1), 255)
        pixels = whole.astype(np.uint8)
    return image(pixels)


def write_png(picture, path):
    writer = vtkPNGWriter()
    writer.SetInputData(picture)
    writer.SetCompressionLevel(4)
    writer.SetFileName(os.fsencode(path))
    writer.Write()
    if writer.GetErrorCode():
        raise OSError(f"{path}: cannot be written")


@contextlib.contextmanager
def _errors_without(marker):
    """Meanwhile the process's standard error comes late and without the lines that hold the marker (bytes)."""
    sys.stderr.flush()
    shown = os.dup(2)
    with tempfile.TemporaryFile() as caught:
        os.dup2(caught.fileno(), 2)
        try:
            yield
        finally:
            sys.stderr.flush()
            os.dup2(shown, 2)
            os.close(shown)
            caught.seek(0)
            for line in caught:
                if marker not in line:
                    os.write(2, line)


class _VtkMovie:
    """A movie by one of VTK's writers."""

    def __init__(self, writer, path, rate):
        self._writer = writer
        self._writer.SetFileName(os.fsencode(os.path.abspath(path)))  # a name by itself may look like a protocol
        self._writer.SetRate(max(int(round(rate)), 1))
        self._writer.SetQuality(2)
        self._started = False

    def add(self, picture):
        self._writer.SetInputData(picture)
        if not self._started:
            self._writer.Start()
            self._started = True
        self._writer.Write()

    def close(self):
        if self._started:
            self._writer.End()
            self._started = False

    discard = close


class OggMovie(_VtkMovie):
    """An Ogg Theora movie."""

    def __init__(self, path, rate):
        super().__init__(vtkOggTheoraWriter(), path, rate)


class AviMovie(_VtkMovie):
    """An AVI movie (MJPEG)."""

    def __init__(self, path, rate):
        super().__init__(vtkFFMPEGWriter(), path, rate)

    def add(self, picture):
        with _errors_without(b"deprecated pixel format"):  # the writer's library says so at each picture
            super().add(picture)


class Mp4Movie:
    """An MP4 movie by the program ffmpeg, which gets raw pictures through a pipe."""

    def __init__(self, path, rate):
        self._path = os.path.abspath(path)  # a name by itself may look like a protocol, or an option
        self._rate = rate
        self._process = None

    @staticmethod
    def available():
        return shutil.which("ffmpeg") is not None

    def add(self, picture):
        width, height, _ = picture.GetDimensions()
        if self._process is None:
            self._process = subprocess.Popen(
                ["ffmpeg", "-v", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24"]
                + ["-s", f"{width}x{height}", "-r", f"{self._rate:.6g}", "-i", "-"]
                # Rows come from the bottom; H.264 wants even sizes.
                + ["-vf", "vflip,pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"]
                + ["-f", "mp4", self._path],
                stdin=subprocess.PIPE,
            )
        pixels = vtk_to_numpy(picture.GetPointData().GetScalars())
        with contextlib.suppress(BrokenPipeError):  # it ended before its time, as close() tells
            self._process.stdin.write(np.ascontiguousarray(pixels).tobytes())

    def close(self):
        with contextlib.suppress(BrokenPipeError):
            self._process.stdin.close()
        if self._process.wait() != 0:
            raise OSError(f"{self._path}: ffmpeg failed")

    def discard(self):
        if self._process is not None:
            self._process.kill()
            self._process.wait()
