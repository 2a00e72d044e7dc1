# SPDX-License-Identifier: BSD-3-Clause
"""Pictures and movies as files."""

import contextlib
import io
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

from ._scenery import image
from .failures import BadInput, WaftError


def grab(window, samples):
    """The window's picture as vtkImageData; `samples` x `samples` pixels of it make one."""
    reader = vtkWindowToImageFilter()
    reader.SetInput(window)
    reader.SetInputBufferTypeToRGB()
    reader.ReadFrontBufferOff()
    reader.ShouldRerenderOff()
    reader.Update()
    taken = reader.GetOutput()
    if samples == 1:
        return taken
    width, height, _ = taken.GetDimensions()
    pixels = vtk_to_numpy(taken.GetPointData().GetScalars())
    pixels = pixels.reshape(height, width, 3).astype(np.uint16)
    rows = sum(pixels[i::samples] for i in range(samples))
    total = sum(rows[:, i::samples] for i in range(samples))
    return image(((total + samples * samples // 2) // (samples * samples)).astype(np.uint8))


def write_png(picture, path):
    writer = vtkPNGWriter()
    writer.SetInputData(picture)
    writer.SetCompressionLevel(4)
    writer.SetFileName(str(path))
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
        self._writer.SetFileName(str(path))
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
        self._path = str(path)
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
        self._process.stdin.write(np.ascontiguousarray(pixels).tobytes())

    def close(self):
        self._process.stdin.close()
        if self._process.wait() != 0:
            raise OSError(f"{self._path}: ffmpeg failed")

    def discard(self):
        if self._process is not None:
            self._process.kill()
            self._process.wait()


class Loop:
    """An animated WebP picture that begins again, by Pillow: the last picture stays for a while and fades into the first. The
    best quality is taken that keeps the file within `limit` megabytes."""

    _STAY = 1600  # milliseconds
    _FADE = 8  # pictures
    _QUALITIES = (85, 75, 65, 55, 45, 35, 25, 15)
    _MOST = 2.0e9  # bytes of pictures, which are all kept until the end

    def __init__(self, path, rate, limit):
        self._path = str(path)
        self._duration = max(int(round(1000.0 / rate)), 1)
        self._limit = 1e6 * limit
        self._pictures = []

    @staticmethod
    def require(limit):
        """Raises BadInput unless a file can be that large, and WaftError where Pillow is missing."""
        if not 0.0 < limit <= 1000.0:
            raise BadInput(f"loop {limit}: expected its largest size, from 0 to 1000 megabytes")
        try:
            from PIL import features
        except ImportError:
            features = None
        if features is None or not features.check("webp_anim"):
            raise WaftError("a loop needs Pillow with WebP; on Debian: apt-get install python3-pil")

    @classmethod
    def check(cls, count, size, views):
        """Raises BadInput where the pictures of all views are too many to be kept."""
        if 3.0 * size[0] * size[1] * count * views > cls._MOST:
            raise BadInput(f"a loop of {count} frames of {size[0]}x{size[1]} in {views} views is too much to be kept: expected fewer "
                           "frames (as A:B:S), smaller ones or fewer views")

    def add(self, picture):
        from PIL import Image

        width, height, _ = picture.GetDimensions()
        pixels = vtk_to_numpy(picture.GetPointData().GetScalars()).reshape(height, width, -1)
        self._pictures.append(Image.fromarray(np.ascontiguousarray(pixels[::-1])))

    def close(self):
        from PIL import Image

        first, last = self._pictures[0], self._pictures[-1]
        fade = [Image.blend(last, first, step / (self._FADE + 1)) for step in range(1, self._FADE + 1)]
        fade = fade if len(self._pictures) > 1 else []
        durations = [self._duration] * (len(self._pictures) + len(fade))
        durations[len(self._pictures) - 1] = self._STAY
        # The qualities' sizes grow: half of those left at each try.
        low, high, best = 0, len(self._QUALITIES), None
        while low < high:
            middle = (low + high) // 2
            made = io.BytesIO()
            first.save(made, "WEBP", save_all=True, append_images=self._pictures[1:] + fade, duration=durations, loop=0,
                       quality=self._QUALITIES[middle], method=4)
            if made.tell() <= self._limit:
                best, high = made.getvalue(), middle
            else:
                low = middle + 1
        self._pictures = []
        if best is None:
            raise BadInput(f"{os.path.basename(self._path)}: does not fit into {self._limit / 1e6:g} megabytes: expected fewer frames "
                           f"(as A:B:S), smaller ones or a larger limit")
        with open(self._path, "wb") as file:
            file.write(best)

    def discard(self):
        self._pictures = []
