# SPDX-License-Identifier: BSD-3-Clause
"""How a process of the command ends: what it printed is where it belongs, or its status says that it is not. Nothing here needs more
than Python's own library."""
import errno
import io
import os
import signal
import sys

from waft import failures
from waft.display import STOPS
from waft.texts import say


class Unwritten(Exception):
    """Stdout cannot be written to; no OSError, so that nobody takes it for one of the work."""

    def __init__(self, error):
        super().__init__(f"stdout: could not be written: {error.strerror}")
        self.errno = error.errno


class _Stdout(io.FileIO):
    def write(self, data):
        try:
            return super().write(data)
        except OSError as error:
            raise Unwritten(error) from error


class _Stderr(io.FileIO):
    def write(self, data):
        try:
            return super().write(data)
        except OSError:  # the work matters more than what is said of it
            return len(data)


def leave(act):
    """Calls act() and ends the process with the status that it gives, which is negative for a signal. Where stdout is full the status
    is 1, and where nobody reads it any more SIGPIPE ends the process, as it does others. What is printed is UTF-8."""
    _fill_gaps()
    sys.stdout, sys.stderr = (io.TextIOWrapper(io.BufferedWriter(kind(number, "w", closefd=False)), encoding="utf-8",
                                               errors="backslashreplace", line_buffering=number == 2 or os.isatty(number))
                              for number, kind in ((1, _Stdout), (2, _Stderr)))
    status = failures.FAILED
    try:
        try:
            status = act()
        except SystemExit as end:
            status = end.code or failures.ALL_MET
        sys.stdout.flush()
    except Unwritten as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # for what waits in buffers
        status = -signal.SIGPIPE if error.errno == errno.EPIPE else failures.FAILED
        if status == failures.FAILED:
            say(f"waft: {error}", "error")
    if status < 0:
        _end_by(-status)
    for number in STOPS:  # all is done: one that comes while Python ends, which would give it back its default, changes nothing
        signal.signal(number, signal.SIG_IGN)
    sys.exit(status)


def _fill_gaps():
    """What is closed of stdin, stdout and stderr would be taken by the next file that is opened; now it is a file that cannot be
    written."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDONLY)  # takes the lowest number that is free
            os.set_inheritable(number, True)


def _end_by(number):
    """Ends the process by a signal, as if there were no other in between."""
    if number == signal.SIGKILL:  # whose action cannot be set
        say("waft: ended by SIGKILL, as systems do when memory runs out", "error")
    else:
        signal.signal(number, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, [number])
    os.kill(os.getpid(), number)
