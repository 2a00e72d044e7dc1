# SPDX-License-Identifier: BSD-3-Clause
"""From a scene file to an animation."""
import contextlib
import dataclasses
import os
import pathlib
import tempfile
from typing import TYPE_CHECKING, Optional

from waft import failures
from waft.beneath import Folder
from waft.loading import load_plugin, set_threads
from waft.processes import is_team, share
from waft.reading import check_scene_file
from waft.results._records import REPORT, record_of
from waft.results.store import Store
from waft.results.writing import STATE, left_out, planned_objects, read_rows, result_names, result_place, settled, write_results
from waft.run._chain import WITHOUT, settings_of, shares, word_in_keys
from waft.run._constraints import constraint_report
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
    load_plugin()
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


@dataclasses.dataclass(frozen=True)
class _Course:
    """What the stages of a run go by. edit_of: the file with the air to keep."""

    request: Request
    seed: int
    edit_of: Optional[pathlib.Path]
    clock: Clock
    checkpoint: Optional[Checkpoint]


def _fly(request, scene_folder=None):
    """A scene that is a file."""
    from waft.run._flight import Flight
    from waft.run.pipeline import Pipeline
    from waft.run.result import Result

    scene, output, quality = request.scene, request.output, request.way
    check_scene_file(scene)
    set_threads(request.threads)
    with contextlib.ExitStack() as stack:
        place = result_place(output) if output is not None and is_first_rank() else None
        if place is not None:
            stack.push(place)  # entered when there is something to write: until then a stop leaves nothing
        pipeline = Pipeline(scene, request.database)
        stack.push(lambda error, *_: error and pipeline.delete())  # nobody else has a hold of its stages then
        # What a stage says once it is the caller's, of an input that he changed, is for him to read.
        stack.callback(lambda: [watch.release() for watch in pipeline.watches.values()])
        with Clock(request.time_limit, request.quiet, "stopped before the paths were planned: nothing was written",
                   request.on_progress) as clock:
            clock.shares = {name: share for name, share in shares().items() if name not in WITHOUT[quality]}
            pipeline.read(clock)
            scene_seed = pipeline.output("reader").GetFieldData().GetArray("Seed").GetValue(0)
            edit_of = _state_of(request.edit_of, quality)
            seed = request.seed if request.seed is not None else _seed_of(request.edit_of, int(scene_seed))
            key = run_key(pipeline, seed, f"{word_in_keys(quality)} {request.edit_of or ''}".strip())
            checkpoint = None
            if place is not None:
                place.look(result_names(scene, request))
                checkpoint = Checkpoint(place, key)
            resumes = request.resume and checkpoint is not None
            lack = checkpoint.lack() if resumes else ""
            warnings = []
            if request.edit_of is not None and edit_of is None:
                warnings.append(f"edit_of: {request.edit_of}: the state of that run is kept no more: flown from the start, in an air "
                                "of its own")
            if lack:
                warnings.append(f"--resume: {output}: {lack}: done from the start")
            try:
                course = _Course(request, seed, edit_of, clock, checkpoint)
                stopped_in = _run(pipeline, course, is_found=resumes and not lack)
            except failures.BadInput:
                if place is not None and place.folder is not None:
                    checkpoint.clear()
                raise
            clock.check_progress()
            stopped, hurries = clock.interrupted or clock.timed_out, clock.interrupted
        if pipeline.motion[0] == "planner":
            warnings.append("stopped before the paths of the plan were moved by air: they are the plan's")
        warnings += [text for watch in pipeline.watches.values() for text in watch.errors + watch.warnings]
        report = constraint_report(pipeline)
        flight = Flight(pipeline, report=report, warnings=warnings, stopped=stopped, hurries=hurries, stopped_in=stopped_in,
                        series=request.series, keep=tuple(request.keep), seed=seed, quality=quality, edit_of=edit_of, key=key,
                        request=request, scene_folder=scene_folder)
        if place is not None:
            clock.phase = "writing the results"
            clock.report(0.0, clock.phase)
            write_results(flight, place, checkpoint)
            if checkpoint is not None and not stopped:
                checkpoint.hand_on(Store())
                checkpoint.clear()
                _forget_files(pipeline)
        clock.report(1.0, "stopped early" if stopped else "done")
        clock.check_progress()
        clock.hand_on()
    return Result(flight, output)


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


def _run(pipeline, course, is_found):
    """Runs the stages of the quality; returns the one in which it was stopped, or an empty text. is_found: the plan of an earlier
    run is taken."""
    request, clock, checkpoint = course.request, course.clock, course.checkpoint
    optimises = "spacetime" not in WITHOUT[request.way]
    if optimises:
        _check_room(pipeline, request.settings("Spacetime"))
    if is_found:
        checkpoint.take_plan(pipeline)
    else:
        pipeline.add_planner(course.seed)
        share(pipeline.planner.GetClientSideObject())
        pipeline.watch("planner", clock)
        pipeline.update("planner")
        pipeline.plan_report = read_rows(pipeline.output("planner", 2))
        pipeline.plan_objects = planned_objects(pipeline)
    clock.keep()
    if checkpoint is not None:
        checkpoint.begin(pipeline, is_found)

    # After a stop no stage begins but the rotation: the motion so far is turned and written.
    stopped_in = "planner" if clock.should_stop() else ""
    if "assimilation" not in WITHOUT[request.way] and not clock.should_stop():
        _assimilate(pipeline, course)
        stopped_in = "assimilation" if clock.should_stop() else ""
    if optimises and not clock.should_stop():
        _optimise(pipeline, course)
        stopped_in = "spacetime" if clock.should_stop() else ""
    pipeline.add_rotation(course.seed, clock.interrupted)
    for setting, value in course.request.settings("Rotation").items():
        setattr(pipeline.rotation, setting, value)
    share(pipeline.rotation.GetClientSideObject())
    pipeline.watch("rotation", clock)
    pipeline.update("rotation", can_stop=False)  # quick, and the best so far is to be written whole
    if "fit" not in WITHOUT[request.way] and not clock.should_stop():
        _fit(pipeline, course)
    return stopped_in


def _assimilate(pipeline, course):
    pipeline.add_assimilation(course.seed)
    share(pipeline.assimilation.GetClientSideObject())
    if course.edit_of is not None:
        pipeline.assimilation.EditOf = str(course.edit_of)
    if course.checkpoint is not None:
        pipeline.assimilation.CheckpointFile = str(course.checkpoint.assimilation_file)
        pipeline.assimilation.StateFile = str(course.checkpoint.air_file)
        if course.checkpoint.air_file.is_file():  # it was done when the run was stopped
            pipeline.assimilation.EditOf = str(course.checkpoint.air_file)
    of_quality = settings_of(course.request.way, "Assimilation")
    _update("assimilation", pipeline, course, {**of_quality, **course.request.settings("Assimilation")})


def _optimise(pipeline, course):
    pipeline.add_spacetime()
    if is_team():
        pipeline.spacetime.GetClientSideObject().SetController(None)  # the others do not update it
    if course.checkpoint is not None:
        pipeline.spacetime.CheckpointFile = str(course.checkpoint.optimiser_file)
        if course.request.checkpoint_interval is not None:
            pipeline.spacetime.CheckpointInterval = course.request.checkpoint_interval
    _update("spacetime", pipeline, course, course.request.settings("Spacetime"))


def _fit(pipeline, course):
    pipeline.add_fit(course.seed)
    pipeline.watch("fit", course.clock)
    for setting, value in settings_of(course.request.way, "VortexFit").items():
        setattr(pipeline.fit, setting, value)
    pipeline.update("fit", can_stop=False)  # quick


def _update(name, pipeline, course, settings):
    """Updates a stage of some length, which takes what is left of the time."""
    stage, clock = getattr(pipeline, name), course.clock
    watch = pipeline.watch(name, clock)
    for setting, value in settings.items():
        setattr(stage, setting, value)
    left = clock.remaining()
    if left is not None:
        stage.TimeLimit = max(left, 0.001)
    pipeline.update(name)
    clock.timed_out = clock.timed_out or (left is not None and watch.seconds >= left)


def _forget_files(pipeline):
    """The stages, which live on, write no more what was the run's."""
    for stage in (pipeline.assimilation, pipeline.spacetime):
        for name in ("CheckpointFile", "StateFile"):
            if stage is not None and name in stage.ListProperties():
                setattr(stage, name, "")
                stage.UpdateVTKObjects()


def _check_room(pipeline, settings):
    """Raises BadInput when the optimiser could not take the scene, before anything is planned for it."""
    from waft.vtkWaftFilters import vtkSPHSpacetimeFilter

    optimiser = vtkSPHSpacetimeFilter()
    for name, value in settings.items():
        getattr(optimiser, f"Set{name}")(value)
    objects = pipeline.output("reader")
    frames = objects.GetFieldData().GetArray("NumberOfFrames").GetValue(0)
    volume = pipeline.reader.GetClientSideObject().GetVolumeAboveGround()
    lack = optimiser.CheckRoom(volume, frames, objects.GetNumberOfPoints())
    if lack:
        raise failures.BadInput(f"{pipeline.reader.FileName}: {lack}")
