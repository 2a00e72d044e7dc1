#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws who includes whom: the Core libraries, Bridge, Motion, Sources and the Plugin, as map.svg, and the folders of a
library that has some, as map_LIBRARY.svg.

    make_map.py ROOT           writes the maps (into ROOT/Documentation)
    make_map.py ROOT --check   exit status 1 when a committed map is not what would be written

A room stands one floor above the highest room that it includes. An arrow that is implied by a chain of others is left
out. The Plugin includes nothing: it loads the modules that Plugin/CMakeLists.txt names.
"""
import pathlib
import re
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"/]+)/(?:([^"/]+)/)?', re.MULTILINE)
LIBRARIES_IN_FOLDERS = ("Air", "Spacetime")
MODULES = {"WaftSources": "Sources", "WaftFilters": "Motion"}  # modules of the plugin, and their rooms
WIDTH, HEIGHT, GAP, FLOOR, MARGIN = 104, 34, 22, 84, 24  # a room, the space beside it, from floor to floor [px]
COLOURS = {"Core": "#e4eef8", "Bridge": "#e6f3e2", "VTK": "#fbeeda", "Plugin": "#f3e2ec"}
KINDS = {"Bridge": "Bridge", "Motion": "VTK", "Sources": "VTK", "Plugin": "Plugin"}
LEGEND = (("Core", "Core: no VTK"), ("Bridge", "Core's types to VTK's and back"), ("VTK", "VTK filters and sources"),
          ("Plugin", "ParaView"))


def rooms(root):
    """{room: folder} of everything that has sources."""
    core = {folder.name: folder for folder in sorted((root / "Filters" / "Core").iterdir()) if folder.is_dir()}
    return {**core, "Bridge": root / "Filters" / "Bridge", "Motion": root / "Filters" / "Motion",
            "Sources": root / "Sources"}


def included(folder):
    """Pairs of first and second part of what the sources below a folder include by a path."""
    return {pair for path in folder.rglob("*") if path.suffix in (".h", ".cxx", ".txx")
            for pair in INCLUDE.findall(path.read_text(encoding="utf-8"))}


def folder_dependencies(root, library):
    """{folder of a library: the set of its other folders that it includes}."""
    folders = [folder for folder in sorted((root / "Filters" / "Core" / library).iterdir()) if folder.is_dir()]
    return {folder.name: {second for first, second in included(folder) if first == library and second} - {folder.name}
            for folder in folders}


def dependencies(root):
    """{room: the set of rooms that it includes}."""
    folders = rooms(root)
    found = {}
    for room, folder in folders.items():
        found[room] = ({first for first, _ in included(folder)} & folders.keys()) - {room}
    plugin = (root / "Plugin" / "CMakeLists.txt").read_text(encoding="utf-8")
    found["Plugin"] = {room for module, room in MODULES.items() if f"Waft::{module}" in plugin}
    return found


def reached(graph, room):
    """All rooms below a room; graph has no circle."""
    below = set()
    for other in graph[room]:
        below |= {other} | reached(graph, other)
    return below


def reduced(graph):
    """The graph without the arrows that chains of others imply."""
    return {room: {target for target in targets
                   if not any(target in reached(graph, other) for other in targets - {target})}
            for room, targets in graph.items()}


def floors(graph):
    """Lists of rooms, the lowest floor first; each floor ordered by where the rooms below stand."""
    level = {}

    def climb(room):
        if room not in level:
            level[room] = 1 + max((climb(other) for other in graph[room]), default=-1)
        return level[room]

    for room in graph:
        climb(room)
    result = [sorted(room for room in graph if level[room] == floor) for floor in range(max(level.values()) + 1)]
    used = {room: sorted(graph[room]) for room in graph}
    users = {room: sorted(other for other in graph if room in graph[other]) for room in graph}
    for sweep in range(8):  # downwards and upwards in turns: each room goes to the middle of its neighbours
        place = {room: i + 0.5 - len(floor) / 2 for floor in result for i, room in enumerate(floor)}
        neighbours = used if sweep % 2 else users
        for floor in result:
            floor.sort(key=lambda room: (sum(place[other] for other in neighbours[room]) / len(neighbours[room])
                                         if neighbours[room] else place[room], room))
    return result


def beside(lefts, x):
    """Where a line that aims for x passes a floor whose rooms begin at lefts: at x, or in the nearest gap."""
    for left in lefts:
        if left - GAP / 2 < x < left + WIDTH + GAP / 2:
            slant = (x - left - WIDTH / 2) / 8  # keeps lines through one gap apart
            return left + WIDTH + GAP / 2 + slant - 7 if slant > 0 else left - GAP / 2 + slant + 7
    return x


def drawing(whole, legend):
    """The map of a graph as SVG."""
    graph = reduced(whole)
    storeys = floors(graph)
    widest = max(len(floor) for floor in storeys)
    width = 2 * MARGIN + widest * (WIDTH + GAP) - GAP
    height = 2 * MARGIN + (len(storeys) - 1) * FLOOR + HEIGHT + (34 if legend else 0)
    place = {}
    for level, floor in enumerate(storeys):
        left = (width - len(floor) * (WIDTH + GAP) + GAP) / 2
        for i, room in enumerate(floor):
            place[room] = (left + i * (WIDTH + GAP), MARGIN + (len(storeys) - 1 - level) * FLOOR, level)
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
             'font-family="sans-serif" font-size="13">',
             '<title>Who includes whom in Waft</title>',
             '<defs><marker id="tip" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="7" markerHeight="7" '
             'orient="auto"><path d="M0 0L8 4L0 8z" fill="#667"/></marker></defs>',
             f'<rect width="{width}" height="{height}" fill="white"/>']
    for room, (x, y, level) in place.items():
        targets = sorted(graph[room], key=lambda other: (place[other], other))
        for i, target in enumerate(targets):
            end_x, end_y, end_level = place[target]
            x0, y0 = x + WIDTH * (i + 1) / (len(targets) + 1), y + HEIGHT
            comers = sorted((other for other in graph if target in graph[other]), key=lambda other: (place[other], other))
            x1, y1 = end_x + WIDTH * (comers.index(room) + 1) / (len(comers) + 1), end_y
            path = f"M{x0:.0f} {y0:.0f}"
            at = x0
            for between in range(level - 1, end_level, -1):  # past the rooms of each floor between
                aim = x0 + (x1 - x0) * (level - between) / (level - end_level)
                gap = beside([place[other][0] for other in storeys[between]], aim)
                top = MARGIN + (len(storeys) - 1 - between) * FLOOR
                path += f"C{at:.0f} {top - 22:.0f} {gap:.0f} {top - 28:.0f} {gap:.0f} {top:.0f}V{top + HEIGHT:.0f}"
                at = gap
            path += f"C{at:.0f} {y1 - 22:.0f} {x1:.0f} {y1 - 28:.0f} {x1:.0f} {y1:.0f}"
            lines.append(f'<path d="{path}" fill="none" stroke="#667" marker-end="url(#tip)">'
                         f'<title>{room} includes {target}</title></path>')
    for room, (x, y, _) in sorted(place.items()):
        colour = COLOURS[KINDS.get(room, "Core")]
        lines.append(f'<rect x="{x:.0f}" y="{y}" width="{WIDTH}" height="{HEIGHT}" rx="5" fill="{colour}" stroke="#556"/>')
        lines.append(f'<text x="{x + WIDTH / 2:.0f}" y="{y + 22}" text-anchor="middle">{room}</text>')
    x = MARGIN
    for kind, text in legend:
        lines.append(f'<rect x="{x}" y="{height - 30}" width="14" height="14" fill="{COLOURS[kind]}" stroke="#556"/>')
        lines.append(f'<text x="{x + 20}" y="{height - 18}">{text}</text>')
        x += 44 + 7 * len(text)
    return "\n".join(lines + ["</svg>", ""])


def main(root, option=""):
    root = pathlib.Path(root)
    maps = {"map.svg": drawing(dependencies(root), LEGEND)}
    for library in LIBRARIES_IN_FOLDERS:
        maps[f"map_{library}.svg"] = drawing(folder_dependencies(root, library), ())
    for name, text in maps.items():
        committed = root / "Documentation" / name
        if option != "--check":
            committed.write_text(text, encoding="utf-8")
        elif not committed.is_file() or committed.read_text(encoding="utf-8") != text:
            print(f"{committed}: expected what make_map.py writes; run: python3 Documentation/scripts/make_map.py .")
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:3]))
