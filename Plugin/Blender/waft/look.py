# SPDX-License-Identifier: BSD-3-Clause
"""A run of `waft check` beside Blender, on a scene in a temporary folder. Nothing here knows of Blender."""
import re
import shutil
import tempfile

from .command import ALL_MET, NOT_ALL_MET, Process

_KINDS = ("cannot be met: ", "hard: ")  # how its lines begin
_COUNT = re.compile(r" constraints, (\d+) of them cannot be met, ")  # in its last line: it may name only the first few


class Look(Process):
    """A running `waft check`. write(folder): writes the scene, returns its file."""

    def __init__(self, command, write):
        self._folder = tempfile.mkdtemp(prefix="waft-check-")
        try:
            super().__init__([command, "check", write(self._folder)])
        except BaseException:
            self._clear()
            raise

    def _clear(self):
        shutil.rmtree(self._folder, ignore_errors=True)

    def kill(self):
        super().kill()
        self._clear()

    def poll(self):
        """(how many marks cannot be met; sentences: which, what is hard, why it failed) once it has ended, else None."""
        status = self.status()
        if status is None:
            return None
        self._clear()
        lines = [line.removeprefix("waft: ").removeprefix("warning: ") for line in self.said if line.startswith("waft: ")]
        found = {kind: [line.removeprefix(kind) for line in lines if line.startswith(kind)] for kind in _KINDS}
        if status in (ALL_MET, NOT_ALL_MET):
            counted = [match for match in map(_COUNT.search, lines) if match]
            return int(counted[-1][1]) if counted else len(found[_KINDS[0]]), *found.values(), []
        wrong = [line.replace(f"{self._folder}/", "") for line in lines] or ["\n".join(self.said)[-300:] or "waft ended without a word"]
        return 0, [], [], wrong
