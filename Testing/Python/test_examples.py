# SPDX-License-Identifier: BSD-3-Clause
"""The scenes of Data/Scenes/examples: made again to the same bytes, nothing in them that cannot be met, a page for each.

    pvpython run.py test_examples.py SOURCE"""

import pathlib
import runpy
import shutil
import subprocess
import sys
import tempfile
import unittest

from waft.loading import command

SOURCE = pathlib.Path(sys.argv[1])
EXAMPLES = SOURCE / "Data" / "Scenes" / "examples"


class ExamplesTest(unittest.TestCase):
    def test_the_scripts_make_the_same_files(self):
        with tempfile.TemporaryDirectory() as folder:
            copy = pathlib.Path(folder) / "Data"
            shutil.copytree(SOURCE / "Data" / "Scenes", copy / "Scenes", ignore=shutil.ignore_patterns("gusts*"))
            shutil.copytree(SOURCE / "Data" / "Shapes", copy / "Shapes")
            made = copy / "Scenes" / "examples"
            for file in made.iterdir():
                if file.suffix != ".py" and file.name != "hand.obj":  # whose decimation is VTK's
                    file.unlink()
            runpy.run_path(str(made / "make_examples.py"), run_name="__main__")
            names = sorted(file.name for file in EXAMPLES.iterdir() if file.suffix in (".json", ".obj", ".png"))
            self.assertEqual(names, sorted(file.name for file in made.iterdir() if file.suffix in (".json", ".obj", ".png")))
            for name in names:
                self.assertEqual((EXAMPLES / name).read_bytes(), (made / name).read_bytes(), name)

    def test_all_can_be_met(self):
        scenes = sorted(EXAMPLES.glob("*.waft.json"))
        self.assertEqual(len(scenes), 6)
        for scene in scenes:
            with self.subTest(scene=scene.name):
                done = subprocess.run([command(), "check", scene], capture_output=True, text=True, check=False)
                self.assertEqual(0, done.returncode, done.stderr)
                self.assertIn("0 of them cannot be met", done.stdout)
                name = scene.name.split(".")[0]
                self.assertIn(f"{name}.waft.json", (SOURCE / "Documentation" / "examples" / f"{name}.md").read_text())
