# SPDX-License-Identifier: BSD-3-Clause
"""What finished runs leave for later ones beside their results: the states of their air, by the keys of the runs. Nothing needs it to be
right: without a home, room or rights all works as without it, and what is gone is made again."""
import contextlib
import os
import pathlib
import re
from typing import List, NamedTuple, Optional

from waft.beneath import Folder
from waft.failures import InputError
from waft.files import copy_file, whole_file

MOST = 5_000_000_000  # bytes; beyond them the oldest go
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

    def __init__(self, most=MOST):
        self._most = most
        self._folder: Optional[Folder] = None
        self.path = place()
        with contextlib.suppress(OSError, InputError):
            if self.path is not None:
                self.path.mkdir(mode=0o700, parents=True, exist_ok=True)
                self._folder = Folder(self.path)

    def found(self, key) -> Optional[pathlib.Path]:
        """The state of a run; None where there is none."""
        name = self._name(key)
        with contextlib.suppress(OSError, InputError):
            if self._folder is not None and name and self._folder.found(name) is not None:
                os.utime(name, dir_fd=self._folder.descriptor, follow_symlinks=False)
                return self._folder.path / name
        return None

    def holds(self, key) -> bool:
        """Whether there is the state of a run, without its being used."""
        return any(entry.name == self._name(key) for entry in self.entries())

    def keep(self, key, folder, name) -> None:
        """Takes a file of a Folder over as the state of a run, where there is room for it."""
        own = self._name(key)
        if self._folder is None or not own or not folder.is_regular(folder.about(name)):
            return
        try:
            folder.move(name, self._folder, own, replaces=True)
        except OSError:  # on another file system
            with contextlib.suppress(OSError, InputError), whole_file(os.fspath(self._folder.path / own), lambda path: True) as part:
                copy_file(folder.file(name), part)
        self._drop_oldest(own)

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

    def _drop_oldest(self, latest):
        with contextlib.suppress(OSError):
            entries = self.entries()
            size = sum(entry.size for entry in entries)
            for entry in entries:
                if size > self._most and entry.name != latest:
                    self.remove(entry.name)
                    size -= entry.size

    @staticmethod
    def _name(key):
        return key + _END if isinstance(key, str) and _KEY.fullmatch(key) else ""
