# SPDX-License-Identifier: BSD-3-Clause
"""A run of `waft check` beside Blender, on a scene in a temporary folder. Nothing here knows of Blender."""
import json
import shutil
import subprocess
import tempfile

from .command import Process


class Look(Process):
    """A running `waft check`. write(folder): writes the scene, returns its file."""

    def __init__(self, command, write):
        self._folder = tempfile.mkdtemp(prefix="waft-check-")
        try:
            super().__init__([command, "check", "--json", write(self._folder)], subprocess.DEVNULL, None)
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
        try:
            answer = json.loads("\n".join(self.said))
        except ValueError:
            return 0, [], [], ["\n".join(self.said)[-300:] or "waft ended without a word"]
        if "error" in answer:
            return 0, [], [], [answer["error"].replace(f"{self._folder}/", "")]
        lost, hard = ([finding["text"] for finding in answer["findings"] if finding["possible"] == is_hard] for is_hard in (False, True))
        return len(lost), lost, hard, []
