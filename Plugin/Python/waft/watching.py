# SPDX-License-Identifier: BSD-3-Clause
"""Errors, progress, interrupts and time limits of the stages of a pipeline."""
import contextlib
import os
import resource
import signal
import sys
import time

from waft.failures import Interrupted

STOPS = (signal.SIGINT, signal.SIGTERM)
NOTHING_COMPUTED = "stopped before anything was computed: nothing was written"
_noted = []  # stops that came while nobody was there to take them


def note_stops():
    """For the command, whose signals come in blocked: a stop that comes before a Clock is there waits for it, one that
    comes after it finds nothing left to do but to write."""
    for number in STOPS:
        signal.signal(number, lambda which, _: _noted.append(which))
    signal.pthread_sigmask(signal.SIG_UNBLOCK, STOPS)


def tell_guard(key, value):
    """Tells the process that guards this one, if there is one (guard.py)."""
    pipe = os.environ.get("WAFT_GUARD")
    if pipe is not None:
        os.write(int(pipe), f"{key} {value}\n".encode())


@contextlib.contextmanager
def _handling(handler):
    """Meanwhile stops go to a handler."""
    before = {number: signal.signal(number, handler) for number in STOPS}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler if handler is not None else signal.SIG_DFL)


@contextlib.contextmanager
def interruptible(words):
    """Meanwhile a stop raises Interrupted(words), wherever Python is; for work in small pieces."""
    def interrupt(*_):
        raise Interrupted(words)

    with _handling(interrupt):
        if _noted:
            interrupt()
        tell_guard("words", words)
        yield


def collect(vtk_object, event, texts):
    """Appends what an object says with ErrorEvent or WarningEvent to a list, a line each, instead of VTK's printing."""
    def take(_caller, _event, text):
        texts.append(_line(text))

    # VTK hands the text over only when the observer says that it wants a string.
    take.CallDataType = "string0"
    vtk_object.AddObserver(event, take)


def _line(text):
    """A message of VTK without its preamble of source file, class and address."""
    if text is None:
        return "a message that is no UTF-8 text"  # VTK hands over none then
    preambles = ("ERROR: In", "Warning: In", "Generic Warning")
    line = " ".join(part for part in text.splitlines() if part.strip() and not part.startswith(preambles))
    head, separator, tail = line.partition("): ")
    return tail if separator and "(0x" in head else line


class StageWatch:
    """Follows one proxy's algorithm while it executes.

    Attributes: errors and warnings (each a line), seconds (wall time of its executions), processor_seconds (of all
    the process's threads meanwhile), peak_mb (the process's peak memory when it ended), was_aborted.
    """

    def __init__(self, name, proxy, clock, port=0):
        self.name = name
        self.errors = []
        self.warnings = []
        self.seconds = 0.0
        self.processor_seconds = 0.0
        self.peak_mb = 0.0
        self.was_aborted = False
        self.can_stop = False  # while the stage computes, not while it serves frames later
        self.clock = clock
        self._started = None
        self._shown = None
        self.algorithm = proxy.GetClientSideObject()
        self.algorithm.AddObserver("StartEvent", self._start)
        self.algorithm.AddObserver("EndEvent", self._end)
        self.algorithm.AddObserver("ProgressEvent", self._progress)

        collect(self.algorithm, "ErrorEvent", self.errors)
        collect(self.algorithm.GetExecutive(), "ErrorEvent", self.errors)
        collect(self.algorithm, "WarningEvent", self.warnings)

    def _start(self, *_):
        self._started = (time.monotonic(), time.process_time())

    def _end(self, *_):
        if self._started is not None:
            self.seconds += time.monotonic() - self._started[0]
            self.processor_seconds += time.process_time() - self._started[1]
            self._started = None
        self.peak_mb = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0

    def _progress(self, *_):
        if self.can_stop and self.clock.should_stop() and not self.was_aborted:
            self.was_aborted = True
            self.algorithm.SetAbortExecute(1)
        self.clock.show(self.name, self.algorithm.GetProgress(), self.algorithm.GetProgressText())


class Clock:
    """Time limit, interrupt and a progress line on stderr (when it is a terminal).

    words: what is said when a stop comes while there is nothing to write; it is empty from keep() on.
    """

    def __init__(self, time_limit=None, quiet=False, words=NOTHING_COMPUTED):
        self.started = time.monotonic()
        self.time_limit = time_limit
        self.interrupted = bool(_noted)
        self.timed_out = False
        self.words = words
        self._quiet = quiet or not sys.stderr.isatty()
        self._last = 0.0
        self._handling = _handling(self._stop)

    def __enter__(self):
        self._handling.__enter__()
        tell_guard("words", self.words)
        if self.time_limit:
            tell_guard("limit", self.time_limit)
        return self

    def __exit__(self, *error):
        self._handling.__exit__(*error)
        if not self._quiet:
            print("\r\033[K", end="", file=sys.stderr)

    def _stop(self, *_):
        self.interrupted = True

    def keep(self):
        """From now on there is something to write when it is stopped."""
        if self.words:
            self.words = ""
            tell_guard("words", self.words)

    def check(self):
        """Raises Interrupted when it is to stop and there is nothing to write."""
        if self.words and self.should_stop():
            raise Interrupted(self.words)

    def remaining(self):
        """Seconds left of the time limit; None without one."""
        if not self.time_limit:
            return None
        return self.time_limit - (time.monotonic() - self.started)

    def should_stop(self):
        left = self.remaining()
        if left is not None and left <= 0.0:
            self.timed_out = True
        return self.interrupted or self.timed_out

    def show(self, name, fraction, text):
        now = time.monotonic()
        if self._quiet or now - self._last < 0.2:
            return
        self._last = now
        print(f"\r\033[K{name} {100.0 * fraction:3.0f} %  {text or ''}"[:110], end="", file=sys.stderr)
