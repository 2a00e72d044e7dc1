# SPDX-License-Identifier: BSD-3-Clause
"""The same flight by another seed: run.seed = 7."""
from waft.failures import InputError
from waft.run.request import STATED
from waft.watching import Clock


def fly_by(flight, seed):
    """Flies anew by another seed, with the properties that the stages have; see Result.seed. Where that fails the motion of the flight
    before is still there."""
    STATED["seed"].check("seed", seed)
    _check_own(flight)
    engine, before = flight.pipeline, flight.seed
    with engine.undone_on_failure(), Clock(quiet=True, words=f"stopped: the motion is still that of the seed {before}") as clock:
        engine.algorithm.SetSeed(seed)
        engine.fly(clock)
    engine.hand_over()
    clock.hand_on()


def _check_own(flight):
    """Raises InputError of a flight that another seed would not make another flight of the same kind."""
    anew = "waft.synthesize flies it anew"
    if flight.request.edit_of is not None:
        raise InputError(f"seed: expected a flight in an air of its own, found one in that of {flight.request.edit_of}, which another seed "
                         f"would not have: {anew}")
    if flight.stopped:
        raise InputError(f"seed: expected a flight that came to its end, found one that was stopped ({flight.stopped_in}): {anew}")
