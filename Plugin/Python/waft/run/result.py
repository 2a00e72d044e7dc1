# SPDX-License-Identifier: BSD-3-Clause
"""A flight that is over: its motion as arrays, tables, pictures, a page, and in ParaView. Result is what waft.synthesize returns, with
the live stages; waft.load gives a Run of a folder."""
import contextlib
import os
import pathlib
import tempfile
from typing import TYPE_CHECKING, Any, ContextManager, Dict, Iterator, List, Optional, Tuple

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from waft.failures import InputError
from waft.run import _pictures, _tables
from waft.run._flight import Flight
from waft.run.request import Path
from waft.texts import is_utf8

if TYPE_CHECKING:
    from numpy.typing import NDArray

_MARK = [("row", int), ("target", int), ("object", int), ("frame", int), ("kind", "U12"), ("status", "U12"), ("residual", float),
         ("message", object)]
_COLUMNS = ("Row", "Target", "ObjectId", "Frame", "Kind", "Status", "Residual", "Message")


class Run:
    """A flight that is over.

    positions[object, frame]: numpy array (objects, frames, 3) [m]; orientations[object, frame]: (objects, frames, 4), w x y z,
    body to world; present[object, frame]: (objects, frames), whether an object is in the shot; times: (frames) [s]; object_ids:
    (objects), the id of each object in the arrays; marks: a structured array, a row a constraint: row, target, object, frame, kind,
    status, residual, message.

    status: exit status of the command; report: the constraints, a dictionary each; warnings: sentences; stopped: whether it was
    stopped early, with the best so far; seed and quality: those of the flight; folder: the path of its files, None where there are none.
    """

    def __init__(self, about: Any, folder: Optional[Path]) -> None:
        self._about = about  # a Flight, or what is told of one
        self._folder = None if folder is None else os.fspath(folder)

    @property
    def status(self) -> int:
        return self._about.status

    @property
    def report(self) -> List[Dict[str, Any]]:
        return self._about.report

    @property
    def warnings(self) -> List[str]:
        return self._about.warnings

    @property
    def stopped(self) -> bool:
        return self._about.stopped

    @property
    def quality(self) -> str:
        return self._about.quality

    @property
    def seed(self) -> int:
        return self._about.seed

    @property
    def folder(self) -> Optional[str]:
        return self._folder

    def _poses(self) -> Any:
        """The poses as VTK data."""
        raise NotImplementedError

    def _drawn(self) -> ContextManager[Any]:
        """A results._folder.Motion for a while."""
        raise NotImplementedError

    def _scene(self) -> str:
        """The name of the scene."""
        raise NotImplementedError

    def _page(self) -> str:
        """The page of the flight."""
        raise NotImplementedError

    def _by_object(self, values):
        lines = self._poses().GetLines()
        order = vtk_to_numpy(lines.GetConnectivityArray())
        return np.array(values)[order].reshape(lines.GetNumberOfCells(), -1, np.shape(values)[1])

    @property
    def positions(self) -> "NDArray[np.float64]":
        return self._by_object(vtk_to_numpy(self._poses().GetPoints().GetData()))

    @property
    def orientations(self) -> "NDArray[np.float64]":
        return self._by_object(vtk_to_numpy(self._poses().GetPointData().GetArray("Orientation")))

    @property
    def present(self) -> "NDArray[np.bool_]":
        present = vtk_to_numpy(self._poses().GetPointData().GetArray("Present"))
        return self._by_object(present[:, None])[..., 0] > 0

    @property
    def times(self) -> "NDArray[np.float64]":
        times = vtk_to_numpy(self._poses().GetPointData().GetArray("Time"))
        return self._by_object(times[:, None])[0, :, 0]

    @property
    def object_ids(self) -> "NDArray[np.int64]":
        return np.array(vtk_to_numpy(self._poses().GetCellData().GetArray("ObjectId")), int)

    @property
    def marks(self) -> "NDArray[np.void]":
        return np.array([tuple(row[name] for name in _COLUMNS) for row in self.report], dtype=_MARK)

    def render(self, path: Optional[Path] = None, frame: Optional[int] = None, size: Tuple[int, int] = (960, 540), view: str = "side",
               **options: Any) -> "NDArray[np.uint8]":
        """A still as a numpy array (height, width, 3; of the style clear 4, with alpha) of bytes, the top row first.

        path: also writes it, .png. frame: default the last. size: width and height, 16 to 16384. view: hero, side, top or follow.
        options: of waft.render.Stage: samples, paths, targets, obstacle_opacity, style. Without a display a virtual one is used
        (Xvfb); raises WaftError where there is none.
        """
        return _pictures.still(self._drawn, len(self.times), type(self).__name__, path, frame, size, view, options)

    def page(self, path: Optional[Path] = None) -> str:
        """Writes the page that shows the flight in a browser (Documentation/Page.md); returns its path.

        path: a name that ends with .html (default: page.html in the folder of the flight). Raises InputError where something is in the way
        that Waft did not write, and where there is neither a path nor a folder.
        """
        from waft.page.writing import write_page, write_text_of_page

        if path is not None:
            if pathlib.Path(path).suffix != ".html":
                raise InputError(f"{type(self).__name__}.page: path: expected a name that ends with .html, found {os.fspath(path)!r}")
            return write_text_of_page(self._page(), os.fspath(path))
        if self.folder is None:
            raise InputError(f"{type(self).__name__}.page: path: expected the name of a file, found none: this flight is in no folder")
        return write_page(self.folder)

    def save(self, folder: Path) -> None:
        """Writes the files of the flight into a folder, as `output` of waft.synthesize does. Raises InputError where results would take
        the place of files that no run wrote, or that were changed since; nothing is written then."""
        raise NotImplementedError

    def show(self, view: Any = None) -> Any:
        """The bodies, the obstacles, the paths and the marks in a view of ParaView (default: the active one, or a new one); the
        animation of the session then has the frames of the scene. Returns the view."""
        raise NotImplementedError

    def delete(self) -> None:
        """Takes all that belongs to the flight out of ParaView's session."""
        raise NotImplementedError

    def to_pandas(self) -> Any:
        """A pandas.DataFrame with a row an object and a frame, and the columns of poses.csv: object, frame, time [s], x, y, z [m], qw, qx,
        qy, qz, vx, vy, vz [m/s], wx, wy, wz [rad/s], and
        present (0 or 1) where an object ever is not in the shot. Raises WaftError where pandas is not installed."""
        return _tables.frame_of(self, self._poses())

    def to_pyvista(self, frame: Optional[int] = None) -> Any:
        """A pyvista.MultiBlock: `bodies`, a block a shape, posed at a frame (default: the last); `paths`, a line an object with the arrays
        of the poses; `obstacles`; `marks`, the places that are asked for. Raises WaftError where PyVista is not installed."""
        frame = _pictures.checked_frame(frame, len(self.times), f"{type(self).__name__}.to_pyvista")
        with self._drawn() as motion:
            return _tables.blocks_of(motion, frame)

    def plot(self, frame: Optional[int] = None, **options: Any) -> Any:
        """Shows a frame (default: the last) in a window of PyVista, with the bodies in their colours and pictures. options: of
        pyvista.Plotter.show, whose answer is returned. Raises WaftError where PyVista is not installed."""
        frame = _pictures.checked_frame(frame, len(self.times), f"{type(self).__name__}.plot")
        with self._drawn() as motion:
            return _tables.plot(motion, frame, options)

    def __dir__(self) -> List[str]:
        return [name for name in super().__dir__() if not name.startswith("_") or name.startswith("__")]

    def __repr__(self) -> str:
        objects, frames, _ = self.positions.shape
        met = int(np.sum(self.marks["status"] == "met"))
        return (f"<{type(self).__name__} of {self._scene()}: {objects} objects, {frames} frames, "
                f"{met} of {len(self.marks)} marks met>")

    def _repr_html_(self) -> str:
        """For notebooks."""
        return _pictures.cell(self)


# What of a flight was an attribute of its Result before.
_FORMER = ("pipeline", "stopped_in", "left_out", "series", "key", "scene_file", "database_file", "watches", "request", "motion", "has_air")


def _in_utf8(folder):
    if not is_utf8(folder):
        raise InputError(f"{os.fsdecode(folder)}: expected a name in UTF-8, as ParaView takes no other")
    return folder


class Result(Run):
    """A flight with its stages: reader, database, planner, assimilation, spacetime, rotation, fit are live proxies of ParaView; the
    arrays are those of the stages as they are: after a change of a property and run.rotation.UpdatePipeline() the new ones (marks: of the run).
    """

    def __init__(self, flight: Flight, folder: Optional[Path] = None) -> None:
        super().__init__(flight, folder)
        self._about: Flight = flight

    @property
    def seed(self) -> int:
        """The number that plan, air and turns are drawn by. Another one flies anew, all stages with the properties that they have: what
        waft.synthesize(..., seed=N) gives. It takes the time of a flight; Ctrl-C stops it, with the best so far. Raises InputError, and leaves
        the seed as it was, of a flight in the air of another (edit_of) or on a plan that was read (resume), and where a stage fails."""
        return self._about.seed

    @seed.setter
    def seed(self, seed: int) -> None:
        from waft.run.reseeding import fly_by

        fly_by(self._about, seed)
        self._folder = None  # its files are those of the flight before

    @property
    def reader(self) -> Any:
        return self._about.reader

    @property
    def database(self) -> Any:
        return self._about.database

    @property
    def planner(self) -> Any:
        return self._about.planner

    @property
    def assimilation(self) -> Any:
        return self._about.assimilation

    @property
    def spacetime(self) -> Any:
        return self._about.spacetime

    @property
    def rotation(self) -> Any:
        return self._about.rotation

    @property
    def fit(self) -> Any:
        return self._about.fit

    def output(self, name: str, port: int = 0) -> Any:
        """The data object of an output port of a stage, on this side."""
        return self._about.output(name, port)

    def delete(self) -> None:
        """Takes the stages out of ParaView's session."""
        self._about.pipeline.delete()

    def save(self, folder: Path) -> None:
        self._about.pipeline.save(_in_utf8(folder))
        self._folder = os.fspath(folder)

    def show(self, view: Any = None) -> Any:
        from waft.run.showing import show

        return show(self, view)[0]

    def _poses(self) -> Any:
        return self._about.pipeline.poses

    def _scene(self) -> str:
        return os.path.basename(self._about.scene_file)

    @contextlib.contextmanager
    def _drawn(self) -> Iterator[Any]:
        from waft.results._folder import load

        with tempfile.TemporaryDirectory(prefix="waft-still-") as folder:
            self._about.pipeline.save(folder, is_shown=True)
            yield load(folder)

    def _page(self) -> str:
        from waft.page.writing import page_of

        with tempfile.TemporaryDirectory(prefix="waft-page-") as folder:
            self._about.pipeline.save(folder, is_shown=True)
            return page_of(folder)

    if not TYPE_CHECKING:
        def __getattr__(self, name):
            if name in _FORMER:
                return getattr(self._about, name)
            raise AttributeError(f"'Result' object has no attribute '{name}'")
