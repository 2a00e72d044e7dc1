# SPDX-License-Identifier: BSD-3-Clause
"""From a scene file to an animation."""
import contextlib
import dataclasses
import os
import pathlib
import sys
import tempfile
from typing import TYPE_CHECKING

from waft import failures
from waft.beneath import Folder
from waft.loading import load, set_threads
from waft.reading import check_scene_file
from waft.results._records import REPORT, record_of
from waft.results.store import Store
from waft.results.writing import STATE, left_out, result_names, result_place, settled, write_results
from waft.run._chain import word_in_keys
from waft.run.request import Request, by_options
from waft.run.resuming import Checkpoint, run_key
from waft.scene import Scene
from waft.texts import ROWS, say, warn
from waft.watching import Clock

if TYPE_CHECKING:
    from waft.run.result import Result


@by_options(Request)
def synthesize(request: Request) -> "Result":
    """Plans, optimises and turns the objects of a scene; returns the Result, with live proxies and arrays.

    It may be called from any thread, of one run at a time; only in the main one Ctrl-C and SIGTERM stop it: the best so far is written,
    then KeyboardInterrupt (SystemExit) goes on, unless the caller has set handlers of his own, which are called instead. The
    stages' data are read where they are made: in a session that is connected to a pvserver it is refused. The Result has, besides those:
    status (exit status of the command), report (the constraints, one dictionary per row), warnings. Raises BadInput on malformed
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
    except failures.BadInput as error:
        raise failures.BadInput(str(error).replace(path, "scene")) from error


def _fly(request, scene_folder=None):
    """A scene that is a file."""
    from waft.run._flight import Flight
    from waft.run.engine import Engine
    from waft.run.result import Result

    scene, output, quality = request.scene, request.output, request.way
    check_scene_file(scene)
    set_threads(request.threads)
    with contextlib.ExitStack() as stack:
        place = result_place(output) if output is not None and is_first_rank() else None
        if place is not None:
            stack.push(place)  # entered when there is something to write: until then a stop leaves nothing
        engine = Engine(scene, quality, request.database)
        stack.push(lambda error, *_: error and engine.delete())  # nobody else has a hold of its source then
        with Clock(request.time_limit, request.quiet, "stopped before the paths were planned: nothing was written",
                   request.on_progress) as clock:
            engine.read(clock)
            edit_of = _state_of(request.edit_of, quality)
            seed = request.seed if request.seed is not None else _seed_of(request.edit_of, engine.seed)
            engine.algorithm.SetSeed(seed)
            engine.set_options(request.settings())
            key = run_key(engine, seed, f"{word_in_keys(quality)} {request.edit_of or ''}".strip())
            checkpoint = None
            if place is not None:
                place.look(result_names(scene, request))
                checkpoint = Checkpoint(place, key)
                engine.algorithm.SetCheckpointFolder(str(checkpoint.folder))
            resumes = request.resume and checkpoint is not None
            lack = checkpoint.lack() if resumes else ""
            is_found = resumes and not lack
            if request.edit_of is not None and edit_of is None:
                engine.warnings.append(f"edit_of: {request.edit_of}: the state of that run is kept no more: flown from the start, in an air "
                                       "of its own")
            if lack:
                engine.warnings.append(f"--resume: {output}: {lack}: done from the start")
            if is_found:
                checkpoint.take_plan(engine)
            air = checkpoint.air_file if is_found and checkpoint.air_file.is_file() else edit_of  # it was done when the run was stopped
            engine.algorithm.SetEditOf(str(air or ""))

            def planned():
                clock.keep()
                if checkpoint is not None:
                    checkpoint.begin(engine, is_found)
            try:
                engine.fly(clock, planned)
            except failures.BadInput:
                if place is not None and place.folder is not None:
                    checkpoint.clear()
                raise
            clock.check_progress()
            stopped, hurries = clock.interrupted or clock.timed_out, clock.interrupted
        if engine.moved_by == "planner":
            engine.warnings.append("stopped before the paths of the plan were moved by air: they are the plan's")
        flight = Flight(engine, stopped=stopped, hurries=hurries, series=request.series, keep=tuple(request.keep), seed=seed, quality=quality,
                        edit_of=edit_of, key=key, request=request, scene_folder=scene_folder)
        if place is not None:
            clock.phase = "writing the results"
            clock.report(0.0, clock.phase)
            write_results(flight, place, checkpoint.planned_file, checkpoint.air_file)
            if not stopped:
                checkpoint.hand_on(Store())
                checkpoint.clear()
                engine.algorithm.SetCheckpointFolder("")  # the source, which lives on, writes no more what was the run's
        clock.report(1.0, "stopped early" if stopped else "done")
        clock.check_progress()
        clock.hand_on()
    return Result(flight, output)


def _check_session():
    servermanager = sys.modules.get("paraview.servermanager")
    connection = servermanager.ActiveConnection if servermanager is not None else None
    if connection is not None and connection.IsRemote():
        raise failures.WaftError(
            f"waft.synthesize reads the data of the stages in this process, and those of this session are on {connection.GetURI()}: "
            "Disconnect() first, run `waft synthesize` on that machine, or join the proxies by hand, which work there")


def _state_of(folder, quality):
    """The file with the air of a finished run; None without a folder, and where it is kept no more."""
    if folder is None:
        return None
    if quality == "paper":
        raise failures.BadInput("edit_of: a run of quality paper has no air to keep")
    place = settled(folder)
    state, report = place.found(STATE), record_of(place, "report.json", REPORT)
    if state is None and (report is None or report.get("quality") == "paper"):
        raise failures.BadInput(f"{pathlib.Path(folder) / STATE}: no such file; expected the folder of a finished run, of another quality "
                                "than paper")
    return pathlib.Path(state) if state is not None else Store().found(report.get("key"))


def _seed_of(folder, otherwise):
    """That of a run that is edited; otherwise, where there is none, another."""
    report = record_of(Folder(folder), "report.json", REPORT) if folder is not None else None
    return int(report["seed"]) if report is not None else otherwise


def report_run(run, folder):
    """What came out, on stderr: warnings, constraints that are not met, and a line of figures."""
    for warning in run.warnings:
        warn(warning)
    for row in run.report:
        if row["Status"] != "met":
            say(f"waft: row {row['Row']} target {row['Target']} (object {row['ObjectId']}, frame {row['Frame']}, "
                f"{row['Kind']}): {row['Status']}: {row['Message']}", "warning")
    met = sum(row["Status"] == "met" for row in run.report)
    if met < len(run.report):
        say(f"waft: {ROWS}", "warning")
    if left_out(run):
        say(f"waft: stopped: without {', '.join(left_out(run))}; --resume goes on and writes all")
    seconds = ", ".join(f"{name} {watch.seconds:.1f} s" for name, watch in run.watches.items())
    say(f"{folder}: {met} of {len(run.report)} constraints met ({seconds})")


def is_first_rank():
    """Whether this is the only process, or the one of several MPI processes that has the outputs."""
    from vtkmodules.vtkParallelCore import vtkMultiProcessController

    controller = vtkMultiProcessController.GetGlobalController()
    return controller is None or controller.GetLocalProcessId() == 0
