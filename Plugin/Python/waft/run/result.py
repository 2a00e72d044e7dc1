# SPDX-License-Identifier: BSD-3-Clause
"""What waft.synthesize returns: the live stages, and the motion as arrays, pictures and a page in a notebook."""
import base64
import contextlib
import dataclasses
import os
import pathlib
import tempfile
from typing import TYPE_CHECKING, Any, Dict, List, Optional, Sequence, Tuple

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from waft.failures import BadInput, WaftError
from waft.reading import read_bytes
from waft.run.pipeline import Pipeline
from waft.run.request import Path, Request
from waft.texts import in_html

if TYPE_CHECKING:
    from numpy.typing import NDArray

_MARK = [("row", int), ("target", int), ("object", int), ("frame", int), ("kind", "U12"), ("status", "U12"), ("residual", float),
         ("message", object)]
_COLUMNS = ("Row", "Target", "ObjectId", "Frame", "Kind", "Status", "Residual", "Message")
_MOST_MARKS = 40  # in a notebook's table; those that are not met first


def _of_pipeline(name: str) -> Any:
    """An attribute that is the pipeline's."""
    return property(lambda self: getattr(self.pipeline, name))


@dataclasses.dataclass(frozen=True, repr=False, eq=False)
class Result:
    """What came of a run, and its pipeline, whose stages (reader, database, planner, assimilation, spacetime, rotation: live
    proxies) have their names here, too.

    positions[object, frame]: numpy array (objects, frames, 3) [m]; orientations[object, frame]: (objects, frames, 4), w x y z,
    body to world; times: (frames) [s]; object_ids: (objects), the id of each object in the arrays; marks: a structured array, a
    row a constraint: row, target, object, frame, kind, status, residual, message. They are those of the stages as they are:
    after a change of a property and run.rotation.UpdatePipeline() the new ones (marks: of the run).

    status: exit status of the command; report: the constraints, a dictionary each; warnings: sentences; stopped: whether it was
    stopped early, with the best so far; seed and quality: those of the run. delete(): takes the stages out of ParaView's session.
    """

    pipeline: Pipeline
    status: int
    report: List[Dict[str, Any]]
    warnings: List[str]
    stopped: bool
    hurries: bool  # somebody stopped it, and waits
    stopped_in: str  # the stage
    series: List[str]  # of data that were asked for, a file a frame
    seed: int
    quality: str
    edit_of: Optional[pathlib.Path]  # the file with the air that was kept
    keep: Sequence[str]  # what is written in full
    key: str  # of the run, for checkpoints
    request: Request  # what was asked for
    scene_folder: "Optional[tempfile.TemporaryDirectory[str]]" = None  # with the file of a scene that was made here

    scene_file, database_file, watches = map(_of_pipeline, ("scene_file", "database_file", "watches"))
    reader, database, planner = map(_of_pipeline, ("reader", "database", "planner"))
    assimilation, spacetime, rotation, fit = map(_of_pipeline, ("assimilation", "spacetime", "rotation", "fit"))
    plan_report, plan_objects, planned = map(_of_pipeline, ("plan_report", "plan_objects", "planned"))
    motion, moved, has_air, delete = map(_of_pipeline, ("motion", "moved", "has_air", "delete"))

    def output(self, name: str, port: int = 0) -> Any:
        """The data object of an output port of a stage, on this side."""
        return self.pipeline.output(name, port)

    def _poses(self):
        return self.output("rotation", 1)

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
        from waft.results._folder import load
        from waft.render._output import write_png
        from waft.files import whole_file
        from waft.render._styles import STYLES, VIEWS
        from waft.render import Stage

        count = len(self.times)
        frame = count - 1 if frame is None else frame
        if not isinstance(frame, (int, np.integer)) or not 0 <= frame < count:
            raise BadInput(f"Result.render: frame: expected a whole number from 0 to {count - 1}, found {frame!r}")
        if view not in VIEWS:
            raise BadInput(f"Result.render: view: expected one of {', '.join(VIEWS)}, found {view!r}")
        if options.get("style", "day") not in STYLES:
            raise BadInput(f"Result.render: style: expected one of {', '.join(STYLES)}, found {options['style']!r}")
        if len(size) != 2 or min(size) < 16 or max(size) > 16384:
            raise BadInput(f"Result.render: size: expected width and height from 16 to 16384, found {size!r}")
        if path is not None and pathlib.Path(path).suffix != ".png":
            raise BadInput(f"Result.render: path: expected a name that ends with .png, found {os.fspath(path)!r}")
        with tempfile.TemporaryDirectory(prefix="waft-still-") as folder, _display():
            self._write_drawn(pathlib.Path(folder))
            stage = Stage(load(folder), size, **options)
            picture = stage.draw(view, int(frame))
            del stage  # its window goes before the display does
        if path is not None:
            with whole_file(os.fspath(path), lambda path: True) as part:
                write_png(picture, part)
        width, height, _ = picture.GetDimensions()
        return vtk_to_numpy(picture.GetPointData().GetScalars()).reshape(height, width, -1)[::-1].copy()

    def _write_drawn(self, folder):
        from waft.files import write_xml
        from waft.results.writing import write_bodies

        class Place:
            @staticmethod
            def path(name):
                (folder / name).parent.mkdir(parents=True, exist_ok=True)
                return folder / name

        rows = self.output("assimilation", 3) if self.assimilation is not None else self.planned(3)
        write_xml(rows, folder / "constraints.vtp")
        write_bodies(self.pipeline, Place)

    def show(self, view: Any = None) -> Any:
        """The bodies, the obstacles, the paths and the marks in a view of ParaView (default: the active one, or a new one); the
        animation of the session then has the frames of the scene. Returns the view."""
        from waft.run.showing import show

        return show(self, view)[0]

    def __repr__(self) -> str:
        objects, frames, _ = self.positions.shape
        met = int(np.sum(self.marks["status"] == "met"))
        return (f"<Result of {os.path.basename(self.scene_file)}: {objects} objects, {frames} frames, "
                f"{met} of {len(self.marks)} marks met>")

    def _repr_html_(self) -> str:
        """For notebooks: a still and the table of marks."""
        try:
            with tempfile.TemporaryDirectory(prefix="waft-still-") as folder:
                path = pathlib.Path(folder) / "still.png"
                self.render(path)
                still = f'<img src="data:image/png;base64,{base64.b64encode(read_bytes(path)).decode()}" alt="the last frame"/>'
        except WaftError as error:
            still = f"<p>{in_html(str(error))}</p>"
        marks = sorted(self.marks.tolist(), key=lambda mark: mark[5] == "met")
        head = "".join(f"<th>{name}</th>" for name, _ in _MARK)
        rows = "".join("<tr>" + "".join(f"<td>{in_html(f'{cell:.3g}' if isinstance(cell, float) else str(cell))}</td>"
                                        for cell in mark) + "</tr>" for mark in marks[:_MOST_MARKS])
        more = f"<p>and {len(marks) - _MOST_MARKS} more, all in run.marks</p>" if len(marks) > _MOST_MARKS else ""
        return f"<p>{in_html(repr(self)[1:-1])}</p>{still}<table><tr>{head}</tr>{rows}</table>{more}"


Run = Result  # the name that it had


@contextlib.contextmanager
def _display():
    """The display that there is, or a virtual one for now."""
    from waft.display import display

    if os.environ.get("DISPLAY"):
        yield
        return
    before = {name: os.environ.get(name) for name in ("DISPLAY", "XAUTHORITY")}
    try:
        with display() as is_there:
            if not is_there:
                raise WaftError("stopped before there was a virtual display")
            yield
    except OSError as error:
        raise WaftError(f"rendering needs a display, or Xvfb for a virtual one: {error}") from error
    finally:
        for name, value in before.items():
            os.environ.pop(name, None)
            if value is not None:
                os.environ[name] = value
