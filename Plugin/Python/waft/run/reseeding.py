# SPDX-License-Identifier: BSD-3-Clause
"""The same flight by another seed: run.seed = 7."""
from waft.failures import BadInput
from waft.run._chain import word_in_keys
from waft.run.request import STATED
from waft.run.resuming import run_key
from waft.watching import Clock


def fly_by(flight, seed):
    """Flies anew by another seed, with the properties that the stages have; see Result.seed. Where that fails the motion of the flight
    before is still there."""
    STATED["seed"].check("seed", seed)
    _check_own(flight)
    engine, before = flight.pipeline, flight.seed
    with engine.undone_on_failure(), Clock(quiet=True, words=f"stopped: the motion is still that of the seed {before}") as clock:
        engine.warnings = []
        engine.algorithm.SetSeed(seed)
        engine.fly(clock, lambda: None)
    engine.hand_over()
    flight.seed, flight.key = seed, run_key(engine, seed, word_in_keys(flight.quality))
    clock.hand_on()


def _check_own(flight):
    """Raises BadInput of a flight that another seed would not make another flight of the same kind."""
    anew = "waft.synthesize flies it anew"
    if flight.edit_of is not None:
        raise BadInput(f"seed: expected a flight in an air of its own, found one in that of {flight.edit_of}, which another seed "
                       f"would not have: {anew}")
    if flight.stopped:
        raise BadInput(f"seed: expected a flight that came to its end, found one that was stopped ({flight.stopped_in}): {anew}")
    if not flight.pipeline.is_planned_here:
        raise BadInput(f"seed: expected a flight whose paths were planned here, found one that went on from files: {anew}")
