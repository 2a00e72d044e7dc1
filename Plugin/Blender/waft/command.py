# SPDX-License-Identifier: BSD-3-Clause
"""The program `waft`, and a process of it beside Blender. Nothing here knows of Blender."""
import atexit
import collections
import os
import pathlib
import shutil
import signal
import subprocess
import threading

ALL_MET, FAILED, BAD_INPUT, NOT_ALL_MET, STOPPED_EARLY = range(5)  # what waft ends with
_KEPT_LINES = 2000  # of what it says
_PREFERENCES = "Edit > Preferences > Add-ons > Waft"
_WAIT = 20.0  # s for its version


def find_command(chosen, package):
    """(path of the program waft, "") or (None, what is said where there is none). chosen: a path of the user's, or "". package:
    the add-on's folder, PREFIX/share/blender/scripts/addons/... where it came with Waft."""
    if chosen:
        if os.path.isfile(chosen) and os.access(chosen, os.X_OK):
            return chosen, ""
        return None, f"{chosen} (of the add-on's preferences) is no program: expected the path of waft"
    parents = pathlib.Path(package).parents
    beside = parents[4] / "bin" / "waft" if len(parents) > 4 else None
    found = str(beside) if beside is not None and os.access(beside, os.X_OK) else shutil.which("waft")
    if found:
        return found, ""
    return None, f"no waft was found: name the program in {_PREFERENCES} (of a checkout, its file waft, after ./waft build)"


class Version:
    """What a program answers to --version; text is "" until it has, and says so where it is no waft. done is called then."""

    def __init__(self, command, done):
        self.command = command
        self.text = ""
        threading.Thread(target=self._ask, args=(done,), daemon=True).start()

    def _ask(self, done):
        try:
            answer = subprocess.run([self.command, "--version"], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                                    timeout=_WAIT, check=False)
            said = answer.stdout.strip() if answer.returncode == 0 else ""
            self.text = said if said.startswith("waft ") else "this is no waft: it does not tell its version"
        except (OSError, ValueError, subprocess.SubprocessError) as error:
            self.text = f"cannot be run: {getattr(error, 'strerror', None) or type(error).__name__}"
        done()


class Process:
    """A running command of waft."""

    def __init__(self, line, errors=subprocess.PIPE, most=_KEPT_LINES):
        self.said = collections.deque(maxlen=most)
        # A group of its own: a Ctrl-C for Blender is not one for the run, which Blender stops by itself.
        self._process = subprocess.Popen(line, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=errors,
                                         start_new_session=True)
        self._readers = [threading.Thread(target=self._read, args=(stream,), daemon=True)
                         for stream in (self._process.stdout, self._process.stderr) if stream is not None]
        for reader in self._readers:
            reader.start()
        atexit.register(self.kill)

    @property
    def pid(self):
        return self._process.pid

    def _read(self, stream):
        for line in stream:
            self.take(line.decode(errors="replace").strip())

    def take(self, line):
        """Takes in a line that it says."""
        self.said.append(line)

    def ask_to_stop(self):
        """Asks it to end with what it has; returns whether it was running."""
        if self._process.poll() is not None:
            return False
        self._process.send_signal(signal.SIGTERM)
        return True

    def kill(self):
        """Ends the run and all that it began."""
        atexit.unregister(self.kill)
        if self._process.poll() is None:
            os.killpg(self._process.pid, signal.SIGKILL)
            self._process.wait()

    def status(self):
        """What it ended with, negative where a signal ended it, once all that it said is taken in; None while it runs."""
        status = self._process.poll()
        if status is None:
            return None
        atexit.unregister(self.kill)
        for reader in self._readers:
            reader.join(1.0)
        return status
