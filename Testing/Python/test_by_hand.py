# SPDX-License-Identifier: BSD-3-Clause
"""A scene made in ParaView without JSON: planned, kept by the writer and by Save Data, read back, planned again.

    pvpython run.py test_by_hand.py"""

import json
import os
import tempfile
import unittest

from paraview import simple
from paraview.simple import OutputPort, UpdatePipeline

import waft


def data_of(source, port=0):
    return source.GetClientSideObject().GetOutputDataObject(port)


def points_of(data):
    return [data.GetPoint(i) for i in range(data.GetNumberOfPoints())]


class ByHandTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        starts = [simple.ObjectSource(ObjectId=k, Position=[-1.0 + k, -0.5, 3.0], SettlingSpeed=0.5) for k in range(3)]
        cls.objects = simple.AppendGeometry(Input=starts)
        way = simple.ConstraintSource(ObjectId=1, Frame=100, LastFrame=220, UseWaypoints=1,
                                      Waypoints=[0, 0, 2.4, 0.6, 0.4, 2.0])
        speed = simple.ConstraintSource(ObjectId=0, Kind="Velocity", Frame=60, Value=[0.1, 0, -0.1], Radius=0.1)
        word = simple.ShapeKeyframeSource(Frame=280, NumberOfTargets=3, Width=1.5, Rest=0, Facing=[0, -3, 0], FacingTolerance=0.25)
        word.Origin = [0, 0.2, 1.5]
        cls.rows = simple.AppendGeometry(Input=[way, speed, word])
        box = simple.Box(XLength=0.3, YLength=0.3, ZLength=1.2, Center=[-0.4, 0.3, 0.9])
        cls.wall = simple.Clean(Input=simple.Triangulate(Input=box))
        cls.planner = simple.StylisticPlannerFilter(Objects=cls.objects, Constraints=cls.rows, Obstacles=cls.wall)
        UpdatePipeline(proxy=cls.planner)
        cls.folder = tempfile.TemporaryDirectory()

    def file(self, name):
        return os.path.join(self.folder.name, name)

    def test_is_planned_without_json(self):
        self.assertEqual(data_of(self.planner).GetNumberOfLines(), 3)
        report = data_of(self.planner, 2)
        statuses = [report.GetValueByName(row, "Status").ToString() for row in range(report.GetNumberOfRows())]
        self.assertEqual(len(statuses), 6)
        messages = [report.GetValueByName(row, "Message").ToString() for row in range(report.GetNumberOfRows())]
        self.assertGreaterEqual(statuses.count("met"), 5, list(zip(statuses, messages)))

    def check_copy(self, path):
        reader = simple.MotionSceneReader(FileName=path)
        UpdatePipeline(proxy=reader)
        self.assertEqual(points_of(data_of(reader, 0)), points_of(data_of(self.objects)))
        self.assertEqual(points_of(data_of(reader, 1)), points_of(data_of(self.rows)))
        self.assertEqual(data_of(reader, 2).GetNumberOfCells(), 12)
        database = simple.XMLMultiBlockDataReader(FileName=[waft.data_file("Database/embedded.vtm")])
        database.TimeArray = "None"
        again = simple.StylisticPlannerFilter(Database=database, Objects=OutputPort(reader, 0),
                                              Constraints=OutputPort(reader, 1), Obstacles=OutputPort(reader, 2))
        UpdatePipeline(proxy=again)
        self.assertEqual(points_of(data_of(again)), points_of(data_of(self.planner)))

    def test_the_writer_keeps_it(self):
        writer = simple.MotionSceneWriter(Objects=self.objects, Constraints=self.rows, Obstacles=self.wall)
        writer.Title = "By hand"
        writer.FileName = self.file("hand.waft.json")
        UpdatePipeline(proxy=writer)
        with open(self.file("hand.waft.json"), encoding="utf-8") as stream:
            written = json.load(stream)
        self.assertEqual(written["title"], "By hand")
        self.assertEqual([row["facing"] for row in written["constraints"] if "facing" in row],
                         [{"direction": [0.0, -1.0, 0.0], "tolerance": 0.25}])
        self.check_copy(self.file("hand.waft.json"))

    def test_vortices_and_winds_are_written_as_an_artist_would(self):
        whirls = simple.AppendGeometry(Input=[simple.VortexSource(VortexId=k, P1=[k, 0, 1], P2=[k, 0, 3], Strength=1 + k)
                                              for k in range(2)])
        gust = simple.WindSource(Direction=[0, 2, 0], Strength=0.5, Radius=0.75)
        writer = simple.MotionSceneWriter(Objects=self.objects, Constraints=self.rows, Obstacles=self.wall,
                                          Vortices=whirls, Wind=gust)
        writer.FileName = self.file("forces.waft.json")
        UpdatePipeline(proxy=writer)
        with open(self.file("forces.waft.json"), encoding="utf-8") as stream:
            scene = json.load(stream)
        self.assertEqual([(entry["p1"], entry["p2"], entry["strength"]) for entry in scene["vortices"]],
                         [([0, 0, 1], [0, 0, 3], 1), ([1, 0, 1], [1, 0, 3], 2)])
        self.assertEqual(scene["winds"], [{"direction": [0, 1, 0], "strength": 0.5, "center": [0, 0, 2], "radius": 0.75,
                                           "centerTime": 5, "duration": 3}])
        reader = simple.MotionSceneReader(FileName=self.file("forces.waft.json"))
        UpdatePipeline(time=4.0, proxy=reader)
        UpdatePipeline(time=4.0, proxy=gust)
        self.assertEqual(points_of(data_of(reader, 4)), points_of(data_of(whirls)))
        read, made = (data_of(*where).GetPointData().GetArray("Wind") for where in ((reader, 5), (gust, 0)))
        self.assertEqual([read.GetTuple(k) for k in range(read.GetNumberOfTuples())],
                         [made.GetTuple(k) for k in range(made.GetNumberOfTuples())])

    def test_objects_take_their_body_from_a_shape(self):
        leaf = simple.LeafShapeSource()  # the active source, which goes into no port by itself
        own, taken = simple.ObjectSource(Mass=0.5), simple.ObjectSource(Mass=0.5, Shapes=leaf, Layout="Row")
        for source in (own, taken):
            UpdatePipeline(proxy=source)
        value = lambda source, name: data_of(source).GetPointData().GetArray(name).GetTuple1(0)  # noqa: E731
        self.assertEqual(value(own, "Mass"), 0.5)
        self.assertEqual(value(taken, "SettlingSpeed"), leaf.SettlingSpeed)
        self.assertLess(value(taken, "Mass"), 0.01)
        box = data_of(leaf).GetBlock(0).GetBounds()
        self.assertAlmostEqual(value(taken, "ClearanceRadius"), max(box[1] - box[0], box[3] - box[2]) / 2, places=6)
        self.assertGreater(value(taken, "RestHeight"), 0)

    def test_obstacles_are_written_as_an_artist_would(self):
        pillar = simple.ObstacleSource(Kind="Cylinder", Base=[-0.6, 0.3, 0], Top=[-0.6, 0.3, 1.5], Radius=0.2, Ground=1)
        ball = simple.ObstacleSource(Kind="Sphere", Center=[1.2, 1, 0.5], Radius=0.25)
        writer = simple.MotionSceneWriter(Objects=self.objects, Constraints=self.rows, Obstacles=pillar)
        writer.FileName = self.file("pillar.waft.json")
        UpdatePipeline(proxy=writer)
        with open(self.file("pillar.waft.json"), encoding="utf-8") as stream:
            scene = json.load(stream)
        self.assertEqual(scene["ground"], {"enabled": True, "height": 0})
        self.assertEqual(scene["obstacles"], [{"kind": "cylinder", "base": [-0.6, 0.3, 0], "top": [-0.6, 0.3, 1.5], "radius": 0.2}])
        both = simple.MotionSceneWriter(Objects=self.objects, Constraints=self.rows,
                                        Obstacles=simple.AppendGeometry(Input=[pillar, ball]))
        both.FileName = self.file("both.waft.json")
        UpdatePipeline(proxy=both)
        reader = simple.MotionSceneReader(FileName=self.file("both.waft.json"))
        UpdatePipeline(proxy=reader)
        self.assertEqual(data_of(reader, 2).GetNumberOfCells(), data_of(pillar).GetNumberOfCells() + data_of(ball).GetNumberOfCells())

    def test_save_data_keeps_it(self):
        scene = simple.MotionSceneWriter(Objects=self.objects, Constraints=self.rows, Obstacles=self.wall)
        UpdatePipeline(proxy=scene)
        simple.SaveData(self.file("saved.waft.json"), proxy=scene)
        self.check_copy(self.file("saved.waft.json"))

    def test_a_loop_is_written(self):
        writer = simple.MotionSceneWriter(Objects=simple.ObjectSource(Layout="Row", NumberOfObjects=4, Loop=1),
                                          FileName=self.file("round.waft.json"))
        UpdatePipeline(proxy=writer)
        with open(self.file("round.waft.json"), encoding="utf-8") as stream:
            self.assertIs(True, json.load(stream)["time"]["loop"])

    def test_fronts_arrows_and_leaving_are_written_as_an_artist_would(self):
        objects = simple.ObjectSource(Layout="Row", NumberOfObjects=4, OpenX=1, OpenTop=1)
        word = simple.ShapeKeyframeSource(Frame=150, FrameFrom=120, NumberOfTargets=4, Width=1.5, Rest=0, Hold=30, Drift=1, Order="Along the Arrow",
                                          OrderFrom=[1.0, 0, 0], OrderTo=[-1.0, 0, 0], Leave="Right", LeaveFrame=200, LastLeave=230)
        front = simple.WindSource(Kind="Front", Heading=[2, 0, 0], Speed=3.0, Width=6.0, Strength=5.0, StartFrame=195, Origin=[-1.5, 0, 2])
        writer = simple.MotionSceneWriter(Objects=objects, Constraints=word, Wind=front, FileName=self.file("gone.waft.json"))
        UpdatePipeline(proxy=writer)
        with open(self.file("gone.waft.json"), encoding="utf-8") as stream:
            written = json.load(stream)
        self.assertEqual(["x", "top"], written["domain"]["open"])
        self.assertEqual([{"kind": "front", "direction": [1.0, 0.0, 0.0], "speed": 3.0, "strength": 5.0, "width": 6.0, "startFrame": 195,
                           "origin": [-1.5, 0.0, 2.0]}], written["winds"])
        reader = simple.MotionSceneReader(FileName=self.file("gone.waft.json"))
        UpdatePipeline(proxy=reader)
        rows, made = data_of(reader, 1).GetPointData(), data_of(word).GetPointData()
        frames = [made.GetArray("Frame").GetValue(k) for k in range(4)]
        self.assertEqual([120, 130, 140, 150], sorted(frames))
        places = [data_of(word).GetPoint(k)[0] for k in range(4)]
        self.assertEqual(sorted(frames), [frame for _, frame in sorted(zip(places, frames), reverse=True)])  # from the right
        for name in ("Frame", "Hold", "Drift", "LeaveFrom"):
            self.assertEqual([made.GetArray(name).GetValue(k) for k in range(4)], [rows.GetArray(name).GetValue(k) for k in range(4)], name)
        self.assertEqual([200, 210, 220, 230], sorted(made.GetArray("LeaveFrom").GetValue(k) for k in range(4)))
        self.assertEqual((1.0, 0.0, 0.0), made.GetArray("LeaveAway").GetTuple(0))
