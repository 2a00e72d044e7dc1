# SPDX-License-Identifier: BSD-3-Clause
"""Save Data of each port of a Waft Animation, and Export Scene of what it shows: ParaView's own writers say nothing, and what they write
has all that the port has.

    pvbatch run.py test_saved_ports.py         on a screen
"""
import csv
import hashlib
import json
import os
import pathlib
import tempfile
import unittest
from unittest import mock

from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLPolyDataReader

import waft

READERS = {"vtkPolyData": (".vtp", vtkXMLPolyDataReader), "vtkImageData": (".vti", vtkXMLImageDataReader)}
EMPTY = ("OptimisedTracks", "Gas", "FittedVortices")  # at Preview: VTK's readers complain of a file without points
SHOWN = ("Meshes", "Poses", "Obstacles", "Marks")
FRAMES = 13


def digest(array):
    if array.IsA("vtkStringArray"):
        return [array.GetValue(i) for i in range(array.GetNumberOfValues())]
    values = vtk_to_numpy(array)
    return str(values.dtype), values.shape, hashlib.sha256(values.tobytes()).hexdigest()


def contents(data):
    """Everything that a data set holds, by name."""
    held = {}
    for fields in ("GetPointData", "GetCellData", "GetRowData", "GetFieldData"):
        attributes = getattr(data, fields)() if hasattr(data, fields) else None
        for index in range(attributes.GetNumberOfArrays() if attributes else 0):
            array = attributes.GetAbstractArray(index)
            held[fields + " " + array.GetName()] = digest(array)
    if data.IsA("vtkPolyData"):
        held["points"] = digest(data.GetPoints().GetData()) if data.GetNumberOfPoints() else None
        held["cells"] = [data.GetNumberOfVerts(), data.GetNumberOfLines(), data.GetNumberOfPolys(), data.GetNumberOfStrips()]
    return held


class SavedPortsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        kept = tempfile.TemporaryDirectory()
        cls.addClassCleanup(kept.cleanup)
        cls.folder = pathlib.Path(kept.name)
        scene = waft.Scene("Saved", seed=7)
        scene.set_time(FRAMES)
        scene.add_shape("red", builtin="maple", size=0.25, color=(0.9, 0.15, 0.1))
        scene.add_objects("red", positions=[(0, 0, 2.5), (0.5, 0.5, 2.5)])
        scene.add_position(0, FRAMES - 1, (0.05, 0.02, 2.3))
        scene.add_box((1, 1, 0), (1.3, 1.3, 1))
        scene.save(cls.folder / "scene.waft.json")
        cls.animation = simple.WaftAnimation(FileName=str(cls.folder / "scene.waft.json"))
        waft.update(cls.animation)
        cls.names = [cls.animation.SMProxy.GetOutputPortName(port) for port in range(cls.animation.SMProxy.GetNumberOfOutputPorts())]

    def setUp(self):
        self.said = vtkStringOutputWindow()
        before = vtkOutputWindow.GetInstance()
        vtkOutputWindow.SetInstance(self.said)
        self.addCleanup(vtkOutputWindow.SetInstance, before)

    def check_quiet(self):
        self.assertNotRegex(self.said.GetOutput(), "(?i)error|warning")  # a test's own dots are said there, too

    def test_each_port_has_the_same_arrays_at_all_times(self):
        held = {}
        for time in self.animation.TimestepValues:
            self.animation.UpdatePipeline(time)
            for port, name in enumerate(self.names):
                data = servermanager.Fetch(self.animation, idx=port)
                arrays = [entry for entry in contents(data) if entry.startswith("Get")]
                self.assertEqual(held.setdefault(name, arrays), arrays, f"{name} at {time} s")

    def test_each_port_is_saved_whole(self):
        self.assertEqual(len(self.names), 20)
        for port, name in enumerate(self.names):
            with self.subTest(port=name):
                data = servermanager.Fetch(self.animation, idx=port)
                if data.IsA("vtkTable"):
                    self.check_table(data, name)
                    continue
                ending, make_reader = READERS[data.GetClassName()]
                file = self.folder / (name + ending)
                simple.SaveData(str(file), self.animation[name])
                if name in EMPTY:
                    self.assertEqual((data.GetNumberOfPoints(), file.is_file()), (0, True))
                    continue
                reader = make_reader()
                reader.SetFileName(str(file))
                reader.Update()
                wanted, read = contents(data), contents(reader.GetOutputDataObject(0))
                self.assertEqual({key: read.get(key) for key in wanted}, wanted)
        self.check_quiet()

    def check_table(self, table, name):
        file = self.folder / (name + ".csv")
        simple.SaveData(str(file), self.animation[name])
        with open(file, encoding="utf-8", newline="") as lines:
            rows = list(csv.DictReader(lines))
        self.assertEqual(len(rows), table.GetNumberOfRows())
        columns = [table.GetColumn(index) for index in range(table.GetNumberOfColumns())]
        for column in columns if rows else []:
            if column.IsA("vtkStringArray"):
                self.assertEqual([row[column.GetName()] for row in rows], [column.GetValue(index) for index in range(len(rows))])
            else:
                parts = column.GetNumberOfComponents()
                names = [column.GetName()] if parts == 1 else [f"{column.GetName()}:{part}" for part in range(parts)]
                for part, part_name in enumerate(names):
                    for row, line in enumerate(rows):
                        wanted = column.GetComponent(row, part)
                        self.assertAlmostEqual(float(line[part_name]), wanted, delta=1e-4 * max(1.0, abs(wanted)))

    def test_a_state_keeps_its_flight(self):
        """Loaded again, as later and elsewhere: the same motion without another air, and without a word; an edit flies on in it."""
        poses = self.names.index("Poses")

        def flown(animation):
            waft.update(animation)
            source = animation.GetClientSideObject()
            return json.loads(source.GetFlight()), contents(source.GetOutputDataObject(poses))

        first, motion = flown(self.animation)
        with mock.patch.dict(os.environ, {"WAFT_CACHE": str(self.folder / "cache")}):
            simple.SaveState(str(self.folder / "state.pvsm"))
            kept = set(os.listdir(self.folder / "cache"))
            self.assertIn(f"{first['key']}.state", kept)
            before = set(simple.GetSources().values())
            simple.LoadState(str(self.folder / "state.pvsm"))
            loaded = next(source for source in simple.GetSources().values() if source not in before and source.SMProxy.GetXMLName() == "WaftAnimation")
            again, same = flown(loaded)
            self.assertEqual(motion, same)
            self.assertLess(again["stages"]["assimilation"]["processorSeconds"], 0.5 * first["stages"]["assimilation"]["processorSeconds"])
            self.assertEqual(0, loaded.GetClientSideObject().GetWantsNewAir())
            loaded.Seed = 8
            other, moved = flown(loaded)
            self.assertNotEqual(motion, moved, "another flight")
            names = set(os.listdir(self.folder / "cache"))
            self.assertNotIn(f"{other['key']}.state", names, "a flight that no state has is not kept")
            self.assertEqual(1, len(names - kept), "the air as it was drawn is")
        self.check_quiet()

    def test_all_frames_are_saved(self):
        simple.SaveData(str(self.folder / "flight.pvd"), self.animation["Meshes"], WriteTimeSteps=1)
        read = simple.PVDReader(FileName=str(self.folder / "flight.pvd"))
        read.UpdatePipelineInformation()
        self.assertEqual(len(read.TimestepValues), FRAMES)
        for frame in (0, 7, FRAMES - 1):
            read.UpdatePipeline(read.TimestepValues[frame])  # the file has six digits of it
            self.animation.UpdatePipeline(frame / 30)
            saved, own = (source.GetClientSideObject().GetOutputDataObject(0) for source in (read, self.animation))
            saved = saved.GetPiece(0) if saved.IsA("vtkMultiPieceDataSet") else saved
            self.assertEqual(contents(saved)["points"], contents(own)["points"], frame)
        self.check_quiet()

    def test_what_is_shown_is_exported(self):
        view = simple.CreateView("RenderView")
        for name in SHOWN:
            simple.Show(self.animation[name], view)
        simple.Render(view)
        file = self.folder / "scene.gltf"
        for ending in (".gltf", ".x3d", ".vrml", ".pov"):
            simple.ExportView(str(file.with_suffix(ending)), view=view)
            self.assertGreater(file.with_suffix(ending).stat().st_size, 1000)
        self.check_quiet()
        exported = json.loads(file.read_text(encoding="utf-8"))
        vertices = [exported["accessors"][part["attributes"]["POSITION"]]["count"] for mesh in exported["meshes"]
                    for part in mesh["primitives"]]
        bodies = servermanager.Fetch(self.animation, idx=0).GetNumberOfPoints()
        obstacles = servermanager.Fetch(self.animation, idx=2).GetNumberOfPoints()
        self.assertGreaterEqual(sum(vertices), bodies + obstacles, vertices)
        colors = [material["pbrMetallicRoughness"]["baseColorFactor"] for material in exported["materials"]]
        self.assertTrue(any(red > 2 * max(green, blue) for red, green, blue, _ in colors), f"the scene's own: {colors}")
