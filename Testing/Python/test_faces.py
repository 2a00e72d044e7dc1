# SPDX-License-Identifier: BSD-3-Clause
"""One motion by every face: whoever flies a scene in a quality, the command, the source in steps or in slices, or its stages, gives
the bytes of waft.synthesize on one thread.

    pvpython test_faces.py WAFT       WAFT: the command of the build or of an installed tree

Several processes are compared by test_ranks.py and test_processes.py, a stopped run by test_resume.py, stages joined by hand by
test_six_stages.py.
"""
import contextlib
import json
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

import waft

WAFT = sys.argv.pop(1)
FRAMES = {"preview": 12, "full": 20, "paper": 12}  # to the motion of fewer no vortices are fitted
MOMENT = 0.2  # s: what goes by time is looked at then
FILES = ("poses.csv", "planned.vtp", "optimized.vtp", "poses.vtp", "constraints.csv", "animation.glb")
PLAN = {"PlannedTracks": ("planner", 0), "Trees": ("planner", 1), "PlannedReport": ("planner", 2), "Marks": ("planner", 3)}
DRIFT = {"AssimilatedTracks": ("assimilation", 0), "Air": ("assimilation", 1), "AssimilatedReport": ("assimilation", 4),
         "Rounds": ("assimilation", 5)}
OPTIMUM = {"OptimisedTracks": ("spacetime", 0), "Gas": ("spacetime", 1), "Convergence": ("spacetime", 4)}
POSES = {"Meshes": ("rotation", 0), "Poses": ("rotation", 1)}
# Ports of the source that a quality fills.
PORTS = {"preview": {**PLAN, **DRIFT, "Vortices": ("assimilation", 2), **POSES},
         "full": {**PLAN, **DRIFT, **OPTIMUM, **POSES, "FittedVortices": ("fit", 0)},
         "paper": {**PLAN, **OPTIMUM, **POSES}}
STOPS = {"Scene": "Objects", "Plan": "PlannedTracks", "Assimilation": "AssimilatedTracks", "Optimisation": "OptimisedTracks",
         "Rotation": "Meshes", "Vortex Fit": "FittedVortices"}


def scene(frames):
    """Two maples, the one with a mark, in a wind."""
    last = frames - 3
    return {"waft": 1, "seed": 5, "time": {"frames": frames}, "shapes": {"maple": {"builtin": "maple"}},
            "objects": [{"shape": "maple", "positions": [[-0.2, 0.0, 2.6], [0.2, 0.0, 2.6]]}],
            "constraints": [{"kind": "position", "object": 0, "frame": last, "value": [-0.2, 0.02, 2.6 - 0.2 * last / 17], "radius": 0.1}],
            "winds": [{"direction": [1, 0, 0], "strength": 0.5, "center": [0, 0, 2], "radius": 1, "centerTime": 0.2, "duration": 0.2}]}


def size(data):
    """Points of a surface or picture, rows of a table."""
    return data.GetNumberOfElements(0) + data.GetNumberOfElements(6)


class Faces(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.scenes = {quality: cls.folder / f"{quality}.waft.json" for quality in FRAMES}
        for quality, path in cls.scenes.items():
            path.write_text(json.dumps(scene(FRAMES[quality])), encoding="utf-8")

    def source(self, quality, **properties):
        animation = simple.WaftAnimation(FileName=str(self.scenes[quality]), Quality=quality.title(), **properties)
        self.addCleanup(simple.Delete, animation)
        return animation

    def check_ports(self, animation, quality, wanted):
        """What the quality makes is there, bit by bit, and no more."""
        animation.UpdatePipeline(MOMENT)
        for name in {**PORTS["full"], **PORTS[quality]}:
            ours = animation.GetClientSideObject().GetOutputDataObject(animation[name].Port)
            with self.subTest(port=name):
                self.assertEqual(size(ours) > 0, name in PORTS[quality])
                if name in PORTS[quality]:
                    self.check_same(ours, wanted.output(*PORTS[quality][name]))

    def check_same(self, ours, wanted):
        """Two data sets: points and all arrays, bit by bit, but for clocks."""
        for kind in ("GetPointData", "GetCellData", "GetRowData"):
            if not hasattr(wanted, kind):
                continue
            theirs = getattr(wanted, kind)()
            self.assertEqual(getattr(ours, kind)().GetNumberOfArrays(), theirs.GetNumberOfArrays())
            for name in (theirs.GetArrayName(i) for i in range(theirs.GetNumberOfArrays())):
                if name != "Seconds" and theirs.GetArray(name) is not None:
                    np.testing.assert_array_equal(vtk_to_numpy(getattr(ours, kind)().GetArray(name)), vtk_to_numpy(theirs.GetArray(name)), name)
        if hasattr(wanted, "GetPoints") and wanted.GetNumberOfPoints():
            np.testing.assert_array_equal(*(vtk_to_numpy(data.GetPoints().GetData()) for data in (ours, wanted)))

    def by_the_command(self, quality, _):
        out = self.folder / f"{quality}-command"
        done = subprocess.run([WAFT, "synthesize", str(self.scenes[quality]), "--output", str(out), "--quality", quality, "--threads", "2"],
                              stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in FILES:
            self.assertEqual((out / name).read_bytes(), (self.folder / quality / name).read_bytes(), name)

    def by_the_source_in_slices(self, quality, wanted):
        animation = self.source(quality, Slice=0.1)
        while not waft.go_on(animation):
            pass
        self.check_ports(animation, quality, wanted)

    def by_the_source_in_steps(self, quality, wanted):
        """It stops where it is asked to, and makes nothing again."""
        animation = self.source(quality)
        seconds = []
        for done, stop in enumerate(STOPS, 1):
            animation.StopAfter = stop
            began = time.process_time()
            animation.UpdatePipeline()
            seconds.append(time.process_time() - began)
            made = [animation[name].GetDataInformation() for name in STOPS.values()]
            self.assertEqual([(one.GetNumberOfPoints() or one.DataInformation.GetNumberOfRows()) > 0 for one in made],
                             [k < done for k in range(len(STOPS))], stop)
        self.assertLess(seconds[-1], 0.5 * sum(seconds))
        self.check_ports(animation, quality, wanted)
        with self.unfolded(animation) as stages:
            self.assertEqual(set(stages), {"Scene", "Planner", "Assimilation", "Spacetime", "Rotation", "VortexFit"})

    def by_stages_of_their_own(self, quality, wanted):
        animation = self.source(quality, StopAfter="Scene")
        animation.UpdatePipeline()
        animation.StopAfter = "Rotation"
        with self.unfolded(animation) as stages:
            self.assertEqual(set(stages), {"Scene", "Planner", "Assimilation", "Rotation"})
            stages["Rotation"].UpdatePipeline(MOMENT)
            for port in (0, 1):
                self.check_same(stages["Rotation"].GetClientSideObject().GetOutputDataObject(port), wanted.output("rotation", port))

    @contextlib.contextmanager
    def unfolded(self, animation):
        stages = {name.rstrip("1"): stage for name, stage in waft.unfold(animation).items()}  # the others have those names
        yield stages
        for stage in reversed(list(stages.values())):
            simple.Delete(stage)

    FACES = {"preview": (by_the_command, by_the_source_in_slices, by_stages_of_their_own), "full": (by_the_source_in_steps,),
             "paper": (by_the_source_in_slices,)}

    def test_each_gives_the_same(self):
        for quality, faces in self.FACES.items():
            wanted = waft.synthesize(self.scenes[quality], quality=quality, threads=1, output=self.folder / quality)
            for stage in {stage for stage, _ in PORTS[quality].values()}:
                getattr(wanted, stage).UpdatePipeline(MOMENT)
            for face in faces:
                with self.subTest(quality=quality, face=face.__name__):
                    face(self, quality, wanted)
            wanted.delete()


if __name__ == "__main__":
    done = unittest.main(argv=sys.argv[:1], exit=False)
    sys.exit(0 if done.result.wasSuccessful() else 1)
