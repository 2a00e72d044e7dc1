# SPDX-License-Identifier: BSD-3-Clause
"""Sentences of waft in the words of Blender: objects by their names, frames as the scene counts them, nothing of the inside."""
import dataclasses
import re

from .problems import Problem

# What waft says, and how it is said here. {} are its groups; what has a number there becomes a name then.
_SENTENCES = [(re.compile(pattern, re.S), words) for pattern, words in (
    (r"too fast: row \d+ target \d+: (?P<object>object \d+) has (\S+) s for (\S+) m[ ,].*: give it (?P<seconds>\S+) s .*or more",
     "too fast: {object} has {1} s for {2} m: give it {seconds} s or more, which is {frames} frames"),
    (r"no time to fall: row \d+ target \d+: (?P<object>object \d+) falls (\S+) m in (\S+) s[ ;].*: give it (?P<seconds>\S+) s .*or more",
     "no time to fall: {object} falls {1} m in {2} s: give it {seconds} s or more, which is {frames} frames"),
    (r"too heavy: row \d+ target \d+: (?P<object>object \d+) sinks at (\S+) m/s, and .* the air has to rise at (\S+) m/s under it; .*",
     "too heavy: {object} sinks at {1} m/s, the air would have to rise at {2} m/s under it: give it a smaller settling speed"),
    (r"too narrow: row \d+ target \d+ lies (\S+) m from (obstacle \d+), the body's clearance radius is ([^\s:]+) m(?:: .*)?",
     "too narrow: lies {0} m from {1}, a flyer turns in a ball of {2} m about it"),
    (r"too many: the balls of clearance of (\d+) bodies take (\d+) % of the volume, (\d+) % is what flies well",
     "too many: {0} flyers and the room that they turn in take {1} % of the volume; up to {2} % fly well"),
    (r"row \d+ target -?\d+ \(object -?\d+, (?P<frame>frame \d+), \w+\): \w+: (?:\w+ at frame \d+: )?(.*)",
     "cannot be met at {frame}: {1}"),
    (r"(infeasible|conflict): (\d+) more", "{1} more cannot be met"),
    (r"Database: traced at (\S+) frames per second, the scene has (\S+): .*",
     "{1} frames a second are far from the {0} of the flights that paths are made of: they may look uneven"),
    (r"(?P<object>object \d+)(?: \([^)]*\))?: the air does not take it there: .* is (\d+) % of .*",
     "the air does not take it to its marks: it is pushed besides, by {1} % of the air's speed; more time between marks helps"),
    (r"and (\d+) more objects that the air does not take to their marks", "{0} more flyers are pushed to their marks besides"),
    (r"(\d+) objects?, (\d+) frames?(?: \([^)]*\))?: turning that frames cannot show is slowed to (?:MaximumTurn \()?(\S+) degrees.*",
     "turns faster than frames can show are slowed to {2} degrees a frame ({0} flyers, {1} frames)"),
    (r"(\d+) objects?, (\d+) frames?(?: \([^)]*\))?: .*, rests or surfaces turn by up to (\S+) degrees, more than .*",
     "marks, rests or surfaces turn flyers by up to {2} degrees in a frame ({0} flyers, {1} frames)"),
    (r"(?P<object>object \d+): its mesh lies up to (\S+) m below a surface, .*", "cuts a surface by up to {1} m"),
    (r"(?P<object>object \d+): its centre was moved by up to (\S+) m so that .*",
     "lies on a surface, for which its centre was moved by up to {1} m"),
    (r"(?P<object>object \d+): the (?:planned )?path leaves less than the clearance asked for.*",
     "comes nearer to something than it is wide"),
    (r"stopped before there was an air: the paths are the plan's", "stopped before the air was there: the motion is only planned"),
    (r"spacetime: (?:.*, since )?nothing can be bettered by more than Tolerance: .*", "there was nothing left to better"),
)]
_NUMBERED = re.compile(
    r"(?<![^\s\"'(])/(?:(?P<group>constraints|obstacles|objects|winds|vortices)/(?P<entry>\d+)|shapes/(?P<shape>[^/:]+))(?:/[^: ]*)?"
    r"|\b(?P<kind>object|row|obstacle)s? (?P<list>\d+(?:(?:, | and )\d+)*)(?:,? target -?\d+)?"
    r"|\b(?P<frame>frames? )(?P<first>\d+)(?:(?P<to> to | and )(?P<last>\d+))?"
    r"|(?P<inside>\bMaximumTurn\b|the database's top speed|\bsegments?\b| \(rms\)|\brows?\b)")
_WHERE = re.compile(r"(?:.*?scene\.waft\.json: )?(?:/(?:constraints|obstacles|objects|winds|vortices|shapes)/[^/:]+[^: ]*: )?")
_GROUPS = {"object": "objects", "row": "constraints", "obstacle": "obstacles"}
_PLAIN = {"MaximumTurn": "the limit of turning", "the database's top speed": "the fastest that air carries", "segment": "flight",
          "segments": "flights", " (rms)": "", "row": "mark", "rows": "marks"}
_MANY = 3  # other objects of which the same is said at once


class Reporter:
    """Reports on a stage (stage.py)."""

    def __init__(self, stage):
        self._sources = stage.sources
        self._shapes = {name: shape["_object"] for name, shape in stage.scene.get("shapes", {}).items()}
        self._first = stage.frames[0]
        self._rate = stage.rate
        self._at = {}  # frame of the file: full names of what asks for something then
        for row, name in zip(stage.scene.get("constraints", []), self._sources.get("constraints", [])):
            self._at.setdefault(row["frame"], set()).add(name)

    def report(self, line, is_error=False):
        """The Problem that a sentence of waft is."""
        about = self._about(line)
        line = line[_WHERE.match(line).end():]
        for pattern, words in _SENTENCES:
            match = pattern.fullmatch(line)
            if match:
                line = words.format(*match.groups(), **self._named(match.groupdict()))
                break
        return Problem(_NUMBERED.sub(self._replaced, line), about, is_error)

    def _named(self, groups):
        if "seconds" in groups:
            groups["frames"] = f"{float(groups['seconds']) * self._rate:.0f}"
        return groups

    def _about(self, line):
        """The name of what a sentence is about: what it points at; else a mark before its flyer, and that before what is in the way."""
        crowded = re.match(r"too near: .* marks at frame (\d+) ", line)
        if crowded:
            names = self._at.get(int(crowded[1]), ())
            if len(names) == 1:
                return next(iter(names))
        found = {}
        for match in _NUMBERED.finditer(line):
            names = self._names(match)
            found.setdefault("pointer" if match["group"] or match["shape"] else match["kind"], names[0] if names else "")
        if re.match(r"object \d+ \(", line):
            return found["object"]
        return next((found[kind] for kind in ("pointer", "row", "object", "obstacle") if found.get(kind)), "")

    def _names(self, match):
        """The names of the objects that a match of _NUMBERED is about; none where one of them is not known."""
        if match["shape"]:
            return [self._shapes[match["shape"]]] if match["shape"] in self._shapes else []
        known = self._sources.get(match["group"] or _GROUPS.get(match["kind"]), [])
        numbers = [match["entry"]] if match["group"] else re.findall(r"\d+", match["list"] or "")
        if not all(number.isdecimal() and int(number) < len(known) for number in numbers):
            return []
        return list(dict.fromkeys(known[int(number)] for number in numbers))

    def _replaced(self, match):
        if match["inside"]:
            return _PLAIN[match["inside"]]
        if match["frame"]:
            numbers = [str(int(number) + self._first) for number in (match["first"], match["last"]) if number]
            return match["frame"] + (match["to"] or "").join(numbers)
        return " and ".join(self._names(match)) or (match[0].replace("row", "mark") if match["kind"] else "the scene")


def gathered(problems):
    """Problems, those that say the same but for numbers together: as the first one of an object, or, where they are about many objects, as
    the first with the others' names."""
    groups = {}
    for problem in problems:
        same = problem.is_error, re.sub(r"[\d.]+", "", problem.text.split(": ")[0])
        groups.setdefault(same, {}).setdefault(problem.object, []).append(problem)
    found = []
    for group in groups.values():
        first, *others = [_first_of(like) for like in group.values()]
        if len(others) < _MANY:
            found += [first, *others]
        else:
            found.append(dataclasses.replace(first, others=tuple(problem.object for problem in others)))
    return found


def _first_of(like):
    return dataclasses.replace(like[0], text=f"{like[0].text} (and {len(like) - 1} more like this)") if len(like) > 1 else like[0]
