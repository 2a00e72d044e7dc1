# SPDX-License-Identifier: BSD-3-Clause
import os
import sys

from waft import ending
from waft.cli import main
from waft.watching import keep_stops


def arguments():
    """Those of the guard (guard.py), or of the command line."""
    given = os.environ.pop("WAFT_ARGUMENTS", None)
    if given is None:
        return sys.argv[1:]
    size = os.fstat(int(given)).st_size
    return [os.fsdecode(argument) for argument in os.pread(int(given), size, 0).split(b"\0")]


keep_stops()
ending.leave(lambda: main(arguments()))
