# SPDX-License-Identifier: BSD-3-Clause
"""What can go wrong, and the exit status that says so."""
from waft.texts import line, shortened

ALL_MET = 0
FAILED = 1
MALFORMED = 2
NOT_ALL_MET = 3
STOPPED_EARLY = 4


class WaftError(Exception):
    """A run could not be done; `status` is the exit status of the command. The message is one line of text that can be read."""

    status = FAILED

    def __init__(self, message):
        super().__init__(line(shortened(message)))


class InputError(WaftError):
    """Malformed input or usage: the message names file, place in it and what was expected."""

    status = MALFORMED


BadInput = InputError  # what it was called before


class Interrupted(WaftError):
    """Stopped before there was anything worth writing."""

    status = STOPPED_EARLY
