#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Flies scenes and keeps how their bodies move, by `waft measure`, in gallery/bodies.json; writes gallery/Bodies.md from all that is
kept there.

    python3 Documentation/scripts/make_body_table.py RUNS [--waft build/bin/waft] [--quality air] [--seed N] [--threads N]
        [--date YYYY-MM-DD] [SCENE.waft.json ...]

Without scenes all of Data/Scenes and its examples are flown, small ones first. Results are folders RUNS/QUALITY/NAME; a finished one is
measured again, and not flown. RUNS may be without flights: then the page alone is written anew.
"""
import argparse
import datetime
import json
import os
import pathlib
import platform
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
GALLERY = ROOT / "Documentation" / "gallery"
KEPT = GALLERY / "bodies.json"
DONE = (0, 3)  # exit statuses of a whole result: all constraints met, or some named that could not be
COLUMNS = (
    ("kinks: step; \\|a\\|", ("mark_steps", "mark_pushes")),
    ("pairs", ("pairs",)),
    ("cuts; beside marks", ("cuts", "cuts_marks")),
    ("glide", ("glide",)),
    ("agreement: median; 90 %", ("agreement", "agreement_90")),
    ("turning: fast; at limit", ("turning", "turning_peak")),
    ("spacing; alignment", ("approach_spacing", "approach_alignment")),
    ("legibility; could be", ("legibility", "legibility_facing")),
    ("facing; push", ("facing", "facing_pushes")),
    ("exact", ("exact",)),
)
HEAD = """# How bodies move

Written by [make_body_table.py](../scripts/make_body_table.py), which flies scenes at their full size and measures what
comes. What is in **bold** misses what is wanted, "-" is not measured: a body alone has no neighbours, a scene without
texts or pictures nothing to be read.

| column | is | wanted |
|---|---|---|
| kinks | longest step at a mark over the 99.9th percentile elsewhere; 90th percentile of \\|a\\| there over the 99th elsewhere | <= 1.5; <= 1 |
| pairs | body-frames with a centre nearer than balls as wide would be, % | |
| cuts | body-frames with a mesh in another's, %; the same beside marks that leave no room | <= 0.1; |
| glide | correlation of gliding downhill with sin(2 tilt) | |
| agreement | degrees that poses are off what the air turns in half a second | <= 15; <= 45 |
| turning | steps of more than 25 degrees, %; within a degree of the limit, % | <= 5; <= 5 |
| spacing | distance to the nearest before a common mark over that of straight paths; alignment of neighbours over that of free bodies | >= 0.7; <= 1.5 |
| legibility | correlation of the silhouette with the drawing; were all to face the reader | half way where `facing` is asked |
| facing | bodies within the cone that a mark asks for, %; largest angular acceleration before it over the 99th percentile elsewhere | >= 95; <= 1.5 |
| exact | largest miss of a row that is met | <= 1e-9 |

[Measure](../Measure.md) has the formulas. Seconds are of processor time.
"""
SHARES = ("pairs", "cuts", "cuts_marks", "turning", "turning_peak", "facing")  # shown in percent
UNMEASURED = {"value": None, "met": None}  # of a flight that was measured before the row was


def machine():
    """What the seconds were taken on."""
    try:
        lines = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        name = next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        name = platform.machine()
    return f"{name}, {os.cpu_count()} cores"


def size_of(path):
    """Bodies times frames of a scene."""
    scene = json.loads(path.read_text(encoding="utf-8"))
    bodies = sum(entry.get("count", len(entry.get("positions", [0]))) for entry in scene["objects"])
    return bodies * scene.get("time", {}).get("frames", 300)


def fly(waft, scene, folder, options):
    """Has a scene flown into a folder, where it is not finished yet; returns whether there is a whole result."""
    if (folder / "report.json").is_file():
        return True
    folder.parent.mkdir(parents=True, exist_ok=True)
    asked = ["--quality", options.quality, "--threads", str(options.threads)] + (["--seed", str(options.seed)] if options.seed else [])
    done = subprocess.run([waft, "synthesize", scene, "--output", folder, *asked, "--no-csv", "-q"], check=False)
    if done.returncode not in DONE:
        print(f"{scene}: waft synthesize ended with {done.returncode}", file=sys.stderr)
    return done.returncode in DONE


def measured(waft, scene, folder, date):
    """What is kept of a flight."""
    said = subprocess.run([waft, "measure", folder, "--scene", scene, "--json"], check=True, stdout=subprocess.PIPE)
    rows = {row["key"]: row for row in json.loads(said.stdout)[0]["rows"]}
    report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    wishes = report["constraints"]
    lost = sum(wishes[key] for key in ("infeasible", "conflict", "unreachable"))
    return {"date": date, "machine": machine(), "objects": len(report["objects"]), "met": wishes["met"], "wishes": wishes["met"] + lost,
            "processorSeconds": round(sum(stage["processorSeconds"] for stage in report["stages"].values()), 1),
            "rows": {key: {name: rows[key][name] for name in ("value", "wanted", "met")} for _, keys in COLUMNS for key in keys}}


def figure(key, row):
    if row["value"] is None:
        return "-"
    value = row["value"] * (100.0 if key in SHARES else 1.0)
    text = "0" if value == 0.0 else f"{value:.0e}" if abs(value) < 0.005 else f"{value:.2f}" if abs(value) < 9.995 else f"{value:.0f}"
    return text if row["met"] is not False else f"**{text}**"


def misses(name, entry):
    """A line on what a scene misses; empty where it misses nothing."""
    lacks = []
    for _, keys in COLUMNS:
        for key in keys:
            row = entry["rows"].get(key, UNMEASURED)
            if row["met"] is False:
                low, high = row["wanted"]
                lacks.append(f"`{key}` {row['value']:.3g} (" + (f"at least {low:g}" if high is None else f"at most {high:g}") + ")")
    if entry["met"] < entry["wishes"]:
        lacks.append(f"{entry['wishes'] - entry['met']} of {entry['wishes']} constraints not met")
    return f"- {name}: " + ", ".join(lacks) + "\n" if lacks else ""


def page(kept):
    text = HEAD
    for quality, flights in sorted(kept.items()):
        text += f"\n## Quality `{quality}`\n\n| scene | bodies | met | " + " | ".join(head for head, _ in COLUMNS) + " | CPU s | flown |\n"
        text += "|---" * (len(COLUMNS) + 5) + "|\n"
        for name, entry in sorted(flights.items()):
            cells = ["; ".join(figure(key, entry["rows"].get(key, UNMEASURED)) for key in keys) for _, keys in COLUMNS]
            met = f"{entry['met']} of {entry['wishes']}"
            text += "| " + " | ".join([name, str(entry["objects"]), met if entry["met"] == entry["wishes"] else f"**{met}**", *cells,
                                       f"{entry['processorSeconds']:.0f}", entry["date"]]) + " |\n"
        lacks = "".join(misses(*item) for item in sorted(flights.items()))
        text += "\nWhat misses:\n\n" + lacks if lacks else "\nNothing misses.\n"
        machines = sorted({entry["machine"] for entry in flights.values()})
        text += "\nFlown on " + "; ".join(machines) + ", beside other work.\n"
    return text


def read_kept():
    return json.loads(KEPT.read_text(encoding="utf-8")) if KEPT.exists() else {}


def main():
    parser = argparse.ArgumentParser(description="flies scenes and writes how their bodies move")
    parser.add_argument("runs", type=pathlib.Path)
    parser.add_argument("scenes", type=pathlib.Path, nargs="*")
    parser.add_argument("--waft", default=str(ROOT / "build/bin/waft"))
    parser.add_argument("--quality", default="air")
    parser.add_argument("--seed", type=int, help="in place of the scene's: the flight is called NAME, seed N")
    parser.add_argument("--threads", type=int, default=os.cpu_count())
    parser.add_argument("--date", default=datetime.date.today().isoformat())
    options = parser.parse_intermixed_args()
    data = ROOT / "Data" / "Scenes"
    scenes = options.scenes or sorted([*data.glob("*.waft.json"), *data.glob("examples/*.waft.json")], key=size_of)
    for scene in scenes if options.runs.is_dir() or options.scenes else ():
        name = scene.name[:-len(".waft.json")] + (f", seed {options.seed}" if options.seed else "")
        folder = options.runs / options.quality / name
        if fly(options.waft, scene, folder, options):
            entry = measured(options.waft, scene, folder, options.date)
            kept = read_kept()  # after each flight, as it takes minutes, and others may fly at the same time
            kept.setdefault(options.quality, {})[name] = entry
            KEPT.write_text(json.dumps(kept, indent=1, sort_keys=True) + "\n", encoding="utf-8")
    (GALLERY / "Bodies.md").write_text(page(read_kept()), encoding="utf-8")


if __name__ == "__main__":
    main()
