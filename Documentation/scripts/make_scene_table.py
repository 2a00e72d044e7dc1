#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures folders that `waft synthesize --quality paper` wrote, each named after its scene, keeps the figures in
gallery/scenes.json and writes gallery/Scenes.md from all that are kept there. The pictures are make_scene_pictures.py's.

    python3 Documentation/scripts/make_scene_table.py RESULTS/leaves-letters RESULTS/feather-spiral-a ...

A folder of a scene may instead hold a folder for each `--seed`, named by its number: these are pooled.
"""
import json
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
GALLERY = ROOT / "Documentation" / "gallery"
sys.path.insert(0, str(ROOT / "Testing/Python"))

import motion_checks  # noqa: E402
import style_checks  # noqa: E402

KEPT = GALLERY / "scenes.json"
STAGES = ("planner", "spacetime", "rotation")
HEAD = """# Scenes, flown and measured

Written by [make_scene_table.py](../scripts/make_scene_table.py) from folders of `waft synthesize --quality paper`, all
at the scenes' full size (about 2500 particles of air, 300 frames), on two threads; the pictures, by
[make_scene_pictures.py](../scripts/make_scene_pictures.py), are of `--quality full`, of petals-1000 `air`. What is in
**bold** misses its gate. What the scenes are about is told in [Data/Scenes](../../Data/Scenes/README.md), what the
measures are in [Measure](../Measure.md#against-the-scene-motion_checkspy).

These flights are of the optimiser from the plan, as `--quality paper` flies and the default did once. The default goes
through a sampled air, and is judged by `waft measure`: what is wanted stands in [Measure](../Measure.md), and what the
scenes come to in [AirAssimilationFilter](../AirAssimilationFilter.md#figures) and
[SPHSpacetimeStudy](../SPHSpacetimeStudy.md#in-a-sampled-air).
"""
GATES = """
## Gates

`met`: rows that are met, of all. `miss`: largest miss of a row, in widths L of the volume (at most 1e-9). `clear`: what the swept centre lacks of its
clearance radius, and `depth`: how far any vertex is in the ground or an obstacle at any frame, in L (each at most 1e-3). `turn`: deviation of a
quaternion from unit length (at most 1e-9); none changes its sign. `E`: the last energy over the first (at most 0.1); it never rises. `top`: fastest step.
`bend` and `|a|`: Kolmogorov-Smirnov distance of log-curvature (at most 0.20) and of acceleration (at most 0.35) from the
database, both at most half of those of a spline through the same marks (in brackets); gates from eight objects on. `S`: velocity differences of
neighbours within 0.2 L, of the motion, of the plan and of straight lines (at most 0.65 or 0.7 of the plan's, and at most 0.8 of the straight lines'), a gate
from twenty objects on. `over`: intersection over union with the picture where the bodies can cover it (at least 0.9).

| scene | objects | met | miss | clear | depth | turn | E | top m/s | bend | \\|a\\| | S: motion, plan, straight | over |
|---|---|---|---|---|---|---|---|---|---|---|---|---|
"""
POOLED = """
## One object, pooled over seeds

Flights of one object are too short for figures of style: these are the same scenes flown with several seeds. `miss`, `clear`, `depth`, `turn` and `E` are
the worst of all flights.

| scene | seeds | met | miss | clear | depth | turn | E | bend | \\|a\\| |
|---|---|---|---|---|---|---|---|---|---|
"""
COSTS = """
## Seconds and memory

Seconds of processor time, both threads together, on a small, busy machine, and the largest memory of the process, ParaView and the
database included.

| scene | objects | planner | spacetime | rotation | whole run | memory |
|---|---|---|---|---|---|---|
"""


def seeds_of(folder):
    """The folders of its flights when a folder holds one for each seed, else none."""
    return sorted((entry for entry in folder.iterdir() if entry.name.isdigit()), key=lambda entry: int(entry.name))


def measured(folder):
    """Figures of a flight, or under "pooled" those of several."""
    scene_file = ROOT / f"Data/Scenes/{folder.name}.waft.json"
    scene = json.loads(scene_file.read_text(encoding="utf-8"))
    seeds = seeds_of(folder)
    flights = seeds or [folder]
    runs = [motion_checks.measure(flight, scene_file) for flight in flights]
    entry = {"figures": motion_checks.worst(runs),
             "style": style_checks.measure(flights, scene, motion_checks.EMBEDDED)}
    if seeds:
        return {"pooled": {"seeds": len(seeds), **entry}}
    stages = json.loads((folder / "report.json").read_text(encoding="utf-8"))["stages"]
    return {"title": scene["title"], **entry,
            "seconds": {name: stage["processorSeconds"] for name, stage in stages.items()},
            "memory": max(stage["peakMemoryMB"] for stage in stages.values())}


def cell(text, is_good=True):
    return text if is_good else f"**{text}**"


def gate(figures, name, form=".1g"):
    value = figures[name]
    return cell(format(value, form) if value else "0", value <= motion_checks.LIMITS[name])


def style_cells(entry, paths):
    """bend and |a|, which have gates from eight paths on."""
    cells = []
    for name, limit in (("KS log-curvature", 0.20), ("KS |a|", 0.35)):
        line = entry["style"][name]
        good = line["optimized"] <= limit and line["optimized"] <= 0.5 * line["spline"]
        cells.append(cell(f"{line['optimized']:.3f} ({line['spline']:.2f})", good or paths < 8))
    return cells


def coherence_cell(entry):
    objects = entry["figures"]["objects"]
    line = entry["style"]["S(0.2 L)"]
    if objects < 2:
        return ""
    good = ((line["optimized"] <= 0.65 or line["optimized"] <= 0.7 * line["planned"])
            and line["optimized"] <= 0.8 * line["straight"])
    return (cell(f"{line['optimized']:.3f}", good or objects < 20) +
            f", {line['planned']:.3f}, {line['straight']:.3f}")


def limit_cells(figures):
    """met, miss, clear, depth, turn and E."""
    met = figures["rows"] - figures["rows_unmet"]
    turn = cell(f"{figures['quaternion_error']:.0e}",
                figures["quaternion_error"] <= 1e-9 and figures["quaternion_flips"] == 0)
    energy = cell(f"{figures['energy_ratio']:.3f}",
                  figures["energy_ratio"] <= motion_checks.LIMITS["energy_ratio"] and figures["energy_rises"] == 0)
    return [cell(f"{met} of {figures['rows']}", met == figures["rows"]), gate(figures, "exact_residual"),
            gate(figures, "clearance_shortfall"), gate(figures, "mesh_depth"), turn, energy]


def gates_line(name, entry):
    figures = entry["figures"]
    covered = figures.get("picture_overlap")
    over = "" if covered is None else cell(f"{covered:.3f}", covered >= motion_checks.LEAST["picture_overlap"])
    cells = [name, str(figures["objects"]), *limit_cells(figures), f"{figures['top_speed']:.2f}",
             *style_cells(entry, figures["objects"]), coherence_cell(entry), over]
    return "| " + " | ".join(cells) + " |\n"


def pooled_line(name, pooled):
    cells = [name, str(pooled["seeds"]), *limit_cells(pooled["figures"]), *style_cells(pooled, pooled["seeds"])]
    return "| " + " | ".join(cells) + " |\n"


def costs_line(name, entry):
    seconds = entry["seconds"]
    cells = [name, str(entry["figures"]["objects"]), *(f"{seconds[stage]:.1f} s" for stage in STAGES),
             f"{sum(seconds.values()):.0f} s", f"{entry['memory'] / 1000.0:.2f} GB"]
    return "| " + " | ".join(cells) + " |\n"


def page(kept):
    text = HEAD + GATES + "".join(gates_line(*item) for item in kept.items())
    text += POOLED + "".join(pooled_line(name, entry["pooled"]) for name, entry in kept.items() if "pooled" in entry)
    text += COSTS + "".join(costs_line(*item) for item in kept.items()) + "\n## Pictures\n"
    for name, entry in kept.items():
        text += (f"\n**{name}**: {entry['title']}.\n\n![{name}, four moments](scene_{name}.png)\n\n"
                 f"![{name}, the last frame](scene_{name}_end.png)\n")
    return text


def main(folders):
    kept = json.loads(KEPT.read_text(encoding="utf-8")) if KEPT.exists() else {}
    for folder in map(pathlib.Path, folders):
        kept.setdefault(folder.name, {}).update(measured(folder))
    kept = dict(sorted(kept.items()))
    KEPT.write_text(json.dumps(kept, indent=1) + "\n", encoding="utf-8")
    (GALLERY / "Scenes.md").write_text(page(kept), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
