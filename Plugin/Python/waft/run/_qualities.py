# SPDX-License-Identifier: BSD-3-Clause
"""The qualities of a run, which say how objects come to their marks."""

# The stages that each goes without. preview: drift in one sampled air on a coarse grid; air: the same on the full one; full: the
# optimiser from there, in that air, and vortices fitted to it; paper: as in the paper, the optimiser from the plan, gas at rest.
WITHOUT = {"preview": ("spacetime", "fit"), "air": ("spacetime", "fit"), "full": (), "paper": ("assimilation", "fit")}
QUALITIES = tuple(WITHOUT)
# What may be kept in full beside the results: every frame of the air, and the state that edits go on from.
KEPT = ("air", "state")
_FORMER = {"air": "assimilated"}  # {quality: what it was called before}


def quality_of(word):
    """The quality that a word names, be it what it was called before; another word as it is."""
    return next((quality for quality, former in _FORMER.items() if word == former), word)


def word_in_keys(quality):
    """What the digests of runs have of a quality: what it was called before, so that they stay the same."""
    return _FORMER.get(quality, quality)
