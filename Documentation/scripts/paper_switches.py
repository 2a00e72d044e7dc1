# SPDX-License-Identifier: BSD-3-Clause
"""Flies a scene in quality `paper` with what the paper has and no quality runs, with more coefficients of the wind and such as
cost less, and with gas that keeps its eddies longer, one switch at a time, and prints a table.

    pvpython paper_switches.py SCENE FOLDER [NAME...]      names: those of SWITCHES; default: all

A run is kept in FOLDER/NAME and taken from there when it is there, as is the database of a box; one that was stopped goes on.
FOLDER must be. Each is held against `as it is`, the closed box against `open box`: both plan with a database of three simulations
of the same random forces, which takes 7 GB. Twice the lattice takes 4 GB, and half an hour of processor time or more.

A second table has what the first solve for the fields does in those that have the fields alone otherwise (FIELDS). Until then
their motion is the same to the bit.
"""
import csv
import json
import math
import pathlib
import sys

from paraview import simple
from paraview.simple import OutputPort

import waft

AXES = ("BoundaryX", "BoundaryY", "BoundaryZ")
SWITCHES = {  # what is set of which stage
    "as it is": {},
    "Eq. 5": {"Rotation": {"Model": "Paper"}},
    "XSPH": {"Spacetime": {"XsphFactor": 0.5}},
    "gamma 7": {"Spacetime": {"PressureExponent": 7.0}},
    "gas at rest": {"Spacetime": {"MoveGas": 0}},
    "windows": {"Spacetime": {"WindowLength": 75}},
    "open box": {"Smoke": {}},
    "closed box": {"Smoke": {axis: "Closed" for axis in AXES}},
    "ridge x 0.1": {"Spacetime": {"FieldRidge": 0.005}},
    "lattice x 2": {"Spacetime": {"WindCells": 10}},
    "softer gas": {"Spacetime": {"Viscosity": 0.02, "CourantNumber": 0.2, "SmoothingLength": 1.4}},
}
FIELDS = ("as it is", "ridge x 0.1", "lattice x 2")
ROWS = ("hidden_hand", "hidden_hand_gas", "replay", "life_velocity", "life_acceleration", "exact")
COLUMNS = ("run", "E", "E2", "fields explain: solved for, left out", "model residual: objects, gas", "forward replay",
           "variance v; a", "exact", "turned by, rad/s", "CPU s")
FIRST = ("run", "E before, after the first solve", "Ev left by it: all, objects")


def make_database(path, settings):
    """Of three simulations, as MotionDatabaseSource makes one of its own, but by stages with these properties of the smoke."""
    smokes = [simple.GridSmokeSource(Seed=seed, **settings) for seed in (1, 2, 3)]
    forces = [OutputPort(smoke, 1) for smoke in smokes]
    tracers = [simple.TrajectoryTraceFilter(Input=smoke, Vortices=force, Obstacles=OutputPort(smoke, 2))
               for smoke, force in zip(smokes, forces)]
    database = simple.TrajectoryClusterFilter(Input=tracers, Vortices=forces)
    simple.SaveData(str(path), proxy=database, DataMode="Binary")
    for stage in (database, *tracers, *smokes):
        simple.Delete(stage)


def fly(scene, folder, settings):
    if (folder / "report.json").exists() and not json.loads((folder / "report.json").read_text(encoding="utf-8"))["stoppedEarly"]:
        return
    database = None
    if "Smoke" in settings:
        database = folder.with_name(f"{folder.name}.vtm")
        if not database.exists():
            make_database(database, settings["Smoke"])
    own = {stage: properties for stage, properties in settings.items() if stage != "Smoke"}  # the database has those of the smoke
    waft.synthesize(scene, output=folder, database=database, quality="paper", resume=folder.exists(), _settings=own).delete()


def turning(folder):
    """Root mean square of the bodies' angular velocities."""
    lines = (folder / "poses.csv").read_text(encoding="utf-8").splitlines()
    first = lines[0].split(",").index("wx")
    squares = [sum(float(w) ** 2 for w in line.split(",")[first:first + 3]) for line in lines[1:]]
    return (sum(squares) / len(squares)) ** 0.5


def convergence(folder):
    with open(folder / "convergence.csv", newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def first_solve(name, folder):
    lines = convergence(folder)
    solve = next(n for n, line in enumerate(lines) if line["Stage"].startswith("fields"))
    before, after = ({key: float(line[key]) for key in ("E", "Ev", "EvObjects")} for line in lines[solve - 1:solve + 1])
    left = ", ".join(f"{after[key] / before[key]:.3f}" for key in ("Ev", "EvObjects"))
    return f"| {name} | {before['E']:.3g}, {after['E']:.3g} | {left} |"


def row(name, folder):
    report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    e2 = float(convergence(folder)[-1]["E2"])
    found = {entry.key: entry.value for entry in waft.measure(folder)[0].rows}
    figures = ["-" if math.isnan(found.get(key, math.nan)) else f"{found[key]:.2g}" for key in ROWS]
    seconds = sum(stage["processorSeconds"] for stage in report["stages"].values())
    explained = ", ".join(f"{part:.3f}" for part in report.get("fieldsExplained", {}).get("all", {}).values()) or "-"
    cells = (name, f"{report['energy']['after']:.3g}", f"{e2:.3g}", explained, ", ".join(figures[:2]), figures[2],
             "; ".join(figures[3:5]), figures[5], f"{turning(folder):.2g}", f"{seconds:.0f}")
    return "| " + " | ".join(cells) + " |"


def head(columns):
    print("| " + " | ".join(columns) + " |")
    print("|" + "---|" * len(columns))


def main(scene, folder, *names):
    names = names or SWITCHES
    folder = pathlib.Path(folder)
    head(COLUMNS)
    for name in names:
        fly(scene, folder / name, SWITCHES[name])
        print(row(name, folder / name), flush=True)
    print()
    head(FIRST)
    for name in filter(FIELDS.__contains__, names):
        print(first_solve(name, folder / name))


if __name__ == "__main__":
    main(*sys.argv[1:])
