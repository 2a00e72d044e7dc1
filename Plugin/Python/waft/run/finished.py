# SPDX-License-Identifier: BSD-3-Clause
"""Flights of folders that `waft synthesize` wrote: nothing is flown again. What the folder says is looked at like any input."""
import contextlib
import dataclasses
import os
from typing import Any, Dict, Iterator, List, cast

from waft import failures
from waft.beneath import Folder
from waft.failures import InputError, WaftError
from waft.files import copy_file
from waft.results import _folder
from waft.results._arrays import array_of
from waft.results._records import REPORT, record_of
from waft.results._tables import columns_of
from waft.results.place import manifest_in
from waft.results.writing import REPORT as SEAL, result_place, settled
from waft.run._chain import quality_of
from waft.run.request import Path
from waft.run.result import Run

_ROW = {"Row": int, "Target": int, "ObjectId": int, "Frame": int, "Kind": str, "Residual": float, "Status": str, "Message": str}
_LATER = ("TouchDown", "Settled", "LiftOff", "Arrival", "Release", "Leave")  # columns of constraints.csv that older versions did not write
_READ = ("poses.vtp", "objects.vtp", "shapes.vtm", "constraints.vtp", "constraints.csv")  # where they are


@dataclasses.dataclass
class _Told:
    """What the files say of a flight."""

    scene: str
    seed: int
    quality: str
    stopped: bool
    report: List[Dict[str, Any]]
    warnings: List[str]

    @property
    def status(self) -> int:
        if self.stopped:
            return failures.STOPPED_EARLY
        return failures.ALL_MET if all(row["Status"] == "met" for row in self.report) else failures.NOT_ALL_MET


def load(folder: Path) -> Run:
    """The flight of a folder that `waft synthesize` (or waft.synthesize with an output) wrote: its arrays, marks, pictures, page, tables, and
    show(). Nothing is flown again, and nothing of the folder is changed.

    The motion is read at once; pictures on the bodies, the page and copies need the folder later, too. Raises InputError that names the file,
    what was expected and what was found. A file that was changed since it was written is read where it is right, and run.warnings
    tells of it.
    """
    if not isinstance(folder, (str, os.PathLike)):
        raise InputError(f"load: folder: expected the path of a folder, found {folder!r}")
    folder = os.path.abspath(os.fspath(folder))
    below = settled(folder)
    if not below.is_file(SEAL):
        raise InputError(f"{below.path / SEAL}: missing; expected the folder of a flight that `waft synthesize` wrote")
    about = record_of(below, SEAL, REPORT)
    motion = _folder.load(folder)
    columns = motion.poses.GetPointData()
    array_of(columns, "Time", "poses.vtp")
    for name in ("Velocity", "AngularVelocity"):
        array_of(columns, name, "poses.vtp", 3)
    told = _Told(about["scene"], int(about["seed"]), quality_of(about.get("quality", "")), about.get("stoppedEarly", False), _report(below),
                 [*about.get("warnings", ()), *_changed(below)])
    return FinishedRun(folder, motion, told)


def _report(below):
    """The rows of constraints.csv, all texts."""
    _folder.needed(below, "constraints.csv")
    rows = below.rows("constraints.csv", "a table that `waft synthesize` writes")
    columns_of(rows, _ROW, below.path / "constraints.csv")
    return [{**{name: row[name] for name in _ROW}, **{name: row[name] for name in _LATER if row.get(name) is not None}} for row in rows]


def _changed(below):
    """A sentence for each of the files that is not as the manifest says."""
    manifest = manifest_in(below, SEAL) or {}
    return [f"{below.path / name}: it was changed since a run wrote it" for name in manifest
            if name.partition("/")[0] in (*_READ, "shapes", "obstacles") and below.is_file(name) and not manifest[name].fits(below, name)]


class FinishedRun(Run):
    """A flight out of a folder."""

    def __init__(self, folder: Path, motion: Any, told: _Told) -> None:
        super().__init__(told, folder)
        self._motion = motion
        self._reader: Any = None

    @property
    def seed(self) -> int:
        return cast(int, self._about.seed)

    @seed.setter
    def seed(self, seed: int) -> None:
        raise WaftError(f"seed: a flight that was read flies no more: waft.synthesize(SCENE, seed={seed!r})")

    def save(self, folder: Path) -> None:
        below = self._below()
        manifest = manifest_in(below, SEAL)
        if manifest is None:
            raise InputError(f"{below.path / SEAL}: expected a manifest of the files of the flight, found none")
        lacking = [name for name, entry in manifest.items() if not entry.fits(below, name)]
        if lacking:
            raise InputError(f"{below.path / lacking[0]}: expected the file that a run wrote, found "
                             f"{'another' if below.about(lacking[0]) is not None else 'none'}: nothing was copied")
        if os.path.realpath(folder) == os.path.realpath(below.path):
            return
        with result_place(folder) as place:
            place.check(list(manifest))
            for name in manifest:
                copy_file(below.file(name), place.path(name))
            place.commit({name: value for name, value in below.json(SEAL).items() if name != "manifest"})
        self._folder = os.path.abspath(os.fspath(folder))

    def show(self, view: Any = None) -> Any:
        from waft.run.showing import show

        return show(self, view)[0]

    def delete(self) -> None:
        from paraview import simple

        if self._reader is not None:
            simple.Delete(self._reader)
            self._reader = None

    def _stage(self) -> Any:
        """The source of ParaView that reads the folder, made at the first call."""
        from paraview import simple

        if self._reader is None:
            self._reader = simple.MotionResultsReader(registrationName=os.path.basename(self._below().path),
                                                      FileName=str(self._below().path / SEAL))
        return self._reader

    def _below(self) -> Folder:
        if not os.path.isdir(str(self._folder)):
            raise InputError(f"{self._folder}: no such folder any more: waft.load reads it from where it is now")
        return settled(self._folder)

    def _poses(self) -> Any:
        return self._motion.poses

    def _scene(self) -> str:
        return cast(str, self._about.scene)

    @contextlib.contextmanager
    def _drawn(self) -> Iterator[Any]:
        yield self._motion

    def _page(self) -> str:
        from waft.page.writing import page_of

        return page_of(self._below().path)
