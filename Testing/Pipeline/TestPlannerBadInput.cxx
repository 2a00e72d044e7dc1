// SPDX-License-Identifier: BSD-3-Clause
// What cannot be, as an artist meets it: named by row and reason, all the rest planned.
#include "PipelineTesting.h"

#include "../Core/Planning/SwirlDatabase.h"
#include "Base/Primitives.h"
#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/DatabaseConversion.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/SceneData.h"

#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>
#include <vtkStylisticPlannerFilter.h>
#include <vtkTable.h>
#include <vtkTrivialProducer.h>
#include <vtkVariant.h>

#include <gtest/gtest.h>

#include <ctime>

using namespace waft;

namespace
{

enum Port
{
  Tracks = 0,
  Report = 2,
  Flights = 6,
  ObjectReport = 7
};

struct Plan
{
  SceneInfo Info;
  MotionDatabase Database = test::SwirlDatabase();
  std::vector<MotionObject> Objects;
  std::vector<Constraint> Rows;
  std::vector<ObstacleMesh> Obstacles;
  vtkNew<vtkMultiBlockDataSet> DatabaseData;
  vtkNew<vtkPolyData> ObjectData, RowData, ObstacleData;
  vtkNew<vtkStylisticPlannerFilter> Filter;
  std::string Errors, Warnings;

  Plan()
  {
    ObstacleMesh ground;
    ground.Mesh = MakeBox(Box{ Vec3(-6, -6, -1), Vec3(6, 6, 0) });
    this->Obstacles.push_back(ground);
  }
  void AddObject(const Vec3& position)
  {
    MotionObject object;
    object.ObjectId = static_cast<int>(this->Objects.size());
    object.Position = position;
    this->Objects.push_back(object);
  }
  Constraint& AddRow(int object, int frame, const Vec3& value)
  {
    Constraint row;
    row.ObjectId = object;
    row.Frame = row.Until = frame;
    row.Value = value;
    row.Row = static_cast<int>(this->Rows.size());
    this->Rows.push_back(row);
    return this->Rows.back();
  }
  void AddBox(const Vec3& low, const Vec3& high)
  {
    ObstacleMesh box;
    box.ObstacleId = static_cast<int>(this->Obstacles.size());
    box.Mesh = MakeBox(Box{ low, high });
    this->Obstacles.push_back(box);
  }
  void Fill()
  {
    DatabaseToMultiBlock(this->Database, this->DatabaseData);
    ObjectsToPolyData(this->Objects, this->Info, this->ObjectData);
    ConstraintsToPolyData(this->Rows, this->Info, this->RowData);
    ObstaclesToPolyData(this->Obstacles, 0.0, this->Info, this->ObstacleData);
  }
  void Run()
  {
    vtkDataObject* data[4] = { this->DatabaseData, this->ObjectData, this->RowData,
                               this->ObstacleData };
    for (int port = 0; port < 4; ++port)
    {
      vtkNew<vtkTrivialProducer> producer;
      producer->SetOutput(data[port]);
      this->Filter->SetInputConnection(port, producer->GetOutputPort());
    }
    ErrorLog errors(this->Filter);
    ErrorLog warnings(this->Filter, vtkCommand::WarningEvent);
    this->Filter->Update();
    this->Errors = errors.Text;
    this->Warnings = warnings.Text;
  }
  vtkIdType NumberOfTracks()
  {
    return vtkPolyData::SafeDownCast(this->Filter->GetOutputDataObject(Tracks))->GetNumberOfLines();
  }
  std::string Cell(int port, vtkIdType row, const char* column)
  {
    auto* table = vtkTable::SafeDownCast(this->Filter->GetOutputDataObject(port));
    return row < table->GetNumberOfRows() ? table->GetValueByName(row, column).ToString()
                                          : "no such line";
  }
  /// The run failed, the message has these parts, and the outputs are empty.
  void ExpectRefused(const std::vector<std::string>& parts)
  {
    this->Run();
    for (const std::string& part : parts)
    {
      EXPECT_NE(this->Errors.find(part), std::string::npos) << this->Errors;
    }
    EXPECT_EQ(this->NumberOfTracks(), 0);
  }
};

bool Has(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

} // namespace

TEST(PlannerBadInput, StartsAndGoalsThatCannotBeAreNamedAndTheRestIsMet)
{
  Plan p;
  p.AddBox(Vec3(-1.4, -0.4, 1.6), Vec3(-0.8, 0.4, 2.4));
  p.AddObject(Vec3(-1.1, 0.0, 2.0)); // inside the box, with a row
  p.AddObject(Vec3(-1.1, 0.1, 2.1)); // inside the box, without
  p.AddObject(Vec3(0.0, 2.4, 2.0));  // outside the volume, without a row
  p.AddObject(Vec3(0.5, 0.0, 2.0));
  p.AddRow(0, 150, Vec3(0.8, 0.5, 2.0));
  p.AddRow(3, 120, Vec3(-1.1, 0.0, 2.0)); // goal inside the box
  p.AddRow(3, 160, Vec3(0.0, 0.0, 4.5));  // goal above the volume
  p.AddRow(3, 220, Vec3(1.2, 0.6, 2.2));
  p.Fill();
  p.Run();
  EXPECT_EQ(p.Errors, "");
  EXPECT_EQ(p.NumberOfTracks(), 4);
  const std::string first = p.Cell(Report, 0, "Message");
  EXPECT_TRUE(Has(first, "object 0 at its start: ") && Has(first, "inside obstacle 1")) << first;
  EXPECT_EQ(p.Cell(Report, 1, "Status"), "infeasible");
  EXPECT_TRUE(Has(p.Cell(Report, 1, "Message"), "inside obstacle 1"));
  EXPECT_EQ(p.Cell(Report, 2, "Status"), "infeasible");
  EXPECT_TRUE(Has(p.Cell(Report, 2, "Message"), "outside the volume"));
  EXPECT_EQ(p.Cell(Report, 3, "Status"), "met");
  // Objects without rows: their own line, and a warning, since the report has no line of theirs.
  EXPECT_EQ(p.Cell(ObjectReport, 1, "Status"), "infeasible");
  EXPECT_TRUE(Has(p.Cell(ObjectReport, 1, "Message"), "object 1 at its start: the position"));
  EXPECT_TRUE(Has(p.Cell(ObjectReport, 2, "Message"), "outside the volume"));
  EXPECT_TRUE(Has(p.Warnings, "object 1 at its start")) << p.Warnings;
  EXPECT_TRUE(Has(p.Warnings, "object 2 at its start")) << p.Warnings;
  EXPECT_FALSE(Has(p.Warnings, "object 0")) << p.Warnings;
  EXPECT_EQ(p.Cell(ObjectReport, 3, "Rows"), "3");
  EXPECT_EQ(p.Cell(ObjectReport, 3, "Met"), "1");
  EXPECT_EQ(p.Cell(ObjectReport, 3, "Status"), "infeasible");
}

TEST(PlannerBadInput, SurfacesThatAreNoSolidAreRefusedByName)
{
  Plan open;
  open.AddObject(Vec3(0.5, 0.0, 2.0));
  open.AddBox(Vec3(-1.4, -0.4, 1.6), Vec3(-0.8, 0.4, 2.4));
  open.Obstacles[1].Mesh.Triangles.pop_back();
  open.Fill();
  open.ExpectRefused({ "obstacle 1", "closed" });

  Plan cut;
  cut.AddObject(Vec3(0.5, 0.0, 2.0));
  cut.AddBox(Vec3(-1.4, -0.4, 1.6), Vec3(-0.8, 0.4, 2.4));
  std::swap(cut.Obstacles[1].Mesh.Points[4], cut.Obstacles[1].Mesh.Points[5]); // its top crosswise
  cut.Fill();
  cut.ExpectRefused({ "obstacle 1", "cuts itself" });

  Plan overlapping; // several that touch or overlap are fine
  overlapping.AddObject(Vec3(0.5, 0.0, 2.0));
  overlapping.AddBox(Vec3(-1.4, -0.4, 0.0), Vec3(-0.8, 0.4, 2.4));
  overlapping.AddBox(Vec3(-1.0, -0.4, -0.2), Vec3(-0.2, 0.4, 1.4));
  overlapping.Fill();
  overlapping.Run();
  EXPECT_EQ(overlapping.Errors, "");
  EXPECT_EQ(overlapping.NumberOfTracks(), 1);
}

TEST(PlannerBadInput, ADatabaseOfFarOtherRateIsSaidSoAndOneOfAnotherVolumeScaled)
{
  const auto flown = [](double rate, double half)
  {
    Plan p;
    p.Info.Time.FramesPerSecond = rate;
    p.Info.Bounds = Box{ Vec3(-half, -half, 0), Vec3(half, half, 2.0 * half) };
    p.AddObject(Vec3(0.5, 0.0, 1.8));
    p.AddRow(0, 100, Vec3(0.0, 0.5, 1.8));
    p.Fill();
    p.Run();
    EXPECT_EQ(p.Errors, "");
    return std::string(p.Warnings);
  };
  EXPECT_EQ(flown(30.0, 2.0), "");
  EXPECT_EQ(flown(24.0, 2.28), "");
  EXPECT_EQ(flown(60.0, 4.0), "");
  EXPECT_EQ(flown(30.0, 40.0), "");
  const std::string far = flown(61.0, 4.1);
  EXPECT_TRUE(Has(far, "traced at 30 frames per second, the scene has 61")) << far;
  EXPECT_TRUE(Has(flown(14.0, 2.0), "the scene has 14"));
}

TEST(PlannerBadInput, MoreTargetsThanObjectsAreNamedAndTheOthersMet)
{
  Plan p;
  p.AddObject(Vec3(0.5, 0.0, 2.0));
  p.AddObject(Vec3(-0.5, 0.0, 2.0));
  for (int k = 0; k < 3; ++k)
  {
    Constraint& row = p.AddRow(-1, 150, Vec3(-0.8 + 0.8 * k, 0.8, 2.2));
    row.Row = row.Group = 0;
    row.Target = k;
  }
  p.Fill();
  p.Run();
  int met = 0;
  for (int line = 0; line < 3; ++line)
  {
    const bool isMet = p.Cell(Report, line, "Status") == "met";
    met += isMet;
    EXPECT_EQ(p.Cell(Report, line, "Target"), std::to_string(line));
    if (!isMet) // the one that costs most
    {
      EXPECT_EQ(p.Cell(Report, line, "Status"), "infeasible");
      EXPECT_EQ(p.Cell(Report, line, "ObjectId"), "-1");
      EXPECT_TRUE(Has(p.Cell(Report, line, "Message"), "at most as many targets as objects"))
        << p.Cell(Report, line, "Message");
    }
  }
  EXPECT_EQ(met, 2);
}

TEST(PlannerBadInput, NoFramesAreRefused)
{
  Plan p;
  p.AddObject(Vec3(0.5, 0.0, 2.0));
  p.Fill();
  vtkNew<vtkIntArray> frames;
  frames->SetName("NumberOfFrames");
  frames->InsertNextValue(0);
  p.ObjectData->GetFieldData()->AddArray(frames);
  p.ExpectRefused({ "`NumberOfFrames`", "at least 1" });

  Plan late;
  late.AddObject(Vec3(0.5, 0.0, 2.0));
  late.AddRow(0, 300, Vec3(0.0, 0.5, 2.0));
  late.Fill();
  late.ExpectRefused({ "vertex 0", "`Frame`", "0 to 299" });
}

// At the default limit of branches.
TEST(PlannerBadInput, ASealedMarkEndsInTimeWithTheNearestApproach)
{
  Plan p;
  p.AddObject(Vec3(-1.5, 0.0, 2.0));
  p.AddObject(Vec3(-1.2, 0.8, 2.4));
  // A closed room about the goal.
  p.AddBox(Vec3(0.8, -0.6, 1.4), Vec3(0.9, 0.6, 2.6));
  p.AddBox(Vec3(1.9, -0.6, 1.4), Vec3(2.0, 0.6, 2.6));
  p.AddBox(Vec3(0.8, -0.7, 1.4), Vec3(2.0, -0.6, 2.6));
  p.AddBox(Vec3(0.8, 0.6, 1.4), Vec3(2.0, 0.7, 2.6));
  p.AddBox(Vec3(0.8, -0.7, 1.3), Vec3(2.0, 0.7, 1.4));
  p.AddBox(Vec3(0.8, -0.7, 2.6), Vec3(2.0, 0.7, 2.7));
  p.AddRow(0, 200, Vec3(1.4, 0.0, 2.0));
  p.AddRow(1, 200, Vec3(0.2, 0.6, 2.2));
  p.Fill();
  const std::clock_t begin = std::clock();
  p.Run();
  EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 60.0);
  EXPECT_EQ(p.Cell(Report, 0, "Status"), "unreachable");
  EXPECT_TRUE(Has(p.Cell(Report, 0, "Message"), "no path found in the limits"))
    << p.Cell(Report, 0, "Message");
  EXPECT_TRUE(Has(p.Cell(Report, 0, "Message"), "comes within"));
  const double residual = std::stod(p.Cell(Report, 0, "Residual"));
  EXPECT_GT(residual, 0.5);
  EXPECT_LT(residual, 2.9) << "nearer than where it started";
  EXPECT_EQ(p.Cell(Report, 1, "Status"), "met");
  EXPECT_EQ(p.Cell(Flights, 0, "Reached"), "0");
  EXPECT_EQ(p.Cell(Flights, 1, "Reached"), "1");
  EXPECT_GT(std::stod(p.Cell(Flights, 0, "Seconds")), 0.0);
  EXPECT_GT(std::stoi(p.Cell(Flights, 0, "Branches")), 0);
  EXPECT_GE(std::stod(p.Cell(ObjectReport, 0, "Seconds")),
            std::stod(p.Cell(Flights, 0, "Seconds")));
}
