# SPDX-License-Identifier: BSD-3-Clause
"""Errors, progress, interrupts and time limits of the stages of a pipeline."""
import contextlib
import json
import os
import re
import resource
import signal
import sys
import threading
import time

from waft.display import STOPS
from waft.failures import Interrupted
from waft.messages import is_quiet
from waft.texts import line, say

NOTHING_COMPUTED = "stopped before anything was computed: nothing was written"
_FIGURES = re.compile(r"[\d.,+-]+")
_kept_stops = []  # stops that came while nobody was there to take them


def _keep(number, _frame):
    _kept_stops.append(number)


def keep_stops():
    """For the command, whose signals come in blocked: a stop that comes before a Clock is there waits for it, one that
    comes after it finds nothing left to do but to write."""
    for number in STOPS:
        signal.signal(number, _keep)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, STOPS)


def report_to_guard(key, value):
    """Reports to the process that guards this one, if there is one (guard.py)."""
    pipe = os.environ.get("WAFT_GUARD")
    if pipe is not None:
        os.write(int(pipe), json.dumps([key, value if isinstance(value, (int, float)) else str(value)]).encode() + b"\n")


def is_main_thread():
    return threading.current_thread() is threading.main_thread()


@contextlib.contextmanager
def _handling(handler):
    """Meanwhile stops go to a handler; not in a thread beside the main one, which alone gets signals."""
    if not is_main_thread():
        yield
        return
    before = {number: signal.signal(number, handler) for number in STOPS}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler if handler is not None else signal.SIG_DFL)


@contextlib.contextmanager
def passed_on(child):
    """Meanwhile a child has the stops that come here, and those that came before."""
    with _handling(lambda number, _: child.send_signal(number)):
        for number in _kept_stops:
            child.send_signal(number)
        yield


@contextlib.contextmanager
def interruptible(words):
    """Meanwhile a stop raises Interrupted(words), wherever Python is; for work in small pieces."""
    def interrupt(*_):
        raise Interrupted(words)

    with _handling(interrupt):
        if _kept_stops:
            interrupt()
        report_to_guard("words", words)
        yield


def collect(vtk_object, event, texts):
    """Appends what an object says with ErrorEvent or WarningEvent to a list, a line each, instead of VTK's printing; returns the
    object and its observer."""
    def take(_caller, _event, text):
        texts.append(_line(text))

    # VTK hands the text over only when the observer says that it wants a string.
    take.CallDataType = "string0"
    return vtk_object, vtk_object.AddObserver(event, take)


def _line(text):
    """A message of VTK without its preamble of source file, class and address."""
    if text is None:
        return "a message that is no UTF-8 text"  # VTK hands over none then
    preambles = ("ERROR: In", "Warning: In", "Generic Warning")
    line = " ".join(part for part in text.splitlines() if part.strip() and not part.startswith(preambles))
    head, separator, tail = line.partition("): ")
    return tail if separator and "(0x" in head else line


class Effort:
    """What work takes, from begin to end, added up.

    Attributes: seconds (by the clock), processor_seconds (of all the process's threads), thread_seconds (of them those of the thread
    that does it: what others could not help with is among them), peak_mb (the process's peak memory when it ended).
    """

    def __init__(self):
        self.seconds = 0.0
        self.processor_seconds = 0.0
        self.thread_seconds = 0.0
        self.peak_mb = 0.0
        self._began = None

    def begin(self):
        self._began = self._now()
        return self

    def end(self):
        if self._began is not None:
            clock, process, thread = (now - then for now, then in zip(self._now(), self._began))
            self.seconds += clock
            self.processor_seconds += process
            self.thread_seconds += thread
            self._began = None
        self.peak_mb = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
        return self

    @classmethod
    def of(cls, told):
        """As as_json says it."""
        effort = cls()
        effort.seconds, effort.processor_seconds, effort.thread_seconds, effort.peak_mb = (
            told[name] for name in ("seconds", "processorSeconds", "threadSeconds", "peakMemoryMB"))
        return effort

    def as_json(self):
        return {"seconds": self.seconds, "processorSeconds": self.processor_seconds, "threadSeconds": self.thread_seconds,
                "peakMemoryMB": self.peak_mb}

    @staticmethod
    def _now():
        return time.monotonic(), time.process_time(), time.thread_time()


class Clock:
    """Time limit, interrupt and progress: a line on stderr (when it is a terminal), and calls of a function.

    words: what is said when a stop comes while there is nothing to write; it is empty from keep() on. on_progress: called with
    the share that is done (0 to 1, never less than before) and a sentence; it stops the run by returning False, and ends it by
    an exception.
    """

    def __init__(self, time_limit=None, quiet=False, words=NOTHING_COMPUTED, on_progress=None):
        self.on_progress = on_progress
        self._done = 0.0
        self._failure = None
        self.started = time.monotonic()
        self.time_limit = time_limit
        self.interrupted = bool(_kept_stops)
        self.timed_out = False
        self.words = words
        self._quiet = quiet or is_quiet() or not sys.stderr.isatty()
        self._last = 0.0
        self.stage = ""  # that which is updated; those before it serve it
        self._told = ""  # its last sentence, without figures, which change all the time
        self._stopped_by = None
        self._earlier = {number: signal.getsignal(number) for number in STOPS}
        self._handling = _handling(self._stop)

    def __enter__(self):
        self._handling.__enter__()
        self.interrupted = self.interrupted or bool(_kept_stops)  # by the handler before ours, since this was made
        report_to_guard("words", self.words)
        return self

    def __exit__(self, *error):
        self._handling.__exit__(*error)
        if not self._quiet:
            print("\r\033[K", end="", file=sys.stderr)

    def _stop(self, number, _frame):
        self.interrupted = True
        self._stopped_by = number

    def hand_on(self):
        """What a stop would have done, had it not been taken to end the work early: a caller in a loop is to stop, too. Where he has a
        handler of his own that is called, else KeyboardInterrupt is raised, or SystemExit. To be called once all is put away."""
        if self._stopped_by is None:
            return
        earlier = self._earlier[self._stopped_by]
        if earlier not in (None, signal.SIG_DFL, signal.default_int_handler):  # pvpython has some that Python does not know
            if callable(earlier) and earlier is not _keep:
                earlier(self._stopped_by, None)
        elif self._stopped_by == signal.SIGINT:
            raise KeyboardInterrupt
        else:
            raise SystemExit(128 + self._stopped_by)

    def keep(self):
        """From now on there is something to write when it is stopped."""
        if self.words:
            self.words = ""
            report_to_guard("words", self.words)

    def check(self):
        """Raises Interrupted when it is to stop and there is nothing to write, or what hand_on does."""
        self.check_progress()
        if self.words and self.should_stop():
            self.hand_on()
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

    def check_progress(self):
        """Raises what on_progress raised; within VTK, from where it is called, it would be lost."""
        if self._failure is not None:
            raise self._failure

    def show(self, name, fraction, text):
        now = time.monotonic()
        if now - self._last < 0.2:
            return
        self._last = now
        told = _FIGURES.sub("", text or "")
        if name == self.stage and told and told != self._told:
            self._told = told
            say(f"waft: {name}: {text}", "detail")
        self.report(fraction, ": ".join(filter(None, (name, text))))
        if self._quiet:
            return
        print("\r\033[K" + line(f"{name} {100.0 * fraction:3.0f} %  {text or ''}")[:104], end="", file=sys.stderr)

    def report(self, done, text):
        """Calls on_progress."""
        self._done = max(self._done, done)
        if self.on_progress is None or self._failure is not None:
            return
        try:
            if self.on_progress(self._done, text) is False:
                self.interrupted = True
        except BaseException as error:  # noqa: B902 (raised again by check_progress)
            self._failure = error
            self.interrupted = True
