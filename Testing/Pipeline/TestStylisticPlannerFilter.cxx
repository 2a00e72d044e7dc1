// SPDX-License-Identifier: BSD-3-Clause
#include "PipelineTesting.h"

#include "../Core/Planning/SwirlDatabase.h"
#include "Base/Primitives.h"
#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/DatabaseConversion.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/TrackData.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkSharedWork.h>
#include <vtkStylisticPlannerFilter.h>
#include <vtkTable.h>
#include <vtkTrivialProducer.h>
#include <vtkVariant.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

namespace
{

using namespace waft;

struct Pipeline
{
  SceneInfo Info;
  std::vector<MotionObject> Objects;
  std::vector<Constraint> Constraints;
  vtkNew<vtkMultiBlockDataSet> Database;
  vtkNew<vtkPolyData> ObjectData;
  vtkNew<vtkPolyData> ConstraintData;
  vtkNew<vtkPolyData> ObstacleData;
  vtkNew<vtkTrivialProducer> Producers[4];
  vtkNew<vtkStylisticPlannerFilter> Filter;

  Pipeline()
  {
    for (int i = 0; i < 12; ++i)
    {
      MotionObject object;
      object.ObjectId = i;
      object.Position = Vec3(-1.2 + 0.2 * i, -0.8, 2.6);
      object.RestHeight = 0.003;
      this->Objects.push_back(object);
    }
    Constraint row;
    row.ObjectId = 0;
    row.Frame = 120;
    row.Value = Vec3(0.7, 0.6, 2.2);
    this->Constraints.push_back(row);
    for (int i = 0; i < 6; ++i)
    {
      Constraint rest;
      rest.Kind = ConstraintKind::Rest;
      rest.Frame = 220;
      rest.Until = 299;
      rest.Row = 1;
      rest.Target = i;
      rest.Group = 0;
      rest.Value = Vec3(-1.0 + 0.4 * i, 1.0, 1.0);
      this->Constraints.push_back(rest);
    }
    ObstacleMesh ground;
    ground.Mesh = MakeBox(Box{ Vec3(-3, -3, -1), Vec3(3, 3, 0) });
    ObstacleMesh box;
    box.ObstacleId = 1;
    box.Mesh = MakeBox(Box{ Vec3(-0.1, -0.4, 0.0), Vec3(0.1, 0.4, 2.0) });
    DatabaseToMultiBlock(test::SwirlDatabase(), this->Database);
    ObjectsToPolyData(this->Objects, this->Info, this->ObjectData);
    ConstraintsToPolyData(this->Constraints, this->Info, this->ConstraintData);
    ObstaclesToPolyData({ ground, box }, 0.0, this->Info, this->ObstacleData);
    vtkDataObject* data[4] = { this->Database, this->ObjectData, this->ConstraintData,
                               this->ObstacleData };
    for (int port = 0; port < 4; ++port)
    {
      this->Producers[port]->SetOutput(data[port]);
      this->Filter->SetInputConnection(port, this->Producers[port]->GetOutputPort());
    }
  }
  vtkPolyData* Output(int port)
  {
    return vtkPolyData::SafeDownCast(this->Filter->GetOutputDataObject(port));
  }
  std::vector<Track> Tracks()
  {
    std::vector<Track> tracks;
    EXPECT_TRUE(TracksFromPolyData(this->Output(0), tracks));
    return tracks;
  }
};

} // namespace

// What sets it is in another library than what works by it.
TEST(StylisticPlannerFilter, TakesTheThreadsOfTheProcessesThatWorkForThisOne)
{
  const auto threads = []
  {
    const std::filesystem::directory_iterator tasks("/proc/self/task");
    return std::distance(begin(tasks), end(tasks));
  };
  vtkSMPTools::Initialize(1);
  const auto before = threads();
  Pipeline alone;
  alone.Filter->Update();
  EXPECT_EQ(threads(), before);
  vtkSharedWork::SetProcessesHere(3);
  Pipeline first;
  first.Filter->Update();
  vtkSharedWork::SetProcessesHere(1);
  vtkSMPTools::Initialize();
  EXPECT_EQ(threads(), before + 2);
}

// When it works on a thread of its own it is too late: loops of VTK may be under way on another.
TEST(StylisticPlannerFilter, ChoosesVtksThreadsWhereItIsMade)
{
  if (std::getenv("VTK_SMP_BACKEND_IN_USE") != nullptr)
  {
    GTEST_SKIP() << "they are chosen by the environment";
  }
  vtkSMPTools::SetBackend("Sequential");
  const vtkNew<vtkStylisticPlannerFilter> stage;
  EXPECT_STREQ(vtkSMPTools::GetBackend(), "STDThread");
}

TEST(StylisticPlannerFilter, PlansTracksTreesReportRowsAndVortices)
{
  Pipeline p;
  ErrorLog errors(p.Filter);
  p.Filter->Update();
  EXPECT_EQ(errors.Text, "");
  const std::vector<Track> tracks = p.Tracks();
  ASSERT_EQ(tracks.size(), 12u);
  for (const Track& track : tracks)
  {
    ASSERT_EQ(track.Positions.size(), 300u);
    EXPECT_EQ(track.Positions[0], p.Objects[track.ObjectId].Position);
    for (const Vec3& x : track.Positions)
    {
      EXPECT_TRUE(p.Info.Bounds.Contains(x));
    }
  }
  EXPECT_EQ(tracks[0].Positions[120], Vec3(0.7, 0.6, 2.2));

  std::vector<Constraint> assigned;
  ASSERT_TRUE(ConstraintsFromPolyData(p.Output(3), p.Info.Time, assigned));
  ASSERT_EQ(assigned.size(), p.Constraints.size());
  for (const Constraint& row : assigned)
  {
    ASSERT_GE(row.ObjectId, 0);
    if (row.Kind == ConstraintKind::Rest)
    {
      const Vec3 place(row.Value.x(), row.Value.y(), 0.003);
      EXPECT_LT((tracks[row.ObjectId].Positions[299] - place).norm(), 4e-9);
      EXPECT_EQ(tracks[row.ObjectId].Positions[299], tracks[row.ObjectId].Positions[220]);
    }
  }
  auto* report = vtkTable::SafeDownCast(p.Filter->GetOutputDataObject(2));
  ASSERT_EQ(report->GetNumberOfRows(), 7);
  for (vtkIdType i = 0; i < 7; ++i)
  {
    EXPECT_EQ(report->GetValueByName(i, "Status").ToString(), "met");
  }
  vtkPolyData* trees = p.Output(1);
  EXPECT_GT(trees->GetNumberOfLines(), 50);
  for (const char* name : { "ObjectId", "Span", "Tree", "Parent", "Segment", "Cost", "Frame" })
  {
    EXPECT_TRUE(trees->GetCellData()->HasArray(name)) << name;
  }
  EXPECT_GT(p.Output(4)->GetNumberOfCells(), 0);
  for (int port = 0; port < 6; ++port)
  {
    EXPECT_TRUE(p.Filter->GetOutputDataObject(port)->GetFieldData()->HasArray("Bounds")) << port;
  }
}

TEST(StylisticPlannerFilter, ServesEveryFrameFromOnePlan)
{
  Pipeline p;
  p.Filter->Update();
  const std::vector<Track> before = p.Tracks();
  const std::vector<double> steps = TimeSteps(p.Filter);
  ASSERT_EQ(steps.size(), 300u);
  const WorkCount work(p.Filter);
  for (int frame : { 250, 3, 120 })
  {
    p.Filter->UpdateTimeStep(steps[frame], -1, 1, 0);
  }
  EXPECT_EQ(work.Value, 0);
  EXPECT_EQ(p.Tracks()[5].Positions, before[5].Positions);
  p.Filter->SetSeed(9);
  p.Filter->Update();
  EXPECT_GT(work.Value, 0);
  EXPECT_NE(p.Tracks()[5].Positions, before[5].Positions);
  p.Filter->SetSeed(1);
  p.Filter->Update();
  EXPECT_EQ(p.Tracks()[5].Positions, before[5].Positions);
}

TEST(StylisticPlannerFilter, GivesTheTakeThatIsChosen)
{
  Pipeline p;
  p.Filter->SetSeed(2);
  p.Filter->Update();
  const std::vector<Track> second = p.Tracks();
  p.Filter->SetSeed(1);
  p.Filter->SetNumberOfTakes(2);
  p.Filter->SetTake(1);
  p.Filter->Update();
  EXPECT_EQ(p.Tracks()[5].Positions, second[5].Positions);
  auto* takes = vtkTable::SafeDownCast(p.Filter->GetOutputDataObject(5));
  ASSERT_EQ(takes->GetNumberOfRows(), 2);
  for (vtkIdType i = 0; i < 2; ++i)
  {
    EXPECT_EQ(takes->GetValueByName(i, "Take").ToInt(), i);
    EXPECT_EQ(takes->GetValueByName(i, "Seed").ToInt(), 1 + i);
    EXPECT_EQ(takes->GetValueByName(i, "Met").ToInt(), 7);
    EXPECT_EQ(takes->GetValueByName(i, "Rows").ToInt(), 7);
    EXPECT_GT(takes->GetValueByName(i, "Score").ToDouble(), 0.0);
  }
  p.Filter->SetTake(2);
  ErrorLog errors(p.Filter);
  p.Filter->Update();
  EXPECT_TRUE(errors.Contains("Take is 2")) << errors.Text;
}

TEST(StylisticPlannerFilter, FollowsGuidesOfTheObjectsTheyName)
{
  // Objects 6 and 7 have no row; of the two lines the second is object 6's.
  Pipeline p;
  p.Constraints.resize(1);
  ConstraintsToPolyData(p.Constraints, p.Info, p.ConstraintData);
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  for (int line = 0; line < 2; ++line)
  {
    lines->InsertNextCell(3);
    for (int k = 0; k < 3; ++k)
    {
      const vtkIdType id = points->InsertNextPoint(-0.5 * k, -0.8 + k, 2.6 - 0.5 * line);
      lines->InsertCellPoint(id);
    }
  }
  vtkNew<vtkPolyData> guides;
  guides->SetPoints(points);
  guides->SetLines(lines);
  vtkNew<vtkIntArray> ids;
  ids->SetName("ObjectId");
  ids->InsertNextValue(7);
  ids->InsertNextValue(6);
  guides->GetCellData()->AddArray(ids);
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(guides);
  p.Filter->SetInputConnection(4, producer->GetOutputPort());
  p.Filter->Update();
  const std::vector<Track> tracks = p.Tracks();
  EXPECT_LT((tracks[7].Positions[299] - Vec3(-1.0, 1.2, 2.6)).norm(), 0.081);
  EXPECT_LT((tracks[6].Positions[299] - Vec3(-1.0, 1.2, 2.1)).norm(), 0.081);

  ids->SetValue(0, 40);
  ids->Modified();
  guides->Modified();
  producer->Modified();
  ErrorLog errors(p.Filter);
  p.Filter->Update();
  EXPECT_TRUE(errors.Contains("guide of object 40")) << errors.Text;
}

TEST(StylisticPlannerFilter, NamesWhatIsWrongAndLeavesItsOutputsEmpty)
{
  Pipeline p;
  p.Database->SetBlock(0, nullptr);
  p.Database->Modified();
  ErrorLog errors(p.Filter);
  p.Filter->Update();
  EXPECT_TRUE(errors.Contains("Segments")) << errors.Text;
  EXPECT_EQ(p.Output(0)->GetNumberOfPoints(), 0);

  Pipeline q;
  q.ConstraintData->GetPointData()->GetArray("Value")->SetComponent(0, 1, std::nan(""));
  ErrorLog nan(q.Filter);
  q.Filter->Update();
  EXPECT_TRUE(nan.Contains("Value")) << nan.Text;
  EXPECT_EQ(q.Output(0)->GetNumberOfPoints(), 0);
}

TEST(StylisticPlannerFilter, StopsWhenAskedWithWhatItHas)
{
  Pipeline p;
  {
    const AbortBeyond stop(p.Filter);
    p.Filter->Update();
  }
  EXPECT_LT(p.Output(0)->GetNumberOfLines(), 12);
  p.Filter->Modified();
  p.Filter->Update();
  EXPECT_EQ(p.Output(0)->GetNumberOfLines(), 12);
}

TEST(StylisticPlannerFilter, PlansOnlyTheObjectsThatAChangeTouches)
{
  Pipeline p;
  p.Filter->Update();
  EXPECT_EQ(p.Filter->GetNumberOfPlannedObjects(), 12);
  const std::vector<Track> before = p.Tracks();
  // The row of object 0 moves.
  p.Constraints[0].Value.x() -= 0.2;
  ConstraintsToPolyData(p.Constraints, p.Info, p.ConstraintData);
  p.Producers[2]->Modified();
  p.Filter->Update();
  EXPECT_EQ(p.Filter->GetNumberOfPlannedObjects(), 1);
  const std::vector<Track> after = p.Tracks();
  ASSERT_EQ(after.size(), before.size());
  EXPECT_NE(after[0].Positions, before[0].Positions);
  for (std::size_t i = 1; i < after.size(); ++i)
  {
    EXPECT_EQ(after[i].Positions, before[i].Positions) << i;
  }
  // The same as a plan from scratch, in every table and array but the seconds.
  Pipeline fresh;
  fresh.Constraints = p.Constraints;
  ConstraintsToPolyData(fresh.Constraints, fresh.Info, fresh.ConstraintData);
  fresh.Filter->Update();
  EXPECT_EQ(fresh.Filter->GetNumberOfPlannedObjects(), 12);
  const std::vector<Track> scratch = fresh.Tracks();
  for (std::size_t i = 0; i < after.size(); ++i)
  {
    EXPECT_EQ(after[i].Positions, scratch[i].Positions) << i;
    EXPECT_EQ(after[i].VortexIds, scratch[i].VortexIds) << i;
  }
  for (const int port : { 1, 3, 4 })
  {
    ASSERT_EQ(p.Output(port)->GetNumberOfPoints(), fresh.Output(port)->GetNumberOfPoints());
    for (vtkIdType k = 0; k < p.Output(port)->GetNumberOfPoints(); ++k)
    {
      ASSERT_EQ(Vec3(p.Output(port)->GetPoint(k)), Vec3(fresh.Output(port)->GetPoint(k)));
    }
  }
  for (const int port : { 2, 6, 7 })
  {
    auto* one = vtkTable::SafeDownCast(p.Filter->GetOutputDataObject(port));
    auto* other = vtkTable::SafeDownCast(fresh.Filter->GetOutputDataObject(port));
    ASSERT_EQ(one->GetNumberOfRows(), other->GetNumberOfRows());
    EXPECT_GT(one->GetNumberOfRows(), 0);
    for (vtkIdType column = 0; column < one->GetNumberOfColumns(); ++column)
    {
      const std::string name = one->GetColumnName(column);
      for (vtkIdType row = 0;
           name != "Seconds" && name != "Planned" && row < one->GetNumberOfRows(); ++row)
      {
        EXPECT_EQ(one->GetValue(row, column).ToString(), other->GetValue(row, column).ToString())
          << port << " " << name << " " << row;
      }
    }
  }
  // An obstacle that moves may change any path: all are planned.
  double x[3];
  p.ObstacleData->GetPoint(15, x);
  p.ObstacleData->GetPoints()->SetPoint(15, x[0], x[1], x[2] + 1e-6);
  p.ObstacleData->GetPoints()->Modified();
  p.Producers[3]->Modified();
  p.Filter->Update();
  EXPECT_EQ(p.Filter->GetNumberOfPlannedObjects(), 12);
}
