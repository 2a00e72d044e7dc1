// SPDX-License-Identifier: BSD-3-Clause
// A scene that goes through the writer and the reader is the same scene.
#include "PipelineTesting.h"
#include "SceneSources.h"

#include "Base/TemporaryFolder.h"

#include <vtkAppendPolyData.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkConstraintSource.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMotionSceneFileWriter.h>
#include <vtkMotionSceneReader.h>
#include <vtkMotionSceneWriter.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkShapeKeyframeSource.h>
#include <vtkStringArray.h>
#include <vtkStylisticPlannerFilter.h>
#include <vtkXMLMultiBlockDataReader.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>

namespace
{

void Connect(vtkMotionSceneReader* reader, vtkMotionSceneWriter* writer)
{
  for (int port = 0; port <= vtkMotionSceneReader::WIND; ++port)
  {
    writer->SetInputConnection(port, reader->GetOutputPort(port));
  }
}

void ExpectSameArrays(vtkFieldData* a, vtkFieldData* b, const std::set<std::string>& passedOver,
                      double tolerance)
{
  for (int i = 0; i < a->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* one = a->GetAbstractArray(i);
    const std::string name = one->GetName() ? one->GetName() : "";
    if (passedOver.count(name) > 0)
    {
      continue;
    }
    SCOPED_TRACE("array " + name);
    vtkAbstractArray* other = b->GetAbstractArray(name.c_str());
    ASSERT_TRUE(other);
    ASSERT_EQ(one->GetNumberOfValues(), other->GetNumberOfValues());
    for (vtkIdType k = 0; k < one->GetNumberOfValues(); ++k)
    {
      if (vtkStringArray::SafeDownCast(one))
      {
        EXPECT_EQ(one->GetVariantValue(k).ToString(), other->GetVariantValue(k).ToString());
        continue;
      }
      const double x = one->GetVariantValue(k).ToDouble();
      const double y = other->GetVariantValue(k).ToDouble();
      ASSERT_TRUE(x == y || std::abs(x - y) <= tolerance) << k << ": " << x << " and " << y;
    }
  }
}

void ExpectSameSurface(vtkPolyData* a, vtkPolyData* b, const std::set<std::string>& passedOver = {},
                       double tolerance = 0.0)
{
  ASSERT_EQ(a->GetNumberOfPoints(), b->GetNumberOfPoints());
  for (vtkIdType i = 0; i < a->GetNumberOfPoints(); ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_LE(std::abs(a->GetPoint(i)[c] - b->GetPoint(i)[c]), tolerance);
    }
  }
  ASSERT_EQ(a->GetNumberOfCells(), b->GetNumberOfCells());
  vtkNew<vtkIdList> ofA, ofB;
  for (vtkIdType cell = 0; cell < a->GetNumberOfCells(); ++cell)
  {
    a->GetCellPoints(cell, ofA);
    b->GetCellPoints(cell, ofB);
    ASSERT_EQ(ofA->GetNumberOfIds(), ofB->GetNumberOfIds());
    for (vtkIdType k = 0; k < ofA->GetNumberOfIds(); ++k)
    {
      ASSERT_EQ(ofA->GetId(k), ofB->GetId(k));
    }
  }
  ExpectSameArrays(a->GetPointData(), b->GetPointData(), passedOver, 0.0);
  ExpectSameArrays(a->GetCellData(), b->GetCellData(), passedOver, 0.0);
  ExpectSameArrays(a->GetFieldData(), b->GetFieldData(), passedOver, 0.0);
}

vtkPolyData* Poly(vtkAlgorithm* stage, int port)
{
  return vtkPolyData::SafeDownCast(stage->GetOutputDataObject(port));
}

void ExpectSameScene(vtkMotionSceneReader* a, vtkMotionSceneReader* b, double time = 0.0,
                     double tolerance = 0.0)
{
  for (vtkMotionSceneReader* reader : { a, b })
  {
    reader->UpdateInformation();
    for (const int port : { vtkMotionSceneReader::OBJECTS, vtkMotionSceneReader::OBSTACLES,
                            vtkMotionSceneReader::WIND })
    {
      reader->GetOutputInformation(port)->Set(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(),
                                              time);
      reader->Update(port);
    }
  }
  for (const int port : { vtkMotionSceneReader::OBJECTS, vtkMotionSceneReader::CONSTRAINTS,
                          vtkMotionSceneReader::OBSTACLES, vtkMotionSceneReader::VORTICES })
  {
    SCOPED_TRACE("port " + std::to_string(port));
    ExpectSameSurface(Poly(a, port), Poly(b, port), {}, tolerance);
  }
  auto* shapes =
    vtkMultiBlockDataSet::SafeDownCast(a->GetOutputDataObject(vtkMotionSceneReader::SHAPES));
  auto* others =
    vtkMultiBlockDataSet::SafeDownCast(b->GetOutputDataObject(vtkMotionSceneReader::SHAPES));
  ASSERT_EQ(shapes->GetNumberOfBlocks(), others->GetNumberOfBlocks());
  for (unsigned int i = 0; i < shapes->GetNumberOfBlocks(); ++i)
  {
    SCOPED_TRACE("shape " + std::to_string(i));
    ExpectSameSurface(vtkPolyData::SafeDownCast(shapes->GetBlock(i)),
                      vtkPolyData::SafeDownCast(others->GetBlock(i)));
  }
  auto* wind = vtkImageData::SafeDownCast(a->GetOutputDataObject(vtkMotionSceneReader::WIND));
  auto* other = vtkImageData::SafeDownCast(b->GetOutputDataObject(vtkMotionSceneReader::WIND));
  ASSERT_EQ(wind->GetNumberOfPoints(), other->GetNumberOfPoints());
  ExpectSameArrays(wind->GetPointData(), other->GetPointData(), {}, 1e-12);
}

// The paths that the planner finds, byte for byte.
std::string PlanOf(vtkMotionSceneReader* reader)
{
  vtkNew<vtkXMLMultiBlockDataReader> database;
  database->SetFileName(WAFT_SOURCE_DIR "/Data/Database/embedded.vtm");
  vtkNew<vtkStylisticPlannerFilter> planner;
  planner->SetInputConnection(0, database->GetOutputPort());
  planner->SetInputConnection(1, reader->GetOutputPort(vtkMotionSceneReader::OBJECTS));
  planner->SetInputConnection(2, reader->GetOutputPort(vtkMotionSceneReader::CONSTRAINTS));
  planner->SetInputConnection(3, reader->GetOutputPort(vtkMotionSceneReader::OBSTACLES));
  planner->Update();
  std::ostringstream text;
  text.precision(17);
  vtkPolyData* tracks = Poly(planner, 0);
  for (vtkIdType i = 0; i < tracks->GetNumberOfPoints(); ++i)
  {
    const double* x = tracks->GetPoint(i);
    text << x[0] << ' ' << x[1] << ' ' << x[2] << '\n';
  }
  return text.str();
}

} // namespace

TEST(MotionSceneWriter, TheScenesOfTheProjectReadBackTheSame)
{
  waft::test::TemporaryFolder folder;
  int count = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(WAFT_SOURCE_DIR) + "/Data/Scenes"))
  {
    if (entry.path().extension() != ".json")
    {
      continue;
    }
    SCOPED_TRACE(entry.path());
    vtkNew<vtkMotionSceneReader> reader;
    reader->SetFileName(entry.path().string());
    vtkNew<vtkMotionSceneWriter> writer;
    Connect(reader, writer);
    writer->SetFileName(folder.File("copy.waft.json"));
    ErrorLog errors(writer);
    ASSERT_TRUE(writer->Write()) << errors.Text;
    vtkNew<vtkMotionSceneReader> copy;
    copy->SetFileName(folder.File("copy.waft.json"));
    ExpectSameScene(reader, copy);
    ++count;
  }
  EXPECT_GE(count, 4);
}

TEST(MotionSceneWriter, AWrittenSceneIsPlannedTheSame)
{
  waft::test::TemporaryFolder folder;
  for (const char* name : { "feather-waypoints.waft.json", "feather-maze.waft.json" })
  {
    SCOPED_TRACE(name);
    vtkNew<vtkMotionSceneReader> reader;
    reader->SetFileName(SceneFile(name));
    vtkNew<vtkMotionSceneWriter> writer;
    Connect(reader, writer);
    writer->SetFileName(folder.File("copy.waft.json"));
    ASSERT_TRUE(writer->Write());
    vtkNew<vtkMotionSceneReader> copy;
    copy->SetFileName(folder.File("copy.waft.json"));
    const std::string plan = PlanOf(reader);
    EXPECT_GT(plan.size(), 1000u);
    EXPECT_EQ(plan, PlanOf(copy));
  }
}

TEST(MotionSceneWriter, MeshesMotionsAndWindsGoBesideTheScene)
{
  waft::test::TemporaryFolder folder;
  folder.Write("body.obj", Tetrahedron);
  vtkNew<vtkMotionSceneReader> reader;
  reader->SetFileName(folder.Write("a.waft.json", R"({"waft": 1, "time": {"frames": 40},
    "shapes": {"own": {"mesh": "body.obj", "size": 0.3}, "leaf": {"builtin": "leaf"}},
    "objects": [{"shape": "own", "position": [0, 0, 3]}, {"shape": "leaf", "position": [1, 0, 3]}],
    "obstacles": [{"kind": "mesh", "file": "body.obj", "scale": 0.25, "position": [1.1, 0, 0.7]},
      {"kind": "box", "min": [-1, -1, 0.1], "max": [-0.3, -0.2, 0.9], "motion": [
        {"frame": 3, "position": [-0.65, -0.6, 0.5]}, {"frame": 30, "position": [-0.3, -0.5, 1.2]}]}],
    "vortices": [{"p1": [0, 0, 0], "p2": [0, 0.1, 1], "strength": 1.3, "centerTime": 0.4,
      "duration": 0.3, "coreRadius": 0.2}],
    "winds": [{"direction": [1, 0.3, 0], "strength": 1.7, "center": [0, 0, 2], "radius": 1.1,
      "centerTime": 0.5, "duration": 0.3}]})"));
  std::filesystem::create_directory(folder.File("out"));
  vtkNew<vtkMotionSceneWriter> writer;
  Connect(reader, writer);
  writer->SetTitle("Meshes");
  writer->SetFileName(folder.File("out/b.waft.json"));
  ErrorLog errors(writer);
  ASSERT_TRUE(writer->Write()) << errors.Text;
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder.File("out")))
  {
    files.insert(entry.path().filename().string());
  }
  EXPECT_EQ(files, (std::set<std::string>{ "b.waft.json", "b.shape-own.vtp", "b.obstacle-0.vtp",
                                           "b.wind", "b.wind.pvd" }));
  vtkNew<vtkMotionSceneReader> copy;
  copy->SetFileName(folder.File("out/b.waft.json"));
  for (const double time : { 0.0, 0.5, 1.3 })
  {
    SCOPED_TRACE(time);
    ExpectSameScene(reader, copy, time, 1e-14);
  }

  // Save Data of the gathered scene: another class, the same files.
  vtkNew<vtkMotionSceneFileWriter> saver;
  saver->SetInputConnection(writer->GetOutputPort());
  saver->SetFileName(folder.File("out/c.waft.json"));
  saver->Write();
  vtkNew<vtkMotionSceneReader> saved;
  saved->SetFileName(folder.File("out/c.waft.json"));
  ExpectSameScene(copy, saved, 0.5, 1e-14);
}

TEST(MotionSceneWriter, WhatIsMadeByHandReadsBack)
{
  waft::test::TemporaryFolder folder;
  vtkNew<vtkAppendPolyData> objects, rows;
  for (int k = 0; k < 3; ++k)
  {
    vtkNew<vtkObjectSource> object;
    object->SetObjectId(k == 2 ? 7 : k);
    object->SetPosition(0.3 * k, 0.1, 3.0);
    object->SetVelocity(0.0, 0.1 * k, 0.0);
    object->SetNumberOfFrames(120);
    object->SetSettlingSpeed(0.5 + 0.1 * k);
    objects->AddInputConnection(object->GetOutputPort());
  }
  vtkNew<vtkConstraintSource> way;
  way->SetNumberOfFrames(120);
  way->SetObjectId(7);
  way->SetFrame(20);
  way->SetLastFrame(60);
  way->UseWaypointsOn();
  way->SetWaypoint(0, 0.1, 0.2, 2.5);
  way->SetWaypoint(1, 0.4, 0.2, 2.1);
  vtkNew<vtkConstraintSource> speed;
  speed->SetNumberOfFrames(120);
  speed->SetKind(vtkConstraintSource::VELOCITY);
  speed->SetFrame(40);
  speed->SetValue(0.1, 0.0, -0.2);
  speed->SetRadius(0.05);
  vtkNew<vtkShapeKeyframeSource> word;
  word->SetNumberOfFrames(120);
  word->SetFrame(90);
  word->SetNumberOfTargets(3);
  for (vtkAlgorithm* source : std::initializer_list<vtkAlgorithm*>{ way, speed, word })
  {
    rows->AddInputConnection(source->GetOutputPort());
  }
  vtkNew<vtkMotionSceneWriter> writer;
  writer->SetInputConnection(vtkMotionSceneReader::OBJECTS, objects->GetOutputPort());
  writer->SetInputConnection(vtkMotionSceneReader::CONSTRAINTS, rows->GetOutputPort());
  writer->SetFileName(folder.File("hand.waft.json"));
  ErrorLog errors(writer);
  ASSERT_TRUE(writer->Write()) << errors.Text;
  vtkNew<vtkMotionSceneReader> copy;
  copy->SetFileName(folder.File("hand.waft.json"));
  ErrorLog reading(copy);
  copy->Update();
  EXPECT_EQ(reading.Text, "");
  // AppendPolyData drops field data; rows by hand have no numbers of their own yet.
  ExpectSameSurface(objects->GetOutput(), Poly(copy, vtkMotionSceneReader::OBJECTS));
  ExpectSameSurface(rows->GetOutput(), Poly(copy, vtkMotionSceneReader::CONSTRAINTS),
                    { "Row", "Group" });
  EXPECT_EQ(Poly(copy, vtkMotionSceneReader::OBSTACLES)->GetNumberOfPoints(), 0)
    << "no ground was given";
}

TEST(MotionSceneWriter, AnErrorLeavesWhatStoodThere)
{
  waft::test::TemporaryFolder folder;
  const std::string before = "what stood there";
  const std::string file = folder.Write("kept.waft.json", before);
  const auto content = [&]()
  {
    std::ifstream stream(file);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  vtkNew<vtkObjectSource> object;
  object->SetShapeId(3);
  vtkNew<vtkMotionSceneWriter> writer;
  writer->SetInputConnection(vtkMotionSceneReader::OBJECTS, object->GetOutputPort());
  writer->SetFileName(file);
  ErrorLog errors(writer);
  EXPECT_FALSE(writer->Write());
  EXPECT_TRUE(errors.Contains("object 0: `ShapeId`")) << errors.Text;
  EXPECT_EQ(content(), before);

  object->SetShapeId(0);
  errors.Text.clear();
  writer->SetFileName(folder.File("scene.txt"));
  EXPECT_FALSE(writer->Write());
  EXPECT_TRUE(errors.Contains("ending in .waft.json, found \"")) << errors.Text;
  writer->SetFileName("");
  EXPECT_FALSE(writer->Write());
  EXPECT_TRUE(errors.Contains("ending in .waft.json, found none")) << errors.Text;

  errors.Text.clear();
  writer->SetFileName("/proc/none/scene.waft.json");
  EXPECT_FALSE(writer->Write());
  EXPECT_TRUE(errors.Contains("cannot write")) << errors.Text;

  // A folder stands where a part has to go: the scene is not touched and nothing is left behind.
  vtkNew<vtkMotionSceneReader> reader;
  folder.Write("body.obj", Tetrahedron);
  reader->SetFileName(folder.Write("a.waft.json", R"({"waft": 1,
    "shapes": {"own": {"mesh": "body.obj"}}, "objects": [{"shape": "own", "position": [0, 0, 3]}]})"));
  std::filesystem::create_directory(folder.File("kept.shape-own.vtp"));
  Connect(reader, writer);
  writer->SetFileName(file);
  errors.Text.clear();
  EXPECT_FALSE(writer->Write());
  EXPECT_TRUE(errors.Contains("kept.shape-own.vtp")) << errors.Text;
  EXPECT_EQ(content(), before);
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(file).parent_path()))
  {
    EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
  }

  writer->SetFileName("");
  errors.Text.clear();
  EXPECT_FALSE(writer->Write());
  EXPECT_TRUE(errors.Contains("found none")) << errors.Text;
}

TEST(MotionSceneWriter, WritesOnceForEachChange)
{
  waft::test::TemporaryFolder folder;
  vtkNew<vtkObjectSource> object;
  vtkNew<vtkMotionSceneWriter> writer;
  writer->SetInputConnection(vtkMotionSceneReader::OBJECTS, object->GetOutputPort());
  writer->Update();
  EXPECT_TRUE(std::filesystem::is_empty(std::filesystem::path(folder.File("x")).parent_path()));
  writer->SetFileName(folder.File("a.waft.json"));
  writer->Update();
  ASSERT_TRUE(std::filesystem::remove(folder.File("a.waft.json")));
  writer->Update();
  EXPECT_FALSE(std::filesystem::exists(folder.File("a.waft.json"))) << "nothing changed";
  object->SetMass(0.002);
  writer->Update();
  EXPECT_TRUE(std::filesystem::exists(folder.File("a.waft.json")));
}
