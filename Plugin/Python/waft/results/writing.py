# SPDX-License-Identifier: BSD-3-Clause
"""The files of a run: their names, and what is in each."""
import functools
import math
import os
import pathlib

from waft import failures
from waft.beneath import Folder
from waft.files import XmlSeries, copy_file, half, in_steps, table_rows, write_csv, write_pvd, write_rounded, write_xml
from waft.loading import version
from waft.reading import dynamics, found_json
from waft.results.place import ResultPlace
from waft.results.store import Store
from waft.run._chain import WITHOUT
from waft.texts import is_utf8
from waft.watching import Effort, collect

STATUS_ORDER = ("met", "infeasible", "conflict", "unreachable")
REPORT = "report.json"
PLAN = {0: "planned.vtp", 3: "constraints.vtp", 4: "vortices.vtp"}  # what is kept of a plan, by the planner's ports
STATE = "assimilated.state"
FITTED = "fitted_vortices.vtp"
POSES = "poses.csv"
# Data that is written only when it is asked for, a file a frame: {name: (stage, port)}.
SERIES = {"meshes": ("rotation", 0), "particles": ("spacetime", 1)}
# The air's series, with the array of each: a series has the same arrays at all of its times.
AIR = {"air": "Velocity", "air_wind": "Wind"}

# Of the air's images: between two of them it is as good as straight (1 % off), at any frame rate [s].
AGREEING = (15.0, 45.0)  # degrees: median and 90th percentile of half a second of turning in the air
AIR_INTERVAL = 0.1
# Binary digits below the typical value that replay can tell from more: figures of `waft measure` change by some per cent.
AIR_DIGITS = 4
WIND_STEPS = 10  # steps of the air from one at which the wind correction's force is written to the next
# What reads back bit for bit beside points: what else poses.csv says but velocities, which follow from points, and time.
_EXACT = ("Time", "Orientation", "AngularVelocity")


def result_place(folder):
    """The ResultPlace of a folder of results."""
    return ResultPlace(folder, REPORT)


def settled(folder):
    """The Folder of finished results, to be read: where a change of them was cut short it is finished first."""
    if not os.path.isdir(folder):
        raise failures.BadInput(f"{folder}: no such folder; `waft synthesize` makes it")
    result_place(folder).settle()
    return Folder(folder)


def result_names(scene, request):
    """What a run that was asked for by a Request writes of a scene file, folders with a slash at their end."""
    names = ["planned.vtp", "optimized.vtp", "poses.vtp", *_tables_of_poses(request), "vortices.vtp", "objects.vtp", "shapes.vtm",
             "shapes/", "constraints.vtp", "constraints.csv", "convergence.csv", "animation.glb", REPORT]
    if "spacetime" not in WITHOUT[request.way]:
        names += ["wind.pvd", "wind/"]
    if "assimilation" not in WITHOUT[request.way]:
        names += ["assimilated.vtp", *(name + end for name in AIR for end in (".pvd", "/")), "rounds.csv", *([STATE] if "state" in request.keep else [])]
    if "fit" not in WITHOUT[request.way]:
        names.append(FITTED)
    names += ["obstacles.pvd", "obstacles/"] if _do_obstacles_move(scene) else ["obstacles.vtp"]
    return names + [name + end for name in request.series for end in (".pvd", "/")]


def _tables_of_poses(request):
    return [POSES] if request.csv else []


def is_beyond_results(name):
    """Whether a file of a run is one that the motion does without: a series of fields, of particles or of meshes, a state."""
    return name.partition("/")[0].removesuffix(".pvd") in (*AIR, "wind", *SERIES, STATE)


def _do_obstacles_move(scene):
    """Whether an obstacle of a scene file (one that was read well) is ever at another place."""
    return any(len({tuple(step["position"]) for step in obstacle.get("motion", ())}) > 1
               for obstacle in (found_json(scene) or {}).get("obstacles", ()))


def read_rows(table):
    """A table as one dictionary a row, all texts."""
    header, rows = table_rows(table)
    return [dict(zip(header, row)) for row in rows]


def write_results(run, place, checkpoint, is_shown_alone=False):
    """Every file of a Flight, all at once: see the user guide for what each holds. checkpoint: has the plan. is_shown_alone: those that a
    page is made of alone."""
    efforts = {"stages": {name: watch.as_json() for name, watch in run.watches.items()}}  # before they serve what is written
    writing = Effort().begin()
    checkpoint.copy_plan("planned.vtp")
    write_bodies(run, place)
    progress = _write_convergence(run, place)
    rows = _posed_rows(run)
    write_xml(rows, place.path("constraints.vtp"))
    if run.assimilation is not None:
        write_csv(place.path("rounds.csv"), *table_rows(run.output("assimilation", 5)))
    if run.fit is not None:
        write_xml(run.output("fit"), place.path(FITTED))
    _write_report(run, place.path("constraints.csv"))
    _write_animation(run, rows, place)
    if not is_shown_alone:
        _write_fields(run, place, checkpoint)
    efforts["writing"] = writing.end().as_json()
    place.commit(_summary(run, progress, efforts))


def save_results(run, folder, is_shown_alone=False):
    """The files of a Flight that is over in a folder."""
    if not is_utf8(folder):
        raise failures.BadInput(f"{os.fsdecode(folder)}: expected a name in UTF-8, as ParaView takes no other")
    with result_place(folder) as place:
        place.check(result_names(run.scene_file, run.request))
        run.pipeline.rewind()
        write_results(run, place, _Kept(run, place), is_shown_alone)


class _Kept:
    """In place of the checkpoint of a run: its plan, and the state of its air where the store has it."""

    def __init__(self, run, place):
        self._run, self._place = run, place
        self.air_file = Store().found(run.key) or pathlib.Path(os.devnull)

    def copy_plan(self, name):
        port = next(port for port, own in PLAN.items() if own == name)
        write_xml(self._run.planned(port), self._place.path(name))


def _write_fields(run, place, checkpoint):
    """The motion by itself, and what moves it."""
    _, tracks, vortices, _ = run.motion
    write_tracks(run.moved(tracks), place.path("optimized.vtp"))
    write_xml(run.moved(vortices), place.path("vortices.vtp"))
    for name in run.series if not run.hurries else ():
        _write_series(run, *SERIES[name], name, ".vtp", place)
    if run.motion[0] == "spacetime" and not run.hurries:
        _write_series(run, "spacetime", 3, "wind", ".vti", place)
    if run.assimilation is not None:
        _write_air(run, place, checkpoint)


def _write_convergence(run, place):
    """convergence.csv; returns its first and its last row, nothing where no optimiser was at work."""
    if run.motion[0] != "spacetime":
        write_csv(place.path("convergence.csv"), *table_rows(_empty_convergence()))
        return []
    header, rows = table_rows(run.output("spacetime", 4))
    write_csv(place.path("convergence.csv"), header, rows)
    return [dict(zip(header, row)) for row in (rows[0], rows[-1])]


def write_bodies(pipeline, place):
    """The files with the motion of the bodies and what stands about them, which pictures are drawn from."""
    write_tracks(pipeline.output("rotation", 1), place.path("poses.vtp"))
    write_xml(pipeline.output("reader", 0), place.path("objects.vtp"))
    _write_shapes(pipeline, place)
    if _do_obstacles_move(pipeline.scene_file):
        _write_series(pipeline, "reader", 2, "obstacles", ".vtp", place)
    else:
        write_xml(_at(pipeline.reader.GetClientSideObject(), 2, 0.0), place.path("obstacles.vtp"))


def write_tracks(tracks, path):
    """Tracks or poses as a file: what drives the bodies to 7 digits, the motion itself to all."""
    write_rounded(tracks, path, _EXACT)


def _empty_convergence():
    """The optimiser's table of a run that does without it."""
    from vtkmodules.vtkCommonDataModel import vtkTable
    from waft.vtkWaftFilters import vtkSPHSpacetimeFilter

    table = vtkTable()
    vtkSPHSpacetimeFilter.EmptyConvergence(table)
    return table


def _write_air(run, place, checkpoint):
    """The assimilation's motion and air."""
    if run.spacetime is None:
        copy_file(place.path("optimized.vtp"), place.path("assimilated.vtp"))
    else:
        write_tracks(run.output("assimilation", 0), place.path("assimilated.vtp"))
    if run.has_air and not run.hurries:
        if "air" in run.keep:
            _write_air_series(run, place, half, 0.0, 1)
        else:  # so small that it is kept
            _write_air_series(run, place, functools.partial(in_steps, digits=AIR_DIGITS), AIR_INTERVAL, WIND_STEPS)
        if "state" in run.keep and checkpoint.air_file.is_file():
            copy_file(checkpoint.air_file, place.path(STATE))


def _write_air_series(run, place, rounded, interval, wind_steps):
    """The series of AIR, rounded, at times as `spaced` has them of the interval; of the wind's force each wind_steps-th of these."""
    algorithm = run.assimilation.GetClientSideObject()
    entries = {name: [] for name in AIR}
    with XmlSeries(packs_well=True) as files:
        for number, (step, time) in enumerate(spaced(_times(algorithm, 1), interval)):
            data = _at(algorithm, 1, time)
            rounded(data)
            for name, array in AIR.items():
                values = data.GetPointData().GetArray(array)
                if values is None or (name != "air" and number % wind_steps != 0):
                    continue
                image = data.NewInstance()
                image.CopyStructure(data)
                image.GetFieldData().DeepCopy(data.GetFieldData())  # two are written at once, and each notes ranges in its arrays
                image.GetPointData().AddArray(values)
                entries[name].append((time, f"{name}/{name}_{step:04d}.vti"))
                files.write(image, place.path(entries[name][-1][1]))
    for name, own in entries.items():
        if own:
            write_pvd(place.path(name + ".pvd"), own)


def _write_shapes(pipeline, place):
    """shapes.vtm and its folder with the surfaces, and with copies of the pictures on them, whose `Texture` is relative to
    the results: they can be drawn from anywhere, and on another machine."""
    shapes = pipeline.output("reader", 3).NewInstance()
    shapes.DeepCopy(pipeline.output("reader", 3))
    pictures = {}
    for block in range(shapes.GetNumberOfBlocks()):
        texture = shapes.GetBlock(block).GetFieldData().GetAbstractArray("Texture")
        source = pathlib.Path(texture.GetValue(0)) if texture is not None and texture.GetValue(0) else None
        if source is not None:  # of one that is missing the scene's reader has warned
            name = f"shapes/picture_{len(pictures)}{source.suffix}"
            texture.SetValue(0, pictures.setdefault(source, name) if source.is_file() else "")
    write_xml(shapes, place.path("shapes.vtm"))
    for source, name in pictures.items():
        copy_file(source, place.path(name))


def _write_series(pipeline, stage, port, name, suffix, place):
    """NAME.pvd with one file a step in the folder NAME."""
    algorithm = getattr(pipeline, stage).GetClientSideObject()
    entries = []
    with XmlSeries() as files:
        for step, time in enumerate(_times(algorithm, port)):
            entries.append((time, f"{name}/{name}_{step:04d}{suffix}"))
            files.write(_at(algorithm, port, time), place.path(entries[-1][1]))
    write_pvd(place.path(name + ".pvd"), entries)


def _times(algorithm, port):
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Sddp

    return algorithm.GetOutputInformation(port).Get(Sddp.TIME_STEPS()) or (0.0,)


def spaced(times, interval):
    """(number, time) of the first of the times, of those that keep at most the interval from the one before, and of the last:
    as few as that takes."""
    steps = list(enumerate(times))
    chosen = steps[:1]
    for here, after in zip(steps[1:], steps[2:] + [None]):
        if after is None or after[1] - chosen[-1][1] > interval * (1.0 + 1e-9):
            chosen.append(here)
    return chosen


def _at(algorithm, port, time):
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Sddp

    algorithm.GetOutputInformation(port).Set(Sddp.UPDATE_TIME_STEP(), time)
    algorithm.Update(port)
    copy = algorithm.GetOutputDataObject(port).NewInstance()
    copy.DeepCopy(algorithm.GetOutputDataObject(port))
    return copy


def _posed_rows(run):
    """The constraints, with when their rests touched and were still as the bodies were turned."""
    rows = run.pipeline.planned(3) if run.assimilation is None else run.output("assimilation", 3)
    begun = {(int(line["Row"]), int(line["Target"])): line for line in run.report if line["Settled"] != "-1"}
    posed = rows.NewInstance()
    posed.DeepCopy(rows)
    number, target, *times = (posed.GetPointData().GetArray(name) for name in ("Row", "Target", "TouchDown", "Settled"))
    for i in range(posed.GetNumberOfPoints()):
        line = begun.get((number.GetValue(i), target.GetValue(i)))
        if line is not None:
            for name, column in zip(("TouchDown", "Settled"), times):
                column.SetValue(i, int(line[name]))
    return posed


def _write_report(run, path):
    header = ["Row", "Target", "ObjectId", "Frame", "Kind", "Residual", "Status", "Message", "TouchDown", "Settled", "LiftOff"]
    write_csv(path, header, [[row[name] for name in header] for row in run.report])


def _write_animation(run, rows, place):
    from waft.vtkWaftFilters import vtkMotionAnimationWriter

    writer = vtkMotionAnimationWriter()
    errors = []
    collect(writer, "ErrorEvent", errors)
    collect(writer, "WarningEvent", run.warnings)
    writer.SetInputDataObject(0, run.output("rotation", 1))
    writer.SetInputDataObject(1, run.output("reader", 0))
    writer.SetInputDataObject(2, run.output("reader", 3))
    writer.SetInputDataObject(3, rows)
    for name in ("animation.glb", *_tables_of_poses(run.request)):
        writer.SetFileName(str(place.path(name)))
        if not writer.Write():
            raise failures.WaftError(f"{name}: could not be written: {'; '.join(errors)}")


def planned_objects(pipeline):
    """What planning came to, one dictionary an object."""
    kinds = {"ObjectId": int, "Rows": int, "Met": int, "Status": str, "Cost": float, "Branches": int,
             "Seconds": float, "Message": str}
    return [{name[0].lower() + name[1:]: kind(row[name]) for name, kind in kinds.items()}
            for row in read_rows(pipeline.output("planner", 7))]


def _settled(pipeline):
    """How many bodies are laid on surfaces away from their paths, and by how much at most [m]."""
    shifts = pipeline.output("rotation", 1).GetCellData().GetArray("Shift")
    shifts = [shifts.GetValue(i) for i in range(shifts.GetNumberOfTuples())] if shifts is not None else []
    return {"objects": sum(shift > 0.0 for shift in shifts), "largestShift": max(shifts, default=0.0)}


def _agreement(pipeline):
    """How far half a second of turning in the air leads away from the poses [degrees]: of all bodies, and of whom by more than is
    wanted."""
    poses = pipeline.output("rotation", 1)
    lines, together = (data.GetArray("Agreement") for data in (poses.GetCellData(), poses.GetFieldData()))
    if lines is None:
        return {}
    objects, (middle, high) = poses.GetCellData().GetArray("ObjectId"), AGREEING
    beyond = [objects.GetValue(i) for i in range(lines.GetNumberOfTuples()) if lines.GetComponent(i, 0) > middle
              or lines.GetComponent(i, 1) > high]
    return {"median": together.GetComponent(0, 0), "ninetieth": together.GetComponent(0, 1), "beyond": beyond}


def _free(pipeline):
    """Bodies that came down and lie though no row asks for it: rests of no row."""
    if pipeline.assimilation is None:
        return []
    rows = pipeline.output("assimilation", 3).GetPointData()
    objects, targets, frames = (rows.GetArray(name) for name in ("ObjectId", "Target", "TouchDown"))
    found = [i for i in range(targets.GetNumberOfTuples() if targets is not None else 0) if targets.GetValue(i) < 0]
    return [{"object": objects.GetValue(i), "touchDown": frames.GetValue(i)} for i in found]


def _dynamics(pipeline):
    if pipeline.spacetime is None:
        return {}
    return {name[0].lower() + name[1:]: value for name, value in dynamics(pipeline.output("spacetime", 0)).items()}


def _fit(pipeline):
    """How many vortices were fitted to the air about the paths, and what part of its accelerations they explain: of all objects, and
    of every fifth by a fit that did not see it (None of fewer than five)."""
    if pipeline.fit is None:
        return {}
    vortices = pipeline.output("fit")
    explained, left_out = (vortices.GetFieldData().GetArray(name) for name in ("Explained", "ExplainedLeftOut"))
    return {"vortices": vortices.GetNumberOfCells(), "explained": explained.GetValue(0) if explained is not None else 0.0,
            "explainedLeftOut": left_out.GetValue(0) if left_out is not None else None}


def _time(pipeline):
    fields = pipeline.output("reader").GetFieldData()
    return {"frames": int(fields.GetArray("NumberOfFrames").GetValue(0)),
            "framesPerSecond": float(fields.GetArray("FramesPerSecond").GetValue(0))}


def _forces(pipeline, progress):
    """What moved the objects, of an optimiser that stirs its own air: of each force its share and its squares over those of the
    motion, of vortices besides what they explain that wind alone would not (SPHSpacetimeFilter); nothing in a sampled air."""
    told = pipeline.output("spacetime", 0).GetFieldData() if pipeline.spacetime is not None else None
    squares, part = (told and told.GetArray(name) for name in ("ForceSquares", "VorticesPart"))
    if not squares:
        return {}
    forces = {name.lower(): {"share": float(progress[-1][f"Share{name}"]), "square": squares.GetValue(number)}
              for number, name in enumerate(("Vortices", "Wind", "Gas", "Drag", "Landing", "None"))}
    if part:
        forces["vortices"]["part"] = part.GetValue(0)
    return forces


def _explained(pipeline):
    """What the fields explain of the bodies that they are solved for and of one in five that are left out of the solve (None of no
    bodies), of an optimiser that stirs its own air."""
    told = pipeline.output("spacetime", 0).GetFieldData() if pipeline.spacetime is not None else None
    array = told and told.GetArray("FieldsExplained")
    values = [None if math.isnan(array.GetValue(n)) else array.GetValue(n) for n in range(6)] if array else []
    return {kind: dict(zip(("solved", "leftOut"), values[at:at + 2])) for kind, at in (("all", 0), ("objects", 2), ("gas", 4)) if values}


def _summary(run, progress, efforts):
    counts = {status: 0 for status in STATUS_ORDER}
    for row in run.report:
        counts[row["Status"]] += 1
    return {
        "version": version(),
        "scene": pathlib.Path(run.scene_file).name,
        "title": str((found_json(run.scene_file) or {}).get("title", "")),
        "seed": run.seed,
        "key": run.key,
        **efforts,
        "quality": run.quality,
        "defaults": dict(run.request._defaults),
        "time": _time(run),
        "energy": {when: float(row["E"]) for when, row in zip(("before", "after"), progress)},
        "dynamics": _dynamics(run),
        "forces": _forces(run, progress),
        "fieldsExplained": _explained(run),
        "fit": _fit(run),
        "constraints": {**counts, "unmet": [row for row in run.report if row["Status"] != "met"]},
        "objects": run.plan_objects,
        "settled": _settled(run),
        "agreement": _agreement(run),
        "free": _free(run),
        "without": [] if run.request.csv else [POSES],
        "stoppedEarly": run.stopped,
        **({"stopped": {"in": run.stopped_in, "motion": run.motion[0], "leftOut": left_out(run)}}
           if run.stopped else {}),
        "warnings": run.warnings,
    }


def left_out(run):
    """The series of a run that somebody stopped and waits for: the fields, which take longer to write than all else. They are
    made by --resume."""
    if not run.hurries:
        return []
    names = [f"{name}.pvd" for name in AIR] if run.has_air else []
    return names + (["wind.pvd"] if run.spacetime is not None else []) + [f"{name}.pvd" for name in run.series]
