# SPDX-License-Identifier: BSD-3-Clause
"""Prints the rows of `waft measure` for several scenes as a table of a page.

    waft measure DIR --json SCENE.json        for each folder of results
    python3 make_measure_table.py [--optimised] SCENE.json...

With --optimised the residuals of the optimiser's model are shown in place of what the air alone brings about. A line a scene, named
after its file; what misses what is wanted is in **bold**, what is not measured is "-".
Processor seconds and the largest memory are of the folder's report.json, where it is still there.
"""
import json
import pathlib
import sys

COLUMNS = (
    ("control", ("control", "control_all")),
    ("let go 1 s: median, 90th; whole", ("replay_last", "replay_last_90", "replay_whole")),
    ("rush; stationary", ("rush", "stationary")),
    ("variance v; a", ("life_velocity", "life_acceleration")),
    ("AUC", ("told_apart",)),
    ("agreement", ("agreement", "agreement_90")),
    ("slip", ("slip",)),
    ("landing; sd, s", ("landing", "landing_times")),
    ("cuts", ("cuts",)),
    ("exact", ("exact",)),
)
OPTIMISED = (
    ("model residual: objects, gas", ("hidden_hand", "hidden_hand_gas")),
    ("residual control", ("private_hand",)),
    ("forward replay", ("replay",)),
    ("variance v; a", ("life_velocity", "life_acceleration")),
    ("energy in four bands", ("band_0.1", "band_0.3", "band_0.6", "band_1.2")),
    ("S2; 3 S_L / S", ("one_air", "one_air_along")),
    ("AUC", ("told_apart",)),
    ("start: a; jerk", ("start", "start_jerk")),
    ("landing; sd, s", ("landing", "landing_times")),
    ("exact", ("exact",)),
)


def figure(row, small=False):
    """The value of a row in two digits, bold where it misses; "-" where it is not measured. small: those below a tenth, too."""
    value = None if row is None else row["value"]
    if value is None:
        return "-"
    text = f"{value:.0e}" if 0.0 < abs(value) < 1e-3 else f"{value:.2f}" if abs(value) < 9.995 else f"{value:.0f}"
    text = "0" if value == 0.0 else f"{value:.2g}" if small and 1e-3 <= abs(value) < 0.1 else text
    return text if row["met"] is not False else f"**{text}**"


def cost(folder, tracks):
    """Processor seconds and megabytes of the run, of its report; of what the optimiser began with the seconds until then."""
    try:
        stages = json.loads((pathlib.Path(folder) / "report.json").read_text(encoding="utf-8"))["stages"]
    except (OSError, KeyError, ValueError):
        return "-"
    if tracks == "assimilated" and stages.pop("spacetime", None):
        return f"{sum(stage['processorSeconds'] for stage in stages.values()):.0f}, -"
    seconds = sum(stage["processorSeconds"] for stage in stages.values())
    return f"{seconds:.0f}, {max(stage['peakMemoryMB'] for stage in stages.values()):.0f}"


def main(arguments):
    optimised = "--optimised" in arguments
    files = [file for file in arguments if file != "--optimised"]
    columns = OPTIMISED if optimised else COLUMNS
    heads = ["scene", "objects", *(name for name, _ in columns), "CPU s, MB"]
    print("| " + " | ".join(heads) + " |")
    print("|" + "---|" * len(heads))
    for file in files:
        measured = json.loads(pathlib.Path(file).read_text(encoding="utf-8"))[0]
        rows = {row["key"]: row for row in measured["rows"]}
        cells = [", ".join(figure(rows.get(key), not optimised) for key in keys) for _, keys in columns]
        print("| " + " | ".join([pathlib.Path(file).stem, str(measured["objects"]), *cells, cost(measured["folder"], measured["tracks"])]) + " |")


if __name__ == "__main__":
    main(sys.argv[1:])
