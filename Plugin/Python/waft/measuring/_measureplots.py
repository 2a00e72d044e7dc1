# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a motion's figures beside the drifters'."""
import io
import os
import pathlib

import numpy as np

from waft.files import check_target, whole_file, write_bytes
from waft.marks import is_marked_png, marked_png
from waft.measuring import _flights
from waft.results import check_folder


def check_pictures(names, tracks, folder):
    """Raises InputError where a picture cannot be written in a folder, or would take the place of what this did not draw."""
    check_folder(folder)
    for name in names if os.path.isdir(folder) else ():
        check_target(_path(name, tracks, folder), is_marked_png)


def _path(name, tracks, folder):
    name = pathlib.Path(name).resolve().name if name != "pooled" else "pooled"
    return os.path.join(folder, f"{name}-{tracks}.png")


def draw(measured, folder):
    """Writes FOLDER/<name>.png; returns sentences about what could not be drawn."""
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ImportError:
        return ["no plots: matplotlib (python3-matplotlib) is not installed"]
    os.makedirs(folder, exist_ok=True)
    figure = Figure(figsize=(15.0, 8.5))
    FigureCanvasAgg(figure)
    panels = figure.subplots(2, 3).ravel()
    kinds = ((measured.tracks, measured.airs, "tab:red"), ("drifters", measured.others, "tab:blue"))
    for label, airs, color in kinds:
        _distribution(panels[0], airs, "velocity", label, color)
        _distribution(panels[1], airs, "acceleration", label, color)
        _spectrum(panels[2], measured, airs, label, color)
        _structure(panels[3], airs, label, color)
        _heights(panels[4], airs, label, color)
    for panel, title, x, y in zip(panels, ("speed", "acceleration", "spectrum of velocity", "S2(r) / 2 var", "vertical speed"),
                                  ("|v| [m/s]", "|a| [m/s²]", "f [Hz]", "r [m]", "height above the ground [m]"),
                                  ("density", "density", "[m²/s]", "", "mean and deviation [m/s]")):
        panel.set(title=title, xlabel=x, ylabel=y)
        panel.legend()
    panels[5].axis("off")
    figure.suptitle(f"{measured.name}: {measured.tracks}")
    figure.tight_layout()
    made = io.BytesIO()
    figure.savefig(made, format="png", dpi=80)
    with whole_file(_path(measured.name, measured.tracks, folder), is_marked_png) as part:
        write_bytes(part, marked_png(made.getvalue()))
    return []


def _free(airs, name):
    return np.concatenate([getattr(air, name)[air.free] for air in airs])


def _distribution(panel, airs, name, label, color):
    sizes = np.linalg.norm(_free(airs, name), axis=1)
    if len(sizes):
        panel.hist(sizes, bins=60, range=(0.0, float(np.percentile(sizes, 99.5))), density=True, histtype="step", label=label,
                   color=color)


def _spectrum(panel, measured, airs, label, color):
    for seconds in (4.0, 3.0, 2.0, 1.0):
        found = [_flights.spectrum(each, seconds) for each in (measured.airs, measured.others)]
        if all(each is not None for each in found):
            frequencies, density = _flights.spectrum(airs, seconds)
            panel.loglog(frequencies, density, label=label, color=color)
            return


def _structure(panel, airs, label, color):
    if min(len(air) for air in airs) > 1:
        values, _ = _flights.structure(airs)
        panel.plot(0.5 * (_flights.DISTANCES[1:] + _flights.DISTANCES[:-1]), values, "o-", label=label, color=color)
        panel.set_ylim(0.0, None)


def _heights(panel, airs, label, color):
    floor = min(float(np.nanmin(air.positions[..., 2])) for air in airs)
    height = np.concatenate([air.positions[air.inside][:, 2] for air in airs]) - floor
    speed = np.concatenate([air.velocity[air.inside][:, 2] for air in airs])
    edges = np.linspace(0.0, max(height.max(initial=1.0), 0.1), 17)
    place = np.digitize(height, edges) - 1
    known = [i for i in range(16) if np.count_nonzero(place == i) > 10]
    panel.errorbar([0.5 * (edges[i] + edges[i + 1]) for i in known], [speed[place == i].mean() for i in known],
                   [speed[place == i].std() for i in known], fmt="o-", capsize=2, label=label, color=color)
