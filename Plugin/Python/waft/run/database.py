# SPDX-License-Identifier: BSD-3-Clause
"""A motion database from simulations of smoke."""
import dataclasses
import os
import pathlib
import re

from waft import failures, reading
from waft.beneath import Folder
from waft.files import table_rows, write_csv, write_xml
from waft.loading import set_threads
from waft.processes import share
from waft.results.place import LOCK, ResultPlace
from waft.watching import Clock, StageWatch


@dataclasses.dataclass
class Made:
    """A database that was made: its source, whether it was stopped before all simulations were done, and the
    rows of its coverage (simulations before, segments brought, share of these that is new)."""

    source: object
    stopped: bool
    coverage: list


def coverage_file(path):
    """Where the coverage of a database is written: FILE.coverage.csv beside FILE.vtm."""
    return pathlib.Path(path).with_suffix(".coverage.csv")


def kept_folder(path):
    """Where simulations that are whole wait for the others; it is gone when all are there."""
    return pathlib.Path(f"{path}.kept")


_KEPT = re.compile(r"simulation\d+(\.part\d+)?")
_MANIFEST = "manifest.json"  # in the folder beside FILE.vtm


def database_place(path):
    """The ResultPlace of a database."""
    path = pathlib.Path(path)
    own = (path.name, coverage_file(path).name)
    return ResultPlace(path.parent, f"{path.stem}/{_MANIFEST}", room=kept_folder(path).name,
                       owns=lambda name: name in own or name.startswith(f"{path.stem}/"))


def settle_database(path):
    """Finishes a change of a database that was cut short, before it is read."""
    database_place(path).settle()


def check_database(path):
    """Raises BadInput unless a file is a motion database by its structure, whose blocks are files beside it that no link leads
    to."""
    if os.path.isfile(path):
        own = pathlib.Path(os.path.realpath(path))  # it may be linked itself, as files of an installed tree are
        Folder(own.parent).check_blocks(own.name)
    reading.check_blocks(path, "motion database")


def _check_kept(kept):
    for name in kept.names():
        if name != LOCK and not (_KEPT.fullmatch(name) and kept.is_regular(kept.about(name))):
            raise failures.BadInput(f"{kept.path / name}: expected what a stopped run left, found something else: it stays as it is: "
                                    "move it away, or choose another name for the database")


def _forget(kept):
    """Removes the simulations that wait there; nothing else."""
    for name in kept.names():
        if _KEPT.fullmatch(name):
            kept.remove(name)


def make_database(path, simulations=8, frames=300, resolution=64, seed=1, threads=None, time_limit=None,
                  stop_below=0.0, coverage_tolerance=0.05, resume=False, quiet=True):
    """Simulates, traces, cuts and clusters; writes PATH (.vtm and the folder beside it) and its coverage,
    whole or not at all, and returns what was Made.

    The same seed gives the same bytes on any number of threads. stop_below: the first simulation of whose
    segments a smaller share than this is new is the last; new is what is farther from all before than
    coverage_tolerance of the rms chord. Stopped by the time limit [s] or an interrupt, the
    database is that of the simulations that are whole (Interrupted is raised when there is none), and these
    are kept; with resume a run of the same parameters goes on from there.
    """
    if not str(path).endswith(".vtm"):
        raise failures.BadInput(f"{path}: expected a file name that ends with .vtm")
    from waft.vtkWaftSources import vtkMotionDatabaseSource

    path = pathlib.Path(path)
    # It looks whether to stop from its first step on, and knows whether a simulation is whole.
    with Clock(time_limit, quiet, words="") as clock, database_place(path) as place:
        place.check([path.name, f"{path.stem}/", coverage_file(path).name])
        kept = place.folder.below(place.room.name)
        _check_kept(kept)
        if not resume:
            _forget(kept)
        set_threads(threads)
        source = vtkMotionDatabaseSource()
        for name, value in (("NumberOfSimulations", simulations), ("NumberOfFrames", frames), ("Resolution", resolution), ("Seed", seed),
                            ("StopBelow", stop_below), ("CoverageTolerance", coverage_tolerance), ("KeptIn", str(place.room))):
            getattr(source, f"Set{name}")(value)
        share(source)
        watch = StageWatch("database", source, clock)
        source.Update()
        if watch.errors:
            if "cannot write" in watch.errors[0]:
                raise failures.WaftError(watch.errors[0])
            _forget(kept)
            raise failures.BadInput(watch.errors[0])
        database = source.GetOutputDataObject(0)
        if database.GetNumberOfBlocks() == 0:
            raise failures.Interrupted("stopped before a simulation was whole")
        header, rows = table_rows(source.GetOutputDataObject(1))
        write_xml(database, place.path(path.name))
        write_csv(coverage_file(place.path(path.name)), header, rows)
        place.commit({})
        coverage = [(int(before), int(segments), float(share)) for before, segments, share in rows]
        stopped = watch.was_aborted and len(coverage) + 1 < simulations
        if not stopped:
            _forget(kept)
    clock.hand_on()
    return Made(source, stopped, coverage)
