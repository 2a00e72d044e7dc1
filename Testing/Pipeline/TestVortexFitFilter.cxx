// SPDX-License-Identifier: BSD-3-Clause
#include "PipelineTesting.h"

#include "Base/Random.h"
#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/TrackData.h"
#include "Bridge/Data/VortexData.h"

#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTrivialProducer.h>
#include <vtkVortexFitFilter.h>

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace waft;

Vortex Truth()
{
  Vortex v;
  v.VortexId = 7;
  v.P1 = Vec3(0.1, -0.2, 1.0);
  v.P2 = Vec3(0.5, 0.3, 3.0);
  v.Strength = 5.0;
  v.CenterTime = 2.5;
  v.Duration = 1.5;
  v.CoreRadius = 0.3;
  return v;
}

/// Three objects that circle the vortex at different heights, in a light wind.
std::vector<Track> Witnesses(const SceneInfo& info)
{
  const Vortex v = Truth();
  Random random(4);
  std::vector<Track> tracks;
  for (int t = 0; t < 3; ++t)
  {
    Track track;
    track.ObjectId = 10 + t;
    for (int k = 0; k < info.Time.NumberOfFrames; ++k)
    {
      const double time = info.Time.Time(k);
      const double angle = 2.0 * t + 0.7 * time;
      const double radius = 0.4 + 0.1 * t;
      const Vec3 x(0.3 + radius * std::cos(angle), 0.05 + radius * std::sin(angle),
                   1.5 + 0.5 * t + 0.05 * time);
      const Vec3 wind(0.2, 0.0, 0.0);
      track.Positions.push_back(x);
      track.WindAccelerations.push_back(wind);
      track.Forces.push_back(v.Acceleration(x, time) + wind + 0.02 * random.Direction());
      track.ForceTypes.push_back(ForceType::Vortex);
      track.VortexIds.push_back(v.VortexId);
      track.VortexAccelerations.push_back(Vec3::Zero());
    }
    tracks.push_back(std::move(track));
  }
  return tracks;
}

struct Pipeline
{
  SceneInfo Info;
  vtkNew<vtkPolyData> Tracks;
  vtkNew<vtkPolyData> Priors;
  vtkNew<vtkTrivialProducer> TrackProducer;
  vtkNew<vtkTrivialProducer> PriorProducer;
  vtkNew<vtkVortexFitFilter> Filter;

  explicit Pipeline(bool withPrior)
  {
    this->Info.Time.NumberOfFrames = 150;
    TracksToPolyData(Witnesses(this->Info), this->Info, this->Tracks);
    Vortex prior = Truth();
    prior.P1 += Vec3(0.2, 0.1, 0.1);
    prior.P2 += Vec3(0.1, 0.2, 0.1);
    prior.Strength = 3.5;
    prior.CenterTime = 2.9;
    VorticesToPolyData({ prior }, this->Info, this->Priors);
    this->TrackProducer->SetOutput(this->Tracks);
    this->PriorProducer->SetOutput(this->Priors);
    this->Filter->SetInputConnection(0, this->TrackProducer->GetOutputPort());
    if (withPrior)
    {
      this->Filter->SetInputConnection(1, this->PriorProducer->GetOutputPort());
    }
  }
  std::vector<Vortex> Fitted()
  {
    std::vector<Vortex> fitted;
    EXPECT_TRUE(VorticesFromPolyData(this->Filter->GetOutput(0), fitted));
    return fitted;
  }
};

} // namespace

TEST(VortexFitFilter, RecoversTheVortexAndExplainsTheForces)
{
  Pipeline p(true);
  p.Filter->SetMaximumNewVortices(0);
  p.Filter->Update();
  const auto fitted = p.Fitted();
  ASSERT_EQ(fitted.size(), 1u);
  EXPECT_EQ(fitted[0].VortexId, 7);
  EXPECT_EQ(fitted[0].ObjectCount, 3);
  EXPECT_GT(fitted[0].Confidence, 0.5);
  const Vec3 center = 0.5 * (fitted[0].P1 + fitted[0].P2);
  EXPECT_LT((center - 0.5 * (Truth().P1 + Truth().P2)).norm(), 0.05 * 4.0);
  EXPECT_NEAR(fitted[0].Strength, 5.0, 0.5);
  EXPECT_NEAR(fitted[0].CenterTime, 2.5, 0.2);

  vtkPolyData* tracks = p.Filter->GetOutput(1);
  vtkDataArray* force = tracks->GetPointData()->GetArray("Force");
  vtkDataArray* vortex = tracks->GetPointData()->GetArray("VortexForce");
  vtkDataArray* residual = tracks->GetPointData()->GetArray("ResidualForce");
  ASSERT_TRUE(force && vortex && residual);
  double squares = 0.0;
  for (vtkIdType i = 0; i < tracks->GetNumberOfPoints(); ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(force->GetComponent(i, c),
                  vortex->GetComponent(i, c) + residual->GetComponent(i, c), 1e-12);
      const double rest = residual->GetComponent(i, c) - (c == 0 ? 0.2 : 0.0);
      squares += rest * rest;
    }
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(tracks->GetNumberOfPoints())), 0.05);
  EXPECT_EQ(tracks->GetNumberOfLines(), 3);
  EXPECT_TRUE(p.Filter->GetOutput(0)->GetFieldData()->HasArray("Bounds"));
  EXPECT_TRUE(tracks->GetFieldData()->HasArray("FramesPerSecond"));
  EXPECT_FALSE(p.Tracks->GetPointData()->HasArray("VortexForce")); // the input stays as it was
}

TEST(VortexFitFilter, FindsItWithoutPriors)
{
  Pipeline p(false);
  p.Filter->Update();
  const auto fitted = p.Fitted();
  ASSERT_GE(fitted.size(), 1u);
  EXPECT_GT(fitted[0].VortexId, 7); // ids in use are not given again
  const Vec3 axis = (Truth().P2 - Truth().P1).normalized();
  EXPECT_LT((fitted[0].P2 - fitted[0].P1).normalized().cross(axis).norm(), 0.087);
}

TEST(VortexFitFilter, RunsAgainOnlyAfterAChange)
{
  Pipeline p(true);
  p.Filter->Update();
  const auto steps = TimeSteps(p.Filter);
  ExecutionCount fits(p.Filter);
  const WorkCount work(p.Filter);
  p.Filter->Update();
  EXPECT_EQ(fits.Value, 0);
  ASSERT_EQ(steps.size(), 150u);
  p.Filter->UpdateTimeStep(steps[70], -1, 1, 0);
  p.Filter->UpdateTimeStep(steps[20], -1, 1, 0);
  EXPECT_EQ(work.Value, 0);
  p.Filter->SetSeed(2);
  p.Filter->Update();
  EXPECT_GT(work.Value, 0);
}

TEST(VortexFitFilter, NamesWhatIsMissing)
{
  Pipeline p(true);
  p.Tracks->GetPointData()->RemoveArray("Force");
  ErrorLog errors(p.Filter);
  p.Filter->Update();
  EXPECT_TRUE(errors.Contains("`Force`")) << errors.Text;
  EXPECT_EQ(p.Filter->GetOutput(0)->GetNumberOfCells(), 0);
  EXPECT_EQ(p.Filter->GetOutput(1)->GetNumberOfPoints(), 0);

  Pipeline q(true);
  q.Tracks->GetPointData()->GetArray("Force")->SetComponent(5, 1, std::nan(""));
  ErrorLog nan(q.Filter);
  q.Filter->Update();
  EXPECT_TRUE(nan.Contains("Force")) << nan.Text;
  EXPECT_EQ(q.Filter->GetOutput(0)->GetNumberOfCells(), 0);
}

TEST(VortexFitFilter, StopsWhenAsked)
{
  Pipeline p(true);
  const AbortBeyond stop(p.Filter);
  p.Filter->Update();
  ASSERT_EQ(p.Filter->GetOutput(0)->GetNumberOfCells(), 1); // the prior, as good as it got
}
