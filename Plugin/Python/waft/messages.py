# SPDX-License-Identifier: BSD-3-Clause
"""What this process says while it works: how much of it is shown, and the log that has all of it. Nothing here needs more than Python's
own library."""
import contextlib
import datetime
import os
import sys
from typing import Iterator, Optional

LOUDNESS = ("quiet", "normal", "verbose")
# The least loudness at which a message of a kind is shown; what is only for the log has none.
_SHOWN = {"error": 0, "warning": 0, "note": 1, "detail": 2, "record": len(LOUDNESS)}


class _Voice:
    loudness = 1
    log: Optional[int] = None  # its descriptor


_voice = _Voice()


@contextlib.contextmanager
def speaking(loudness: str, log: Optional[int]) -> Iterator[None]:
    """Meanwhile messages are shown as one of LOUDNESS says, and written to a descriptor, a line each."""
    before = _voice.loudness, _voice.log
    _voice.loudness, _voice.log = LOUDNESS.index(loudness), log
    try:
        yield
    finally:
        _voice.loudness, _voice.log = before


def emit(text: str, kind: str) -> None:
    """A message, of one line: on stderr and in the log."""
    if _voice.loudness >= _SHOWN[kind]:
        print(text, file=sys.stderr, flush=True)
    if _voice.log is None:
        return
    now = datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="milliseconds").replace("+00:00", "Z")
    try:
        os.write(_voice.log, f"{now} {kind:7} {text}\n".encode(errors="backslashreplace"))
    except OSError as error:  # the work matters more than what is said of it
        _voice.log = None
        emit(f"waft: warning: nothing more is written to the log: {error.strerror}", "warning")


def log() -> Optional[int]:
    """The descriptor of the log, for a process that is to write to it as well."""
    return _voice.log


def is_quiet() -> bool:
    return _voice.loudness == 0
