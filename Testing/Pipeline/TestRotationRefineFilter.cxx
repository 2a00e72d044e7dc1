// SPDX-License-Identifier: BSD-3-Clause
#include "PipelineTesting.h"

#include "Base/Primitives.h"
#include "Base/ShapeMeasures.h"
#include "Base/TemporaryFolder.h"
#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/PoseData.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/ShapeData.h"
#include "Bridge/Data/TrackData.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkGLTFReader.h>
#include <vtkImageAlgorithm.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMotionAnimationWriter.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkRotationRefineFilter.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTable.h>
#include <vtkTrivialProducer.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

using namespace waft;

namespace
{

constexpr int Frames = 60;

Shape Leaf(const std::string& name, double length)
{
  Shape shape;
  shape.Name = name;
  for (int j = 0; j < 3; ++j)
  {
    for (int i = 0; i < 4; ++i)
    {
      shape.Mesh.Points.emplace_back(length * (i / 3.0 - 0.5), 0.5 * length * (j / 2.0 - 0.5),
                                     0.1 * length * (i - 1.5) * (i - 1.5));
      shape.TextureCoordinates.push_back({ i / 3.0, j / 2.0 });
      if (i < 3 && j < 2)
      {
        const int p = 4 * j + i;
        shape.Mesh.Triangles.push_back({ p, p + 1, p + 5 });
        shape.Mesh.Triangles.push_back({ p, p + 5, p + 4 });
      }
    }
  }
  const Vec3 center = ShellCentroid(shape.Mesh);
  for (Vec3& p : shape.Mesh.Points)
  {
    p -= center;
  }
  return shape;
}

/// Two leaves and a smaller one that fall over the ground; the first lies still from frame 40 on.
struct Pipeline
{
  SceneInfo Info;
  std::vector<Shape> Shapes{ Leaf("leaf", 0.1), Leaf("petal", 0.04) };
  std::vector<Track> Tracks;
  vtkNew<vtkPolyData> TrackData, ObjectData, ObstacleData, RowData;
  vtkNew<vtkMultiBlockDataSet> ShapeData;
  vtkNew<vtkTrivialProducer> Producers[5];
  vtkNew<vtkRotationRefineFilter> Filter;

  Pipeline()
  {
    this->Info.Time.NumberOfFrames = Frames;
    std::vector<MotionObject> objects;
    for (int i = 0; i < 3; ++i)
    {
      MotionObject object;
      object.ObjectId = 5 * i;
      object.ShapeId = i % 2;
      const Shape& shape = this->Shapes[static_cast<std::size_t>(object.ShapeId)];
      object.Mass = ShellMass(shape);
      object.RestHeight = RestHeight(shape);
      object.ClearanceRadius = ClearanceRadius(shape);
      object.Orientation = Quat(Eigen::AngleAxisd(0.5 * i, Vec3::UnitX()));
      Track track;
      track.ObjectId = object.ObjectId;
      for (int k = 0; k < Frames; ++k)
      {
        const double left = std::max(0, 40 - k) / 30.0;
        track.Positions.emplace_back(0.3 * i + 0.2 * std::sin(3.0 * left) * std::min(left, 1.0),
                                     0.1 * left, object.RestHeight + 0.5 * i + 0.6 * left * left);
      }
      object.Position = track.Positions[0];
      objects.push_back(object);
      this->Tracks.push_back(track);
    }
    Constraint rest;
    rest.ObjectId = 0;
    rest.Frame = 40;
    rest.Until = Frames - 1;
    rest.Kind = ConstraintKind::Rest;
    rest.Value = this->Tracks[0].Positions[40];
    TracksToPolyData(this->Tracks, this->Info, this->TrackData);
    ObjectsToPolyData(objects, this->Info, this->ObjectData);
    ShapesToMultiBlock(this->Shapes, this->Info, this->ShapeData);
    ConstraintsToPolyData({ rest }, this->Info, this->RowData);
    ObstacleMesh ground;
    ground.Mesh = MakeBox({ Vec3(-2.0, -2.0, -1.0), Vec3(2.0, 2.0, 0.0) });
    ObstaclesToPolyData({ ground }, 0.0, this->Info, this->ObstacleData);
    vtkDataObject* data[5] = { this->TrackData, this->ObjectData, this->ShapeData,
                               this->ObstacleData, this->RowData };
    const int ports[5] = { 0, 1, 2, 3, 5 };
    for (int i = 0; i < 5; ++i)
    {
      this->Producers[i]->SetOutput(data[i]);
      this->Filter->SetInputConnection(ports[i], this->Producers[i]->GetOutputPort());
    }
  }

  vtkPolyData* Meshes(int frame)
  {
    this->Filter->UpdateTimeStep(this->Info.Time.Time(frame));
    return this->Filter->GetOutput(0);
  }
};

/// Air that moves along x at Gain * t m/s, at two times, as the assimilation gives it: beside the
/// velocity it has the force of a wind.
class GrowingAir : public vtkImageAlgorithm
{
public:
  static GrowingAir* New();
  vtkTypeMacro(GrowingAir, vtkImageAlgorithm);

  double Gain = 1.5; // m/s^2
  double Last = (Frames - 1) / 30.0;

protected:
  using Sddp = vtkStreamingDemandDrivenPipeline;
  GrowingAir() { this->SetNumberOfInputPorts(0); }
  int RequestInformation(vtkInformation*, vtkInformationVector**,
                         vtkInformationVector* outputs) override
  {
    const double times[2] = { 0.0, this->Last };
    const int extent[6] = { 0, 2, 0, 2, 0, 2 };
    vtkInformation* info = outputs->GetInformationObject(0);
    info->Set(Sddp::TIME_STEPS(), times, 2);
    info->Set(Sddp::TIME_RANGE(), times, 2);
    info->Set(Sddp::WHOLE_EXTENT(), extent, 6);
    return 1;
  }
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkInformation* info = outputs->GetInformationObject(0);
    const double time =
      info->Has(Sddp::UPDATE_TIME_STEP()) ? info->Get(Sddp::UPDATE_TIME_STEP()) : 0.0;
    vtkImageData* image = vtkImageData::GetData(info);
    MakeEvenWind(image, names::Velocity, { this->Gain * time, 0.0, 0.0 });
    vtkNew<vtkImageData> force;
    MakeEvenWind(force, names::Wind, { 7.0, 7.0, 7.0 });
    image->GetPointData()->AddArray(force->GetPointData()->GetArray(names::Wind));
    image->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
    return 1;
  }
};
vtkStandardNewMacro(GrowingAir);

} // namespace

TEST(RotationRefineFilter, AirIsPulledOverTimeAndCountsInPlaceOfTheTracks)
{
  // Bodies that the air takes along from its start feel nothing, whatever their tracks say.
  Pipeline pipeline;
  vtkNew<GrowingAir> air;
  for (Track& track : pipeline.Tracks)
  {
    for (int k = 0; k < Frames; ++k)
    {
      const double t = k / 30.0;
      track.Positions[static_cast<std::size_t>(k)] =
        track.Positions[0] + Vec3(0.5 * air->Gain * t * t, 0.0, 0.0);
    }
    track.AirVelocities.assign(Frames, Vec3(2.0, 3.0, -4.0));
  }
  TracksToPolyData(pipeline.Tracks, pipeline.Info, pipeline.TrackData);
  pipeline.Filter->RemoveAllConstraints();
  pipeline.Filter->RemoveAllObstacles();
  pipeline.Filter->SetInputConnection(6, air->GetOutputPort());
  ErrorLog errors(pipeline.Filter);
  const auto torque = [&](int frame)
  {
    pipeline.Meshes(Frames - 1);
    vtkPointData* arrays = pipeline.Filter->GetOutput(1)->GetPointData();
    return Vec3(arrays->GetArray(names::Torque)->GetTuple3(frame)).norm();
  };
  const double along = torque(30);
  EXPECT_EQ(errors.Text, "");
  pipeline.Filter->RemoveAllAir();
  EXPECT_LT(along, 1e-3 * torque(30));
}

TEST(RotationRefineFilter, AirWithoutVelocityIsRefused)
{
  Pipeline pipeline;
  vtkNew<vtkImageData> force;
  MakeEvenWind(force, names::Wind, { 1.0, 0.0, 0.0 });
  pipeline.Filter->SetInputDataObject(6, force);
  ErrorLog errors(pipeline.Filter);
  pipeline.Filter->Update();
  EXPECT_TRUE(errors.Contains("Air: expected the point data array `Velocity` of 3 components"))
    << errors.Text;
  EXPECT_EQ(pipeline.Filter->GetOutput(1)->GetNumberOfPoints(), 0);
}

TEST(RotationRefineFilter, PosesAndMeshesAgree)
{
  Pipeline pipeline;
  ErrorLog errors(pipeline.Filter);
  vtkPolyData* meshes = pipeline.Meshes(25);
  EXPECT_EQ(errors.Text, "");
  std::vector<Track> tracks;
  std::vector<PoseTrack> poses;
  ASSERT_TRUE(PosesFromPolyData(pipeline.Filter->GetOutput(1), tracks, poses));
  ASSERT_EQ(tracks.size(), 3u);
  ASSERT_EQ(poses[0].Orientations.size(), static_cast<std::size_t>(Frames));
  vtkPointData* arrays = pipeline.Filter->GetOutput(1)->GetPointData();
  for (const char* name : { names::Velocity, names::AngularVelocity, names::Torque })
  {
    ASSERT_TRUE(arrays->HasArray(name)) << name;
  }
  ASSERT_EQ(meshes->GetNumberOfPoints(), 36);
  ASSERT_TRUE(meshes->GetPointData()->GetTCoords());
  ASSERT_TRUE(meshes->GetPointData()->GetNormals());
  EXPECT_EQ(meshes->GetCellData()->GetArray(names::ObjectId)->GetTuple1(12), 5);
  EXPECT_EQ(meshes->GetCellData()->GetArray(names::ShapeId)->GetTuple1(12), 1);
  for (std::size_t t = 0; t < 3; ++t)
  {
    for (std::size_t i = 0; i < 12; ++i)
    {
      const Vec3 expected =
        tracks[t].Positions[25] + poses[t].Orientations[25] * pipeline.Shapes[t % 2].Mesh.Points[i];
      const Vec3 found(meshes->GetPoint(static_cast<vtkIdType>(12 * t + i)));
      EXPECT_LT((found - expected).norm(), 1e-12);
    }
  }
  for (std::size_t k = 40; k < Frames; ++k)
  {
    EXPECT_EQ(poses[0].Orientations[k].coeffs(), poses[0].Orientations[40].coeffs());
    EXPECT_EQ(poses[0].AngularVelocities[k].norm(), 0.0);
  }
}

TEST(RotationRefineFilter, OrientationRowsAreReported)
{
  Pipeline pipeline;
  Constraint met;
  met.ObjectId = 5;
  met.Row = 2;
  met.Frame = 20;
  met.Kind = ConstraintKind::Orientation;
  Constraint missed = met; // half a turn in a frame
  missed.Row = 3;
  missed.Frame = 21;
  missed.Orientation = Quat(0.0, 1.0, 0.0, 0.0);
  ConstraintsToPolyData({ met, missed }, pipeline.Info, pipeline.RowData);
  pipeline.Filter->Update();
  auto* report = vtkTable::SafeDownCast(pipeline.Filter->GetOutputDataObject(2));
  ASSERT_EQ(report->GetNumberOfRows(), 2);
  EXPECT_EQ(report->GetValueByName(0, "Status").ToString(), "met");
  EXPECT_EQ(report->GetValueByName(0, "Row").ToInt(), 2);
  EXPECT_LT(report->GetValueByName(0, "Residual").ToDouble(), 1e-9);
  EXPECT_EQ(report->GetValueByName(1, "Status").ToString(), "unreachable");
  EXPECT_NEAR(report->GetValueByName(1, "Residual").ToDouble(), std::acos(-1.0) - 2.0, 1e-6);
}

TEST(RotationRefineFilter, PlayingComputesOnceAndOrderDoesNotMatter)
{
  Pipeline pipeline;
  EXPECT_EQ(TimeSteps(pipeline.Filter).size(), static_cast<std::size_t>(Frames));
  vtkNew<vtkPolyData> early;
  early->DeepCopy(pipeline.Meshes(7));
  const WorkCount work(pipeline.Filter);
  for (int k = Frames - 1; k >= 0; --k)
  {
    pipeline.Meshes(k);
  }
  EXPECT_EQ(work.Value, 0);
  vtkPolyData* again = pipeline.Meshes(7);
  for (vtkIdType i = 0; i < early->GetNumberOfPoints(); ++i)
  {
    EXPECT_EQ(Vec3(early->GetPoint(i)), Vec3(again->GetPoint(i)));
  }
  pipeline.Filter->SetDamping(3.0);
  vtkPolyData* damped = pipeline.Meshes(7);
  EXPECT_GT(work.Value, 0);
  double moved = 0.0;
  for (vtkIdType i = 0; i < early->GetNumberOfPoints(); ++i)
  {
    moved = std::max(moved, (Vec3(early->GetPoint(i)) - Vec3(damped->GetPoint(i))).norm());
  }
  EXPECT_GT(moved, 1e-6);
}

TEST(RotationRefineFilter, ErrorsNameTheArrayAndLeaveNothing)
{
  Pipeline pipeline;
  pipeline.TrackData->GetCellData()->RemoveArray(names::ObjectId);
  ErrorLog errors(pipeline.Filter);
  pipeline.Filter->Update();
  EXPECT_TRUE(errors.Contains("ObjectId")) << errors.Text;
  EXPECT_EQ(pipeline.Filter->GetOutput(0)->GetNumberOfPoints(), 0);
  EXPECT_EQ(pipeline.Filter->GetOutput(1)->GetNumberOfPoints(), 0);
}

TEST(RotationRefineFilter, InputsThatAreEmptyOrOfAnotherSceneAreNamed)
{
  Pipeline pipeline;
  ErrorLog errors(pipeline.Filter);
  const auto expect = [&](const std::string& words)
  {
    pipeline.Filter->Update();
    EXPECT_TRUE(errors.Contains(words)) << errors.Text;
    EXPECT_EQ(pipeline.Filter->GetOutput(1)->GetNumberOfPoints(), 0);
    errors.Text.clear();
  };
  const vtkNew<vtkMultiBlockDataSet> noShapes, oneShape;
  pipeline.Producers[2]->SetOutput(noShapes);
  expect("Shapes: no shapes: expected a block (vtkPolyData) for each ShapeId of Objects");
  oneShape->SetBlock(0, pipeline.ShapeData->GetBlock(0));
  pipeline.Producers[2]->SetOutput(oneShape);
  expect("Tracks: object 5: expected an object of this id and its shape, found its ShapeId 1, "
         "where Shapes has 0 to 0");
  pipeline.Producers[2]->SetOutput(pipeline.ShapeData);
  vtkNew<vtkPolyData> others, pointsAlone;
  others->DeepCopy(pipeline.TrackData);
  vtkDataArray* ids = others->GetCellData()->GetArray(names::ObjectId);
  ids->SetComponent(2, 0, 99);
  pipeline.Producers[0]->SetOutput(others);
  expect("Tracks: object 99: expected an object of this id and its shape, found no such object in "
         "Objects");
  const vtkNew<vtkPolyData> none;
  pipeline.Producers[0]->SetOutput(none);
  expect("Tracks: no objects: expected at least one line, the path of an object, found empty data");
  pointsAlone->SetPoints(pipeline.TrackData->GetPoints());
  pipeline.Producers[0]->SetOutput(pointsAlone);
  expect("Tracks: no objects: expected at least one line, the path of an object, found points");
}

TEST(RotationRefineFilter, AbortLeavesNothingAndTheNextRunIsWhole)
{
  Pipeline pipeline;
  {
    const AbortBeyond stop(pipeline.Filter);
    pipeline.Filter->Update();
  }
  EXPECT_EQ(pipeline.Filter->GetOutput(1)->GetNumberOfPoints(), 0);
  pipeline.Filter->Modified();
  pipeline.Filter->Update();
  EXPECT_EQ(pipeline.Filter->GetOutput(1)->GetNumberOfPoints(), 3 * Frames);
}

TEST(MotionAnimationWriter, ParaViewsReaderSeesTheSamePoses)
{
  Pipeline pipeline;
  const test::TemporaryFolder folder;
  const std::string path = folder.File("animation.glb");
  vtkNew<vtkMotionAnimationWriter> writer;
  writer->SetInputConnection(0, pipeline.Filter->GetOutputPort(1));
  writer->SetInputConnection(1, pipeline.Producers[1]->GetOutputPort());
  writer->SetInputConnection(2, pipeline.Producers[2]->GetOutputPort());
  writer->Update();
  EXPECT_FALSE(std::filesystem::exists(path));
  writer->SetFileName(path);
  ASSERT_TRUE(writer->Write());
  EXPECT_TRUE(writer->Write()) << "its own";

  vtkNew<vtkGLTFReader> reader;
  reader->SetFileName(path.c_str());
  reader->SetFrameRate(30);
  reader->ApplyDeformationsToGeometryOn();
  reader->UpdateInformation();
  ASSERT_EQ(reader->GetNumberOfAnimations(), 1);
  EXPECT_NEAR(reader->GetAnimationDuration(0), (Frames - 1) / 30.0, 1e-4);
  reader->EnableAnimation(0);
  for (const int frame : { 0, 17, 33, Frames - 1 })
  {
    reader->UpdateInformation();
    reader->UpdateTimeStep(pipeline.Info.Time.Time(frame));
    vtkPolyData* meshes = pipeline.Meshes(frame);
    std::vector<vtkPolyData*> found;
    std::vector<vtkDataObject*> open{ reader->GetOutput() };
    while (!open.empty())
    {
      vtkDataObject* data = open.back();
      open.pop_back();
      if (auto* blocks = vtkMultiBlockDataSet::SafeDownCast(data))
      {
        for (unsigned int i = blocks->GetNumberOfBlocks(); i-- > 0;)
        {
          open.push_back(blocks->GetBlock(i));
        }
      }
      else if (auto* surface = vtkPolyData::SafeDownCast(data))
      {
        found.push_back(surface);
      }
    }
    ASSERT_EQ(found.size(), 3u);
    for (std::size_t t = 0; t < 3; ++t)
    {
      ASSERT_EQ(found[t]->GetNumberOfPoints(), 12);
      for (vtkIdType i = 0; i < 12; ++i)
      {
        const Vec3 x(meshes->GetPoint(static_cast<vtkIdType>(12 * t) + i));
        const Vec3 y(found[t]->GetPoint(i));
        EXPECT_LT((y - Vec3(x.x(), x.z(), -x.y())).norm(), 1e-4) << "frame " << frame;
      }
    }
  }
}

TEST(MotionAnimationWriter, CsvAndErrors)
{
  Pipeline pipeline;
  vtkNew<vtkMotionAnimationWriter> writer;
  writer->SetInputConnection(0, pipeline.Filter->GetOutputPort(1));
  writer->SetInputConnection(1, pipeline.Producers[1]->GetOutputPort());
  writer->SetInputConnection(2, pipeline.Producers[2]->GetOutputPort());
  const test::TemporaryFolder folder;
  const std::string path = folder.File("poses.csv");
  writer->SetFileName(path);
  ASSERT_TRUE(writer->Write());
  std::ifstream file(path);
  std::string line;
  int lines = 0;
  while (std::getline(file, line))
  {
    ++lines;
  }
  EXPECT_EQ(lines, 1 + 3 * Frames);
  EXPECT_TRUE(writer->Write()) << "its own";
  ErrorLog errors(writer);
  for (const char* name : { "own.csv", "own.glb" })
  {
    const std::string own = folder.Write(name, "of another program");
    writer->SetFileName(own);
    EXPECT_FALSE(writer->Write());
    EXPECT_TRUE(errors.Contains(own + ": nothing was written")) << errors.Text;
    EXPECT_EQ(std::filesystem::file_size(own), 18u);
  }
  writer->SetFileName("animation.txt");
  EXPECT_FALSE(writer->Write());
  EXPECT_TRUE(errors.Contains(".glb or .csv")) << errors.Text;
  errors.Text.clear();
  writer->SetFileName("/no/such/folder/a.glb");
  EXPECT_FALSE(writer->Write());
  EXPECT_TRUE(errors.Contains("/no/such/folder/a.glb")) << errors.Text;
}

TEST(MotionAnimationWriter, InputsThatAreEmptyOrOfAnotherSceneAreNamed)
{
  Pipeline pipeline;
  pipeline.Filter->Update();
  vtkNew<vtkPolyData> poses;
  poses->DeepCopy(pipeline.Filter->GetOutput(1));
  const test::TemporaryFolder folder;
  const auto expect =
    [&](vtkPolyData* given, vtkMultiBlockDataSet* shapes, const char* file, const char* words)
  {
    vtkNew<vtkMotionAnimationWriter> writer;
    writer->SetInputDataObject(0, given);
    writer->SetInputDataObject(1, pipeline.ObjectData);
    writer->SetInputDataObject(2, shapes);
    const std::string path = folder.File(file);
    writer->SetFileName(path);
    ErrorLog errors(writer);
    EXPECT_FALSE(writer->Write());
    EXPECT_TRUE(errors.Contains(words)) << errors.Text;
    EXPECT_FALSE(std::filesystem::exists(path));
  };
  const vtkNew<vtkPolyData> none;
  const vtkNew<vtkMultiBlockDataSet> noShapes, oneShape;
  oneShape->SetBlock(0, pipeline.ShapeData->GetBlock(0));
  expect(none, pipeline.ShapeData, "poses.csv", "Poses: no objects: expected at least one line");
  expect(none, pipeline.ShapeData, "a.glb", "Poses: no objects: expected at least one line");
  expect(pipeline.TrackData, pipeline.ShapeData, "a.glb", "Poses: ");
  expect(poses, noShapes, "a.glb", "Shapes: no shapes: expected a block (vtkPolyData)");
  expect(poses, oneShape, "a.glb",
         "Poses: object 5: expected an object of this id and its shape, found its ShapeId 1");
  poses->GetCellData()->GetArray(names::ObjectId)->SetComponent(0, 0, 99);
  expect(poses, pipeline.ShapeData, "a.glb", "found no such object in Objects");
}
