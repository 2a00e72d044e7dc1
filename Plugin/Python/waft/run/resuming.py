# SPDX-License-Identifier: BSD-3-Clause
"""What a run keeps in its folder while it goes, so that another can go on from it (Bridge/Run/FlightCheckpoint.h), looked at from outside."""
from waft.failures import InputError
from waft.results._records import KEPT, record_of
from waft.results.place import manifest_in

PLAN = ("planned.vtp", "constraints.vtp", "vortices.vtp")  # what is kept of a plan: its tracks, rows and vortices
_FOLDER, _KEY = "checkpoint", "key"
# Of the assimilation on its way, and when it is done.
_STATES = {"assimilation.state", "assimilated.state"}


def _manifest_in(below):
    """Of the plan in a Folder; None where it cannot be read."""
    try:
        return manifest_in(below, f"{_FOLDER}/{_KEY}")
    except InputError:
        return None


def key_and_damage(below):
    """(key of the run that left a checkpoint in a Folder, None where it cannot be told; what of it is damaged, in words)"""
    manifest = _manifest_in(below)
    try:
        key = record_of(below, f"{_FOLDER}/{_KEY}", KEPT)
    except InputError:
        key = None
    folder = below.path / _FOLDER
    if key is None or manifest is None or not set(PLAN) <= manifest.keys():
        return None, f"{folder / _KEY} is damaged, or of another version"
    damaged = [name for name, entry in manifest.items() if not entry.fits(below, f"{_FOLDER}/{name}")]
    return key["key"], f"{folder / damaged[0]} is damaged" if damaged else ""


def stages_done(below):
    """The stages that the checkpoint in a Folder has something of, in their order; none where there is no checkpoint."""
    try:
        names = set(below.names(_FOLDER))
    except InputError:  # it is no folder
        return []
    marks = {"planner": {_KEY}, "assimilation": _STATES}
    return [stage for stage, own in marks.items() if names & own]
