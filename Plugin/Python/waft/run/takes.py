# SPDX-License-Identifier: BSD-3-Clause
"""Many variations of one scene: `waft takes`. A take is `waft synthesize` of the scene with a seed of its own, in a process of its
own; what came of all is a table, takes.csv and takes.txt, whose rows are kept in takes.json.

Several processes may fly takes of one folder at the same time, on several machines that share it: the table is changed by one at
a time, and each adds its own rows.
"""
import concurrent.futures
import contextlib
import csv
import hashlib
import io
import os
import pathlib
import signal
import subprocess
import tempfile
import threading
import time

from waft import failures, loading
from waft.beneath import Folder
from waft.display import STOPS
from waft.failures import InputError, Interrupted, WaftError
from waft.files import write_text
from waft.reading import check_scene_file, json_of, open_stream
from waft.results import Busy, Entry, ResultPlace, check_folder
from waft.results._records import FLOWN, MEASURED, TAKES, checked, record_of
from waft.run._chain import word_in_keys
from waft.scene import Scene
from waft.texts import cell, line
from waft.watching import interruptible

OUTCOMES = {failures.ALL_MET: "all met", failures.NOT_ALL_MET: "not all met", failures.STOPPED_EARLY: "stopped",
            failures.MALFORMED: "refused"}
DONE = (failures.ALL_MET, failures.NOT_ALL_MET)
SEAL, TABLES = "takes.json", ("takes.csv", "takes.txt")
PATIENCE = 120.0  # s that another process may take to change the table
_FIRST = ["seed", "folder", "outcome", "met", "wishes", "seconds", "processorSeconds", "peakMemoryMB"]


def fly_takes(scene, seeds, output, quality="full", jobs=1, threads=None, database=None, log=print):
    """Flies the takes of these seeds that are not there yet, `jobs` at a time, each on `threads` threads (by default all cores
    together), and puts them in the table of `output`. log: called with a line for each.

    Returns the exit status of all and the rows of the table (dictionaries). Raises InputError before anything is computed: of a scene
    that is malformed, and of files of others where the table or a take would be.
    """
    check_folder(output)
    folder = pathlib.Path(output)
    flight = _Flight(scene, folder, quality, threads or max(1, (os.cpu_count() or 1) // jobs), database)
    done = {row["seed"]: row for row in _change_table(folder, [])}
    missing = [seed for seed in seeds if not flight.is_done(seed, done.get(seed))]
    for seed in missing if folder.is_dir() else ():
        Folder(folder).is_folder(take_name(seed))  # raises of a link, which would lead a flight elsewhere
    for seed in seeds:
        if seed not in missing:
            log(f"{take_name(seed)}: there already")
    statuses = [done[seed]["status"] for seed in seeds if seed not in missing]
    stopped = False
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        waiting = {pool.submit(flight.fly, seed) for seed in missing}
        while waiting:
            ended = set()
            try:
                with contextlib.nullcontext() if stopped else interruptible("stopped"):
                    ended, waiting = concurrent.futures.wait(waiting, return_when=concurrent.futures.FIRST_COMPLETED)
            except Interrupted:
                stopped = True
                flight.stop()
            statuses += [_told(*future.result(), log) for future in ended]
    rows = [row for row in _rows(folder) if row["seed"] in seeds]
    return _status_of_all(stopped, statuses), rows


def take_name(seed):
    return f"take-{seed:04d}"


def _told(row, is_flown, log):
    """Says what a row holds; returns its status, None of a take that was not begun."""
    if row is None:
        return None
    if not is_flown:
        log(f"{row['folder']}: there already")
        return row["status"]
    if row["status"] == failures.MALFORMED:
        log(f"{row['folder']}: {row['message']}")
        return row["status"]
    met = f", {row['met']} of {row['wishes']} constraints met" if {"met", "wishes"} <= row.keys() else ""
    log(f"{row['folder']}: {row['outcome']}{met}" + (f": {row['message']}" if row["message"] else ""))
    return row["status"]


def _status_of_all(stopped, statuses):
    if stopped:
        return failures.STOPPED_EARLY
    found = set(statuses) - {None}
    for status in (failures.FAILED, failures.MALFORMED, failures.STOPPED_EARLY, failures.NOT_ALL_MET):
        if status in found:
            return status
    return failures.ALL_MET if found <= {failures.ALL_MET} else failures.FAILED


class _Flight:
    """What all takes have in common, and their processes."""

    def __init__(self, scene, folder, quality, threads, database):
        content = hashlib.sha256(f"{loading.version()} {word_in_keys(quality)}".encode())
        check_scene_file(scene)
        self._scene = Scene.load(scene)
        self._name = os.path.basename(scene)
        if database and not os.path.isfile(database):
            raise InputError(f"{database}: no such file")
        # What a scene lacks is for who flies it to say: there is no file, as there might be another.
        for file in [scene, *sorted(self._scene.files()), *([database] if database else [])]:
            content.update((Entry.of(open_stream(file)).digest if os.path.isfile(file) else "none").encode())
        self.key = content.hexdigest()  # takes of one key and seed are the same
        self._folder = folder
        self._arguments = ["--quality", quality, "--threads", str(threads)]
        self._arguments += ["--database", os.path.abspath(database)] if database else []
        self._lock = threading.Lock()
        self._children = set()
        self._ends = False

    def is_done(self, seed, row):
        return row is not None and row["key"] == self.key and row["status"] in DONE and (
            Folder(self._folder).found(f"{take_name(seed)}/report.json") is not None)

    def fly(self, seed):
        """The row of a take, which is in the table (None when it was not begun, since others were refused or stopped), and whether it was
        flown here: where another process flies it that is waited for."""
        with contextlib.ExitStack() as held:
            try:
                _enter(held, ResultPlace(self._folder, SEAL, room=f"{take_name(seed)}.flying"), lambda: self._ends)
            except Busy:
                return None, False
            row = next((row for row in _rows(self._folder) if row["seed"] == seed), None)
            if self.is_done(seed, row):
                return row, False
            row = self._fly(seed)
            if row is not None and row["status"] != failures.MALFORMED:  # of which nothing was computed
                _change_table(self._folder, [row])
            return row, True

    def _fly(self, seed):
        """The row of a take; None when it was not begun."""
        place = self._folder.absolute() / take_name(seed)  # a name by itself may look like an option
        resume = ["--resume"] if (place / "checkpoint").is_dir() else []
        began = time.monotonic()
        with tempfile.TemporaryDirectory(prefix="waft-take-") as folder:
            scene = os.path.join(folder, self._name)
            self._scene.with_seed(seed).save(scene)  # the air is drawn from the scene's seed, too
            status, _, words = self._run("synthesize", scene, *self._arguments, "--output", str(place), *resume)
            if status is None:
                return None
            row = {"seed": seed, "folder": place.name, "key": self.key, "status": status, "outcome": OUTCOMES.get(status, "failed"),
                   "message": "" if status in DONE else words.replace(scene, self._name),
                   "seconds": round(time.monotonic() - began, 3)}
            self._ends = self._ends or status == failures.MALFORMED  # the others would be refused as well
            if status in DONE:
                row.update(_summary(_flown(place)))
                status, text, words = self._run("measure", str(place), "--scene", scene, "--json")
                if status == 0:
                    row["measures"] = checked(json_of(text, "waft measure"), MEASURED, "waft measure")[0]["rows"]
                else:
                    row["message"] = "not measured" + (f": {words.replace(scene, self._name)}" if words else "")
        return row

    def stop(self):
        """Asks all to come to their end, as a stop from the outside does."""
        with self._lock:
            self._ends = True
            for child in self._children:
                child.send_signal(signal.SIGTERM)

    def _run(self, *arguments):
        """Exit status, stdout and the last line of stderr of a `waft` of its own; the status is None where it was not begun."""
        with self._lock:
            if self._ends:
                return None, "", ""
            child = subprocess.Popen([loading.command(), *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                     stderr=subprocess.PIPE, text=True, start_new_session=True, preexec_fn=_block_stops,
                                     env={**os.environ, "WAFT_DEFAULTS": "off"})
            self._children.add(child)
        text, errors = child.communicate()
        with self._lock:
            self._children.discard(child)
        said = [words for words in errors.splitlines() if words.strip()]
        words = said[-1].removeprefix("waft: ") if said else ""
        if child.returncode < 0:  # a signal, told as shells do
            return 128 - child.returncode, text, words or f"ended by {signal.Signals(-child.returncode).name}"
        return child.returncode, text, words


def _block_stops():
    """A stop waits until the process is there to take it."""
    signal.pthread_sigmask(signal.SIG_BLOCK, STOPS)


def _flown(place):
    """The report of a take that came to its end."""
    report = record_of(Folder(place), "report.json", FLOWN)
    if report is None:
        raise WaftError(f"{place}: expected report.json, which a take that ended leaves")
    return report


def _summary(report):
    """What the table says of a report.json."""
    counts = {status: count for status, count in report["constraints"].items() if status != "unmet"}
    stages = report["stages"].values()
    return {"met": counts["met"], "wishes": sum(counts.values()),
            "processorSeconds": round(sum(stage["processorSeconds"] for stage in stages), 3),
            "peakMemoryMB": round(max((stage["peakMemoryMB"] for stage in stages), default=0.0), 1)}


def _rows(folder):
    """Those of the table, by their seeds."""
    found = record_of(Folder(folder), SEAL, TAKES) if folder.is_dir() else None
    return sorted(found["takes"] if found else [], key=lambda row: row["seed"])


def _change_table(folder, rows):
    """Puts rows in the table, in place of those of the same seeds; without any only looks whether that could be done. Returns
    all."""
    end = time.monotonic() + PATIENCE
    place = ResultPlace(folder, SEAL)
    with contextlib.ExitStack() as held:
        _enter(held, place, lambda: time.monotonic() > end)
        place.check(TABLES)
        every = {row["seed"]: row for row in (*_rows(folder), *rows)}
        every = [every[seed] for seed in sorted(every)]
        if rows:
            write_text(place.path("takes.csv"), _as_csv(every))
            write_text(place.path("takes.txt"), table(every))
            place.commit({"takes": every})
        return every


def _enter(stack, place, gives_up):
    """Enters a place that another process may hold for a while; raises Busy when it is given up."""
    while True:
        try:
            return stack.enter_context(place)
        except Busy:
            if gives_up():
                raise
            time.sleep(0.1)


def _as_csv(rows):
    keys = list(dict.fromkeys(measure["key"] for row in rows for measure in row.get("measures", ())))
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([*_FIRST, *keys, "message"])
    for row in rows:
        values = {measure["key"]: measure["value"] for measure in row.get("measures", ())}
        writer.writerow([*(row.get(name, "") for name in _FIRST), *(values.get(key) for key in keys), cell(row["message"])])
    return text.getvalue()


def table(rows):
    """The rows for a reader: constraints met, how many measures are within what is wanted, and which are not."""
    cells = [("seed", "outcome", "constraints", "measures", "seconds", "not as wanted")]
    for row in rows:
        judged = [measure for measure in row.get("measures", ()) if measure["met"] is not None]
        cells.append((str(row["seed"]), row["outcome"], f"{row['met']}/{row['wishes']}" if {"met", "wishes"} <= row.keys() else "-",
                      f"{sum(measure['met'] for measure in judged)}/{len(judged)}" if judged else "-", f"{row['seconds']:.0f}",
                      ", ".join(measure["key"] for measure in judged if not measure["met"]) or row["message"]))
    widths = [max(len(own[column]) for own in cells) for column in range(5)]
    padded = ([*(text.ljust(width) for text, width in zip(own, widths)), own[5]] for own in cells)
    return "".join(line("  ".join(cells).rstrip()) + "\n" for cells in padded)
