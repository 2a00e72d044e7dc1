# SPDX-License-Identifier: BSD-3-Clause
"""A run as a picture, and as a cell of a notebook."""
import base64
import contextlib
import html
import os
import pathlib
import tempfile
from typing import TYPE_CHECKING, Any, Callable, ContextManager, Dict, Iterator, Optional, Tuple

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from waft.failures import InputError, WaftError
from waft.reading import read_bytes
from waft.run.request import Path
from waft.texts import in_html

if TYPE_CHECKING:
    from numpy.typing import NDArray

_MOST_MARKS = 40  # in a notebook's table; those that are not met first
_MOST_PAGE = 64 << 20  # bytes of a page within a notebook, which keeps it
# The page is an interactive part of the notebook and no part of its session: it cannot reach what is about it.
_FRAME = '<iframe sandbox="allow-scripts" srcdoc="{}" title="{}" style="width: 100%; height: 560px; border: 0"></iframe>'


def still(drawn: Callable[[], ContextManager[Any]], count: int, who: str, path: Optional[Path], frame: Optional[int], size: Tuple[int, int], view: str,
          options: Dict[str, Any]) -> "NDArray[np.uint8]":
    """See Run.render. drawn: gives what is drawn, for a while; who: is named by errors."""
    from waft.files import whole_file
    from waft.render import Stage
    from waft.render._output import write_png
    from waft.render._styles import STYLES, VIEWS

    frame = checked_frame(frame, count, f"{who}.render")
    if view not in VIEWS:
        raise InputError(f"{who}.render: view: expected one of {', '.join(VIEWS)}, found {view!r}")
    if options.get("style", "day") not in STYLES:
        raise InputError(f"{who}.render: style: expected one of {', '.join(STYLES)}, found {options['style']!r}")
    if len(size) != 2 or min(size) < 16 or max(size) > 16384:
        raise InputError(f"{who}.render: size: expected width and height from 16 to 16384, found {size!r}")
    if path is not None and pathlib.Path(path).suffix != ".png":
        raise InputError(f"{who}.render: path: expected a name that ends with .png, found {os.fspath(path)!r}")
    with _display(), drawn() as motion:
        stage = Stage(motion, size, **options)
        picture = stage.draw(view, frame)
        del stage  # its window goes before the display does
    if path is not None:
        with whole_file(os.fspath(path), lambda path: True) as part:
            write_png(picture, part)
    width, height, _ = picture.GetDimensions()
    return vtk_to_numpy(picture.GetPointData().GetScalars()).reshape(height, width, -1)[::-1].copy()


def checked_frame(frame: Optional[int], count: int, who: str) -> int:
    """The number of a frame, the last where none is given."""
    frame = count - 1 if frame is None else frame
    if isinstance(frame, bool) or not isinstance(frame, (int, np.integer)) or not 0 <= frame < count:
        raise InputError(f"{who}: frame: expected a whole number from 0 to {count - 1}, found {frame!r}")
    return int(frame)


def cell(run: Any) -> str:
    """What a notebook shows: the page in a frame, the table of marks, and a still, which is there as well where frames are left out."""
    try:
        page = run._page()
        if len(page) > _MOST_PAGE:
            raise WaftError(f"its page would take {len(page) >> 20} MB of this notebook: run.page(path) writes it as a file")
        shown = _FRAME.format(html.escape(page), in_html(repr(run)[1:-1]))
    except WaftError as error:
        shown = f"<p>{in_html(str(error))}</p>"
    return (f"<p>{in_html(repr(run)[1:-1])}</p>{shown}{_table(run.marks)}<details><summary>the last frame</summary>{_still_in_html(run)}"
            "</details>")


def _still_in_html(run):
    try:
        with tempfile.TemporaryDirectory(prefix="waft-still-") as folder:
            path = pathlib.Path(folder) / "still.png"
            run.render(path)
            return f'<img src="data:image/png;base64,{base64.b64encode(read_bytes(path)).decode()}" alt="the last frame"/>'
    except WaftError as error:
        return f"<p>{in_html(str(error))}</p>"


def _table(marks):
    head = "".join(f"<th>{name}</th>" for name in marks.dtype.names)
    ordered = sorted(marks.tolist(), key=lambda mark: mark[5] == "met")
    rows = "".join("<tr>" + "".join(f"<td>{in_html(f'{value:.3g}' if isinstance(value, float) else str(value))}</td>"
                                    for value in mark) + "</tr>" for mark in ordered[:_MOST_MARKS])
    more = f"<p>and {len(ordered) - _MOST_MARKS} more, all in run.marks</p>" if len(ordered) > _MOST_MARKS else ""
    return f"<table><tr>{head}</tr>{rows}</table>{more}"


@contextlib.contextmanager
def _display() -> Iterator[None]:
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
