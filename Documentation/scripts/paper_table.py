# SPDX-License-Identifier: BSD-3-Clause
"""Prints what the paper says of its results beside what a run of quality `paper` has, as a table of a page.

    pvpython paper_table.py DIR...          folders of `waft synthesize --quality paper`

A column a folder, named after its scene. The paper has six unknowns a particle, Waft six a gas particle and six an object, whose
particles go along. Counts of particles are those that were seen where the folder has them (`--particles`),
and otherwise what the optimiser makes by default. Forces are root mean squares along the paths while the bodies move.
"""
import csv
import datetime
import json
import math
import pathlib
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLPolyDataReader

GAS, OBJECTS = 2500, 125  # particles, by default; an object has one to five
FULL_WIDTH = 2.0 * math.sqrt(2.0 * math.log(2.0))  # at half of the maximum, in standard deviations
STILL = 1e-9  # m/s


def read(path, reader):
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def values(attributes, name):
    return vtk_to_numpy(attributes.GetArray(name)).astype(float)


def diameter(length, core):
    """Twice the radius where the acceleration of Eq. 13, its denominator regularised, falls to half of its maximum half way
    between the poles."""
    radii = np.linspace(0.0, 4.0 * core + length, 20001)[1:]
    strength = radii / np.sqrt(radii**2 + length**2 / 4.0) / (radii**2 + core**2)
    return 2.0 * radii[np.nonzero(strength >= strength.max() / 2.0)[0][-1]]


def rms(vectors):
    return float(np.sqrt((vectors**2).sum(axis=-1).mean()))


def particles(folder, objects):
    """Numbers of gas and of object particles, and whether they were counted."""
    files = sorted((folder / "particles").glob("*.vtp"))
    if files:
        kinds = values(read(files[0], vtkXMLPolyDataReader()).GetPointData(), "Kind")
        return int((kinds == 0).sum()), int((kinds == 1).sum()), True
    return GAS, objects * min(max(OBJECTS // objects, 1), 5), False


def vortices(folder, width):
    data = read(folder / "vortices.vtp", vtkXMLPolyDataReader())
    if data.GetNumberOfCells() == 0:
        return "none", "-", "-"
    poles = vtk_to_numpy(data.GetPoints().GetData()).astype(float).reshape(-1, 2, 3)
    lengths = np.linalg.norm(poles[:, 1] - poles[:, 0], axis=1)
    wide = [diameter(*size) / width for size in zip(lengths, values(data.GetCellData(), "CoreRadius"))]
    lasts = FULL_WIDTH * values(data.GetCellData(), "Duration")
    return str(len(lengths)), f"{lasts.mean():.1f} s ({lasts.min():.1f} to {lasts.max():.1f})", \
        f"{np.mean(wide):.2f} ({min(wide):.2f} to {max(wide):.2f})"


def wind_changes(folder, frames_per_second):
    """What the wind of a place becomes within half a second, and a node of its lattice farther, over its root mean square."""
    files = sorted((folder / "wind").glob("*.vti"))[::round(frames_per_second / 2)]
    images = [read(file, vtkXMLImageDataReader()) for file in files]
    shape = (*reversed(images[0].GetDimensions()), 3)
    field = np.array([values(image.GetPointData(), "Wind").reshape(shape) for image in images])
    steps = [field[:, 1:] - field[:, :-1], field[:, :, 1:] - field[:, :, :-1], field[:, :, :, 1:] - field[:, :, :, :-1]]
    apart = math.sqrt(np.mean([rms(step)**2 for step in steps]))
    return f"{rms(field[1:] - field[:-1]) / rms(field):.2f}, {apart / rms(field):.2f}"


def rises(folder):
    """Within a stage, how often E grew from one iteration to the next, of how many."""
    with open(folder / "convergence.csv", encoding="utf-8", newline="") as file:
        rows = [((row["Pass"], row["Stage"]), float(row["E"])) for row in csv.DictReader(file)]
    pairs = [(before[1], after[1]) for before, after in zip(rows, rows[1:]) if before[0] == after[0]]
    return f"{sum(after > before for before, after in pairs)} of {len(pairs)}"


def column(folder):
    """{what: what it is in a folder}, in the order of ROWS."""
    report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    if report["quality"] != "paper":
        raise SystemExit(f"{folder}: expected a result of quality paper, found {report['quality']}")
    tracks = read(folder / "optimized.vtp", vtkXMLPolyDataReader())
    fields, points = tracks.GetFieldData(), tracks.GetPointData()
    bounds = values(fields, "Bounds")
    objects = tracks.GetNumberOfCells()
    gas, own, are_counted = particles(folder, objects)
    moves = np.linalg.norm(values(points, "Velocity"), axis=1) > STILL
    whirl, wind = (rms(values(points, f"{name}Acceleration")[moves]) for name in ("Vortex", "Wind"))
    number, lasts, wide = vortices(folder, max(bounds[1] - bounds[0], bounds[3] - bounds[2]))
    seconds = {name: stage["processorSeconds"] for name, stage in report["stages"].items()}
    is_whole = "planner" in seconds  # not one that was gone on with, whose first part nobody counted
    about = "" if are_counted else " (default)"
    return report["scene"].split(".")[0], [
        str(objects),
        f"{gas}{about}",
        f"{own}{about}",
        f"{6 * (gas + objects)}",
        f"{6e-6 * (gas + objects) * fields.GetArray('NumberOfFrames').GetValue(0):.1f} million",
        number,
        f"{whirl:.2f} : {wind:.2f} m/s^2",
        wind_changes(folder, fields.GetArray("FramesPerSecond").GetValue(0)),
        lasts,
        wide,
        f"{report['energy']['after'] / report['energy']['before']:.3f}",
        rises(folder),
        f"{seconds['planner']:.1f} s" if is_whole else "-",
        f"{seconds['spacetime']:.0f} s" if is_whole else "-",
    ]


ROWS = (
    ("objects", "1 to some dozens"),
    ("gas particles", "2500"),
    ("object particles", "125"),
    ("unknowns a frame", "15750"),
    ("unknowns of all frames", "4.7 million of 300"),
    ("vortices", "-"),
    ("strength of vortices : of the wind, at the objects", "same order"),
    ("change of the wind in half a second, and from node to node, over its rms", "smooth"),
    ("duration of a vortex, full width at half maximum", "about 7 s"),
    ("diameter of a vortex, in widths of the volume", "about one third"),
    ("E after, of E before", "-"),
    ("iterations at which E grew within a stage", "none"),
    ("planning, processor time", "under 15 min (one object), 2 h"),
    ("optimisation, processor time", "2 h (one object), 5 h"),
)


def lines(columns):
    """The table, of (scene, cells) of each column."""
    yield "| what | the paper says | " + " | ".join(name for name, _ in columns) + " |"
    yield "|---" * (2 + len(columns)) + "|"
    for number, (what, said) in enumerate(ROWS):
        yield f"| {what} | {said} | " + " | ".join(cells[number] for _, cells in columns) + " |"


def main(folders):
    print(f"{datetime.date.today()}:\n")
    print("\n".join(lines([column(pathlib.Path(folder)) for folder in folders])))


if __name__ == "__main__":
    main(sys.argv[1:])
