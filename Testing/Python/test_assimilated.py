# SPDX-License-Identifier: BSD-3-Clause
"""A scene by assimilation alone: its files, its rows, and that its air carries it.

    pvpython run.py test_assimilated.py PVPYTHON        what is killed is a process of its own
"""
import csv
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import textwrap
import unittest
from unittest import mock

import numpy as np
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy

import waft
from result_files import ImageData, read_series
from waft.failures import BadInput
from waft.measuring import measure
from waft.reading import read_surface
from waft.results.exporting import export

COARSE = {"Assimilation": {"Resolution": 16, "LatticeResolution": 16}}
PVPYTHON = sys.argv[1]
SCENE = {
    "waft": 1,
    "seed": 3,
    "time": {"frames": 45, "framesPerSecond": 30},
    "shapes": {"leaf": {"builtin": "leaf", "size": 0.15, "settlingSpeed": 0.5}},
    "objects": [{"shape": "leaf", "position": [0.3 * k, 0.2, z]} for k, z in enumerate((0.6, 1.5, 1.2))],  # the second stays in the air
    "constraints": [
        {"kind": "position", "object": 2, "frame": 30, "value": [0.7, 0.3, 1.0]},
        {"kind": "rest", "object": 0, "frame": 40, "value": [0.1, 0.1, 0.5]},
    ],
}


class Assimilated(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.scene = cls.folder / "three.waft.json"
        cls.scene.write_text(json.dumps(SCENE), encoding="utf-8")
        cls.out = cls.folder / "out"
        cls.made = waft.synthesize(str(cls.scene), output=str(cls.out), quality="air", _settings=COARSE)

    def tracks(self, name):
        data = read_surface(str(self.out / name))
        points = vtk_to_numpy(data.GetPoints().GetData()).reshape(3, 45, 3)
        return points, data.GetPointData()

    def test_all_rows_are_met(self):
        self.assertEqual(self.made.status, 0)
        points, _ = self.tracks("optimized.vtp")
        self.assertEqual(points[2, 30].tolist(), [0.7, 0.3, 1.0])
        self.assertEqual(points[0, 40:, :2].tolist(), [[0.1, 0.1]] * 5)

    def test_files_are_those_of_an_assimilation(self):
        self.assertEqual((self.out / "optimized.vtp").read_bytes(), (self.out / "assimilated.vtp").read_bytes())
        self.assertEqual((self.out / "convergence.csv").read_text(), "Pass,Stage,Iteration,E,Ex,Ev,Ec,MaxViolation,Leash,Seconds,"
                         "Clearance,Approach,Contact,Separation,Control,EvObjects,Fields,E2,"
                         "ShareVortices,ShareWind,ShareGas,ShareDrag,ShareLanding,ShareNone\n")
        images = sorted(path.name for path in (self.out / "air").iterdir())  # every tenth of a second at 30 frames, and the last
        self.assertEqual(images, [f"air_{frame:04d}.vti" for frame in (*range(0, 45, 3), 44)])
        self.assertFalse((self.out / "wind.pvd").exists())
        report = json.loads((self.out / "report.json").read_text())
        self.assertEqual((report["quality"], self.made.quality), ("air", "air"))
        self.assertIn("air.pvd", [row["name"] for row in report["manifest"]])
        with open(self.out / "rounds.csv", newline="", encoding="utf-8") as stream:
            rounds = list(csv.DictReader(stream))
        self.assertEqual(rounds[-1]["Stage"], "finish")
        drift = next(row for row in rounds if row["Stage"] == "drift")
        self.assertLess(float(rounds[-1]["ControlRms"]), 0.7 * float(drift["ControlRms"]))

    def test_each_series_has_the_same_arrays_at_all_times(self):
        held = {}
        for name in ("air", "air_wind"):
            times, files = read_series(self.out / f"{name}.pvd")
            held[name] = times
            for file in files:
                self.assertEqual(list(ImageData(file).point), [{"air": "Velocity", "air_wind": "Wind"}[name]], file)
        self.assertEqual(held["air_wind"], held["air"][::10])
        reader = simple.PVDReader(FileName=str(self.out / "air.pvd"))
        seeds = simple.PointSource(Center=[0, 0, 1], Radius=0.3, NumberOfPoints=20)
        tracer = simple.ParticleTracer(Input=reader, SeedSource=seeds, SelectInputVectors=["POINTS", "Velocity"])
        tracer.UpdatePipeline(0.6)
        self.assertEqual(servermanager.Fetch(tracer).GetNumberOfPoints(), 20)

    def test_a_body_lies_from_its_touch_down_on(self):
        rows = read_surface(str(self.out / "constraints.vtp")).GetPointData()
        down, still = (vtk_to_numpy(rows.GetArray(name)).tolist() for name in ("TouchDown", "Settled"))
        row = vtk_to_numpy(rows.GetArray("Kind")).tolist().index(4)
        self.assertTrue(0 < down[row] <= still[row] <= 40)
        with open(self.out / "constraints.csv", newline="", encoding="utf-8") as stream:
            told = next(line for line in csv.DictReader(stream) if line["Kind"] == "rest")
        self.assertEqual((str(down[row]), str(still[row])), (told["TouchDown"], told["Settled"]))
        points, _ = self.tracks("optimized.vtp")
        self.assertTrue((points[0, still[row]:] == points[0, -1]).all())
        posed, arrays = self.tracks("poses.vtp")
        turns = vtk_to_numpy(arrays.GetArray("Orientation")).reshape(3, 45, 4)
        self.assertTrue((posed[0, still[row]:] == posed[0, -1]).all() and (turns[0, still[row]:] == turns[0, -1]).all())

    def test_control_is_on_the_tracks(self):
        _, arrays = self.tracks("assimilated.vtp")
        control = vtk_to_numpy(arrays.GetArray("Control")).reshape(3, 45, 3)
        self.assertTrue(np.isfinite(control).all())
        self.assertLess(np.abs(control[1]).max(), 1e-3)  # nothing is asked of the object in the middle

    def test_an_edit_leaves_what_it_does_not_touch(self):
        changed = json.loads(json.dumps(SCENE))
        changed["constraints"][0]["value"] = [0.6, 0.4, 1.1]
        scene = self.folder / "edited.waft.json"
        scene.write_text(json.dumps(changed), encoding="utf-8")
        edited = waft.synthesize(str(scene), output=str(self.folder / "edited"), quality="air", edit_of=str(self.out),
                                 _settings=COARSE)
        self.assertEqual(edited.status, 0)
        for warning in edited.warnings:  # a second is short, in an air that was made for another mark
            self.assertIn("object 2 (its mark at frame 30): the air does not take it there", warning)
        before, _ = self.tracks("optimized.vtp")
        after, _ = self.tracks("../edited/optimized.vtp")
        self.assertEqual(after[2, 30].tolist(), [0.6, 0.4, 1.1])
        self.assertEqual(before[:2].tolist(), after[:2].tolist())
        for name in ("air/air_0000.vti", "air/air_0030.vti"):
            self.assertEqual((self.out / name).read_bytes(), (self.folder / "edited" / name).read_bytes())

    def test_what_is_kept_in_full_and_what_an_edit_does_without_a_state(self):
        kept, edited = self.folder / "kept", self.folder / "kept-edit"
        with tempfile.TemporaryDirectory() as empty, mock.patch.dict(os.environ, {"WAFT_CACHE": empty}):
            waft.synthesize(str(self.scene), output=str(kept), quality="air", keep=("air", "state"), _settings=COARSE)
            self.assertEqual(len(list((kept / "air").iterdir())), 45, "every frame")
            self.assertEqual(len(os.listdir(empty)), 2, "in the store as well, beside the air as it was drawn")
            self.assertTrue((kept / "assimilated.state").is_file())
            with_state = waft.synthesize(str(self.scene), output=str(edited), quality="air", edit_of=str(kept), _settings=COARSE)
            self.assertEqual(with_state.warnings, [])
        with tempfile.TemporaryDirectory() as empty, mock.patch.dict(os.environ, {"WAFT_CACHE": empty}):
            without = waft.synthesize(str(self.scene), output=str(edited), quality="air", edit_of=str(self.out), _settings=COARSE)
        self.assertEqual(without.status, 0)
        self.assertEqual(len(without.warnings), 1)
        self.assertIn("the state of that run is kept no more: flown from the start", without.warnings[0])
        for folder in (self.out, edited):
            self.assertFalse((folder / "assimilated.state").exists())
        with self.assertRaisesRegex(BadInput, "keep: expected of air, state, found 'all'"):
            waft.synthesize(str(self.scene), quality="air", keep=("all",))
        for option, value, expected in (("seed", -1, "a whole number from 0 to 2147483647"), ("memory_limit", 0, "a number above 0"),
                                        ("checkpoint_interval", -1, "a number from 0 to")):
            with self.assertRaisesRegex(BadInput, f"{option}: expected {expected}.*, found {value}"):
                waft.synthesize("scene.waft.json", **{option: value})

    def test_the_table_of_poses_may_be_left_out(self):
        out = self.folder / "no-csv"
        shutil.copytree(self.out, out)
        waft.synthesize(str(self.scene), output=str(out), quality="air", csv=False, _settings=COARSE)
        before, after = (json.loads((folder / "report.json").read_text(encoding="utf-8")) for folder in (self.out, out))
        self.assertEqual(([], ["poses.csv"]), (before["without"], after["without"]))
        self.assertEqual({"poses.csv"}, {row["name"] for row in before["manifest"]} - {row["name"] for row in after["manifest"]})
        self.assertFalse((out / "poses.csv").exists(), "that of the run before")
        for name in ("poses.vtp", "animation.glb", "constraints.csv"):
            self.assertEqual((self.out / name).read_bytes(), (out / name).read_bytes(), name)
        export(str(out), "glb", ("ground",))
        measured = [[row.as_json() for row in measure([str(folder)])[0].rows] for folder in (self.out, out)]
        self.assertGreater(len(measured[0]), 10)
        self.assertEqual(*measured)
        waft.synthesize(str(self.scene), output=str(out), quality="air", resume=True, _settings=COARSE)
        self.assertEqual((self.out / "poses.csv").read_bytes(), (out / "poses.csv").read_bytes())

    def test_another_seed_is_another_air_which_an_edit_keeps(self):
        first, edited = self.folder / "seeded", self.folder / "seeded-edit"
        waft.synthesize(str(self.scene), output=str(first), quality="air", seed=9, _settings=COARSE)
        air = (first / "air/air_0030.vti").read_bytes()
        self.assertNotEqual(air, (self.out / "air/air_0030.vti").read_bytes())
        again = waft.synthesize(str(self.scene), output=str(edited), quality="air", edit_of=str(first), _settings=COARSE)
        self.assertEqual(again.warnings, [])
        self.assertEqual(air, (edited / "air/air_0030.vti").read_bytes())

    def test_a_run_that_was_killed_goes_on_to_the_same_bytes(self):
        kill = f"""if True:
            import os, pathlib, signal, sys, waft
            from waft.watching import Clock
            state = pathlib.Path(sys.argv[2]) / "checkpoint" / "assimilation.state"
            Clock.show = lambda *_: state.exists() and os.kill(os.getpid(), signal.SIGKILL)
            waft.synthesize(sys.argv[1], output=sys.argv[2], quality="assimilated", _settings={COARSE})
            """
        out = self.folder / "killed"
        program = self.folder / "kill.py"
        program.write_text(textwrap.dedent(kill), encoding="utf-8")
        done = subprocess.run([PVPYTHON, str(program), str(self.scene), str(out)], check=False, capture_output=True)
        self.assertEqual(done.returncode, -signal.SIGKILL)
        # The same under both names.
        again = waft.synthesize(str(self.scene), output=str(out), quality="air", resume=True, _settings=COARSE)
        self.assertEqual((again.status, again.warnings, again.quality), (0, [], "air"))
        for name in ("assimilated.vtp", "poses.csv", "constraints.vtp", "air/air_0044.vti"):
            self.assertEqual((self.out / name).read_bytes(), (out / name).read_bytes(), name)
        reports = [json.loads((folder / "report.json").read_text(encoding="utf-8")) for folder in (self.out, out)]
        self.assertEqual(*({name: report[name] for name in ("key", "quality", "seed", "constraints")} for report in reports))

    def test_the_air_of_an_edit_has_to_be_there(self):
        with self.assertRaisesRegex(BadInput, "assimilated.state: no such file; expected the folder of a finished run"):
            waft.synthesize(str(self.scene), quality="air", edit_of=str(self.folder))
        with self.assertRaisesRegex(BadInput, "edit_of: a run of quality paper has no air to keep"):
            waft.synthesize(str(self.scene), quality="paper", edit_of=str(self.out))

    def test_its_air_turns_the_bodies(self):
        rotation = self.made.rotation
        self.assertIs(rotation.Air.SMProxy, self.made.assimilation.SMProxy)
        self.assertEqual(rotation.Air.Port, 1)
        with_air = self.turns(rotation)
        rotation.Air = None
        rotation.UpdatePipeline()
        self.assertGreater(np.abs(self.turns(rotation) - with_air).max(), 1e-3)

    @staticmethod
    def turns(rotation):
        poses = rotation.GetClientSideObject().GetOutputDataObject(1).GetPointData()
        return vtk_to_numpy(poses.GetArray("AngularVelocity")).copy()

    def test_an_unknown_quality_is_named(self):
        for word in ("air", "assimilated"):
            with self.assertRaisesRegex(BadInput, "particles: expected quality full or paper, whose optimiser has particles, found air"):
                waft.synthesize(str(self.scene), quality=word, particles=True)
        with self.assertRaisesRegex(BadInput, "quality: expected one of preview, air, full, paper, found best"):
            waft.synthesize(str(self.scene), quality="best")
