# SPDX-License-Identifier: BSD-3-Clause
"""The type hints of the package waft by mypy: the package itself, and a user's script that is held to all that mypy asks for.

    python3 test_types.py MODULES         MODULES: the folder with the package waft in the sources; without mypy it is skipped
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

MODULES = sys.argv[1]
SCRIPT = """import waft
from waft.page import write_page
from waft.render import Stage, render
from waft.run import Run

scene: waft.Scene = waft.Scene("A word")
scene.add_objects("maple", count=60, region={"min": (-1, -1, 2.5), "max": (1, 1, 3.8)})
scene.save("word.waft.json")
run = waft.synthesize(scene, output="out", quality="preview", on_progress=lambda share, text: share < 0.5)
words: str = run.warnings[0] + run.report[0]["Message"] + run.quality
counts: int = run.positions.shape[0] + run.status + run.seed + waft.synthesize("word.waft.json", "out", seed=1, keep=("air",)).status
print(run.planner, run.output("reader", 0), run.orientations[0, 0], run.times[0], run.object_ids[0], run.marks["status"])
run.render("still.png", size=(640, 360))
waft.show(run)
waft.update(run.rotation)
waft.fetch(run.planner, "Tracks")
while not waft.go_on(run.planner):
    pass
print(waft.unfold(run.planner)["planner"], waft.measure("out")[0]["start"].value, waft.data_file("Scenes").upper(), waft.version().upper())
for name in render("out", frames="0:9:1", size=(640, 360), views=("hero",)):
    print(name.upper(), Stage(None).draw("side", 0), write_page("out").upper())
run.seed = 7
run.save("two")
loaded: Run = waft.load("two")
print(run.page("page.html").upper(), loaded.folder, loaded.positions.mean(), loaded.seed + 1, loaded.show(), loaded.to_pandas().head())
for shown in (run, loaded):
    print(shown.to_pyvista(frame=3).keys(), shown.plot(window_size=(640, 360)))
    shown.delete()
"""
WRONG = {"waft.synthesize(scene, qualty='full')": 'Unexpected keyword argument "qualty"',
         "waft.synthesize(scene, seed='7')": '"seed" to "synthesize" has incompatible type "str"',
         "waft.synthesize(scene, 'out', None, 7)": "Too many positional arguments",
         "run.positons": '"Result" has no attribute "positons"',
         "run.status = 1": 'Property "status" defined in "Run" is read-only',
         "run.seed = '7'": 'Incompatible types in assignment (expression has type "str", variable has type "int")',
         "waft.load(3)": 'Argument 1 to "load" has incompatible type "int"'}


class Types(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)

    def mypy(self, *arguments):
        return subprocess.run(["mypy", "--ignore-missing-imports", "--python-executable", sys.executable,
                               "--cache-dir", pathlib.Path(os.environ.get("WAFT_CACHE", self.folder)) / "mypy", *arguments],
                              cwd=MODULES, capture_output=True, text=True, check=False)

    def test_of_the_package(self):
        done = self.mypy("-p", "waft")
        self.assertEqual(0, done.returncode, done.stdout)

    def test_of_how_it_is_written(self):
        if shutil.which("flake8") is None:
            self.skipTest("flake8 was not found")
        done = subprocess.run(["flake8", "Plugin", "Testing", "Documentation", "CMake", "Data"], cwd=pathlib.Path(MODULES).resolve().parents[1],
                              capture_output=True, text=True, check=False)
        self.assertEqual("", done.stdout + done.stderr)

    def test_of_what_a_user_writes(self):
        path = self.folder / "script.py"
        path.write_text(SCRIPT + "".join(f"{line}\n" for line in WRONG), encoding="utf-8")
        done = self.mypy("--strict", "--follow-imports=silent", path)
        reported = [line for line in done.stdout.splitlines() if ": error: " in line]
        self.assertEqual(len(WRONG), len(reported), done.stdout)
        for wrong, line in zip(WRONG.values(), reported):
            self.assertIn(wrong, line)


if __name__ == "__main__":
    if shutil.which("mypy") is None:
        print("mypy was not found")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
