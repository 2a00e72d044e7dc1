# SPDX-License-Identifier: BSD-3-Clause
"""Children that end with this process, and a virtual screen. Nothing here needs more than Python's own library."""
import contextlib
import ctypes
import os
import secrets
import select
import signal
import struct
import subprocess

STOPS = {signal.SIGINT, signal.SIGTERM, signal.SIGUSR1}  # the last is what launchers and batch systems hand on
_LIBC = ctypes.CDLL(None)


def start(command, blocked=(), death=signal.SIGKILL, **options):
    """A child that gets the signal `death` when this process ends, and takes all signals but those that are blocked."""
    parent = os.getpid()

    def prepare():
        _LIBC.prctl(1, int(death))  # PR_SET_PDEATHSIG
        if os.getppid() != parent:
            os._exit(1)
        signal.pthread_sigmask(signal.SIG_SETMASK, blocked)

    return subprocess.Popen(command, preexec_fn=prepare, **options)


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
