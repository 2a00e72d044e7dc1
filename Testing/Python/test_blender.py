# SPDX-License-Identifier: BSD-3-Clause
"""The add-on in Blender without its window: python3 test_blender.py ADDONS WAFT [NAMES OF TESTS ...]

ADDONS: the folder share/blender/scripts; WAFT: the program. Where Blender is not installed it is skipped (77), and says so.
"""
import os
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77


def main(scripts, waft, *names):
    blender = shutil.which("blender")
    if blender is None:
        print("skipped: no blender: apt-get install --no-install-recommends blender")
        return SKIPPED
    checks = os.path.join(os.path.dirname(os.path.abspath(__file__)), "blender_checks.py")
    with tempfile.TemporaryDirectory(prefix="waft-blender-") as folder:
        # Blender takes Python's library from the first python3 on the PATH: that beside it is its own.
        path = os.pathsep.join([os.path.dirname(blender), os.environ["PATH"]])
        environment = {**os.environ, "PATH": path, "BLENDER_USER_SCRIPTS": scripts, "BLENDER_USER_CONFIG": folder, "PYTHONDONTWRITEBYTECODE": "1"}
        return subprocess.run([blender, "-b", "--factory-startup", "--python-exit-code", "1", "--python", checks, "--", folder, waft,
                               *names], env=environment, check=False).returncode


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
