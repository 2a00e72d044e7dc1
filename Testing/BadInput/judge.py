# SPDX-License-Identifier: BSD-3-Clause
"""What was wrong with a case that was done."""
import dataclasses
import re
import signal

# From the worst to the least; a case counts as its first.
FAULTS = ("crash", "lost files", "hang", "memory", "traceback", "status", "leftover", "message", "noise")
DONE = (0, 3, 4)  # exit statuses of a run that wrote its results
MOST_MEGABYTES = 1600  # the most particles that the optimiser takes need 1575
MOST_BYTES = 2048
SUMMARY = re.compile(r" constraints met \(| simulations")
NOISE = re.compile(r"ERR\||FATL\||WARN\||ERROR: In|Warning: In|Generic Warning|0x[0-9a-f]{6,}|Loguru|libpng|TIFF|vtk[A-Z]\w+ \(")


@dataclasses.dataclass
class Done:
    """How a case's process ended. changed: names of files that came, went or are others, in the case's folder and in
    that of the older results."""

    status: int  # of the exit; a signal's number below 0
    is_hung: bool
    megabytes: float
    said: bytes
    changed: list
    old_results_changed: list


def _without_usage(text):
    """The lines but for argparse's own help, which names no input."""
    lines = []
    in_usage = False
    for line in text.splitlines():
        in_usage = line.startswith("usage:") or (in_usage and line.startswith(" "))
        if not in_usage and line.strip():
            lines.append(line)
    return lines


def _changes(case, done):
    # What a run that came to its end put in place of older files of its own is not lost.
    refused = done.status not in DONE
    old = [name for name in done.old_results_changed if refused or "notes.txt" in name]
    may_replace = not refused and done.status in case.status
    gone = [name for name in done.changed if not name.startswith("+") and not (may_replace and name.startswith("out"))]
    new = [name for name in done.changed if name.startswith("+") and (refused or not name.startswith(("+out", "+d.", "+d/")))]
    if done.status == 1:  # what failed goes on from there
        old = [name for name in old if not name.startswith("+checkpoint")]
    if old or gone:
        yield "lost files", f"{(old + gone)[:4]} are gone or others"
    if new:
        yield "leftover", f"new: {new[:4]}"
    if any("/.waft" in name.replace("+", "/", 1) for name in done.changed + done.old_results_changed if name.startswith("+")):
        yield "leftover", "a temporary folder"


def _words(case, done):
    try:
        text = done.said.decode()
    except UnicodeDecodeError as error:
        yield "message", f"no UTF-8: {error}"
        text = done.said.decode(errors="replace")
    if "Traceback" in text or re.search(r"^\w+(Error|Exception): ", text, re.M):
        yield "traceback", text.strip()[-200:]
    lines = _without_usage(text)
    if done.status in (1, 2):
        size = len("\n".join(lines).encode())
        if size > MOST_BYTES:
            yield "message", f"of {size} bytes"
        if not lines:
            yield "message", "none"
    # Of a case that may be taken or refused the words are those of the refusal.
    may_be_either = set(case.status) & set(DONE) and set(case.status) - set(DONE)
    for part in () if may_be_either and done.status in DONE else case.says:
        if part not in text:
            yield "message", f"without '{part}': {' '.join(lines)[:300]}"
    for line in lines:
        if NOISE.search(line) or not (line.startswith("waft") or (done.status in DONE and SUMMARY.search(line))):
            yield "noise", line[:200]
            return


def faults(case, done):
    """[(fault, sentence)], none when all is well."""
    found = []
    if done.is_hung:
        found.append(("hang", "killed"))
    elif done.status < 0:
        found.append(("crash", signal.Signals(-done.status).name + ": " + done.said[-200:].decode(errors="replace").strip()))
    if done.megabytes > MOST_MEGABYTES:
        found.append(("memory", f"{done.megabytes:.0f} MB"))
    if case.act is not None:
        if done.status > 0:
            found.append(("status", done.said.decode(errors="replace").strip()[-300:]))
        return found
    if done.status >= 0 and not done.is_hung:
        found += _words(case, done)
        if done.status not in case.status:
            found.append(("status", f"{done.status} in place of {case.status}: "
                                    f"{' '.join(done.said.decode(errors='replace').split())[:300]}"))
    found += _changes(case, done)
    return sorted(found, key=lambda fault: FAULTS.index(fault[0]))
