# SPDX-License-Identifier: BSD-3-Clause
"""What a folder of results holds, from its own records: `waft info DIR`. Nothing of it is changed."""
import contextlib

from waft.failures import InputError
from waft.results._records import TOLD, record_of
from waft.results.place import is_at_work, manifest_in
from waft.results.store import Store
from waft.results.writing import REPORT, STATE, STATUS_ORDER, is_beyond_results, settled
from waft.run.resuming import key_and_damage, stages_done

# What other commands write beside a run's own files, by the files that have their manifests.
_SEALS = {REPORT: "synthesize", "pictures.json": "render", "page.json": "page",
          **{f"export-{to}.json": "export" for to in ("glb", "abc", "usd")}}
_UNMET = {"Row": int, "Target": int, "ObjectId": int, "Frame": int, "Kind": str, "Status": str, "Message": str}
_MEGABYTE = 1e6
_NAMED = 8  # files that a reader is told of, the largest


def describe_result(folder):
    """The document on a folder of results, or of a run that was stopped before there were any. Raises InputError where it is neither."""
    below = settled(folder)
    report, stages = record_of(below, REPORT, TOLD), stages_done(below)
    if report is None and not stages:
        raise InputError(f"{folder}: expected a folder of results with its {REPORT}, or what a stopped run left, found neither")
    files = _files(below)
    own = [file for file in files if file["command"] == "synthesize"]
    held = {**(_of_report(report) if report is not None else {}), "atWork": is_at_work(below), "goesOn": _goes_on(below, report, stages)}
    return {"folder": str(folder), "finished": report is not None, **held,
            "whole": report is not None and all(file["state"] in ("whole", "cleaned") for file in own),
            "files": files, "bytes": sum(file["bytes"] for file in files)}


def _of_report(report):
    """What report.json says; what it lacks, as one of an older version may, is null."""
    counts = report.get("constraints", {})
    names = ("scene", "title", "version", "quality", "seed", "time", "stoppedEarly", "stopped", "stages", "energy", "settled", "defaults",
             "without", "warnings")
    unmet = [{name[0].lower() + name[1:]: kind(row[name]) for name, kind in _UNMET.items()} for row in counts.get("unmet", ())]
    return {**{name: report.get(name) for name in names}, "objects": len(report["objects"]) if "objects" in report else None,
            "constraints": {**{status: counts.get(status, 0) for status in STATUS_ORDER}, "unmet": unmet}}


def _files(below):
    """What is there and what is missing, a row a file or series: a folder counts as one, with a slash at its end."""
    sealed = {}  # {name: (command, entry)}
    for seal, command in _SEALS.items():
        manifest = manifest_in(below, seal)
        if manifest is not None:
            sealed.update({name: (command, entry) for name, entry in manifest.items()})
            sealed[seal] = (command, None)
    there = {name: about for name, about in below.everything().items() if not name.startswith(("checkpoint/", ".waft-"))}
    rows = {}
    for name in sorted({*sealed, *there}):
        command, entry = sealed.get(name, (None, None))
        head, slash, _ = name.partition("/")
        row = rows.setdefault((head + slash, command), {
            "name": head + slash, "command": command, "files": 0, "bytes": 0, "state": "whole"})
        row["files"] += name in there
        row["bytes"] += there[name].st_size if name in there else 0
        row["state"] = max(row["state"], _state(below, name, entry), key=_WORST.index)
    return list(rows.values())


_WORST = ("whole", "cleaned", "changed", "missing")


def _state(below, name, entry):
    if below.about(name) is None:
        return "cleaned" if is_beyond_results(name) else "missing"
    return "whole" if entry is None or entry.fits(below, name) else "changed"


def _goes_on(below, report, stages):
    """From where --resume goes on, and --edit-of."""
    damage = key_and_damage(below)[1] if stages else "nothing was stopped"
    state = None
    with contextlib.suppress(InputError):
        if below.found(STATE):
            state = STATE
    if state is None and report is not None and Store().holds(report.get("key")):
        state = "store"
    return {"resume": {"possible": bool(stages) and not damage, "stages": stages, "why": damage},
            "edit": {"possible": state is not None, "from": state}}


def words_of_result(held):
    """The same in lines for a reader."""
    folder = held["folder"]
    if not held["finished"]:
        yield f"{folder}: no results: a run is at work there" if held["atWork"] else f"{folder}: no results yet: a run was stopped before"
    else:
        title = f"{held['title']} ({held['scene']})" if held["title"] else held["scene"]
        yield f"{folder}: {title}, quality {held['quality'] or 'unknown'}, seed {held['seed']}, by Waft {held['version']}"
        yield from _words_of_run(held)
    for file in held["files"]:
        if file["state"] != "whole":
            yield f"  {file['name']}: {file['state']} since {file['command']} wrote it"
    yield f"  {held['bytes'] / _MEGABYTE:.1f} MB: {_words_of_files(held['files'])}"
    yield from _words_of_going_on(held)


def _words_of_run(held):
    time = held["time"]
    if time:
        yield (f"  {held['objects']} objects, {time['frames']} frames at {time['framesPerSecond']:g} a second "
               f"({time['frames'] / time['framesPerSecond']:.3g} s)")
    counts = held["constraints"]
    total = sum(counts[status] for status in STATUS_ORDER)
    others = "".join(f", {counts[status]} {status}" for status in STATUS_ORDER[1:] if counts[status])
    yield f"  {counts['met']} of {total} constraints met{others}" + (", stopped early" if held["stoppedEarly"] else "")
    for row in counts["unmet"]:
        yield (f"    row {row['row']} target {row['target']} (object {row['objectId']}, frame {row['frame']}, {row['kind']}): "
               f"{row['status']}: {row['message']}")
    stages = ", ".join(f"{name} {stage['seconds']:.1f} s" for name, stage in (held["stages"] or {}).items() if "seconds" in stage)
    if stages:
        yield f"  {stages}"
    for name, taken in (held["defaults"] or {}).items():
        yield f"  {name} {taken['value']}, by {taken['from']}"
    if held["without"]:
        yield f"  without {', '.join(held['without'])}"
    for warning in held["warnings"] or ():
        yield f"  warning: {warning}"


def _words_of_files(files):
    """The largest by name, all others together."""
    there = sorted((file for file in files if file["files"]), key=lambda file: -file["bytes"])
    rest = there[_NAMED:]
    more = [f"and {len(rest)} more {sum(file['bytes'] for file in rest) / _MEGABYTE:.2f}"] if rest else []
    return ", ".join([*map(_words_of_file, there[:_NAMED]), *more])


def _words_of_file(file):
    count = f" in {file['files']} files" if file["files"] > 1 else ""
    whose = {"synthesize": "", None: " (not Waft's)"}.get(file["command"], f" (by {file['command']})")
    return f"{file['name']} {file['bytes'] / _MEGABYTE:.2f}{count}{whose}"


def _words_of_going_on(held):
    resume, edit = held["goesOn"]["resume"], held["goesOn"]["edit"]
    if held["atWork"]:
        yield "  a run is at work there"
    elif resume["possible"]:
        yield f"  --resume goes on, with what is there of {', '.join(resume['stages'])}"
    elif resume["stages"]:
        yield f"  --resume begins anew: {resume['why']}"
    if edit["possible"]:
        yield f"  --edit-of goes on from {STATE if edit['from'] == STATE else 'its air in the store'}"
    elif held["finished"] and held["quality"] != "paper":
        yield "  --edit-of flies anew: its air is kept no more"
