# SPDX-License-Identifier: BSD-3-Clause
"""Several MPI processes: the same bits as on one, with the first, or with each where each runs the script.

    python3 test_ranks.py PVBATCH [MPIEXEC]        exit status 77 (skipped) without MPIEXEC
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

FRAMES = 40  # of small_plans.py
COARSE = {"Resolution": 16, "LatticeResolution": 16, "Candidates": 1, "Starts": 1, "Rounds": 1}

# All there is of the plans comes to process 0.
PLANS = f"""
import sys
sys.path.insert(0, {str(pathlib.Path(__file__).resolve().parent)!r})
from small_plans import make
from vtkmodules.vtkCommonDataModel import vtkPolyData
"""

# All processes run this script (--symmetric); the plans are given to the first alone.
SYMMETRIC = PLANS + """
import json
from vtkmodules.vtkParallelCore import vtkMultiProcessController
import waft.loading
from waft.vtkWaftFilters import vtkSPHSpacetimeFilter

rank = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
stage = vtkSPHSpacetimeFilter()
stage.SetNumberOfGasParticles(216)
stage.SetLeashIterations(2)
stage.SetMaximumNumberOfIterations(6)
if rank > 0:
    stage.SetNumberOfGasParticles(1000)  # the first process' properties hold
for port, data in enumerate(make()):
    stage.SetInputDataObject(port, data if rank == 0 else vtkPolyData())
said = []
stage.AddObserver("ErrorEvent", lambda *_: said.append("error"))
courses = []

def course():
    table = stage.GetOutputDataObject(4)
    return [table.GetValueByName(k, "E").ToDouble() for k in range(table.GetNumberOfRows())]

for sway in range(2):
    stage.SetCoherenceWeight(0.25 + 0.25 * sway)
    stage.Update()
    courses.append(course())
tracks = stage.GetOutputDataObject(0)
found = {
    "courses": courses, "said": list(said),
    "points": [tracks.GetPoint(k) for k in range(tracks.GetNumberOfPoints())],
    "particles": stage.GetOutputDataObject(1).GetNumberOfPoints(),
    "wind": stage.GetOutputDataObject(3).GetNumberOfPoints(),
    "report": stage.GetOutputDataObject(5).GetNumberOfRows(),
}
stage.Restart()
watch = stage.AddObserver("ProgressEvent", lambda *_: stage.SetAbortExecute(1))  # which the first alone is told of
stage.Update()
stage.RemoveObserver(watch)
stage.SetAbortExecute(0)
found["stopped"] = [len(course()) > 0, len(said)]
for port, data in enumerate(make()):  # and a mistake that the first alone can see
    if rank == 0 and port == 1:
        data.GetPointData().GetArray("ObjectId").SetValue(1, 77)
    stage.SetInputDataObject(port, data if rank == 0 else vtkPolyData())
stage.Update()
found["mistakes"] = len(said) - len(found["said"])
found["alone"] = []
if rank == 0:  # which the others know nothing of
    for port, data in enumerate(make()):
        stage.SetInputDataObject(port, data)
    stage.SetController(None)
    stage.SetCoherenceWeight(0.25)
    stage.Restart()
    stage.Update()
    found["alone"] = course()
with open(sys.argv[1] + ".%d" % rank, "w", encoding="utf-8") as stream:
    json.dump(found, stream)
"""

# The first process runs this script, ParaView the pipeline on all of them.
PROXIES = PLANS + """
import json
from paraview import simple
from paraview.simple import OutputPort, UpdatePipeline
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter
folder = sys.argv[2]
for name, data in zip(("tracks", "objects", "rows"), make()):
    writer = vtkXMLPolyDataWriter()
    writer.SetDataModeToBinary()
    writer.SetFileName(folder + "/" + name + ".vtp")
    writer.SetInputData(data)
    writer.Write()
read = [simple.XMLPolyDataReader(FileName=[folder + "/" + name + ".vtp"]) for name in ("tracks", "objects", "rows")]
stage = simple.SPHSpacetimeFilter(Tracks=read[0], Objects=read[1], Constraints=read[2], NumberOfGasParticles=216,
                                  LeashIterations=2, MaximumNumberOfIterations=6)
shapes = simple.LeafShapeSource()
turned = simple.RotationRefineFilter(Tracks=OutputPort(stage, 0), Objects=read[1], Shapes=shapes)
UpdatePipeline(time=0.5, proxy=stage)
UpdatePipeline(time=0.5, proxy=turned)

def here(source, port=0):  # what this process has
    return source.GetClientSideObject().GetOutputDataObject(port)

def points(source, port=0):  # what all processes have together
    return OutputPort(source, port).GetDataInformation().GetNumberOfPoints()

table = here(stage, 4)
tracks = here(stage)
with open(sys.argv[1], "w", encoding="utf-8") as stream:
    json.dump({"course": [table.GetValueByName(k, "E").ToDouble() for k in range(table.GetNumberOfRows())],
               "lines": tracks.GetNumberOfLines(),
               "points": [tracks.GetPoint(k) for k in range(tracks.GetNumberOfPoints())],
               "all": [points(stage, 0), points(stage, 1), points(turned)]}, stream)
"""


# All processes run this script (--symmetric), as a user's.
SYNTHESIS = f"COARSE = {COARSE}" + """
import hashlib, json, os, sys
import waft
from vtkmodules.vtkParallelCore import vtkMultiProcessController
from vtkmodules.util.numpy_support import vtk_to_numpy
rank = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
run = waft.synthesize(sys.argv[2], quality="full", _settings={"Assimilation": COARSE, "Spacetime": {
    "NumberOfGasParticles": 216, "LeashIterations": 2, "MaximumNumberOfIterations": 6}})

def digest(array):
    return hashlib.sha256(array.tobytes()).hexdigest()

stage, tracks, vortices, _ = run.motion
found = {"shape": run.positions.shape, "marks": run.marks["status"].tolist(), "residuals": run.marks["residual"].tolist(),
         "positions": digest(run.positions), "orientations": digest(run.orientations), "warnings": run.warnings,
         "vortices": run.output(stage, vortices).GetNumberOfCells()}
data = run.output(stage, tracks).GetPointData()
for k in range(data.GetNumberOfArrays()):
    found[data.GetArrayName(k)] = digest(vtk_to_numpy(data.GetArray(k)))
with open(sys.argv[1] + ".%d" % rank, "w", encoding="utf-8") as stream:
    json.dump(found, stream)
"""

# The first process runs this script, ParaView the pipeline on all of them: nothing of a scene is there twice, also after
# another time was looked at.
SCENE = f"COARSE = {COARSE}" + """
import json, sys
from paraview import simple
from paraview.simple import OutputPort

reader = simple.MotionSceneReader(FileName=sys.argv[2])
objects, rows, obstacles, shapes, _, wind = (OutputPort(reader, port) for port in range(6))
planner = simple.StylisticPlannerFilter(Objects=objects, Constraints=rows, Obstacles=obstacles)
air = simple.AirAssimilationFilter(Tracks=OutputPort(planner, 0), Objects=objects, Constraints=OutputPort(planner, 3),
                                   Obstacles=obstacles, Wind=wind, **COARSE)
turned = simple.RotationRefineFilter(Tracks=OutputPort(air, 0), Objects=objects, Shapes=shapes, Obstacles=obstacles,
                                     Constraints=OutputPort(air, 3), Wind=wind)
found = []
for seed in (1, 2):
    planner.Seed = seed
    turned.UpdatePipeline(0.2)
    for stage in (reader, planner, air, turned):
        ports = range(stage.SMProxy.GetNumberOfOutputPorts())
        found.append([OutputPort(stage, port).GetDataInformation().GetNumberOfPoints() for port in ports])
    poses = turned.GetClientSideObject().GetOutputDataObject(1)
    found.append([poses.GetPoint(k) for k in range(poses.GetNumberOfPoints())])
    reader.UpdatePipeline(0.3)
with open(sys.argv[1], "w", encoding="utf-8") as stream:
    json.dump(found, stream)
"""


class Ranks(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_on(self, processes, script, arguments, options=()):
        path = self.folder / "child.py"
        path.write_text(script, encoding="utf-8")
        command = [MPIEXEC, "--allow-run-as-root", "--oversubscribe", "-n", str(processes)] if processes > 1 else []
        command += [PVBATCH, *(options if processes > 1 else []), str(path), *map(str, arguments)]
        # One thread each, and no process waits by spinning.
        environment = dict(os.environ, VTK_SMP_BACKEND_IN_USE="Sequential", OMPI_MCA_mpi_yield_when_idle="1")
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              env=environment, check=False)
        self.assertEqual(done.returncode, 0, done.stdout[-3000:])
        return done.stdout

    def test_gives_the_bits_of_one_process_and_has_them_on_the_first(self):
        found = {}
        for processes in (1, 2):
            out = self.folder / f"found{processes}"
            self.run_on(processes, SYMMETRIC, [out], ["--symmetric"])
            found[processes] = [json.loads(pathlib.Path(f"{out}.{rank}").read_text(encoding="utf-8"))
                                for rank in range(processes)]
        one = found[1][0]
        self.assertEqual([len(one["points"]), one["said"], one["report"], one["stopped"]], [3 * FRAMES, [], 3, [True, 0]])
        self.assertGreater(one["particles"], 216)
        self.assertLess(one["courses"][0][-1], 0.8 * one["courses"][0][0])
        self.assertEqual(one["alone"], one["courses"][0])
        first, other = found[2]
        self.assertGreater(first["mistakes"], 0)
        self.assertEqual(first, one)
        self.assertGreater(other.pop("mistakes"), 0)
        self.assertEqual(other, {"courses": [[], []], "said": [], "points": [], "particles": 0, "wind": 0,
                                 "report": 0, "stopped": [False, 0], "alone": []})

    def make_scene(self):
        """Two maples in a gust, one with a mark, as a file."""
        path = self.folder / "gust.waft.json"
        path.write_text(json.dumps({
            "waft": 1, "seed": 5, "time": {"frames": 13}, "shapes": {"maple": {"builtin": "maple"}},
            "objects": [{"shape": "maple", "positions": [[0.2, 0.1, 2.6], [-0.2, 0.1, 2.6]]}],
            "constraints": [{"kind": "position", "object": 0, "frame": 10, "value": [0.2, 0.1, 2.5], "radius": 0.1}],
            "winds": [{"direction": [1, 0.2, 0], "strength": 1.5, "center": [0, 0, 2.5], "radius": 1, "centerTime": 0.2,
                       "duration": 0.2}]}), encoding="utf-8")
        return path

    def test_synthesizes_the_same_on_each(self):
        scene = self.make_scene()
        found = []
        for processes in (1, 3):
            out = self.folder / f"on{processes}"
            self.run_on(processes, SYNTHESIS, [out, scene], ["--symmetric"])
            found += [json.loads(pathlib.Path(f"{out}.{rank}").read_text(encoding="utf-8")) for rank in range(processes)]
        self.assertEqual((found[0]["shape"], found[0]["marks"]), ([2, 13, 3], ["met"]))
        for other in found[1:]:
            self.assertEqual(other, found[0])

    def test_of_a_scene_nothing_is_there_twice(self):
        scene = self.make_scene()
        found = {}
        for processes in (1, 2):
            out = self.folder / f"seen{processes}"
            self.assertNotIn("ERR|", self.run_on(processes, SCENE, [out, scene]))
            found[processes] = json.loads(out.read_text(encoding="utf-8"))
        self.assertEqual([len(found[1]), found[1][0][0], len(found[1][4])], [10, 2, 2 * 13])
        self.assertEqual(found[2], found[1])

    def test_in_a_pipeline_of_paraview(self):
        found = {}
        for processes in (1, 2):
            out = self.folder / f"found{processes}"
            text = self.run_on(processes, PROXIES, [out, self.folder])
            self.assertNotIn("ERR|", text)
            found[processes] = json.loads(out.read_text(encoding="utf-8"))
        self.assertEqual(found[1]["lines"], 3)
        self.assertEqual(found[1]["all"][0], 3 * FRAMES)
        self.assertGreater(min(found[1]["all"]), 0)
        self.assertEqual(found[2], found[1])


if __name__ == "__main__":
    PVBATCH = sys.argv[1]
    MPIEXEC = sys.argv[2] if len(sys.argv) > 2 else ""
    if not MPIEXEC:
        print("mpiexec is not there (package openmpi-bin): several processes are not tested")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
