# SPDX-License-Identifier: BSD-3-Clause
"""Pictures drawn one after the other, or by several processes side by side: the same files in the same order."""

import contextlib
import multiprocessing
import os
import signal

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkRenderingCore import vtkRenderWindow
from vtkmodules.vtkRenderingOpenGL2 import vtkTextureObject

from waft.failures import WaftError
from waft.render._output import write_png
from waft.render._scenery import image

MOST_JOBS = 64


def pictures(make_stage, wanted, jobs, with_pixels):
    """Draws and writes the pictures of `wanted`, [(view, frame, path)], and gives them in that order: images where with_pixels,
    else None, each when its file is whole. make_stage: makes what draws, once in each process. Raises WaftError where a process
    ended before its pictures were drawn; closing this generator ends all of them."""
    jobs = min(jobs, len(wanted))
    if jobs <= 1:
        stage = make_stage()
        for view, frame, path in wanted:
            yield _drawn(stage, view, frame, path)
        return
    with contextlib.ExitStack() as processes:
        ends = [processes.enter_context(_painter(make_stage, wanted[first::jobs], with_pixels)) for first in range(jobs)]
        for number in range(len(wanted)):
            pixels = _received(*ends[number % jobs])
            yield image(pixels) if with_pixels else None


def widest_window():
    """Pixels that a window may have along a side. Asked in a process of its own, since processes that draw later share no window."""
    fork = multiprocessing.get_context("fork")
    receiving, sending = fork.Pipe(duplex=False)
    process = fork.Process(target=_ask_window, args=(sending,), daemon=True)
    process.start()
    sending.close()
    try:
        return _received(process, receiving)
    finally:
        process.kill()
        process.join()
        receiving.close()


def _ask_window(sending):
    try:
        window = vtkRenderWindow()
        window.SetOffScreenRendering(1)
        window.SetSize(16, 16)
        window.Initialize()
        sending.send(vtkTextureObject.GetMaximumTextureSize(window))
    finally:
        sending.close()
        os._exit(0)


def _drawn(stage, view, frame, path):
    picture = stage.draw(view, frame)
    write_png(picture, path)
    return picture


@contextlib.contextmanager
def _painter(make_stage, wanted, with_pixels):
    """A process that draws these; (it, the end of a pipe from which its pictures come)."""
    fork = multiprocessing.get_context("fork")  # there is no window yet that two would share
    receiving, sending = fork.Pipe(duplex=False)
    process = fork.Process(target=_paint, args=(make_stage, wanted, with_pixels, sending), daemon=True)
    process.start()
    sending.close()  # so that the pipe ends with the process
    try:
        yield process, receiving
    finally:
        process.kill()
        process.join()
        receiving.close()


def _paint(make_stage, wanted, with_pixels, sending):
    for number in (signal.SIGINT, signal.SIGTERM):  # who began this is told, and ends it
        signal.signal(number, signal.SIG_IGN)
    try:
        stage = make_stage()
        for view, frame, path in wanted:
            picture = _drawn(stage, view, frame, path)
            width, height, _ = picture.GetDimensions()
            sending.send(vtk_to_numpy(picture.GetPointData().GetScalars()).reshape(height, width, -1) if with_pixels else None)
    except Exception as error:  # of any kind: it is reported where the pictures are waited for
        sending.send(error if isinstance(error, WaftError) else WaftError(f"drawing: {error}"))
    finally:
        sending.close()
        os._exit(0)  # nothing of the process that was copied is put away twice


def _received(process, receiving):
    try:
        found = receiving.recv()
    except EOFError:
        process.join()
        raise WaftError(f"a process that draws ended before its time (status {process.exitcode})") from None
    if isinstance(found, Exception):
        raise found
    return found
