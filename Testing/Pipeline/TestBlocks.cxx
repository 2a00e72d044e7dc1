// SPDX-License-Identifier: BSD-3-Clause
// Inputs that come in blocks: one in a group of any kind is as by itself, at every time step;
// several are put together where that means something, else refused by the input's name; and inputs
// that do not say what their scene is.
#include "PipelineTesting.h"

#include "SceneChain.h"

#include "Bridge/Data/Blocks.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/SceneData.h"

#include <vtkFieldData.h>
#include <vtkGridSmokeSource.h>
#include <vtkGroupDataSetsFilter.h>
#include <vtkMotionSceneWriter.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkTrivialProducer.h>
#include <vtkUnstructuredGrid.h>

#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>

using namespace waft;

namespace
{

// With an obstacle that moves and a wind: what stages look at over all time steps.
const char* const MovingScene =
  R"({"waft": 1, "seed": 5, "title": "Blocks", "time": {"frames": 40, "framesPerSecond": 20},
  "ground": {"enabled": false},
  "shapes": {"leaf": {"builtin": "leaf"}, "petal": {"builtin": "petal"}},
  "objects": [{"shape": "leaf", "positions": [[-0.5, 0.0, 2.1], [-0.5, 0.4, 2.2]]}],
  "constraints": [{"kind": "position", "object": 0, "frame": 39, "value": [0.3, 0.1, 1.6]}],
  "obstacles": [{"kind": "sphere", "center": [1, -1, 2], "radius": 0.2, "motion":
    [{"frame": 0, "position": [1, -1, 2]}, {"frame": 39, "position": [1, 1, 2]}]},
    {"kind": "box", "min": [-1.5, -1.5, 0.2], "max": [-1.2, -1.2, 0.6]}],
  "vortices": [{"p1": [0, 0, 1], "p2": [0, 0, 2], "strength": 0.1, "centerTime": 0.5, "duration": 0.5,
    "coreRadius": 0.2}],
  "winds": [{"direction": [1, 0, 0], "strength": 0.5, "center": [0, 0, 2], "radius": 1,
    "centerTime": 0.6, "duration": 0.5}]})";

using Ports = std::vector<vtkAlgorithmOutput*>;

/// Groups of outputs, kept for as long as it lives.
class Groups
{
public:
  vtkAlgorithmOutput* Of(int type, const Ports& members)
  {
    vtkNew<vtkGroupDataSetsFilter> group;
    group->SetOutputType(type);
    int number = 0;
    for (vtkAlgorithmOutput* member : members)
    {
      group->AddInputConnection(member);
      group->SetInputName(number, ("Block" + std::to_string(number)).c_str());
      ++number;
    }
    return this->Keep(group);
  }
  vtkAlgorithmOutput* Data(vtkDataObject* data)
  {
    vtkNew<vtkTrivialProducer> producer;
    producer->SetOutput(data);
    return this->Keep(producer);
  }
  /// One output in a group of each kind.
  std::map<std::string, vtkAlgorithmOutput*> OfEachKind(vtkAlgorithmOutput* port)
  {
    const vtkNew<vtkPolyData> empty;
    return { { "group", this->Of(VTK_MULTIBLOCK_DATA_SET, { port }) },
             { "nested",
               this->Of(VTK_MULTIBLOCK_DATA_SET, { this->Of(VTK_MULTIBLOCK_DATA_SET, { port }) }) },
             { "with an empty block",
               this->Of(VTK_MULTIBLOCK_DATA_SET, { port, this->Data(empty) }) },
             { "partitions", this->Of(VTK_PARTITIONED_DATA_SET, { port }) },
             { "collection", this->Of(VTK_PARTITIONED_DATA_SET_COLLECTION, { port }) } };
  }

private:
  vtkAlgorithmOutput* Keep(vtkAlgorithm* algorithm)
  {
    this->Kept.emplace_back(algorithm);
    return algorithm->GetOutputPort();
  }
  std::vector<vtkSmartPointer<vtkAlgorithm>> Kept;
};

/// Points and field data of all blocks, as one text.
std::string Printed(vtkDataObject* data)
{
  std::ostringstream text;
  text.precision(17);
  if (auto* blocks = vtkMultiBlockDataSet::SafeDownCast(data))
  {
    for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
    {
      text << "[" << Printed(blocks->GetBlock(i)) << "]";
    }
    return text.str();
  }
  auto* set = vtkDataSet::SafeDownCast(data);
  for (vtkIdType i = 0; set && i < set->GetNumberOfPoints(); ++i)
  {
    text << set->GetPoint(i)[0] << " " << set->GetPoint(i)[1] << " " << set->GetPoint(i)[2] << " ";
  }
  for (int a = 0; set && a < set->GetFieldData()->GetNumberOfArrays(); ++a)
  {
    vtkAbstractArray* array = set->GetFieldData()->GetAbstractArray(a);
    text << array->GetName() << ":";
    for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
    {
      text << " " << array->GetVariantValue(i).ToString();
    }
  }
  return text.str();
}

struct Blocks : testing::Test
{
  SceneChain Chain{ MovingScene };
  Groups Made;

  vtkAlgorithmOutput* Port(int what) { return this->Chain.Reader->GetOutputPort(what); }
  vtkPolyData* Data(int what)
  {
    this->Chain.Reader->Update();
    return SceneChain::Poly(this->Chain.Reader, what);
  }
};

// The scene writer takes every kind of data and gives all that it was given, moving ones whole.
const std::vector<int> OfWriter{ vtkMotionSceneReader::OBJECTS,   vtkMotionSceneReader::CONSTRAINTS,
                                 vtkMotionSceneReader::OBSTACLES, vtkMotionSceneReader::SHAPES,
                                 vtkMotionSceneReader::VORTICES,  vtkMotionSceneReader::WIND };

} // namespace

TEST_F(Blocks, OneInAGroupOfAnyKindIsAsByItself)
{
  const auto gathered = [&](const std::string& kind)
  {
    vtkNew<vtkMotionSceneWriter> writer;
    for (std::size_t port = 0; port < OfWriter.size(); ++port)
    {
      vtkAlgorithmOutput* plain = this->Port(OfWriter[port]);
      // VTK's filter makes no partitions of a list of blocks.
      const bool isList = OfWriter[port] == vtkMotionSceneReader::SHAPES;
      const std::string own = isList && !kind.empty() ? "nested" : kind;
      writer->SetInputConnection(static_cast<int>(port),
                                 own.empty() ? plain : this->Made.OfEachKind(plain).at(own));
    }
    const ErrorLog errors(writer);
    const ErrorLog warnings(writer, vtkCommand::WarningEvent);
    writer->Update();
    EXPECT_EQ(errors.Text + warnings.Text, "") << kind;
    return Printed(writer->GetOutputDataObject(0));
  };
  const std::string plain = gathered("");
  EXPECT_NE(plain.find("FramesPerSecond: 20"), std::string::npos) << plain.substr(0, 2000);
  for (const char* kind : { "group", "nested", "partitions", "collection" })
  {
    EXPECT_EQ(gathered(kind), plain) << kind;
  }
}

TEST_F(Blocks, ObstaclesInAGroupAreLookedAtOverAllTimeSteps)
{
  this->Chain.Planner->Update();
  const std::string plain = Printed(this->Chain.Planner->GetOutputDataObject(0));
  EXPECT_GT(plain.size(), 100U);
  for (const auto& [kind, port] :
       this->Made.OfEachKind(this->Port(vtkMotionSceneReader::OBSTACLES)))
  {
    this->Chain.Planner->SetInputConnection(3, port);
    const ErrorLog errors(this->Chain.Planner);
    this->Chain.Planner->Update();
    EXPECT_EQ(errors.Text, "") << kind;
    EXPECT_EQ(Printed(this->Chain.Planner->GetOutputDataObject(0)), plain) << kind;
  }
  vtkNew<vtkGridSmokeSource> smoke; // and of a stage that is no filter
  smoke->SetResolution(8, 8, 8);
  smoke->SetNumberOfFrames(5);
  smoke->SetWarmUpSeconds(0.0);
  smoke->SetNumberOfObstacles(0);
  smoke->SetInputConnection(
    1, this->Made.Of(VTK_MULTIBLOCK_DATA_SET, { this->Port(vtkMotionSceneReader::OBSTACLES) }));
  smoke->SetInputConnection(2, this->Made.Of(VTK_PARTITIONED_DATA_SET_COLLECTION,
                                             { this->Port(vtkMotionSceneReader::WIND) }));
  const ErrorLog errors(smoke);
  smoke->Update();
  EXPECT_EQ(errors.Text, "");
  EXPECT_EQ(SceneChain::Poly(smoke, 2)->GetNumberOfPoints(),
            this->Data(vtkMotionSceneReader::OBSTACLES)->GetNumberOfPoints());
}

TEST_F(Blocks, SeveralBlocksAreOneInput)
{
  vtkAlgorithmOutput* rows = this->Port(vtkMotionSceneReader::CONSTRAINTS);
  this->Chain.Planner->SetInputConnection(2,
                                          this->Made.Of(VTK_MULTIBLOCK_DATA_SET, { rows, rows }));
  this->Chain.Planner->Update();
  EXPECT_EQ(SceneChain::Poly(this->Chain.Planner, 0)->GetNumberOfLines(), 2);
}

TEST_F(Blocks, ObstaclesOfSeveralMakersKeepApart)
{
  vtkPolyData* obstacles = this->Data(vtkMotionSceneReader::OBSTACLES);
  vtkNew<vtkPolyData> nameless;
  nameless->ShallowCopy(obstacles);
  nameless->GetPointData()->RemoveArray("ObstacleId");
  vtkNew<vtkMultiBlockDataSet> group;
  group->SetBlock(0, obstacles);
  group->SetBlock(2, obstacles);
  group->SetBlock(3, nameless);
  ObstacleCollector collector;
  ASSERT_TRUE(collector.Add(group, 0.0, Timeline()));
  std::vector<int> ids;
  for (const ObstacleMesh& obstacle : collector.Take())
  {
    ids.push_back(obstacle.ObstacleId);
  }
  EXPECT_EQ(ids, (std::vector<int>{ 0, 1, 2, 3, 4, 5 }));
}

TEST_F(Blocks, MakersOfObjectsAreAppendedUnlessTheyDiffer)
{
  vtkPolyData* objects = this->Data(vtkMotionSceneReader::OBJECTS);
  const auto merged = [](vtkDataObject* data, vtkSmartPointer<vtkPolyData>& all)
  { return MergedSurface(data, "Objects", all).Message(); };
  vtkNew<vtkMultiBlockDataSet> group;
  group->SetBlock(0, objects);
  group->SetBlock(1, objects);
  vtkSmartPointer<vtkPolyData> all;
  EXPECT_EQ(merged(group, all), "");
  EXPECT_EQ(all->GetNumberOfPoints(), 4);
  EXPECT_TRUE(all->GetPointData()->HasArray("SettlingSpeed"));
  EXPECT_TRUE(all->GetFieldData()->HasArray("NumberOfFrames"));

  vtkNew<vtkPolyData> other;
  other->DeepCopy(objects);
  other->GetPointData()->RemoveArray("Mass");
  group->SetBlock(1, other);
  EXPECT_EQ(merged(group, all),
            "Objects: expected the point data array `Mass` in all blocks, found it in some");
  other->DeepCopy(objects);
  SceneInfo longer;
  longer.Time.NumberOfFrames = 90;
  SceneInfoToFieldData(longer, other);
  EXPECT_EQ(merged(group, all),
            "Objects: expected blocks of one scene, found another `NumberOfFrames` in their field "
            "data");
}

TEST_F(Blocks, WhatAPortDoesNotTakeIsRefusedByItsName)
{
  const vtkNew<vtkUnstructuredGrid> other;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.0, 0.0, 0.0);
  other->SetPoints(points);
  vtkNew<vtkMultiBlockDataSet> group;
  group->SetBlock(0, other);
  const char* const names[] = { "Database", "Objects", "Constraints", "Obstacles", "Guides" };
  for (vtkDataObject* data :
       { static_cast<vtkDataObject*>(other), static_cast<vtkDataObject*>(group) })
  {
    for (int port = 0; port < 5; ++port)
    {
      SceneChain chain(MovingScene);
      chain.Planner->SetInputConnection(port, this->Made.Data(data));
      const ErrorLog errors(chain.Planner);
      chain.Planner->Update();
      const bool isReported = errors.Contains(std::string(names[port]) + ": expected") ||
                              errors.Contains("motion database: block `Segments` is missing");
      EXPECT_TRUE(isReported) << names[port] << ": " << errors.Text;
      EXPECT_EQ(SceneChain::Poly(chain.Planner, 0)->GetNumberOfPoints(), 0) << names[port];
    }
  }
  vtkAlgorithmOutput* wind = this->Port(vtkMotionSceneReader::WIND);
  this->Chain.Spacetime->SetInputConnection(5,
                                            this->Made.Of(VTK_MULTIBLOCK_DATA_SET, { wind, wind }));
  const ErrorLog errors(this->Chain.Spacetime);
  this->Chain.Spacetime->Update();
  EXPECT_TRUE(errors.Contains("Wind: expected one data set, found 2 blocks")) << errors.Text;
}

TEST_F(Blocks, NoObjectsAreReportedAsThat)
{
  const vtkNew<vtkPolyData> none;
  this->Chain.Planner->SetInputConnection(1, this->Made.Data(none));
  const ErrorLog errors(this->Chain.Planner);
  this->Chain.Planner->Update();
  EXPECT_TRUE(errors.Contains("Objects: no objects")) << errors.Text;

  SceneChain chain(MovingScene);
  chain.Rotation->SetInputConnection(0, this->Made.Data(none));
  const ErrorLog turned(chain.Rotation);
  chain.Rotation->Update();
  EXPECT_TRUE(turned.Contains("Tracks: no objects")) << turned.Text;
}

TEST_F(Blocks, WhatObjectsDoNotSayOfTheirSceneTheOtherInputsSay)
{
  vtkNew<vtkPolyData> bare;
  bare->ShallowCopy(this->Data(vtkMotionSceneReader::OBJECTS));
  bare->GetFieldData()->Initialize();
  this->Chain.Planner->Update();
  const std::string plain = Printed(this->Chain.Planner->GetOutputDataObject(0));
  this->Chain.Planner->SetInputConnection(1, this->Made.Data(bare));
  {
    const ErrorLog warnings(this->Chain.Planner, vtkCommand::WarningEvent);
    this->Chain.Planner->Update();
    EXPECT_EQ(warnings.Text.find("no input has"), std::string::npos) << warnings.Text;
  }
  EXPECT_EQ(Printed(this->Chain.Planner->GetOutputDataObject(0)), plain);

  // None says it: the defaults are named.
  vtkNew<vtkPolyData> rows;
  rows->ShallowCopy(this->Data(vtkMotionSceneReader::CONSTRAINTS));
  rows->GetFieldData()->Initialize();
  vtkNew<vtkStylisticPlannerFilter> alone;
  alone->SetInputConnection(0, this->Chain.Database->GetOutputPort());
  alone->SetInputConnection(1, this->Made.Data(bare));
  alone->SetInputConnection(2, this->Made.Data(rows));
  const ErrorLog warnings(alone, vtkCommand::WarningEvent);
  alone->Update();
  EXPECT_NE(
    warnings.Text.find("no input has the field data `Bounds`, `NumberOfFrames`, `FramesPerSecond` "
                       "and `Seed`: taken are a volume from (-2, -2, 0) to (2, 2, 4) m, 300 "
                       "frames, 30 a second and seed 1"),
    std::string::npos)
    << warnings.Text;
}
