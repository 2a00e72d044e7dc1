# SPDX-License-Identifier: BSD-3-Clause
"""The same stages once more, by another seed: run.seed = 7."""
from waft.failures import BadInput, WaftError
from waft.results.writing import planned_objects, read_rows
from waft.run._constraints import constraint_report
from waft.run._flight import Flight
from waft.run._chain import word_in_keys
from waft.run.pipeline import NO_MEMORY
from waft.run.request import STATED
from waft.run.resuming import run_key
from waft.watching import Clock

_STAGES = ("planner", "assimilation", "spacetime", "rotation", "fit")
# What the run gave its stages besides properties of the motion: another flight takes its time.
_OF_THE_RUN = {"TimeLimit": 0.0}


def fly_by(flight: Flight, seed: int) -> None:
    """Flies anew by another seed, with the properties that the stages have; see Result.seed. Where that fails the stages have their old
    seed, and the motion of the flight before is still there."""
    STATED["seed"].check("seed", seed)
    _check(flight)
    pipeline, before = flight.pipeline, flight.seed
    planned = pipeline.plan_report, pipeline.plan_objects
    stages = [name for name in _STAGES if getattr(pipeline, name) is not None]
    warnings = []
    _sow(pipeline, stages, seed)
    try:
        with Clock(quiet=True, words=f"stopped: the motion is still that of the seed {before}") as clock:
            try:
                for name in stages:
                    warnings += _updated(pipeline, name, clock)
            finally:
                for watch in pipeline.watches.values():
                    watch.release()
        pipeline.plan_report, pipeline.plan_objects = read_rows(pipeline.output("planner", 2)), planned_objects(pipeline)
        report = constraint_report(pipeline)
    except BaseException:
        pipeline.plan_report, pipeline.plan_objects = planned
        _sow(pipeline, stages, before)
        raise
    flight.seed, flight.report, flight.warnings = seed, report, warnings
    flight.key = run_key(pipeline, seed, word_in_keys(flight.quality))
    clock.hand_on()


def _check(flight):
    if flight.edit_of is not None:
        raise BadInput(f"seed: expected a flight in an air of its own, found one in that of {flight.edit_of}, which another seed would not "
                       "have: waft.synthesize flies it anew")
    if flight.stopped:
        raise BadInput(f"seed: expected a flight that came to its end, found one that was stopped ({flight.stopped_in}): waft.synthesize "
                       "flies it anew")
    if flight.planner is None:
        raise BadInput("seed: expected a flight whose paths were planned here, found one that went on from files: waft.synthesize flies it "
                       "anew")


def _sow(pipeline, stages, seed):
    for name in stages:
        stage = getattr(pipeline, name)
        for setting, value in {"Seed": seed, **_OF_THE_RUN}.items():
            if setting in stage.ListProperties():
                setattr(stage, setting, value)


def _updated(pipeline, name, clock):
    """Updates a stage; returns its warnings."""
    watch = pipeline.watch(name, clock)
    watch.can_stop = True
    getattr(pipeline, name).UpdatePipeline()
    watch.can_stop = False
    clock.check()
    if watch.errors:
        raise (WaftError if NO_MEMORY in watch.errors[0] else BadInput)(watch.errors[0])
    return watch.warnings
