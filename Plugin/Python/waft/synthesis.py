# SPDX-License-Identifier: BSD-3-Clause
"""From a scene file to an animation."""
import contextlib
import dataclasses
import os
import pathlib
import tempfile
from typing import TYPE_CHECKING

from waft import failures
from waft._qualities import WITHOUT, word_in_keys
from waft._records import REPORT, record_of
from waft.beneath import Folder
from waft.loading import load_plugin, set_threads
from waft.reading import found_json
from waft.request import Request, by_options
from waft.resuming import Checkpoint, run_key
from waft.scene import Scene
from waft.store import Store
from waft.texts import ROWS, say, warn
from waft.watching import Clock
from waft.writing import STATE, left_out, planned_objects, read_rows, result_names, result_place, settled, write_results

if TYPE_CHECKING:
    from waft.run import Run

# Parts of the time that stages take, for the share that is done.
_SHARES = {"reader": 1, "database": 1, "planner": 6, "assimilation": 45, "spacetime": 45, "rotation": 2}


@by_options(Request)
def synthesize(request: Request) -> "Run":
    """Plans, optimises and turns the objects of a scene; returns the Run with its live proxies and arrays.

    It may be called from any thread, of one run at a time; only in the main one Ctrl-C and SIGTERM stop it. The stages' data are
    read where they are made: in a session that is connected to a pvserver it is refused. The Run has, besides proxies and arrays:
    status (exit status of the command), report (the constraints, one dictionary per row), warnings. Raises BadInput on malformed
    input, and where results would take the place of files that no run wrote; nothing is written then.
    """
    load_plugin()
    _check_session()
    if not isinstance(request.scene, Scene):
        return _fly(request)
    # A file that is there as long as the Run, whose reader may ask for it again.
    folder = tempfile.TemporaryDirectory(prefix="waft-scene-")
    path = os.path.join(folder.name, "scene.waft.json")
    request.scene.save(path)
    try:
        run = _fly(dataclasses.replace(request, scene=path))
    except failures.BadInput as error:
        raise failures.BadInput(str(error).replace(path, "scene")) from error
    run.scene_folder = folder
    return run


def _fly(request):
    """A scene that is a file."""
    from waft.run import Run

    scene, output, quality = request.scene, request.output, request.way
    if not os.path.isfile(scene):
        raise failures.BadInput(f"{scene}: no such scene file")
    set_threads(request.threads)
    with contextlib.ExitStack() as stack:
        place = stack.enter_context(result_place(output)) if output is not None and is_first_rank() else None
        pipeline = Run(scene, request.database)
        stack.push(lambda error, *_: error and pipeline.delete())  # nobody else has a hold of its stages then
        # What a stage says once it is the caller's, of an input that he changed, is for him to read.
        stack.callback(lambda: [watch.release() for watch in pipeline.watches.values()])
        with Clock(request.time_limit, request.quiet, "stopped before the paths were planned: nothing was written",
                   request.on_progress) as clock:
            clock.shares = {name: share for name, share in _SHARES.items() if name not in WITHOUT[quality]}
            pipeline.read(clock)
            scene_seed = pipeline.output("reader").GetFieldData().GetArray("Seed").GetValue(0)
            pipeline.quality = quality
            pipeline.series = request.series
            pipeline.edit_of = _state_of(request.edit_of, quality)
            pipeline.keep = tuple(request.keep)
            pipeline.seed = request.seed if request.seed is not None else _seed_of(request.edit_of, int(scene_seed))
            pipeline.key = run_key(pipeline, f"{word_in_keys(quality)} {request.edit_of or ''}".strip())
            pipeline.warnings = []
            if request.edit_of is not None and pipeline.edit_of is None:
                pipeline.warnings.append(f"edit_of: {request.edit_of}: the state of that run is kept no more: flown from the start, "
                                         "in an air of its own")
            checkpoint = None
            if place is not None:
                place.check(result_names(scene, pipeline.series, quality, request.keep))
                checkpoint = Checkpoint(place, pipeline.key)
            lack = checkpoint.lack() if request.resume and checkpoint is not None else ""
            if lack:
                pipeline.warnings.append(f"--resume: {output}: {lack}: done from the start")
            try:
                _run(pipeline, clock, checkpoint, request.resume and not lack, request)
            except failures.BadInput:
                if checkpoint is not None:
                    checkpoint.clear()
                raise
            clock.check_progress()
            pipeline.stopped = clock.interrupted or clock.timed_out
            pipeline.hurries = clock.interrupted
        pipeline.report = constraint_report(pipeline)
        pipeline.warnings += [text for watch in pipeline.watches.values() for text in watch.errors + watch.warnings]
        unmet = [row for row in pipeline.report if row["Status"] != "met"]
        pipeline.status = (failures.STOPPED_EARLY if pipeline.stopped
                           else failures.NOT_ALL_MET if unmet else failures.ALL_MET)
        if place is not None:
            clock.phase = "writing the results"
            clock.tell(0.0, clock.phase)
            write_results(pipeline, place, scene, checkpoint, pipeline.series)
            if checkpoint is not None and not pipeline.stopped:
                checkpoint.hand_on(Store())
                checkpoint.clear()
        clock.tell(1.0, "stopped early" if pipeline.stopped else "done")
        clock.check_progress()
    return pipeline


def _check_session():
    from paraview import servermanager

    connection = servermanager.ActiveConnection
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


def tell(run, folder):
    """What came out, on stderr: warnings, constraints that are not met, and a line of figures."""
    for warning in run.warnings:
        warn(warning)
    for row in run.report:
        if row["Status"] != "met":
            say(f"waft: row {row['Row']} target {row['Target']} (object {row['ObjectId']}, frame {row['Frame']}, "
                f"{row['Kind']}): {row['Status']}: {row['Message']}")
    met = sum(row["Status"] == "met" for row in run.report)
    if met < len(run.report):
        say(f"waft: {ROWS}")
    if left_out(run):
        say(f"waft: stopped: without {', '.join(left_out(run))}; --resume goes on and writes all")
    seconds = ", ".join(f"{name} {watch.seconds:.1f} s" for name, watch in run.watches.items())
    say(f"{folder}: {met} of {len(run.report)} constraints met ({seconds})")


def is_first_rank():
    """Whether this is the only process, or the one of several MPI processes that has the outputs."""
    from vtkmodules.vtkParallelCore import vtkMultiProcessController

    controller = vtkMultiProcessController.GetGlobalController()
    return controller is None or controller.GetLocalProcessId() == 0


def _run(pipeline, clock, checkpoint, is_found, request):
    optimises = "spacetime" not in WITHOUT[pipeline.quality]
    if optimises:
        _check_room(pipeline, request.settings("Spacetime"))
    if is_found:
        checkpoint.take_plan(pipeline)
    else:
        pipeline.add_planner(pipeline.seed)
        pipeline.watch("planner", clock)
        pipeline.update("planner")
        pipeline.plan_report = read_rows(pipeline.output("planner", 2))
        pipeline.plan_objects = planned_objects(pipeline)
    clock.keep()
    if checkpoint is not None and not is_found:
        checkpoint.keep_plan(pipeline)

    # After a stop no stage begins but the rotation: the motion so far is turned and written.
    pipeline.stopped_in = "planner" if clock.should_stop() else ""
    if "assimilation" not in WITHOUT[pipeline.quality] and not clock.should_stop():
        _assimilate(pipeline, clock, checkpoint, request.settings("Assimilation"))
        pipeline.stopped_in = "assimilation" if clock.should_stop() else ""
    if optimises and not clock.should_stop():
        _optimise(pipeline, clock, checkpoint, request.settings("Spacetime"), request.checkpoint_interval)
        pipeline.stopped_in = "spacetime" if clock.should_stop() else ""
    if pipeline.motion[0] == "planner":
        pipeline.warnings.append("stopped before the paths of the plan were moved by air: they are the plan's")
    pipeline.add_rotation(pipeline.seed, clock.interrupted)
    pipeline.watch("rotation", clock)
    pipeline.update("rotation", can_stop=False)  # quick, and the best so far is to be written whole


def _assimilate(pipeline, clock, checkpoint, settings):
    from waft.pipeline import settings_of

    pipeline.add_assimilation(pipeline.seed)
    if pipeline.edit_of is not None:
        pipeline.assimilation.EditOf = str(pipeline.edit_of)
    if checkpoint is not None:
        pipeline.assimilation.CheckpointFile = str(checkpoint.assimilation_file)
        pipeline.assimilation.StateFile = str(checkpoint.air_file)
        if checkpoint.air_file.is_file():  # it was done when the run was stopped
            pipeline.assimilation.EditOf = str(checkpoint.air_file)
    watch = pipeline.watch("assimilation", clock)
    for name, value in {**settings_of(pipeline.quality, "Assimilation"), **settings}.items():
        setattr(pipeline.assimilation, name, value)
    left = clock.remaining()
    if left is not None:
        pipeline.assimilation.TimeLimit = max(left, 0.001)
    pipeline.update("assimilation")
    clock.timed_out = clock.timed_out or (left is not None and watch.seconds >= left)


def _optimise(pipeline, clock, checkpoint, settings, checkpoint_interval):
    pipeline.add_spacetime()
    watch = pipeline.watch("spacetime", clock)
    for name, value in settings.items():
        setattr(pipeline.spacetime, name, value)
    if checkpoint is not None:
        pipeline.spacetime.CheckpointFile = str(checkpoint.optimiser_file)
        if checkpoint_interval is not None:
            pipeline.spacetime.CheckpointInterval = checkpoint_interval
    left = clock.remaining()
    if left is not None:
        pipeline.spacetime.TimeLimit = max(left, 0.001)
    pipeline.update("spacetime")
    clock.timed_out = clock.timed_out or (left is not None and watch.seconds >= left)


def _check_room(pipeline, settings):
    """Raises BadInput when the optimiser could not take the scene, before anything is planned for it."""
    from waft.vtkWaftFilters import vtkSPHSpacetimeFilter

    optimiser = vtkSPHSpacetimeFilter()
    for name, value in settings.items():
        getattr(optimiser, f"Set{name}")(value)
    objects = pipeline.output("reader")
    fields = objects.GetFieldData()
    bounds = [fields.GetArray("Bounds").GetValue(i) for i in range(6)]
    scene = found_json(pipeline.reader.FileName) or {}
    ground = scene.get("ground", {})
    if ground.get("enabled", True):
        bounds[4] = max(bounds[4], ground.get("height", bounds[4]))
    lack = optimiser.CheckRoom(bounds, fields.GetArray("NumberOfFrames").GetValue(0), objects.GetNumberOfPoints())
    if lack:
        raise failures.BadInput(f"{pipeline.reader.FileName}: {lack}")


def constraint_report(pipeline):
    """The report of the stage that moves the objects, with the reasons of the planner and the orientation rows as they were turned."""
    report = pipeline.moved_report()
    turned = {(row["Row"], row["Target"]): row for row in read_rows(pipeline.output("rotation", 2))}
    reasons = {(row["Row"], row["Target"]): row["Message"] for row in pipeline.plan_report if row["Status"] != "met"}
    for row in report:
        reason = reasons.get((row["Row"], row["Target"]))
        if reason is not None:  # the plan's, with how near the result comes
            row["Message"] = "; ".join(_sentences(reason, False) + _sentences(row["Message"], True))
        measured = turned.get((row["Row"], row["Target"]))
        if measured is not None and row["Kind"] == "orientation" and row["Status"] == "met":
            row.update((name, measured[name]) for name in ("Residual", "Status", "Message"))
    _add_rests(pipeline, report)
    return report


def _add_rests(pipeline, report):
    """The frames from and until which each rest is kept; -1 of other rows, and where no stage tells."""
    names = ("TouchDown", "LiftOff")
    frames = {}
    if pipeline.assimilation is not None:
        rows = pipeline.output("assimilation", 3).GetPointData()
        columns = [rows.GetArray(name) for name in ("Row", "Target", *names)]
        for i in range(columns[0].GetNumberOfTuples()):
            row, target, *found = (column.GetValue(i) for column in columns)
            frames[row, target] = found
    for line in report:
        found = frames.get((int(line["Row"]), int(line["Target"])), (-1, -1))
        line.update(zip(names, map(str, found)))


def _sentences(message, are_approaches):
    return [text for text in message.split("; ") if text.startswith("it comes within ") == are_approaches]
