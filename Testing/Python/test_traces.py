# SPDX-License-Identifier: BSD-3-Clause
"""Scripts that ParaView makes of a session, by Start Trace and by Save State: they run alone, where the plugin is loaded, and give the
same flight.

    pvbatch run.py test_traces.py PVPYTHON         on a screen
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import waft
from paraview import servermanager, simple, smstate, smtrace
from vtkmodules.util.numpy_support import vtk_to_numpy

PVPYTHON = sys.argv[1]
EDIT = [{"op": "replace", "path": "/constraints/0/value", "value": [0.03, 0.02, 2.4]}]
ASKED = """
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy
shown = simple.FindSource({name!r})
shown.UpdatePipeline()
places = servermanager.Fetch(shown, idx={port}).GetPoints().GetData()
open({answer!r}, "wb").write(vtk_to_numpy(places).tobytes())
"""


class TracesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        scene = waft.Scene("Traced", seed=7)
        scene.set_time(13)
        scene.add_objects("leaf", positions=[(0, 0, 2.5), (1, 1, 2.5)])
        scene.add_position(0, 12, (0.02, 0.01, 2.4))
        scene.save(cls.folder / "scene.waft.json")

    def test_a_trace_and_a_state_fly_the_same(self):
        smtrace.start_trace()
        animation = simple.WaftAnimation(registrationName="W", FileName=str(self.folder / "scene.waft.json"), Seed=9,
                                         Edits=json.dumps(EDIT))
        simple.Show(animation)
        simple.Render()
        scripts = {"trace": smtrace.stop_trace(), "state": smstate.get_state()}
        poses, = (number for number in range(animation.SMProxy.GetNumberOfOutputPorts())
                  if animation.SMProxy.GetOutputPortName(number) == "Poses")
        edited = self.places(animation, poses)
        animation.Edits = ""
        self.assertNotEqual(edited, self.places(animation, poses))
        for name, text in scripts.items():
            with self.subTest(script=name):
                self.assertEqual(edited, self.flown_by(text, "W", poses))

    def test_stages_and_their_state_fly_the_same(self):
        animation = simple.WaftAnimation(FileName=str(self.folder / "scene.waft.json"), Seed=9)
        rotation = waft.unfold(animation)["Rotation"]
        simple.Delete(animation)
        self.assertEqual(self.places(rotation, 1), self.flown_by(smstate.get_state(), "Rotation", 1))

    def tearDown(self):
        for source in simple.GetSources().values():
            simple.Delete(source)

    @staticmethod
    def places(source, port):
        simple.UpdatePipeline(proxy=source)
        return vtk_to_numpy(servermanager.Fetch(source, idx=port).GetPoints().GetData()).tobytes()

    def flown_by(self, text, name, port):
        """Places that a script gives in a process of its own."""
        script, answer = self.folder / "script.py", self.folder / "answer"
        answer.unlink(missing_ok=True)
        script.write_text(text + ASKED.format(name=name, port=port, answer=str(answer)), encoding="utf-8")
        done = subprocess.run([PVPYTHON, script], capture_output=True, text=True, check=False)
        self.assertEqual(0, done.returncode, done.stdout + done.stderr)
        return answer.read_bytes()
