# SPDX-License-Identifier: BSD-3-Clause
"""What Core says of the chain: its stages, and the qualities of a run, which say how objects come to their marks. chain.json is written
when Waft is built (Filters/Programs)."""
import pathlib

from waft.reading import read_json

_TABLE = read_json(pathlib.Path(__file__).parents[1] / "chain.json")
STAGES = {stage["name"]: stage for stage in _TABLE["stages"]}
# The stages of the table as they are called here.
ATTRIBUTES = {name: stage["word"] for name, stage in STAGES.items()}
# preview: drift in one sampled air on a coarse grid; air: the same on the full one; full: the optimiser from there, in that air, and
# vortices fitted to it; paper: as in the paper, the optimiser from the plan, gas at rest.
QUALITIES = tuple(_TABLE["qualities"])
# {quality: the stages that it goes without}
WITHOUT = {quality: tuple(ATTRIBUTES[name] for name, stage in STAGES.items() if quality not in stage["qualities"]) for quality in QUALITIES}
# What may be kept in full beside the results: every frame of the air, and the state that edits go on from.
KEPT = ("air", "state")
_FORMER = {"air": "assimilated"}  # {quality: what it was called before}


def quality_of(word):
    """The quality that a word names, be it what it was called before; another word as it is."""
    return next((quality for quality, former in _FORMER.items() if word == former), word)


def word_in_keys(quality):
    """What the digests of runs have of a quality: what it was called before, so that they stay the same."""
    return _FORMER.get(quality, quality)
