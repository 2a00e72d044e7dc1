# SPDX-License-Identifier: BSD-3-Clause
"""The process that is the command `waft`: it runs pvpython as a child and answers stops that the child cannot.

    python3 -I guard.py COMMAND ...         SIGINT and SIGTERM come in blocked, so that none is lost meanwhile

The child looks whether to stop between two pieces of its work. While ParaView starts, and within a long call of a
library, it cannot; as long as it has nothing to write it is ended from here then, at once and without a trace. It
tells through a pipe, a line each, what stands for it:

    limit S         the time limit: S seconds from now
    words TEXT      what to say when it is ended; none: it has something to write and ends by itself
    made FOLDER     it made this folder, which goes when it is empty; the innermost first

Nothing here needs more than Python's own library, nor do the commands that do without ParaView, which are done here.
"""
import contextlib
import os
import pathlib
import signal
import sys
import time

if __name__ == "__main__":  # run by its file alone: the package is where that is
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from waft.display import STOPS, display, start  # noqa: E402

STOPPED_EARLY = 4
GRACE = 0.5  # s from a stop until a child that has nothing to write is ended
NOTHING_BEGUN = "stopped before anything was begun"


class Told:
    """What the child told of itself."""

    def __init__(self, end):
        os.set_blocking(end, False)
        self._end = end
        self._text = b""
        self.words = NOTHING_BEGUN
        self.deadline = None
        self.made = []

    def read(self):
        with contextlib.suppress(BlockingIOError):
            self._text += os.read(self._end, 65536)
        *lines, self._text = self._text.split(b"\n")
        for line in lines:
            key, _, value = line.decode("utf-8", "replace").partition(" ")
            if key == "words":
                self.words = value
            elif key == "limit":
                self.deadline = time.monotonic() + float(value)
            elif key == "made":
                self.made.append(value)


def watch(arguments):
    """Runs `waft` with these arguments to its end; returns its exit status, negative when a signal ended it."""
    reading, writing = os.pipe()
    package = pathlib.Path(__file__).resolve().parent
    environment = {**os.environ, "WAFT_GUARD": str(writing), "OMPI_MCA_ess_singleton_isolated": "1",  # no daemon of MPI
                   "HWLOC_COMPONENTS": os.environ.get("HWLOC_COMPONENTS", "-gl"),  # nor a look at the X server's cards
                   "PYTHONPATH": os.pathsep.join([str(package.parent), *filter(None, [os.environ.get("PYTHONPATH")])])}
    child = start(["pvpython", str(package / "__main__.py"), *arguments], STOPS, pass_fds=(writing,), env=environment)
    os.close(writing)
    told = Told(reading)
    asked = None
    while child.poll() is None:
        got = signal.sigtimedwait(STOPS | {signal.SIGCHLD}, 0.1)
        told.read()
        now = time.monotonic()
        if got is not None and got.si_signo in STOPS:
            child.send_signal(got.si_signo)
            asked = asked or now
        if told.deadline is not None and now >= told.deadline:
            asked = asked or told.deadline
        if asked is not None and told.words and now >= asked + GRACE:
            child.kill()
            child.wait()
            told.read()
            for folder in told.made:
                with contextlib.suppress(OSError):
                    os.rmdir(folder)
            say(told.words)
            return STOPPED_EARLY
    return child.returncode


def say(text):
    """A line on stderr, in place of the progress line when that is a terminal."""
    print(("\r\033[K" if sys.stderr.isatty() else "") + f"waft: {text}", file=sys.stderr)


def parse(arguments):
    """The options; --help, --version and malformed usage end here, before ParaView is started for them."""
    from waft import cli

    return cli.parse(arguments)


def check_version(command):
    """Ends the process where the command is of another version than this package."""
    from waft.loading import version

    if command not in (None, version()):
        say(f"the command is of Waft {command}, the package {pathlib.Path(__file__).resolve().parent} of Waft {version()}: "
            "install both anew, from one")
        sys.exit(1)


def main(arguments):
    if not parse(arguments).needs_paraview:
        from waft import cli, watching

        watching.note_stops()
        return cli.main(arguments)
    signal.pthread_sigmask(signal.SIG_BLOCK, STOPS | {signal.SIGCHLD})
    if arguments[:1] not in (["demo"], ["render"]) or os.environ.get("DISPLAY"):
        return watch(arguments)
    with display() as is_there:
        if is_there:
            return watch(arguments)
    say(NOTHING_BEGUN)
    return STOPPED_EARLY


if __name__ == "__main__":
    try:
        check_version(globals().get("COMMAND_VERSION"))  # that of the installed command
        status = main(sys.argv[1:])
    except OSError as error:
        say(error)
        status = 1
    if status < 0:  # as if there were no process in between
        if -status == signal.SIGKILL:  # whose action cannot be set
            say("ended by SIGKILL, as systems do when memory runs out")
        else:
            signal.signal(-status, signal.SIG_DFL)
        signal.pthread_sigmask(signal.SIG_UNBLOCK, [-status])
        os.kill(os.getpid(), -status)
    sys.exit(status)
