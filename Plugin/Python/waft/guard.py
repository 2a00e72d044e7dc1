# SPDX-License-Identifier: BSD-3-Clause
"""What the program `waft` hands over to Python: a child is run that has ParaView, and stops are answered that it cannot.

    python3 -I guard.py COMMAND ...         SIGINT and SIGTERM come in blocked, so that none is lost meanwhile

The child looks whether to stop between two pieces of its work. While it starts, and within a long call of a
library, it cannot; as long as it has nothing to write it is ended from here then, at once and without a trace. It
reports through a pipe, a line of JSON each (`[key, value]`: a name may hold any letter), what stands for it:

    words TEXT      what to say when it is ended; none: it has something to write and ends by itself

Nothing here needs more than Python's own library, nor do the commands that do without ParaView, which are done here.
"""
import contextlib
import json
import os
import pathlib
import signal
import sys
import tempfile
import time

if __name__ == "__main__":  # run by its file alone: the package is where that is
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from waft import ending, failures, texts  # noqa: E402
from waft.display import STOPS, display, start  # noqa: E402

GRACE = 0.5  # s from a stop until a child that has nothing to write is ended
PACKAGE = pathlib.Path(__file__).resolve().parent
NOTHING_BEGUN = "stopped before anything was begun"
# Lists of folders that programs look into, in which an empty entry is the working folder.
SEARCHED = ("PATH", "LD_LIBRARY_PATH", "PV_PLUGIN_PATH", "QT_PLUGIN_PATH")


class Reports:
    """What the child reported of itself."""

    def __init__(self, end):
        os.set_blocking(end, False)
        self._end = end
        self._text = b""
        self.words = NOTHING_BEGUN

    def read(self):
        with contextlib.suppress(BlockingIOError):
            self._text += os.read(self._end, 65536)
        *lines, self._text = self._text.split(b"\n")
        for line in lines:
            key, value = json.loads(line)
            if key == "words":
                self.words = value


def watch(arguments):
    """Has pvpython run `waft` with these arguments to its end; returns its exit status, negative when a signal ended it. Raises
    Interrupted where it had to be ended."""
    from waft.cli import speaking

    variables, descriptors = speaking.for_child()
    reading, writing = os.pipe()
    given = os.memfd_create("waft")  # pvpython takes no names that are not of its locale
    os.write(given, b"\0".join(map(os.fsencode, arguments)))
    environment = {**environment_of_child(), **variables, "WAFT_GUARD": str(writing), "WAFT_ARGUMENTS": str(given),
                   "OMPI_MCA_ess_singleton_isolated": "1"}  # no daemon of MPI
    child = start(["pvpython", str(PACKAGE / "__main__.py")], STOPS, pass_fds=(writing, given, *descriptors), env=environment)
    os.close(writing)
    os.close(given)
    reports = Reports(reading)
    asked = None
    while child.poll() is None:
        got = signal.sigtimedwait(STOPS | {signal.SIGCHLD}, 0.1)
        reports.read()
        now = time.monotonic()
        if got is not None and got.si_signo in STOPS:
            child.send_signal(got.si_signo)
            asked = asked or now
        if asked is not None and reports.words and now >= asked + GRACE:
            child.kill()
            child.wait()
            clear_line()
            raise failures.Interrupted(reports.words)
    return child.returncode


def environment_of_child():
    return {**os.environ,
            "LC_ALL": "C.UTF-8",  # whose names of files are any
            "HWLOC_COMPONENTS": os.environ.get("HWLOC_COMPONENTS", "-gl"),  # no look at the X server's cards
            "PYTHONPATH": str(PACKAGE.parent),
            "PYTHONNOUSERSITE": "1"}


def clear_line():
    """Takes away the progress line of a child that cannot any more."""
    if sys.stderr.isatty():
        print("\r\033[K", end="", file=sys.stderr)


def say(text):
    texts.say(f"waft: {text}", "error")


def parse(arguments):
    """The options; --help, --version and malformed usage end here, before ParaView is started for them."""
    from waft import cli

    return cli.parse(arguments)


def settle_environment():
    """What the shell hands over, as all processes of the command are to have it."""
    for name in SEARCHED:
        folders = os.environ.get(name)
        if folders is not None:
            os.environ[name] = os.pathsep.join(filter(None, folders.split(os.pathsep)))
    folder = os.environ.get("TMPDIR")
    if folder is not None and not (os.path.isdir(folder) and os.access(folder, os.W_OK | os.X_OK)):
        os.environ["TMPDIR"] = tempfile.gettempdir()  # as Python has it; MPI would take the other, and fail
    # What a shell sets for another Python, or its user has installed for one, need not fit ParaView's.
    for name in list(os.environ):
        if name.startswith("PYTHON") or name in ("WAFT_GUARD", "WAFT_ARGUMENTS", "WAFT_GUARD_LOG"):
            del os.environ[name]


def main(arguments):
    options = parse(arguments)
    settle_environment()
    from waft import cli, watching

    if not options.is_guarded:
        watching.keep_stops()
        return cli.main(arguments)
    signal.pthread_sigmask(signal.SIG_BLOCK, STOPS | {signal.SIGCHLD})
    return cli.carry_out(options, arguments, lambda _: watch_with_display(arguments))


def watch_with_display(arguments):
    """The same with a display, where one is needed."""
    if arguments[:1] not in (["demo"], ["render"]) or os.environ.get("DISPLAY"):
        return watch(arguments)
    with display() as is_there:
        if is_there:
            return watch(arguments)
    raise failures.Interrupted(NOTHING_BEGUN)


def run():
    try:
        return main(sys.argv[1:])
    except OSError as error:
        say(error)
        return failures.FAILED


if __name__ == "__main__":
    ending.leave(run)
