// SPDX-License-Identifier: BSD-3-Clause
#include "PipelineTesting.h"

#include "../Core/Spacetime/SpacetimeScenes.h"
#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/TrackData.h"
#include "Bridge/Data/VortexData.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSPHSpacetimeFilter.h>
#include <vtkTable.h>
#include <vtkTrivialProducer.h>
#include <vtkVariant.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace
{

using namespace waft;

struct Pipeline
{
  SpacetimeInput Scene;
  vtkNew<vtkPolyData> Data[5]; // tracks, objects, constraints, obstacles, vortices
  vtkNew<vtkTrivialProducer> Producers[5];
  vtkNew<vtkSPHSpacetimeFilter> Filter;

  explicit Pipeline(bool land = true)
  {
    SceneOptions options;
    options.NumberOfFrames = 40;
    options.Land = land;
    this->Scene = MakeScene(options);
    const SceneInfo& info = this->Scene.Scene;
    TracksToPolyData(this->Scene.Tracks, info, this->Data[0]);
    ObjectsToPolyData(this->Scene.Objects, info, this->Data[1]);
    ConstraintsToPolyData(this->Scene.Constraints, info, this->Data[2]);
    ObstaclesToPolyData(this->Scene.Obstacles, 0.0, info, this->Data[3]);
    VorticesToPolyData(this->Scene.Vortices, info, this->Data[4]);
    for (int port = 0; port < 5; ++port)
    {
      this->Producers[port]->SetOutput(this->Data[port]);
      this->Filter->SetInputConnection(port, this->Producers[port]->GetOutputPort());
    }
    this->Filter->SetNumberOfGasParticles(216);
    this->Filter->SetNumberOfObjectParticles(3);
    this->Filter->SetLeashIterations(4);
    this->Filter->SetMaximumNumberOfIterations(10);
  }
  vtkDataObject* Output(int port) { return this->Filter->GetOutputDataObject(port); }
  vtkPolyData* Poly(int port) { return vtkPolyData::SafeDownCast(this->Output(port)); }
  vtkTable* Table(int port) { return vtkTable::SafeDownCast(this->Output(port)); }
  std::vector<Track> Tracks()
  {
    std::vector<Track> tracks;
    EXPECT_TRUE(TracksFromPolyData(this->Poly(0), tracks));
    return tracks;
  }
};

double FirstCost(vtkTable* log)
{
  return log->GetValueByName(0, "E").ToDouble();
}

double LastCost(vtkTable* log)
{
  return log->GetValueByName(log->GetNumberOfRows() - 1, "E").ToDouble();
}

} // namespace

TEST(SPHSpacetimeFilter, FillsItsSixPorts)
{
  Pipeline p;
  ErrorLog errors(p.Filter);
  p.Filter->Update();
  EXPECT_EQ(errors.Text, "");
  const std::vector<Track> tracks = p.Tracks();
  ASSERT_EQ(tracks.size(), 3u);
  for (std::size_t o = 0; o < 3; ++o)
  {
    EXPECT_EQ(tracks[o].Positions.front(), p.Scene.Objects[o].Position);
    EXPECT_EQ(tracks[o].Positions.back(), p.Scene.Tracks[o].Positions.back());
  }
  for (const char* name : { "Force", "AirVelocity", "SPHVelocity", "Velocity", "VortexId" })
  {
    EXPECT_TRUE(p.Poly(0)->GetPointData()->HasArray(name)) << name;
  }
  for (const char* name : { "PositionResidual", "VelocityResidual" })
  {
    vtkDataArray* residuals = p.Poly(0)->GetCellData()->GetArray(name);
    ASSERT_NE(residuals, nullptr) << name;
    EXPECT_LT(residuals->GetRange()[1], 0.02) << name;
  }
  EXPECT_EQ(p.Poly(1)->GetNumberOfPoints(), 216 + 3);
  for (const char* name : { "ParticleId", "Kind", "ObjectId", "Mass", "Velocity", "Density",
                            "Pressure", "Wind", "VortexForce" })
  {
    EXPECT_TRUE(p.Poly(1)->GetPointData()->HasArray(name)) << name;
  }
  EXPECT_EQ(p.Poly(2)->GetNumberOfCells(), 1);
  auto* wind = vtkImageData::SafeDownCast(p.Output(3));
  EXPECT_TRUE(wind->GetPointData()->HasArray("Wind"));
  int whole[6];
  p.Filter->GetOutputInformation(3)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), whole);
  for (int k = 0; k < 6; ++k)
  {
    EXPECT_EQ(wind->GetExtent()[k], whole[k]);
  }
  vtkTable* log = p.Table(4);
  ASSERT_GT(log->GetNumberOfRows(), 10);
  const vtkIdType last = log->GetNumberOfRows() - 1;
  EXPECT_EQ(log->GetValueByName(0, "Stage").ToString(), "initial");
  EXPECT_EQ(log->GetValueByName(last, "Stage").ToString(), "final");
  std::string columns;
  for (vtkIdType column = 0; column < log->GetNumberOfColumns(); ++column)
  {
    columns += std::string(" ") + log->GetColumnName(column);
  }
  EXPECT_EQ(columns, " Pass Stage Iteration E Ex Ev Ec MaxViolation Leash Seconds Clearance "
                     "Approach Contact Separation Control EvObjects Fields E2 "
                     "ShareVortices ShareWind ShareGas ShareDrag ShareLanding ShareNone");
  vtkTable* report = p.Table(5);
  ASSERT_EQ(report->GetNumberOfRows(), 3);
  for (vtkIdType row = 0; row < 3; ++row)
  {
    EXPECT_EQ(report->GetValueByName(row, "Status").ToString(), "met");
  }
  for (int port = 0; port < 6; ++port)
  {
    EXPECT_TRUE(p.Output(port)->GetFieldData()->HasArray("Bounds")) << port;
  }
}

TEST(SPHSpacetimeFilter, ServesFramesInAnyOrderFromOneSolution)
{
  Pipeline p;
  p.Filter->Update();
  const std::vector<double> steps = TimeSteps(p.Filter, 1);
  ASSERT_EQ(steps.size(), 40u);
  const WorkCount work(p.Filter);
  const auto particle = [&](int frame)
  {
    p.Filter->UpdateTimeStep(steps[frame], -1, 1, 0);
    double x[3];
    p.Poly(1)->GetPoint(216, x); // of the first object
    return Vec3(x[0], x[1], x[2]);
  };
  const Vec3 late = particle(30);
  const Vec3 early = particle(2);
  EXPECT_EQ(particle(30), late);
  const std::vector<Track> tracks = p.Tracks();
  EXPECT_LT((late - tracks[0].Positions[30]).norm(), 1e-5);
  EXPECT_LT((early - tracks[0].Positions[2]).norm(), 1e-5);
  EXPECT_EQ(work.Value, 0); // served, not solved again
  p.Filter->SetCoherenceWeight(2.0);
  p.Filter->Update();
  EXPECT_GT(work.Value, 10);
}

TEST(SPHSpacetimeFilter, NamesWhatIsWrongAndLeavesItsOutputsEmpty)
{
  Pipeline p;
  p.Data[0]->GetPoints()->SetPoint(45, 0.0, std::nan(""), 0.0);
  p.Data[0]->Modified();
  ErrorLog errors(p.Filter);
  p.Filter->Update();
  EXPECT_NE(errors.Text, "");
  EXPECT_EQ(p.Poly(0)->GetNumberOfPoints(), 0);
  EXPECT_EQ(p.Table(4)->GetNumberOfRows(), 0);

  Pipeline q;
  q.Data[2]->GetPointData()->GetArray("ObjectId")->SetComponent(1, 0, 77);
  ErrorLog unknown(q.Filter);
  q.Filter->Update();
  EXPECT_TRUE(unknown.Contains("object 77")) << unknown.Text;
  EXPECT_EQ(q.Poly(0)->GetNumberOfPoints(), 0);
}

// The plan keeps to its rows: one that has to be braked to land would have less E than any motion
// that does.
TEST(SPHSpacetimeFilter, BettersThePlan)
{
  Pipeline p(false);
  p.Filter->Update();
  EXPECT_LT(LastCost(p.Table(4)), 0.5 * FirstCost(p.Table(4)));
}

TEST(SPHSpacetimeFilter, KeepsTheBestSoFarWhenStopped)
{
  Pipeline p(false);
  const AbortBeyond stop(p.Filter, 0.4);
  p.Filter->Update();
  const std::vector<Track> tracks = p.Tracks();
  ASSERT_EQ(tracks.size(), 3u);
  EXPECT_EQ(tracks[1].Positions.front(), p.Scene.Objects[1].Position);
  EXPECT_LT(LastCost(p.Table(4)), 0.5 * FirstCost(p.Table(4)));
}

TEST(SPHSpacetimeFilter, SolvesAnewToTheSameBits)
{
  Pipeline p;
  p.Filter->Update();
  const std::vector<Track> first = p.Tracks();
  p.Filter->Continue();
  {
    const AbortBeyond stop(p.Filter, 0.4);
    p.Filter->Update();
  }
  EXPECT_NE(p.Tracks()[1].Positions, first[1].Positions);
  p.Filter->Restart();
  p.Filter->Update();
  EXPECT_EQ(std::string(p.Table(4)->GetValueByName(0, "Stage").ToString()), "initial");
  for (std::size_t o = 0; o < 3; ++o)
  {
    EXPECT_EQ(p.Tracks()[o].Positions, first[o].Positions);
  }
}

TEST(SPHSpacetimeFilter, NamesAMemoryLimitThatIsTooLow)
{
  Pipeline p;
  p.Filter->SetMemoryLimit(3.0);
  ErrorLog errors(p.Filter);
  p.Filter->Update();
  EXPECT_TRUE(errors.Contains("MemoryLimit: 3 MB, at least")) << errors.Text;
  EXPECT_EQ(p.Poly(0)->GetNumberOfPoints(), 0);
}
