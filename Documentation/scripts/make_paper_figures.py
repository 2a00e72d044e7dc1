# SPDX-License-Identifier: BSD-3-Clause
"""Figs. 4 to 9 of the paper beside ours, in quality `paper` and in `full`: pictures, the rows of `waft measure`, and the table of
paper_table.py. Writes these sections of Documentation/Paper.md.

PYTHONPATH=build/lib/python3/dist-packages xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" \\
  pvbatch Documentation/scripts/make_paper_figures.py [--into FOLDER] DIR...

DIR: what `waft synthesize` wrote of a scene of FIGURES in either quality. A few are enough: what each of them came to is kept in
gallery/figures.json, and the page is written from all that is kept there. Where nothing is kept of a scene, it has the picture of
the page on scenes. FOLDER: what stands for Documentation; it has a Paper.md.
"""
import argparse
import datetime
import json
import math
import pathlib
import re
import textwrap

import numpy as np
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

import waft

import make_measure_table
import make_scene_pictures
import paper_table

DOCUMENTATION = pathlib.Path(__file__).resolve().parents[1]
FIGURES = (
    ("Fig. 4, above: two examples of single object motion that satisfies two intermediate position constraints.",
     ("feather-waypoints-a", "feather-waypoints-b")),
    ("Fig. 4, below: two examples with a partially constrained trajectory.", ("feather-spiral-a", "feather-spiral-b")),
    ("Fig. 5: stylistic path planning with obstacle (maze) avoidance.", ("feather-maze",)),
    ("Fig. 6: leaves fall onto the ground, forming letters.", ("leaves-letters",)),
    ("Fig. 7: leaves form different shapes in the air.", ("leaves-shapes",)),
    ("Fig. 8: leaves form shapes on the ground after being disturbed by external forces.", ("leaves-disturbed",)),
    ("Fig. 9: feathers fall onto the ground, forming a pattern similar to a painting.", ("feathers-painting",)),
)
SCENES = [scene for _, scenes in FIGURES for scene in scenes]
QUALITIES = ("paper", "full")
SLACK = 1.05  # a row of `full` that misses what is wanted may miss it by so much more than the same of the air does
MOVED = 1e-3  # m
LIKELIHOOD = 0.03  # what AUC may be more, for it is never below a half
COLUMNS = [("forward replay; by the air alone", (*keys, "drift")) if name == "forward replay" else (name, keys)
           for name, keys in make_measure_table.OPTIMISED]
PICTURES, MEASURES, TABLE = "In both qualities", "Measured", "The paper says, Waft has"


def taken(folder, into):
    """(scene, quality, what is kept of a folder); draws its picture."""
    report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    scene, quality = report["scene"].split(".")[0], report["quality"]
    if scene not in SCENES or quality not in QUALITIES:
        raise SystemExit(f"{folder}: expected a scene of Figs. 4 to 9 in quality paper or full, found {scene} in {quality}")
    if report["stoppedEarly"]:
        raise SystemExit(f"{folder}: expected a run that went to its end, found one that was stopped; --resume goes on with it")
    make_scene_pictures.draw_moments(folder, into / "gallery" / f"figure_{scene}_{quality}.png")
    measured = waft.measure(folder)[0].as_json()
    entry = {"date": datetime.date.fromtimestamp((folder / "report.json").stat().st_mtime).isoformat(), "objects": measured["objects"],
             "rows": {row["key"]: {"value": row["value"], "met": row["met"]} for row in measured["rows"]},
             "cost": cost(folder)}
    if quality == "paper":
        entry["table"] = paper_table.column(folder)[1]
        entry["explained"] = {**report.get("fieldsExplained", {}), "vortices": report["forces"]["vortices"].get("part")}
    else:
        entry["beside"] = beside(folder, measured["rows"], report["dynamics"])
    return scene, quality, entry


def places(path):
    """Objects x frames x 3."""
    tracks = paper_table.read(path, vtkXMLPolyDataReader())
    return paper_table.vtk_to_numpy(tracks.GetPoints().GetData()).reshape(tracks.GetNumberOfCells(), -1, 3)


def is_worse(row, before):
    """Whether a row misses what is wanted, and by more than SLACK of what it was."""
    if row["met"] is not False or before["value"] is None:
        return row["met"] is False
    low, high = (end if end is not None else side * math.inf for end, side in zip(row["wanted"], (-1, 1)))
    value, was = row["value"], before["value"]
    more = was + LIKELIHOOD if row.get("key") == "told_apart" else SLACK * was
    return value > max(high, more) if value > high else value < min(low, was / SLACK)


def like_air(rows, of_air):
    """The rows of an optimised motion as those of an air are: bodies that are let go drift in it alone, in both."""
    drift = next(row["value"] for row in rows if row["key"] == "drift")
    low, high = of_air["replay"]["wanted"]
    replay = {**of_air["replay"], "value": drift, "met": None if drift is None else low <= drift <= high}
    return [replay if row["key"] == "replay" else row for row in rows if row["key"] != "drift"]


def cost(folder, *without):
    """Processor seconds and those by the clock, of which a busy machine has more, of all stages but some; and megabytes at most of
    the run, where it is counted whole."""
    stages = json.loads((folder / "report.json").read_text(encoding="utf-8"))["stages"]
    seconds = [sum(stage[kind] for name, stage in stages.items() if name not in without) for kind in ("processorSeconds", "seconds")]
    most = "-" if without else f"{max(stage['peakMemoryMB'] for stage in stages.values()):.0f}"
    return f"{seconds[0]:.0f}, {seconds[1]:.0f}, {most}"


def beside(folder, rows, dynamics):
    """What the optimiser of `full` changed in the air's own motion, and what its gas came to."""
    air = waft.measure(folder, tracks="assimilated")[0].as_json()
    of_air = {row["key"]: row for row in air["rows"]}
    lengths = np.linalg.norm(places(folder / "optimized.vtp") - places(folder / "assimilated.vtp"), axis=2).max(axis=1)
    return {"worse": [[row["row"].partition(":")[0], row["value"], of_air[row["key"]]["value"]]
                      for row in like_air(rows, of_air) if is_worse(row, of_air[row["key"]])],
            "rows": {key: {"value": row["value"], "met": row["met"]} for key, row in of_air.items()},
            "moved": int((lengths > MOVED).sum()), "farthest": float(lengths.max()),
            "gas": [dynamics["gasReplayError"], dynamics["gasHiddenHand"]], "cost": cost(folder, "spacetime", "fit")}


def prose(text):
    return textwrap.fill(text, 118, break_long_words=False, break_on_hyphens=False)


def pictures(kept):
    yield prose("Four moments each, the same of both qualities; the captions are the paper's, the cameras ours. Where one is \"-\", the scene was "
                "not flown in `full` for this page; its picture in `paper` is then that of [Scenes](gallery/Scenes.md).")
    for caption, scenes in FIGURES:
        yield f"*{caption}*"
        rows = ["| scene, quality | picture |", "|---|---|"]
        for scene in scenes:
            for quality in QUALITIES:
                name = f"figure_{scene}_{quality}" if quality in kept.get(scene, {}) else f"scene_{scene}" if quality == "paper" else ""
                rows.append(f"| {scene}, `{quality}` | " + (f"![{scene} in {quality}](gallery/{name}.png) |" if name else "- |"))
        yield "\n".join(rows)


def flown(kept, qualities=QUALITIES):
    return [(scene, quality, kept[scene][quality]) for scene in SCENES for quality in qualities if quality in kept.get(scene, {})]


def measures(kept):
    yield prose("By `waft measure`; what misses [what is wanted](Measure.md) is in **bold**, \"-\" is not measured: quality `paper` has no air, "
                "in which its bodies could have a residual control, and AUC takes scikit-learn. Where seconds by the clock are many times those of "
                "the processor, other programs ran, and those of the processor are more than they need be.")
    rows = ["| scene, quality | objects | " + " | ".join(name for name, _ in COLUMNS) + " | CPU s, s by the clock, MB | flown |",
            "|---" * (len(COLUMNS) + 4) + "|"]
    for scene, quality, entry in flown(kept):
        lines = [(quality, entry)]
        if "beside" in entry:
            lines.insert(0, ("air", {**entry["beside"], "objects": entry["objects"], "date": entry["date"]}))
        for name, of in lines:
            cells = [", ".join(make_measure_table.figure(of["rows"].get(key)) for key in keys) for _, keys in COLUMNS]
            rows.append(f"| {scene}, `{name}` | {of['objects']} | " + " | ".join(cells) + f" | {of['cost']} | {of['date']} |")
    yield "\n".join(rows)
    yield prose("What the optimiser does in `full`: how many bodies it moved by more than a millimetre, and the farthest; its gas; and the rows "
                f"that miss what is wanted by more than {SLACK} of what they were in `air` (in brackets). There bodies that are let go drift in the "
                "air alone, in both.")
    rows = ["| scene | bodies moved, farthest | gas: forward replay, model residual | rows worse than in `air` |", "|---|---|---|---|"]
    for scene, _, entry in flown(kept, ("full",)):
        if (of := entry.get("beside")) is not None:
            worse = "; ".join(f"{name} {value:.2g} (" + ("-" if was is None else f"{was:.2g}") + ")" for name, value, was in of["worse"]) or "none"
            replay, residual = (f"{value:.2f}" if value >= 0.0 else "-" for value in of["gas"])
            rows.append(f"| {scene} | {of['moved']} of {entry['objects']}, {1000.0 * of['farthest']:.1f} mm | {replay}, {residual} | {worse} |")
    yield "\n".join(rows)
    yield prose("What the fields explain in `paper`, by the motion that it ends with: solved for anew without one object and one gas particle in "
                "five, of those that counted and of those left out (`fieldsExplained` of report.json); and what the vortices explain of the "
                "objects that a wind alone would not (`part`). \"-\": the flight did not tell it, or has too few objects.")
    rows = ["| scene | all: solved for, left out, ratio | objects | gas | vortices by drop-one |", "|---|---|---|---|---|"]
    for scene, _, entry in flown(kept, ("paper",)):
        if (of := entry.get("explained")) is not None:
            cells = [explained(**of.get(kind, {})) for kind in ("all", "objects", "gas")]
            rows.append(f"| {scene} | " + " | ".join(cells) + (f" | {of['vortices']:.3f} |" if of["vortices"] is not None else " | - |"))
    yield "\n".join(rows)


def explained(solved=None, leftOut=None):
    """What fields explain of those that they were solved for and of the others, and its ratio."""
    if solved is None or leftOut is None:
        return "-" if solved is None else f"{solved:.3f}, -"
    return f"{solved:.3f}, {leftOut:.3f}, {leftOut / solved:.2f}"


def table(kept):
    columns = [(scene, entry) for scene, _, entry in flown(kept, ("paper",))]
    dates = ", ".join(sorted({entry["date"] for _, entry in columns}))
    yield prose(f"By [paper_table.py](scripts/paper_table.py) from folders of quality `paper`, on a virtual machine with other work (AMD EPYC), "
                f"flown on {dates}:")
    yield "\n".join(paper_table.lines([(scene, entry["table"]) for scene, entry in columns]))
    yield prose("A vortex of the optimiser is wider than the paper's, since its core is at least 1.5 spacings of the gas wide, and gas "
                "follows nothing finer; those that drive the air of the database are 0.22 to 0.44 widths in diameter. "
                "The paper's hours are of an AMD 2100+.")
    yield "    pvpython Documentation/scripts/paper_table.py out"


def replaced(page, heading, paragraphs):
    """The page, with these in the section of a heading."""
    found = re.search(rf"^#+ {re.escape(heading)}\n.*?(?=^#+ |\Z)", page, re.DOTALL | re.MULTILINE)
    if found is None:
        raise SystemExit(f"Paper.md: expected a section named {heading!r}, found none")
    return page[:found.start()] + "\n\n".join([found.group().partition("\n")[0], *paragraphs]) + "\n" + "\n" * (found.end() < len(page)) + page[found.end():]


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--into", type=pathlib.Path, default=DOCUMENTATION)
    parser.add_argument("folders", nargs="*", type=pathlib.Path)
    options = parser.parse_args(arguments)
    file, page = options.into / "gallery" / "figures.json", options.into / "Paper.md"
    kept = json.loads(file.read_text(encoding="utf-8")) if file.is_file() else {}
    for folder in options.folders:
        scene, quality, entry = taken(folder, options.into)
        kept.setdefault(scene, {})[quality] = entry
    file.write_text(json.dumps(kept, indent=1, sort_keys=True) + "\n", encoding="utf-8")
    text = page.read_text(encoding="utf-8")
    for heading, paragraphs in ((PICTURES, pictures(kept)), (MEASURES, measures(kept)), (TABLE, table(kept))):
        text = replaced(text, heading, paragraphs)
    page.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
