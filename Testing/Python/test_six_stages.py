# SPDX-License-Identifier: BSD-3-Clause
"""The stages of the paper joined by hand (Documentation/examples/six_stages.py), on a coarse grid with few particles: the bytes
of waft.synthesize with the database that the script wrote, and in each port what the page on the pipeline names.

    pvpython test_six_stages.py SOURCE [all]       with all each switch of the paper's figures is thrown, else four of them"""

import ast
import contextlib
import io
import json
import pathlib
import re
import runpy
import sys
import tempfile
import unittest
from unittest import mock

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

import six_stages_small
import waft

SOURCE, ALL = pathlib.Path(sys.argv[1]), sys.argv[2:] == ["all"]
SCRIPT = SOURCE / "Documentation" / "examples" / "six_stages.py"


def numbers(data):
    """The points of a data set and its arrays, by name."""
    attributes = data.GetPointData()
    return {"": data.GetPoints().GetData(),
            **{attributes.GetArrayName(i): attributes.GetArray(i) for i in range(attributes.GetNumberOfArrays())}}


class SixStagesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        kept = tempfile.TemporaryDirectory()
        cls.addClassCleanup(kept.cleanup)
        cls.folder = pathlib.Path(kept.name)
        scene = cls.folder / "three.waft.json"
        six_stages_small.make_scene(scene)
        cls.stages = six_stages_small.join(SCRIPT, scene, cls.folder)
        cls.run_dir = cls.folder / "out"
        cls.flight = waft.synthesize(scene, quality="paper", database=cls.folder / "air.vtm", output=cls.run_dir,
                                     _settings={"Spacetime": six_stages_small.SHORT})

    def test_gives_the_bytes_of_synthesize(self):
        for name in ("poses.csv", "animation.glb"):
            self.assertEqual((self.run_dir / name).read_bytes(), (self.folder / name).read_bytes(), name)
        for stage, ours, ports in (("planner", "plan", (0, 1, 3, 4)), ("spacetime", "gas", (0, 2)), ("rotation", "turn", (1,))):
            for port in ports:
                wanted = self.flight.output(stage, port)
                self.assertGreater(wanted.GetNumberOfPoints(), 0)
                found = numbers(waft.fetch(self.stages[ours], port))
                self.assertEqual(set(found), set(numbers(wanted)))
                for name, values in numbers(wanted).items():
                    with self.subTest(stage=stage, port=port, array=name):
                        np.testing.assert_array_equal(vtk_to_numpy(found[name]), vtk_to_numpy(values))

    def test_the_report_says_what_moved_the_objects(self):
        report = json.loads((self.run_dir / "report.json").read_text(encoding="utf-8"))
        forces = report["forces"]
        self.assertEqual(["vortices", "wind", "gas", "drag", "landing", "none"], list(forces))
        self.assertAlmostEqual(1.0, sum(force["share"] for force in forces.values()), places=6)
        for name, force in forces.items():  # what makes up the motion by a share has some size
            self.assertGreaterEqual(force["square"], force["share"] ** 2 * (1.0 - 1e-9), name)
        self.assertTrue(-1.0 < forces["vortices"]["part"] < 1.0)
        for kind in ("all", "gas"):  # the fields were solved for the one, and say less of the other: nothing, where bodies are few
            solved, left_out = (report["fieldsExplained"][kind][which] for which in ("solved", "leftOut"))
            self.assertTrue(0.0 < solved < 1.0 and -1.0 < left_out < solved, (kind, solved, left_out))

    def test_every_port_of_the_page_is_there(self):
        """The table of the page names, port by port, arrays that the data have."""
        page = (SOURCE / "Documentation" / "Pipeline.md").read_text(encoding="utf-8")
        rows = re.findall(r"^\| `(\w+)` \| `(\w+)` \| (.*?) \|", page, re.MULTILINE)
        self.assertGreater(len(rows), 15)
        for variable, port, words in rows:
            with self.subTest(stage=variable, port=port):
                names = self.names(waft.fetch(self.stages[variable], port))
                for array in re.findall(r"`(\w+)`", words):
                    self.assertIn(array, names)

    def test_changes_of_the_page_are_taken(self):
        page = (SOURCE / "Documentation" / "Pipeline.md").read_text(encoding="utf-8")
        lines = re.findall(r"^\| `(\w+)\.(\w+) = (.*?)` \|", page, re.MULTILINE)
        self.assertGreater(len(lines), 3)
        for variable, name, value in lines:
            with self.subTest(stage=variable, property=name):
                stage, wanted = type(self.stages[variable])(), ast.literal_eval(value)
                self.assertNotEqual(self.stages[variable].GetPropertyValue(name), wanted)
                setattr(stage, name, wanted)
                self.assertEqual(stage.GetPropertyValue(name), wanted)

    def test_the_table_of_the_paper_is_made_of_its_folder(self):
        said = io.StringIO()
        script = SOURCE / "Documentation" / "scripts" / "paper_table.py"
        with contextlib.redirect_stdout(said), mock.patch.object(sys, "argv", [script.name, str(self.run_dir)]):
            runpy.run_path(str(script), run_name="__main__")
        rows = dict(re.findall(r"^\| (.*?) \| .*? \| (.*?) \|$", said.getvalue(), re.MULTILINE))
        self.assertEqual(rows["objects"], "3")
        self.assertEqual(rows["object particles"], "15 (default)")
        self.assertRegex(rows["iterations at which E grew within a stage"], r"^0 of \d+$")
        self.assertRegex(rows["strength of vortices : of the wind, at the objects"], r"^\d\.\d\d : \d\.\d\d m/s\^2$")

    def test_each_switch_of_the_paper_changes_the_flight(self):
        script = runpy.run_path(str(SOURCE / "Documentation" / "scripts" / "paper_switches.py"))
        script["SWITCHES"]["windows"]["Spacetime"]["WindowLength"] = 20
        script["SWITCHES"]["lattice x 2"]["Spacetime"]["WindCells"] = 7
        poses, left = {}, {}
        for name, settings in script["SWITCHES"].items():
            if not ALL and name not in (*script["FIELDS"], "Eq. 5"):
                continue
            short = {"Spacetime": {**six_stages_small.SHORT, **settings.get("Spacetime", {})}}
            if "Smoke" in settings:
                short["Smoke"] = {**six_stages_small.AIR, **settings["Smoke"]}
            folder = self.folder / "switches" / name
            script["fly"](self.folder / "three.waft.json", folder, {**settings, **short})
            poses[name] = (folder / "poses.csv").read_bytes()
            cells = script["row"](name, folder).strip("| ").split(" | ")
            self.assertEqual(len(script["COLUMNS"]), len(cells), name)
            self.assertLess(float(cells[script["COLUMNS"].index("exact")]), 1e-12, name)
            if name in script["FIELDS"]:
                cells = script["first_solve"](name, folder).strip("| ").split(" | ")
                self.assertEqual(len(script["FIRST"]), len(cells), name)
                left[name] = float(cells[2].split(", ")[0])
        self.assertEqual(len(poses), len(set(poses.values())))
        self.assertEqual(tuple(left), script["FIELDS"])
        self.assertLessEqual(left["ridge x 0.1"], left["as it is"])
        self.assertLess(left["lattice x 2"], left["as it is"])

    def test_the_user_guide_quotes_it(self):
        guide = (SOURCE / "Documentation" / "UserGuide.md").read_text(encoding="utf-8")
        quoted = next(block for block in re.findall(r"```python\n(.*?)```", guide, re.DOTALL) if block.startswith("plan = "))
        script = SCRIPT.read_text(encoding="utf-8").splitlines()
        self.assertEqual([line for line in quoted.splitlines() if line not in script], [])

    def names(self, data):
        """Names of all arrays, and blocks, of a data set."""
        found = set()
        if data.IsA("vtkMultiBlockDataSet"):
            for i in range(data.GetNumberOfBlocks()):
                found.add(data.GetMetaData(i).Get(data.NAME()))
            return found
        for kind in ("GetPointData", "GetCellData", "GetRowData"):
            if hasattr(data, kind):
                found.update(getattr(data, kind)().GetArrayName(i) for i in range(getattr(data, kind)().GetNumberOfArrays()))
        return found


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
