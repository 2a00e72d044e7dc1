# SPDX-License-Identifier: BSD-3-Clause
"""The files of a run: their names, and what is in each."""
import os
import pathlib

from waft import failures
from waft.beneath import Folder
from waft.loading import version
from waft.reading import found_json
from waft.results.place import ResultPlace
from waft.results.store import Store
from waft.run._chain import WITHOUT
from waft.texts import is_utf8
from waft.watching import Effort

STATUS_ORDER = ("met", "infeasible", "conflict", "unreachable")
REPORT = "report.json"
PLAN = ("planned.vtp", "constraints.vtp", "vortices.vtp")  # what is kept of a plan: its tracks, rows and vortices
STATE = "assimilated.state"
FITTED = "fitted_vortices.vtp"
POSES = "poses.csv"
SERIES = ("meshes", "particles")  # what is written only when it is asked for, a file a frame
AIR = ("air", "air_wind")  # the air's series


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


def write_results(run, place, planned_file="", air_file="", is_shown_alone=False):
    """Every file of a Flight, all at once: see the user guide for what each holds. planned_file: what an earlier part of the run wrote as
    planned.vtp; air_file: the state of the air; is_shown_alone: those that a page is made of alone."""
    writing = Effort().begin()
    keeps_air = "state" in run.keep and run.has_air and not run.hurries and os.path.isfile(air_file)
    told = run.pipeline.write({
        "Folder": str(place.path(REPORT).parent), "HasCsv": run.request.csv, "HasMeshes": "meshes" in run.series,
        "HasParticles": "particles" in run.series, "HasAllAir": "air" in run.keep, "IsHurried": run.hurries,
        "HasFields": not is_shown_alone, "PlannedFile": str(planned_file), "AirStateFile": str(air_file) if keeps_air else ""})
    place.commit(_summary(run, told, writing.end()))


def save_results(run, folder, is_shown_alone=False):
    """The files of a Flight that is over in a folder."""
    if not is_utf8(folder):
        raise failures.BadInput(f"{os.fsdecode(folder)}: expected a name in UTF-8, as ParaView takes no other")
    with result_place(folder) as place:
        place.check(result_names(run.scene_file, run.request))
        write_results(run, place, air_file=Store().found(run.key) or os.devnull, is_shown_alone=is_shown_alone)


def _summary(run, told, writing):
    counts = {status: 0 for status in STATUS_ORDER}
    for row in run.report:
        counts[row["Status"]] += 1
    return {
        "version": version(),
        "scene": pathlib.Path(run.scene_file).name,
        "title": str((found_json(run.scene_file) or {}).get("title", "")),
        "seed": run.seed,
        "key": run.key,
        "stages": {name: watch.as_json() for name, watch in run.watches.items()},
        "writing": writing.as_json(),
        "quality": run.quality,
        "defaults": dict(run.request._defaults),
        **told,
        "constraints": {**counts, "unmet": [row for row in run.report if row["Status"] != "met"]},
        "objects": run.plan_objects,
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
    return names + (["wind.pvd"] if run.motion[0] == "spacetime" else []) + [f"{name}.pvd" for name in run.series]
