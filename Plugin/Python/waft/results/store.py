# SPDX-License-Identifier: BSD-3-Clause
"""What finished runs leave for later ones beside their results (Bridge/Run/StateStore.h), looked at from outside: the states of their
air, by the keys of the runs."""
import contextlib
import os
import pathlib
import re
from typing import List, NamedTuple, Optional

from waft.beneath import Folder
from waft.failures import InputError

_KEY = re.compile(r"[0-9a-f]{64}")
_END = ".state"


class Entry(NamedTuple):
    name: str
    size: int
    used: float  # when, in seconds since 1970


def place() -> Optional[pathlib.Path]:
    """The folder that the environment names as WAFT_CACHE, else ~/.cache/waft; None without a home."""
    named, home = os.environ.get("WAFT_CACHE"), os.environ.get("HOME")
    return pathlib.Path(named) if named else pathlib.Path(home, ".cache", "waft") if home else None


class Store:
    """The folder; several processes may use it at once. Files in it of other names are left alone."""

    def __init__(self):
        self._folder: Optional[Folder] = None
        self.path = place()
        with contextlib.suppress(OSError, InputError):
            if self.path is not None:
                self._folder = Folder(self.path)

    def holds(self, key) -> bool:
        """Whether there is the state of a run, without its being used."""
        return any(entry.name == f"{key}{_END}" for entry in self.entries())

    def entries(self) -> List[Entry]:
        """What it holds, the oldest first."""
        if self._folder is None:
            return []
        about = {name: self._folder.about(name) for name in self._folder.names() if _KEY.fullmatch(name[:-len(_END)]) and name.endswith(_END)}
        held = [Entry(name, state.st_size, state.st_mtime) for name, state in about.items() if self._folder.is_regular(state)]
        return sorted(held, key=lambda entry: entry.used)

    def remove(self, name) -> None:
        with contextlib.suppress(OSError):  # another process has, too
            if self._folder is not None:
                self._folder.remove(name)
