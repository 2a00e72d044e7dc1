# SPDX-License-Identifier: BSD-3-Clause
"""Figs. 4 to 9 of the paper beside ours, in quality `paper` and in `full`: pictures, the rows of `waft measure`, and the table of
paper_table.py. Writes these sections of Documentation/Paper.md.

PYTHONPATH=build/lib/python3/dist-packages xvfb-run -a -s "-screen 0 1280x1024x24" \\
  pvbatch Documentation/scripts/make_paper_figures.py [--into FOLDER] DIR...

DIR: what `waft synthesize` wrote of a scene of FIGURES in either quality. A few are enough: what each of them came to is kept in
gallery/figures.json, and the page is written from all that is kept there. Where nothing is kept of a scene, it has the picture of
the page on scenes. FOLDER: what stands for Documentation; it has a Paper.md.
"""
import argparse
import datetime
import json
import pathlib
import re
import textwrap

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
             "cost": make_measure_table.cost(folder, measured["tracks"])}
    if quality == "paper":
        entry["table"] = paper_table.column(folder)[1]
    return scene, quality, entry


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
                "in which its bodies could have a residual control, and AUC takes scikit-learn.")
    columns = [column for column in make_measure_table.OPTIMISED if column[0] != "wind's force"]
    rows = ["| scene, quality | objects | " + " | ".join(name for name, _ in columns) + " | CPU s, MB | flown |", "|---" * (len(columns) + 4) + "|"]
    for scene, quality, entry in flown(kept):
        cells = [", ".join(make_measure_table.figure(entry["rows"].get(key)) for key in keys) for _, keys in columns]
        rows.append(f"| {scene}, `{quality}` | {entry['objects']} | " + " | ".join(cells) + f" | {entry['cost']} | {entry['date']} |")
    yield "\n".join(rows)


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
