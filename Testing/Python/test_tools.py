# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's own tools on Waft's data: groups, blocks, tables and thresholds as inputs, data by the names of ports, extractors of
each port, and states that another process runs.

    pvpython run.py test_tools.py PVPYTHON"""
import csv
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from paraview import simple, smstate
from vtkmodules.util.numpy_support import vtk_to_numpy

import waft
from waft.reading import read_image, read_surface

PVPYTHON = sys.argv[1]
FRAMES, RATE, SEED = 60, 24, 7
READER = ("Objects", "Constraints", "Obstacles", "Shapes", "Vortices", "Wind")
DIGEST = """
import hashlib
import waft
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
tracks = waft.fetch(simple.FindSource({name!r}), {port!r})
print("digest", hashlib.sha256(vtk_to_numpy(tracks.GetPoints().GetData()).tobytes()).hexdigest())
"""


def make_scene(folder):
    """Three leaves, a mark, an obstacle that moves and a wind."""
    scene = waft.Scene("Tools", seed=SEED)
    scene.set_time(FRAMES, RATE)
    scene.add_objects("leaf", positions=[(-0.5, 0.0, 2.1), (-0.5, 0.4, 2.2), (0.5, 0.4, 2.0)])
    scene.add_position(0, 50, (0.3, 0.1, 1.6), radius=0.1)
    scene.add_sphere((1, -1, 2), 0.2, motion=[{"frame": 0, "position": [1, -1, 2]}, {"frame": 59, "position": [1, 1, 2]}])
    scene.add_wind((1, 0, 0), 0.3, (0, 0, 2), 1.0, 0.5, 0.5)
    path = os.path.join(folder, "tools.waft.json")
    scene.save(path)
    return path


def digest(data):
    return hashlib.sha256(vtk_to_numpy(data.GetPoints().GetData()).tobytes()).hexdigest()


def size_of(file):
    """Rows of a table, points of all else."""
    if file.suffix == ".csv":
        with open(file, encoding="utf-8", newline="") as rows:
            return len(list(csv.reader(rows))) - 1
    # Values stand behind the tags, where VTK 9.2 with a newer Expat reads none: Waft's own readers do.
    read = read_surface if file.suffix == ".pvtp" else read_image
    pieces = re.findall(r'Source="([^"]+)"', file.read_text(encoding="utf-8", errors="replace"))
    return sum(read(file.parent / piece).GetNumberOfPoints() for piece in pieces)


class ToolsTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.addCleanup(lambda: [simple.Delete(source) for source in [*simple.GetSources().values()][::-1]])
        self.reader = simple.MotionSceneReader(registrationName="Scene", FileName=make_scene(folder.name))
        self.reader.UpdatePipeline()
        self.said = []

    def plan(self, **other):
        """A planner of the scene, but for some inputs, that has run; `said` gets its errors and warnings."""
        inputs = {name: self.reader[READER.index(name)] for name in ("Objects", "Constraints", "Obstacles")} | other
        planner = simple.StylisticPlannerFilter(registrationName="Planner", **inputs)
        planner.Seed = SEED
        algorithm = planner.GetClientSideObject()

        def take(_caller, _event, text):
            self.said.append(text)
        take.CallDataType = "string0"
        for event in ("ErrorEvent", "WarningEvent"):
            algorithm.AddObserver(event, take)
            algorithm.GetExecutive().AddObserver(event, take)
        planner.UpdatePipeline()
        return planner

    def tracks(self, planner):
        return planner.GetClientSideObject().GetOutputDataObject(0)

    def test_groups_and_extracted_blocks_are_what_is_in_them(self):
        plain = digest(self.tracks(self.plan()))
        grouped = {name: simple.GroupDatasets(Input=[self.reader[READER.index(name)]])
                   for name in ("Objects", "Constraints", "Obstacles")}
        self.assertEqual(plain, digest(self.tracks(self.plan(**grouped))))
        both = simple.GroupDatasets(Input=[self.reader[0], self.reader[2]])
        both.BlockNames = ["Objects", "Obstacles"]
        extracted = simple.ExtractBlock(Input=both)
        extracted.Selectors = ["/Root/Obstacles"]
        self.assertEqual(plain, digest(self.tracks(self.plan(Obstacles=extracted))))
        self.assertEqual([], [text for text in self.said if "resampled" not in text])

    def test_an_open_surface_in_blocks_is_refused_as_an_obstacle(self):
        self.assertEqual(0, self.tracks(self.plan(Obstacles=simple.FeatherShapeSource())).GetNumberOfPoints())
        self.assertRegex("".join(self.said), "(?i)obstacle 0.*closed")

    def test_rows_of_two_sources_in_a_group_are_one_list(self):
        rows = [simple.ConstraintSource(NumberOfFrames=FRAMES, FramesPerSecond=RATE, ObjectId=k, Frame=40,
                                        Value=[0.1 * k, 0.2, 1.8]) for k in (1, 2)]
        planner = self.plan(Constraints=simple.GroupDatasets(Input=rows))
        self.assertEqual(3, self.tracks(planner).GetNumberOfLines())
        self.assertEqual(2, waft.fetch(planner, "Report").GetNumberOfRows())

    def test_objects_by_way_of_a_table_fly_the_same_scene(self):
        plain = self.tracks(self.plan())
        table = self.folder / "objects.csv"
        simple.SaveData(str(table), simple.OutputPort(self.reader, 0), Precision=17)
        points = simple.TableToPoints(Input=simple.CSVReader(FileName=[str(table)]), XColumn="Points:0", YColumn="Points:1",
                                      ZColumn="Points:2")
        planner = self.plan(Objects=points)
        tracks = self.tracks(planner)
        self.assertEqual([FRAMES], [round(tracks.GetFieldData().GetArray("NumberOfFrames").GetTuple1(0))])
        self.assertEqual((plain.GetNumberOfPoints(), len(planner.TimestepValues)), (tracks.GetNumberOfPoints(), FRAMES))

    def test_a_threshold_that_matches_none_is_no_objects(self):
        none = simple.Threshold(Input=self.reader[0], Scalars=["POINTS", "Mass"], LowerThreshold=5.0, UpperThreshold=6.0)
        self.plan(Objects=none)
        self.assertIn("Objects: no objects", "".join(self.said))

    def test_data_come_by_the_name_of_their_port(self):
        planner = self.plan()
        self.assertEqual("vtkTable", waft.fetch(planner, "Report").GetClassName())
        self.assertEqual(digest(self.tracks(planner)), digest(waft.fetch(planner)))
        self.assertEqual(1, waft.fetch(planner["Report"]).GetNumberOfRows())
        moved = [digest(waft.fetch(self.reader, "Obstacles", time=frame / RATE)) for frame in (0, 59)]
        self.assertNotEqual(*moved)
        self.assertEqual(1, waft.fetch(self.reader, "Shapes").GetNumberOfBlocks())
        animation = simple.WaftAnimation(FileName=self.reader.FileName, StopAfter="Plan")
        self.assertEqual(digest(self.tracks(planner)), digest(waft.fetch(animation, "PlannedTracks")))
        self.assertEqual(1, waft.fetch(animation, "PlannedReport").GetNumberOfRows())
        for wrong in ("Pose", 99, -1, 1.5, True):
            with self.assertRaisesRegex(waft.BadInput, "port: expected one of .*Tracks"):
                waft.fetch(planner, wrong)
        with self.assertRaisesRegex(waft.BadInput, "expected a stage"):
            waft.fetch(None)

    def test_an_extractor_writes_the_port_that_it_was_made_for(self):
        planner = self.plan()
        wanted = {}
        for stage in (planner, self.reader):
            for port in range(stage.SMProxy.GetNumberOfOutputPorts()):
                about = stage[port].GetDataInformation()
                if about.IsCompositeDataSet():
                    continue
                kind = {"vtkTable": "CSV", "vtkPolyData": "VTP", "vtkImageData": "VTI"}[about.GetDataClassName()]
                file = f"{stage.GetXMLName()}{port}." + {"CSV": "csv", "VTP": "pvtp", "VTI": "pvti"}[kind]
                simple.CreateExtractor(kind, stage[port], registrationName=file).Writer.FileName = file
                wanted[file] = about.DataInformation.GetNumberOfRows() if kind == "CSV" else about.GetNumberOfPoints()
        self.assertEqual(8 + 5, len(wanted))
        simple.SaveExtracts(ExtractsOutputDirectory=str(self.folder), FrameWindow=[0, 0])
        self.assertEqual(wanted, {file: size_of(self.folder / file) for file in wanted})

    def in_another_process(self, lines):
        script = self.folder / "other.py"
        script.write_text(lines, encoding="utf-8")
        done = subprocess.run([PVPYTHON, str(script)], capture_output=True, text=True, check=False)
        self.assertEqual(0, done.returncode, done.stderr)
        return [line.split()[1] for line in done.stdout.splitlines() if line.startswith("digest ")]

    def test_states_give_the_same_motion_in_another_process(self):
        planner = self.plan()
        planner.MaxTilt = 0.2
        rotation = simple.RotationRefineFilter(
            registrationName="Rotation", Tracks=planner[0], Objects=self.reader[0], Shapes=self.reader[3],
            Obstacles=self.reader[2], Constraints=planner[3], Wind=self.reader[5])
        rotation.UpdatePipeline()
        animation = simple.WaftAnimation(registrationName="Waft", FileName=self.reader.FileName, StopAfter="Plan", Seed=3)
        animation.UpdatePipeline()
        wanted = [digest(waft.fetch(rotation, "Poses")), digest(waft.fetch(animation, "PlannedTracks"))]
        look = DIGEST.format(name="Rotation", port="Poses") + DIGEST.format(name="Waft", port="PlannedTracks")
        state = self.folder / "state.pvsm"
        simple.SaveState(str(state))
        load = f"import waft\nfrom paraview import simple\nsimple.LoadState({str(state)!r})"
        self.assertEqual(wanted, self.in_another_process(f"{load}\n{look}"))
        self.assertEqual(wanted, self.in_another_process(f"import waft\n{smstate.get_state()}\n{look}"))
