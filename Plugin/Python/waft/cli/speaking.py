# SPDX-License-Identifier: BSD-3-Clause
"""The options -q, -v and --log of a command line.

A log is a text: a line that names the version and the command line, a line a message (the time, UTC; its kind; its words), the exit
status, and the mark of a text that Waft wrote (marks.py). It grows while the command works. One that has no mark yet is that of a
command at work, or of one that was killed: no other takes its place.
"""
import contextlib
import os
import shlex

from waft import messages
from waft.files import appending, whole_file, write_text
from waft.loading import version
from waft.marks import is_marked_text, mark_of_text
from waft.texts import line, say, shortened

_INHERITED = "WAFT_GUARD_LOG"  # the descriptor of the log of the process that guards this one


def for_child():
    """(variables, descriptors) that a child of this process needs to write to its log."""
    log = messages.log()
    return ({}, ()) if log is None else ({_INHERITED: str(log)}, (log,))


@contextlib.contextmanager
def speaking(options, arguments):
    """Meanwhile messages are shown and kept as the options of a command line ask. Yields a function that takes the exit status in, and
    gives it back. Raises InputError where something is in the place of the log that is none, or was changed since."""
    inherited = os.environ.pop(_INHERITED, None)
    if inherited is not None or options.log is None:
        with messages.speaking(options.loudness, None if inherited is None else int(inherited)):
            yield lambda status: status
        return
    log = _begun(options.log, arguments)
    try:
        with messages.speaking(options.loudness, log):
            yield _record
        with contextlib.suppress(OSError):
            os.write(log, mark_of_text(os.pread(log, os.fstat(log).st_size, 0)))
    finally:
        os.close(log)


def _record(status):
    say(f"waft: ends with status {status}", "record")
    return status


def _begun(path, arguments):
    """A descriptor of a new log."""
    words = shortened(line(" ".join(map(shlex.quote, arguments))))
    try:
        with whole_file(path, is_marked_text) as part:
            write_text(part, f"waft {version()}: waft {words}\n")
    except OSError as error:
        raise OSError(f"{path}: could not be written: {error.strerror}") from error
    return appending(path)
