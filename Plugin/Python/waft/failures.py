# SPDX-License-Identifier: BSD-3-Clause
"""What can go wrong, and the exit status that says so."""

ALL_MET = 0
FAILED = 1
MALFORMED = 2
NOT_ALL_MET = 3
STOPPED_EARLY = 4


_LONGEST = 1800  # characters of a message; what is longer repeats what a file or a caller said


class WaftError(Exception):
    """A run could not be done; `status` is the exit status of the command. What is too long to read loses its middle."""

    status = FAILED

    def __init__(self, message):
        text = str(message).encode("utf-8", "backslashreplace").decode("utf-8")
        half = _LONGEST // 2
        super().__init__(text if len(text) <= _LONGEST else f"{text[:half]} ... {text[-half:]}")


class BadInput(WaftError):
    """Malformed input or usage: the message names file, place in it and what was expected."""

    status = MALFORMED


class Interrupted(WaftError):
    """Stopped before there was anything worth writing."""

    status = STOPPED_EARLY
