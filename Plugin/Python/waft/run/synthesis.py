# SPDX-License-Identifier: BSD-3-Clause
"""From a scene file to an animation."""
import contextlib
import dataclasses
import os
import sys
import tempfile
from typing import TYPE_CHECKING

from waft import failures
from waft.loading import load, set_threads
from waft.reading import check_scene_file
from waft.run.request import Request, by_options
from waft.scene import Scene
from waft.watching import Clock

if TYPE_CHECKING:
    from waft.run.result import Result


@by_options(Request)
def synthesize(request: Request) -> "Result":
    """Plans, optimises and turns the objects of a scene; returns the Result, with live proxies and arrays.

    It may be called from any thread, of one run at a time; only in the main one Ctrl-C and SIGTERM stop it: the best so far is written,
    then KeyboardInterrupt (SystemExit) goes on, unless the caller has set handlers of his own, which are called instead. The
    stages' data are read where they are made: in a session that is connected to a pvserver it is refused. The Result has, besides those:
    status (exit status of the command), report (the constraints, one dictionary per row), warnings. Raises InputError on malformed
    input, and where results would take the place of files that no run wrote; nothing is written then.
    """
    load()
    _check_session()
    if not isinstance(request.scene, Scene):
        return _fly(request)
    # A file that is there as long as the Result, whose reader may ask for it again.
    folder = tempfile.TemporaryDirectory(prefix="waft-scene-")
    path = os.path.join(folder.name, "scene.waft.json")
    request.scene.save(path)
    try:
        return _fly(dataclasses.replace(request, scene=path), folder)
    except failures.InputError as error:
        raise failures.InputError(str(error).replace(path, "scene")) from error


def _fly(request, scene_folder=None):
    """A scene that is a file."""
    from waft.run._flight import Flight
    from waft.run.engine import Engine
    from waft.run.result import Result

    check_scene_file(request.scene)
    set_threads(request.threads)
    engine = Engine(request.scene, request.way, request.database)
    with contextlib.ExitStack() as stack:
        stack.push(lambda error, *_: error and engine.delete())  # nobody else has a hold of its source then
        with Clock(request.time_limit, request.quiet, "stopped before the paths were planned: nothing was written",
                   request.on_progress) as clock:
            engine.read(clock)
            engine.algorithm.SetSeed(-1 if request.seed is None else request.seed)
            engine.set_options(request.settings())
            engine.ask(request, is_first_rank())
            engine.fly(clock)
            flight = Flight(engine, request, scene_folder)
            clock.report(1.0, "stopped early" if flight.stopped else "done")
            clock.check_progress()
            clock.hand_on()
    return Result(flight, request.output)


def _check_session():
    servermanager = sys.modules.get("paraview.servermanager")
    connection = servermanager.ActiveConnection if servermanager is not None else None
    if connection is not None and connection.IsRemote():
        raise failures.WaftError(
            f"waft.synthesize reads the data of the stages in this process, and those of this session are on {connection.GetURI()}: "
            "Disconnect() first, run `waft synthesize` on that machine, or join the proxies by hand, which work there")


def is_first_rank():
    """Whether this is the only process, or the one of several MPI processes that has the outputs."""
    from vtkmodules.vtkParallelCore import vtkMultiProcessController

    controller = vtkMultiProcessController.GetGlobalController()
    return controller is None or controller.GetLocalProcessId() == 0
