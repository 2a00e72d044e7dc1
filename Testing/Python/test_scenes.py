# SPDX-License-Identifier: BSD-3-Clause
"""The scenes that come with Waft: made again they are the same files, and each can be planned whole.

    pvpython test_scenes.py SCENES_FOLDER [NAME...]       names: of those that are planned; default: all"""

import filecmp
import pathlib
import runpy
import shutil
import sys
import tempfile
import unittest

from paraview import simple
from waft.files import table_rows
from waft.loading import load_plugin
from waft.loading import set_threads

FOLDER, *NAMES = map(pathlib.Path, sys.argv[1:])


class ScenesTest(unittest.TestCase):
    def test_the_program_makes_the_same_files(self):
        with tempfile.TemporaryDirectory() as place:
            program = shutil.copy(FOLDER / "make_scenes.py", place)
            runpy.run_path(program, run_name="__main__")
            made = [path.relative_to(place) for path in pathlib.Path(place).rglob("*")
                    if path.is_file() and path.suffix != ".py" and "__pycache__" not in path.parts]
            self.assertGreater(len(made), 10)
            for name in made:
                self.assertTrue(filecmp.cmp(pathlib.Path(place) / name, FOLDER / name, shallow=False), name)

    def test_every_scene_can_be_planned(self):
        for scene in [FOLDER / f"{name}.waft.json" for name in NAMES] or sorted(FOLDER.glob("*.waft.json")):
            with self.subTest(scene=scene.name):
                self.assertEqual(self.unmet(scene), [])

    def test_every_scene_has_its_line_in_the_readme(self):
        text = (FOLDER / "README.md").read_text(encoding="utf-8")
        for scene in FOLDER.glob("*.waft.json"):
            name = scene.name.removesuffix(".waft.json")
            self.assertTrue(f"`{name}`" in text or f"`{scene.name}`" in text or f"`{name[:-1]}a`, `-b`" in text, name)

    def unmet(self, scene):
        animation = simple.WaftAnimation(FileName=str(scene), StopAfter="Plan")
        animation.UpdatePipeline()
        header, rows = table_rows(animation.GetClientSideObject().GetOutputDataObject(7))
        rows = [dict(zip(header, row)) for row in rows]
        self.assertGreater(len(rows), 0)
        return [row for row in rows if row["Status"] != "met"]


load_plugin()
set_threads(None)
unittest.main(argv=sys.argv[:1])
