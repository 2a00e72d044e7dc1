# SPDX-License-Identifier: BSD-3-Clause
"""The add-on in Blender.

    test_blender.py alone SCRIPTS WAFT [NAMES OF TESTS ...]     without a window: blender_checks.py
    test_blender.py window SCRIPTS WAFT                         in its window, on a virtual screen: blender_window.py

SCRIPTS: the folder share/blender/scripts; WAFT: the program. Where Blender is not installed it is skipped (77), and says so.
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
HERE = pathlib.Path(__file__).resolve().parent


def main(where, scripts, waft, *names):
    blender = shutil.which("blender")
    if blender is None:
        print("skipped: no blender: apt-get install --no-install-recommends blender")
        return SKIPPED
    with tempfile.TemporaryDirectory(prefix="waft-blender-") as folder:
        temporary = pathlib.Path(folder) / "tmp"  # what another test leaves for a moment in the system's is not this one's
        temporary.mkdir()
        # Blender takes Python's library from the first python3 on the PATH: that beside it is its own.
        path = os.pathsep.join([os.path.dirname(blender), os.environ["PATH"]])
        environment = {**os.environ, "PATH": path, "BLENDER_USER_SCRIPTS": scripts, "BLENDER_USER_CONFIG": folder,
                       "TMPDIR": str(temporary), "PYTHONDONTWRITEBYTECODE": "1", "LIBGL_ALWAYS_SOFTWARE": "1"}
        options = ["--factory-startup", "--python-exit-code", "1", "--python"]
        if where == "alone":
            return subprocess.run([blender, "-b", *options, HERE / "blender_checks.py", "--", folder, waft, *names], env=environment,
                                  check=False).returncode
        screen = ["xvfb-run", "-n", "950", "-a", "-s", "-screen 0 1280x800x24 -noreset"]
        subprocess.run([*screen, blender, *options, HERE / "blender_window.py", "--", folder, waft], env=environment, check=False,
                       timeout=600)
        said = pathlib.Path(folder) / "said.txt"
        text = said.read_text(encoding="utf-8") if said.exists() else "Blender ended without a word"
        print(text)
        return 0 if text == "all well" else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
