// SPDX-License-Identifier: BSD-3-Clause
// A scene that goes through the writer and the reader is the same scene.
#include "JsonFiles.h"
#include "PipelineTesting.h"
#include "SceneSources.h"

#include "Base/TemporaryFolder.h"
#include "Bridge/Data/ShapeData.h"
#include "Bridge/Files/SceneFiles.h"

#include <vtkAppendPolyData.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkConstraintSource.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkLeafShapeSource.h>
#include <vtkMotionSceneFileWriter.h>
#include <vtkMotionSceneReader.h>
#include <vtkMotionSceneWriter.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkObjectSource.h>
#include <vtkPassInputTypeAlgorithm.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkShapeKeyframeSource.h>
#include <vtkStringArray.h>
#include <vtkStylisticPlannerFilter.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkXMLMultiBlockDataReader.h>
#include <vtkXMLMultiBlockDataWriter.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

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
  std::set<std::string> ofFields = passedOver;
  ofFields.insert("Authored"); // compared as files
  ExpectSameArrays(a->GetFieldData(), b->GetFieldData(), ofFields, 0.0);
}

// Takes away what says how its input was authored.
class Unauthored : public vtkPassInputTypeAlgorithm
{
public:
  static Unauthored* New();
  vtkTypeMacro(Unauthored, vtkPassInputTypeAlgorithm);

protected:
  int RequestData(vtkInformation*, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override
  {
    vtkDataObject* output = vtkDataObject::GetData(outputs);
    output->ShallowCopy(vtkDataObject::GetData(inputs[0]));
    output->GetFieldData()->RemoveArray("Authored");
    if (auto* blocks = vtkMultiBlockDataSet::SafeDownCast(output))
    {
      for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
      {
        vtkNew<vtkPolyData> block;
        block->ShallowCopy(blocks->GetBlock(i));
        block->GetFieldData()->RemoveArray("Authored");
        blocks->SetBlock(i, block);
      }
    }
    return 1;
  }
};
vtkStandardNewMacro(Unauthored);

// A wind that was edited: it still has the words of another scene.
class WithWords : public vtkPassInputTypeAlgorithm
{
public:
  static WithWords* New();
  vtkTypeMacro(WithWords, vtkPassInputTypeAlgorithm);
  vtkMotionSceneReader* Words = nullptr;

protected:
  int RequestData(vtkInformation*, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override
  {
    this->Words->Update(vtkMotionSceneReader::WIND);
    vtkDataObject* output = vtkDataObject::GetData(outputs);
    output->ShallowCopy(vtkDataObject::GetData(inputs[0]));
    output->GetFieldData()->AddArray(this->Words->GetOutputDataObject(vtkMotionSceneReader::WIND)
                                       ->GetFieldData()
                                       ->GetAbstractArray("Authored"));
    return 1;
  }
};
vtkStandardNewMacro(WithWords);

// Everything that the reader has, without how it was authored.
void ConnectUnauthored(vtkMotionSceneReader* reader, vtkMotionSceneWriter* writer)
{
  for (int port = 0; port <= vtkMotionSceneReader::WIND; ++port)
  {
    vtkNew<Unauthored> between;
    between->SetInputConnection(reader->GetOutputPort(port));
    writer->SetInputConnection(port, between->GetOutputPort());
  }
}

vtkPolyData* Poly(vtkAlgorithm* stage, int port)
{
  return vtkPolyData::SafeDownCast(stage->GetOutputDataObject(port));
}

void ExpectSameScene(vtkMotionSceneReader* a, vtkMotionSceneReader* b, double time = 0.0,
                     double tolerance = 0.0, const std::set<std::string>& passedOver = {})
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
                      vtkPolyData::SafeDownCast(others->GetBlock(i)), passedOver);
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

TEST(MotionSceneWriter, TheScenesOfTheProjectAreWrittenAsTheyWere)
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
    ExpectSameFields(entry.path(), entry.path().parent_path(), folder.File("copy.waft.json"),
                     folder.Path());
    vtkNew<vtkMotionSceneReader> copy;
    copy->SetFileName(folder.File("copy.waft.json"));
    ExpectSameScene(reader, copy);
    ++count;
  }
  EXPECT_GE(count, 15);
  EXPECT_EQ(folder.Names(), std::vector<std::string>{ "copy.waft.json" }) << "nothing beside it";
}

// By ParaView's own writers and readers, without the scene file.
TEST(MotionSceneWriter, WhatWasAuthoredSurvivesFilesOfVtk)
{
  waft::test::TemporaryFolder folder;
  for (const char* name : { "leaves-letters.waft.json", "scraps-doorway.waft.json" })
  {
    SCOPED_TRACE(name);
    vtkNew<vtkMotionSceneReader> reader;
    reader->SetFileName(SceneFile(name));
    vtkNew<vtkMotionSceneWriter> writer;
    for (const int port : { vtkMotionSceneReader::OBJECTS, vtkMotionSceneReader::CONSTRAINTS,
                            vtkMotionSceneReader::OBSTACLES, vtkMotionSceneReader::VORTICES })
    {
      const std::string file = folder.File(std::to_string(port) + ".vtp");
      vtkNew<vtkXMLPolyDataWriter> saver;
      saver->SetInputConnection(reader->GetOutputPort(port));
      saver->SetFileName(file.c_str());
      saver->SetDataModeToBinary(); // which any Expat reads
      ASSERT_TRUE(saver->Write());
      vtkNew<vtkXMLPolyDataReader> loader;
      loader->SetFileName(file.c_str());
      writer->SetInputConnection(port, loader->GetOutputPort());
    }
    vtkNew<vtkXMLMultiBlockDataWriter> saver;
    saver->SetInputConnection(reader->GetOutputPort(vtkMotionSceneReader::SHAPES));
    saver->SetFileName(folder.File("shapes.vtm").c_str());
    saver->SetDataModeToBinary();
    ASSERT_TRUE(saver->Write());
    vtkNew<vtkXMLMultiBlockDataReader> loader;
    loader->SetFileName(folder.File("shapes.vtm").c_str());
    writer->SetInputConnection(vtkMotionSceneReader::SHAPES, loader->GetOutputPort());
    writer->SetFileName(folder.File("copy.waft.json"));
    ErrorLog errors(writer);
    ASSERT_TRUE(writer->Write()) << errors.Text;
    ExpectSameFields(SceneFile(name), std::string(WAFT_SOURCE_DIR) + "/Data/Scenes",
                     folder.File("copy.waft.json"), folder.Path());
  }
}

TEST(MotionSceneWriter, AnObstacleMovedInParaViewIsWrittenWhereItIs)
{
  waft::test::TemporaryFolder folder;
  vtkNew<vtkMotionSceneReader> reader;
  reader->SetFileName(SceneFile("scraps-doorway.waft.json"));
  vtkNew<vtkTransform> shift;
  shift->Translate(0.0, 0.0, -0.25);
  vtkNew<vtkTransformPolyDataFilter> moved;
  moved->SetTransform(shift);
  moved->SetInputConnection(reader->GetOutputPort(vtkMotionSceneReader::OBSTACLES));
  vtkNew<vtkMotionSceneWriter> writer;
  Connect(reader, writer);
  writer->SetInputConnection(vtkMotionSceneReader::OBSTACLES, moved->GetOutputPort());
  writer->SetFileName(folder.File("copy.waft.json"));
  ErrorLog errors(writer);
  ASSERT_TRUE(writer->Write()) << errors.Text;
  const std::string file = folder.File("copy.waft.json");
  EXPECT_NO_THROW(JsonAt(file, "/obstacles/3")) << "the ground moved, too";
  EXPECT_ANY_THROW(JsonAt(file, "/obstacles/4"));
  EXPECT_EQ(JsonAt(file, "/obstacles/0/file"), "\"copy.obstacle-0.vtp\"");
  EXPECT_EQ(JsonAt(file, "/ground/enabled"), "false");
  EXPECT_EQ(JsonAt(file, "/constraints"),
            JsonAt(SceneFile("scraps-doorway.waft.json"), "/constraints"));
  vtkNew<vtkMotionSceneReader> copy;
  copy->SetFileName(folder.File("copy.waft.json"));
  copy->Update();
  ExpectSameSurface(moved->GetOutput(), Poly(copy, vtkMotionSceneReader::OBSTACLES), {}, 1e-12);
}

TEST(MotionSceneWriter, FilesOfOthersStayAsTheyAre)
{
  waft::test::TemporaryFolder folder;
  const auto content = [&](const std::string& name)
  {
    std::ifstream stream(folder.File(name), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  folder.Write("body.obj", Tetrahedron);
  vtkNew<vtkMotionSceneReader> reader;
  reader->SetFileName(folder.Write("a.waft.json", R"({"waft": 1,
    "shapes": {"own": {"mesh": "body.obj", "size": 0.2}},
    "objects": [{"shape": "own", "position": [0, 0, 3]}],
    "obstacles": [{"kind": "sphere", "center": [1, 0, 1], "radius": 0.2}]})"));
  vtkNew<Unauthored> stripped;
  stripped->SetInputConnection(reader->GetOutputPort(vtkMotionSceneReader::OBSTACLES));
  vtkNew<vtkMotionSceneWriter> writer;
  Connect(reader, writer);
  writer->SetInputConnection(vtkMotionSceneReader::OBSTACLES, stripped->GetOutputPort());
  writer->SetFileName(folder.File("b.waft.json"));
  ErrorLog errors(writer);
  ErrorLog warnings(writer, vtkCommand::WarningEvent);

  // Its own files are replaced, again and again.
  ASSERT_TRUE(writer->Write()) << errors.Text;
  ASSERT_TRUE(writer->Write()) << errors.Text;
  EXPECT_EQ(warnings.Text, "");
  const std::vector<std::string> names = { "a.waft.json", "b.obstacle-0.vtp", "b.obstacle-1.vtp",
                                           "b.waft.json", "body.obj" };
  EXPECT_EQ(folder.Names(), names);

  // One that somebody changed since, or made, is not.
  std::ofstream(folder.File("b.obstacle-1.vtp"), std::ios::app) << "\n";
  const std::string changed = content("b.obstacle-1.vtp");
  folder.Write("b-2.obstacle-0.vtp", "another's");
  ASSERT_TRUE(writer->Write()) << errors.Text;
  EXPECT_TRUE(warnings.Contains("b.obstacle-1.vtp\" is left alone")) << warnings.Text;
  EXPECT_TRUE(warnings.Contains("called b-3.*")) << warnings.Text;
  EXPECT_EQ(content("b.obstacle-1.vtp"), changed);
  EXPECT_EQ(content("b-2.obstacle-0.vtp"), "another's");
  EXPECT_EQ(JsonAt(folder.File("b.waft.json"), "/obstacles/0/file"), "\"b-3.obstacle-0.vtp\"");

  // Nor is one that the scene names: both obstacles are of it, one was moved since.
  vtkNew<vtkMotionSceneReader> both;
  both->SetFileName(folder.Write("c.waft.json", R"({"waft": 1, "ground": {"enabled": false},
    "obstacles": [{"kind": "mesh", "file": "b.obstacle-0.vtp"},
      {"kind": "mesh", "file": "b.obstacle-0.vtp", "position": [-2, 0, 0]}]})"));
  vtkNew<vtkMotionSceneWriter> second;
  Connect(both, second);
  both->Update();
  vtkNew<vtkPolyData> edited;
  edited->DeepCopy(Poly(both, vtkMotionSceneReader::OBSTACLES));
  for (vtkIdType i = 0; i < edited->GetNumberOfPoints() / 2; ++i)
  {
    double x[3];
    edited->GetPoint(i, x);
    edited->GetPoints()->SetPoint(i, x[0], x[1], x[2] + 0.125);
  }
  second->SetInputDataObject(vtkMotionSceneReader::OBSTACLES, edited);
  second->SetFileName(folder.File("b.waft.json"));
  const std::string named = content("b.obstacle-0.vtp");
  ErrorLog remarks(second, vtkCommand::WarningEvent);
  ASSERT_TRUE(second->Write());
  EXPECT_TRUE(remarks.Contains("called b-2.*") || remarks.Contains("called b-3.*")) << remarks.Text;
  EXPECT_EQ(content("b.obstacle-0.vtp"), named);

  // A name that the user gives the scene is a scene's, or free.
  errors.Text.clear();
  writer->SetFileName(folder.Write("package.json", "{\"name\": \"mine\"}"));
  EXPECT_FALSE(writer->Write());
  EXPECT_TRUE(errors.Contains("expected a new name or a scene file")) << errors.Text;
  EXPECT_EQ(content("package.json"), "{\"name\": \"mine\"}");
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
  vtkNew<vtkMotionSceneWriter> faithful;
  Connect(reader, faithful);
  faithful->SetFileName(folder.File("out/a.waft.json"));
  ASSERT_TRUE(faithful->Write());
  ExpectSameFields(folder.File("a.waft.json"), folder.Path(), folder.File("out/a.waft.json"),
                   folder.File("out"));
  vtkNew<vtkMotionSceneWriter> writer;
  ConnectUnauthored(reader, writer);
  writer->SetTitle("Meshes");
  writer->SetFileName(folder.File("out/b.waft.json"));
  ErrorLog errors(writer);
  ASSERT_TRUE(writer->Write()) << errors.Text;
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder.File("out")))
  {
    files.insert(entry.path().filename().string());
  }
  EXPECT_EQ(files,
            (std::set<std::string>{ "a.waft.json", "b.waft.json", "b.shape-leaf.vtp",
                                    "b.shape-own.vtp", "b.obstacle-0.vtp", "b.obstacle-1.vtp",
                                    "b.obstacle-2.vtp", "b.wind", "b.wind.pvd" }));
  vtkNew<vtkMotionSceneReader> copy;
  copy->SetFileName(folder.File("out/b.waft.json"));
  for (const double time : { 0.0, 0.5, 1.3 })
  {
    SCOPED_TRACE(time);
    // A body in a file has no words for what is not seen.
    ExpectSameScene(reader, copy, time, 1e-14, { "Tint", "Damping" });
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

// A wind that somebody edited is a field; one that nobody did keeps its words.
TEST(MotionSceneWriter, AWindIsWrittenAsItWasUnlessItWasEdited)
{
  waft::test::TemporaryFolder folder;
  vtkNew<vtkMotionSceneReader> reader;
  reader->SetFileName(SceneFile("leaves-disturbed.waft.json"));
  vtkNew<vtkMotionSceneReader> other;
  other->SetFileName(folder.Write("other.waft.json", R"({"waft": 1, "winds": [
    {"direction": [0.3, 0.2, 1.0], "strength": 1.3, "center": [0, 0, 0.4], "radius": 1.4,
     "centerTime": 4.3, "duration": 0.5}]})"));
  vtkNew<WithWords> edited; // the words of the one with the field of the other
  edited->SetInputConnection(0, other->GetOutputPort(vtkMotionSceneReader::WIND));
  edited->Words = reader;
  vtkNew<vtkMotionSceneWriter> writer;
  Connect(reader, writer);
  writer->SetInputConnection(vtkMotionSceneReader::WIND, edited->GetOutputPort());
  writer->SetFileName(folder.File("copy.waft.json"));
  ErrorLog errors(writer);
  ASSERT_TRUE(writer->Write()) << errors.Text;
  EXPECT_EQ(JsonAt(folder.File("copy.waft.json"), "/winds"), R"([{"file":"copy.wind.pvd"}])");
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
  vtkNew<vtkLeafShapeSource> leaf;
  leaf->SetTextureSize(32);
  writer->SetInputConnection(vtkMotionSceneReader::SHAPES, leaf->GetOutputPort());
  writer->SetFileName(folder.File("hand.waft.json"));
  ErrorLog errors(writer);
  ASSERT_TRUE(writer->Write()) << errors.Text;
  ASSERT_TRUE(writer->Write()) << errors.Text; // over its own files
  EXPECT_EQ(folder.Names().size(), 3u);
  vtkNew<vtkMotionSceneReader> copy;
  copy->SetFileName(folder.File("hand.waft.json"));
  ErrorLog reading(copy);
  copy->Update();
  EXPECT_EQ(reading.Text, "");
  std::vector<waft::Shape> shapes;
  ASSERT_TRUE(waft::ShapesFromMultiBlock(
    vtkMultiBlockDataSet::SafeDownCast(copy->GetOutputDataObject(vtkMotionSceneReader::SHAPES)),
    shapes));
  ASSERT_EQ(shapes.size(), 1u);
  EXPECT_EQ(shapes[0].Texture, folder.File("hand.shape-leaf.png"));
  waft::Picture skin;
  EXPECT_EQ(waft::LoadPictureOf(shapes[0], skin).Message(), "");
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
  const std::string before = R"({"waft": 1, "title": "what stood there"})";
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
