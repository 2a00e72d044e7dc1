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
import ctypes
import os
import pathlib
import secrets
import select
import signal
import struct
import subprocess
import sys
import time

STOPS = {signal.SIGINT, signal.SIGTERM}
STOPPED_EARLY = 4
GRACE = 0.5  # s from a stop until a child that has nothing to write is ended
NOTHING_BEGUN = "stopped before anything was begun"
LIBC = ctypes.CDLL(None)


def start(command, blocked=(), death=signal.SIGKILL, **options):
    """A child that gets the signal `death` when this process ends, and takes all signals but those that are blocked."""
    guard = os.getpid()

    def prepare():
        LIBC.prctl(1, int(death))  # PR_SET_PDEATHSIG
        if os.getppid() != guard:
            os._exit(1)
        signal.pthread_sigmask(signal.SIG_SETMASK, blocked)

    return subprocess.Popen(command, preexec_fn=prepare, **options)


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


@contextlib.contextmanager
def display():
    """A virtual screen in DISPLAY; False when a stop came before it was there."""
    cookie = secrets.token_bytes(16)
    key = os.memfd_create("Xauthority")
    name = b"MIT-MAGIC-COOKIE-1"
    # Of any host (65535, no address) and any display (no number): the file is seen by our children alone.
    os.write(key, struct.pack(">HHHH18sH16s", 65535, 0, 0, len(name), name, len(cookie), cookie))
    authority = f"/proc/{os.getpid()}/fd/{key}"
    first = 100 + os.getpid() % 900  # not 0, which programs take where no display is named
    server = None
    try:
        for number in range(first, first + 20):
            reading, writing = os.pipe()
            server = start(["Xvfb", f":{number}", "-displayfd", str(writing), "-screen", "0", "1280x1024x24",
                            "-nolisten", "tcp", "-noreset", "-auth", authority],
                           death=signal.SIGTERM, pass_fds=(writing,), stderr=subprocess.DEVNULL)
            os.close(writing)
            while not select.select([reading], [], [], 0.05)[0]:
                if signal.sigpending() & STOPS:
                    yield False
                    return
            if os.read(reading, 16):  # its number, when it is ready; nothing when that is another's
                os.environ.update(DISPLAY=f":{number}", XAUTHORITY=authority)
                yield True
                return
        raise OSError("no virtual display: Xvfb could not be started")
    finally:
        if server is not None:
            server.terminate()
            server.wait()


def say(text):
    """A line on stderr, in place of the progress line when that is a terminal."""
    print(("\r\033[K" if sys.stderr.isatty() else "") + f"waft: {text}", file=sys.stderr)


def parse(arguments):
    """The options; --help, --version and malformed usage end here, before ParaView is started for them."""
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
    from waft import cli

    return cli.parse(arguments)


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
